//! Whether the least S on a triangle lies on what it shares with a neighbour, and how it goes on from there into that
//! one.

use super::boundary::{Feature, Triangle};
use crate::pair::body::Body;
use crate::particle::particle::Particle;
use crate::particle::potential;
use crate::pose::Pose;
use crate::settings::Settings;
use nalgebra::Vector3;

/// Steps of Newton's method along an edge: from the point of the last step, one or two (chosen).
const STEPS: usize = 6;
/// Slopes of S, relative to |∇S|, that are clear: a rise into the triangle or a fall into its neighbour. Chosen: below
/// it the contact is solved.
const CLEAR: f64 = 1e-4;
/// Vertices within this share of the size are one. Chosen: far above rounding.
const SAME: f64 = 1e-9;
/// Bound on the change of the slopes on the way to the exact point, over `CLEAR`. Chosen: below 1.
const DOUBT: f64 = 0.5;

/// How S goes on into a neighbour from the point where it is least on a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Onwards {
    /// It falls: that point has no contact, as it is not the least of both.
    Falls,
    /// It rises: that point is the least of both.
    Rises,
    /// The point lies elsewhere, or has S ≥ 1, or only a solution can tell.
    Unknown,
}

/// Of A at this pose, whether S is least on this edge or vertex of the triangle, and how it goes on from there into a
/// neighbour that shares it, as [`super::contact_with_triangle`] and the slope of its answer say.
///
/// `share`: on an edge the place of the least S, from its first vertex to the next one, 0 to 1: a guess, replaced by
/// what was found.
///
/// On an edge S is convex, and its curvature at least that of the shadow sphere: a residual slope bounds the way to the
/// least S, and that way, times the curvature, the error of the slopes into both triangles.
pub fn onwards_from_seam(
    a: &Particle,
    pose: &Pose,
    triangle: &Triangle,
    feature: Feature,
    neighbour: &Triangle,
    settings: &Settings,
    share: &mut f64,
) -> Onwards {
    let body = Body::alone(a, settings.least_sphericity());
    let local = |vertices: &[Vector3<f64>; 3]| vertices.map(|x| pose.rotation().tr_mul(&(x - pose.position())));
    let (own, others) = (local(triangle.vertices()), local(neighbour.vertices()));
    let (x, doubt, into, shared) = match (feature.edge(), feature.vertex()) {
        (None, None) => return Onwards::Unknown,
        (None, Some(i)) => (own[i], 0.0, [own[(i + 1) % 3], own[(i + 2) % 3]], [own[i]; 2]),
        (Some(i), _) => {
            let third = own[(i + 2) % 3];
            let Some((x, doubt)) = least_on_edge(&body, &own[i], &own[(i + 1) % 3], share) else {
                return Onwards::Unknown;
            };
            (x, doubt, [third; 2], [own[i], own[(i + 1) % 3]])
        }
    };
    let here = potential::turned(a, body.weights(), |n| n, &x, 0.0, |_, excess| excess > 0.0);
    let steep = here.gradient.norm();
    // On the way to the exact point no plane may switch, and the slopes change by no more than the curvature allows.
    let is_one_quadratic = doubt * a.bounds.longest_normal < here.clear || doubt == 0.0;
    let off = doubt * here.hessian.diagonal().sum();
    let is_known = is_one_quadratic && off <= DOUBT * CLEAR * steep && steep * a.bounding_radius() > CLEAR;
    if !is_known || here.value >= 1.0 {
        return Onwards::Unknown;
    }
    let slope = |to: &Vector3<f64>| {
        let way = to - x;
        here.gradient.dot(&way) / (steep * way.norm())
    };
    if !into.iter().all(|vertex| slope(vertex) > CLEAR) {
        return Onwards::Unknown;
    }
    // On the shared part itself S does not fall; into the neighbour it goes as towards the vertices beyond.
    let is_shared =
        |vertex: &&Vector3<f64>| shared.iter().any(|own| (own - **vertex).norm() <= SAME * a.bounding_radius());
    let mut slopes = others.iter().filter(|vertex| !is_shared(vertex)).map(slope);
    let (first, second, third) = (slopes.next(), slopes.next(), slopes.next());
    let is_edge = feature.edge().is_some();
    let (Some(first), None) = (first, third) else { return Onwards::Unknown };
    // A neighbour has one vertex beyond a shared edge, two beyond a shared vertex.
    if is_edge == second.is_some() {
        return Onwards::Unknown;
    }
    let low = second.map_or(first, |second| first.min(second));
    if low < -CLEAR {
        Onwards::Falls
    } else if low > CLEAR {
        Onwards::Rises
    } else {
        Onwards::Unknown
    }
}

