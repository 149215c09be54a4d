//! Triangles that share an edge or a vertex: where both contacts lie on it, they must be the same to the last bit.

use crate::pair_line::{Place, Shape};
use crate::random::Random;
use crate::stress::boundaries::{beside, particle_of, place_of};
use crate::stress::cases::stream;
use crate::stress::ledger::{Fault, Finding, Ledger};
use crate::stress::placed_boundary::Boundary;
use nalgebra::Vector3;
use potential_particles::{Feature, Flags, FlatContact, Particle, Settings, Triangle, contact_with_triangle};
use serde::Serialize;

/// Triangles of a mesh, by the numbers of their vertices.
#[derive(Clone, Debug, Serialize)]
struct Mesh {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[usize; 3]>,
}

#[derive(Serialize)]
struct Written<'a> {
    #[serde(rename = "A")]
    a: Shape,
    #[serde(rename = "a")]
    at: Place,
    mesh: &'a Mesh,
    pair: [usize; 2],
    answers: [String; 2],
}

/// The part of a mesh on which a contact lies: the numbers of its vertices, in order.
fn part(feature: Feature, triangle: &[usize; 3]) -> Vec<usize> {
    let mut part = match (feature.edge(), feature.vertex()) {
        (Some(i), _) => vec![triangle[i], triangle[(i + 1) % 3]],
        (None, Some(i)) => vec![triangle[i]],
        (None, None) => triangle.to_vec(),
    };
    part.sort_unstable();
    part
}

/// A random triangle beside a particle, made part of a mesh: another on one of its edges, or a fan about one of its
/// vertices.
fn mesh(particle: &Particle, at: &Place, random: &mut Random) -> (Mesh, String) {
    loop {
        let (boundary, how) = beside(particle, at, random);
        let Boundary::Triangle(first) = boundary else { continue };
        let fan = random.uniform() < 0.4;
        let flat = random.uniform() < 0.5;
        let [a, b, c] = first.map(Vector3::from);
        let normal = (b - a).cross(&(c - a)).normalize();
        let bend = |random: &mut Random| if flat { 0.0 } else { 0.5 * random.normal() };
        let mut mesh = Mesh { vertices: first.to_vec(), triangles: vec![[0, 1, 2]] };
        let count = if fan { random.whole(2, 6) } else { 1 };
        for i in 0..count {
            // A fan goes on from the last vertex about the first; a pair shares the edge of the first two.
            let (hinge, last) = if fan { (a, Vector3::from(mesh.vertices[i + 2])) } else { (a, b) };
            let side = last - hinge;
            let across = normal.cross(&side) * if fan { 1.0 } else { -1.0 };
            let (u, v) = (0.3 + random.uniform(), 0.3 + random.uniform());
            let next = hinge + (if fan { 0.3 * u } else { random.uniform() }) * side + v * across;
            let next = next + bend(random) * side.norm() * normal;
            mesh.vertices.push(next.into());
            let new = mesh.vertices.len() - 1;
            mesh.triangles.push(if fan { [0, new - 1, new] } else { [1, 0, new] });
        }
        // Seen from any vertex, and from either side.
        for triangle in &mut mesh.triangles {
            triangle.rotate_left(random.whole(0, 3));
            if random.uniform() < 0.3 {
                triangle.swap(0, 1);
            }
        }
        let corners = |t: &[usize; 3]| t.map(|i| mesh.vertices[i]);
        if mesh.triangles.iter().all(|t| Triangle::new(corners(t)).is_ok()) {
            let kind = if fan { "fan" } else { "pair" };
            let how = how.trim_start_matches("triangle ");
            return (mesh, format!("{}{kind} {how}", if flat { "flat " } else { "" }));
        }
    }
}

/// Case `index`: what is found is added to the ledger.
pub fn one(seed: u64, index: u64, ledger: &mut Ledger) {
    let mut random = stream(seed, 13, index);
    let (particle, name) = particle_of(&mut stream(seed, 14, index / 4), index / 4);
    let at = place_of(&particle, &mut random);
    let (mesh, how) = mesh(&particle, &at, &mut random);
    let family = format!("{name} | {how}");
    *ledger.families.entry(family.clone()).or_default() += 1;
    let settings = Settings::default().with_solve_separated(true);
    let pose = at.pose();
    let answers: Vec<Option<FlatContact>> = mesh
        .triangles
        .iter()
        .map(|t| {
            let triangle = Triangle::new(t.map(|i| mesh.vertices[i])).expect("a triangle of a mesh that was checked");
            // That there is an answer is judged among the walls.
            contact_with_triangle(&particle, &pose, &triangle, &settings, None).ok()
        })
        .collect();
    for i in 0..answers.len() {
        for j in 0..i {
            let (Some(one), Some(other)) = (&answers[i], &answers[j]) else { continue };
            ledger.judged += 1;
            let Some(detail) = differ((one, &mesh.triangles[i]), (other, &mesh.triangles[j])) else { continue };
            let written = Written {
                a: (&particle).into(),
                at,
                mesh: &mesh,
                pair: [i, j],
                answers: [format!("{one:?}"), format!("{other:?}")],
            };
            let case = serde_json::to_value(written).unwrap_or_default();
            let (family, planes) = (family.clone(), particle.plane_count());
            ledger.find(Finding { fault: Fault::Seam, family, seed, index, detail, case, planes });
        }
    }
}

/// What differs, if both lie on what they share.
fn differ(
    (one, of_one): (&FlatContact, &[usize; 3]),
    (other, of_other): (&FlatContact, &[usize; 3]),
) -> Option<String> {
    let (part_one, part_other) = (part(one.feature, of_one), part(other.feature, of_other));
    let shared = |part: &[usize]| part.iter().all(|v| of_one.contains(v) && of_other.contains(v));
    if !(shared(&part_one) && shared(&part_other)) {
        return None;
    }
    if part_one != part_other {
        // On one vertex of two, or on an edge beside them: only where they share the edge can both not be right.
        return Some(format!("vertices {part_one:?} and {part_other:?} of the mesh, s={:e} and {:e}", one.s, other.s));
    }
    let bits = |v: &Vector3<f64>| <[f64; 3]>::from(*v).map(f64::to_bits);
    let place = |c: &FlatContact| (c.s.to_bits(), bits(&c.on_boundary));
    let way = |c: &FlatContact| (c.overlap.to_bits(), bits(&c.normal), bits(&c.point));
    // In the core of the particle the normal is that of the triangle.
    let is_own = [one, other].iter().any(|c| c.flags.contains(Flags::NORMAL_BY_BOUNDARY));
    let same = place(one) == place(other) && (is_own || way(one) == way(other));
    (!same).then(|| {
        let off = (one.on_boundary - other.on_boundary).norm();
        format!("on vertices {part_one:?}: s={:e} and {:e}, points {off:e} apart", one.s, other.s)
    })
}