/// The least S between two points, and a bound on the way to it; none where it lies at one of them or is not found.
fn least_on_edge(body: &Body, from: &Vector3<f64>, to: &Vector3<f64>, share: &mut f64) -> Option<(Vector3<f64>, f64)> {
    let (particle, weights) = (body.particle, body.weights());
    let along = to - from;
    let length = along.norm();
    let unit = along / length;
    let mut way = *share * length;
    for _ in 0..STEPS {
        let x = from + way * unit;
        let line = potential::on_line(particle, weights, &x, &unit);
        let step = line.slope / line.curvature;
        // The slope and its rounding: that of the place, times the curvature of the terms of S.
        let rounding = 64.0 * f64::EPSILON * (x.norm() + length) * line.curvature;
        let doubt = (line.slope.abs() + rounding) / (2.0 * weights.sphere);
        if step.abs() <= 1e-13 * (particle.bounding_radius() + length) || !step.is_finite() {
            *share = way / length;
            return (way > doubt && length - way > doubt).then_some((x, doubt));
        }
        way -= step;
        if !(0.0..=length).contains(&way) {
            return None;
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::contact_with_triangle;
    use crate::contact::contact::Kind;
    use crate::pair::scattered;

    /// The slope test at the common edge of two triangles orders them as their least s.
    #[test]
    fn the_way_of_s_over_a_seam_is_that_of_the_least_s_on_both_sides() {
        let cube = Particle::cube(0.4, 0.1, 0.05, 0.9);
        let settings = Settings::DEFAULT.with_solve_separated(true);
        let (mut falls, mut rises, mut unknown) = (0, 0, 0);
        for seed in 0..4000 {
            let mut chance = scattered(40 * seed);
            let mut vector = || Vector3::<f64>::from_fn(|_, _| chance());
            // A ridge or a valley along x, and a cube about its height.
            let (turn, at, slopes, moved) = (vector(), vector(), vector(), 1e-3 * vector());
            let ends = [Vector3::new(-1.0, 0.0, 0.0), Vector3::new(1.0, 0.05 * slopes.z, 0.0)];
            let (left, right) = (Vector3::new(0.1, 1.0, slopes.x), Vector3::new(-0.1, -1.0, slopes.y));
            let triangle = |v: [Vector3<f64>; 3]| Triangle::new(v.map(Into::into)).unwrap();
            let own = triangle([ends[0], ends[1], left]);
            let other = triangle([ends[1], ends[0], right]);
            let centre = Vector3::new(0.8 * at.x, 0.3 * at.y, 0.35 + 0.25 * at.z);
            let pose = |x: Vector3<f64>| Pose::new(x.into(), [0.6, turn.x, turn.y, turn.z]).unwrap();
            let solved = |triangle, pose| contact_with_triangle(&cube, &pose, triangle, &settings, None).unwrap();
            let before = solved(&own, pose(centre));
            let mut share = 0.5 * (before.on_boundary.x + 1.0);
            if !(0.0..=1.0).contains(&share) {
                continue;
            }
            let now = pose(centre + moved);
            let way = onwards_from_seam(&cube, &now, &own, before.feature, &other, &Settings::default(), &mut share);
            let (here, there) = (solved(&own, now), solved(&other, now));
            let clear = here.gap + there.gap;
            match way {
                Onwards::Unknown => unknown += 1,
                Onwards::Falls => {
                    assert!(there.s < here.s, "{seed}: {} there, {} here", there.s, here.s);
                    falls += 1;
                }
                Onwards::Rises => {
                    assert!((there.s - here.s).abs() <= clear, "{seed}: {} there, {} here", there.s, here.s);
                    rises += 1;
                }
            }
            if way != Onwards::Unknown {
                assert!(here.kind == Kind::Overlapping && here.feature == before.feature, "{seed}: {here:?}");
                let on_edge = ends[0] + share * (ends[1] - ends[0]);
                let is_edge = before.feature == Feature::Edge0;
                assert!(!is_edge || (on_edge - here.on_boundary).norm() < 1e-8, "{seed}: {on_edge}");
            }
        }
        assert!(falls > 100 && rises > 100, "{falls} fall, {rises} rise, {unknown} unknown");
    }

    #[test]
    fn inside_a_triangle_and_apart_nothing_is_known() {
        let ball = Particle::sphere(1.0).unwrap();
        let own = Triangle::new([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]).unwrap();
        let other = Triangle::new([[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, -1.0, 0.0]]).unwrap();
        let way = |pose: [f64; 3], feature, other: &Triangle| {
            let pose = Pose::at(pose).unwrap();
            onwards_from_seam(&ball, &pose, &own, feature, other, &Settings::default(), &mut 0.5)
        };
        let edge = Feature::Edge0;
        // A ridge, seen from its edge.
        let down = Triangle::new([[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, -0.1, -1.0]]).unwrap();
        assert_eq!(way([0.5, -0.2, 0.9], edge, &other), Onwards::Falls);
        assert_eq!(way([0.5, -0.2, 0.9], Feature::Interior, &other), Onwards::Unknown);
        assert_eq!(way([0.5, -0.2, 1.1], edge, &other), Onwards::Unknown); // apart
        assert_eq!(way([0.5, 0.2, 0.9], edge, &other), Onwards::Unknown); // the least lies inside
        assert_eq!(way([0.5, -0.3, 0.9], edge, &down), Onwards::Rises);
    }
}
