//! Force and torque against −∂W of random pairs, of particles on a plane and of particles in a closed mesh.
//!
//! The energy is another integral over the patch, and its differences know nothing of the force. They are taken with
//! three steps, of which the best counts: a long one meets jumps of the third derivative, where a plane goes on, and a
//! short one divides the tolerance of the energy by little.

use kit::patch::bodies::{Chance, FAMILIES, Pair, body, difference, mesh_of_box};
use nalgebra::{UnitQuaternion, Vector3};
use potential_particles::{
    Kind, Particle, Patch, PatchFlags, PatchScratch, PatchSettings, Pose, Settings, Triangle, Wall, contact_with_plane,
    contact_with_triangle, patch_of_contact, patch_on_plane, patch_on_triangle,
};

/// Tolerance of force and energy.
const TOLERANCE: f64 = 1e-9;

/// Estimated error from which on a patch has used up its rays, and says so: no reference for 1e-6.
const SETTLED: f64 = 1e-7;

/// Steps over the overlap.
const STEPS: [f64; 3] = [3e-2, 1e-2, 3e-3];

const SPHERICITIES: [f64; 4] = [0.0, 1e-6, 0.02, 0.3];
const ROUNDINGS: [f64; 3] = [0.05, 0.3, 0.9];
const DEPTHS: [f64; 3] = [0.01, 0.1, 0.3];

/// On the body that moves, about its centre; the largest estimated error.
#[derive(Clone, Copy, Default)]
struct Wrench {
    force: Vector3<f64>,
    torque: Vector3<f64>,
    energy: f64,
    error: f64,
    is_folded: bool,
}

impl Wrench {
    /// A patch of which the body that moves is B (sign 1) or A (sign −1); `arm`: from its centre to the contact point.
    fn add(&mut self, patch: &Patch, sign: f64, arm: &Vector3<f64>) {
        self.force += sign * patch.force;
        self.torque += sign * (patch.torque + arm.cross(&patch.force));
        self.energy += patch.energy;
        self.error = self.error.max(patch.error);
        self.is_folded |= patch.flags.contains(PatchFlags::FOLDED);
    }
}

/// What came out for one kind of contacts.
pub struct Outcome {
    pub kind: &'static str,
    pub worst: f64,
    pub of_99: f64,
    /// How many were compared, folded, and were not settled.
    pub counts: [usize; 3],
}

/// So many random contacts of each kind.
pub fn measure(pairs: usize) -> [Outcome; 3] {
    let some = (pairs / 10).max(10);
    [of("pairs", pairs, pair), of("on a plane", some, plane), of("in a closed mesh", some, mesh)]
}

type Moved = Box<dyn Fn(Vector3<f64>, Vector3<f64>, bool) -> Wrench>;

/// `make`: a contact as a function of a shift and a turn, whether with its energy; its overlap, and the size of the
/// body.
fn of(kind: &'static str, count: usize, make: impl Fn(&mut Chance) -> (Moved, f64, f64)) -> Outcome {
    let mut chance = Chance::new(2024);
    let (mut errors, mut counts) = (Vec::new(), [0; 3]);
    for _ in 0..count {
        let (moved, overlap, size) = make(&mut chance);
        let (along, about) = (chance.direction(), chance.direction());
        let none = Vector3::zeros();
        let here = moved(none, none, false);
        let with_energy = moved(none, none, true);
        if here.is_folded || with_energy.is_folded {
            counts[1] += 1;
        } else if here.error.max(with_energy.error) > SETTLED {
            counts[2] += 1;
        } else {
            let force = here.force.norm();
            let least = |slope: &dyn Fn(f64) -> f64, exact: f64| {
                STEPS.iter().map(|step| (slope(step * overlap) + exact).abs() / force).fold(f64::INFINITY, f64::min)
            };
            let by_shift = |h: f64| difference(|h| moved(h * along, none, true).energy, h);
            let by_turn = |h: f64| difference(|h| moved(none, h / size * about, true).energy, h);
            errors.push(least(&by_shift, here.force.dot(&along)).max(least(&by_turn, here.torque.dot(&about) / size)));
        }
    }
    errors.sort_by(f64::total_cmp);
    counts[0] = errors.len();
    let at = |place: usize| errors.get(place).copied().unwrap_or(f64::INFINITY);
    Outcome { kind, worst: at(errors.len().wrapping_sub(1)), of_99: at(errors.len() * 99 / 100), counts }
}

fn settings(with_energy: bool) -> PatchSettings {
    PatchSettings { tolerance: TOLERANCE, with_energy, ..PatchSettings::default() }
}

fn pair(chance: &mut Chance) -> (Moved, f64, f64) {
    let families = [chance.pick(&FAMILIES), chance.pick(&FAMILIES)];
    let k = [chance.pick(&SPHERICITIES), chance.pick(&SPHERICITIES)];
    let pair = Pair::random(families, k, chance.pick(&ROUNDINGS), chance.pick(&DEPTHS), chance);
    let (overlap, size) = (pair.contact.overlap, pair.contact.branch_b.norm().max(0.1));
    let moved = move |shift, turn, with_energy| {
        let Pair { a, b, pose_a, pose_b, contact } = pair.moved(&shift, &turn);
        let scratch = &mut PatchScratch::new();
        let found = patch_of_contact(&a, &pose_a, &b, &pose_b, &contact, &settings(with_energy), scratch, |_| ());
        let mut wrench = Wrench::default();
        wrench.add(&found.expect("a patch"), 1.0, &contact.branch_b);
        wrench
    };
    (Box::new(moved), overlap, size)
}

/// A particle whose patches with a boundary are added up, and sinks in along a direction as deep as asked.
fn boundary(chance: &mut Chance, on: fn(&Particle, &Pose, bool) -> Wrench) -> (Moved, f64, f64) {
    let a = body(chance.pick(&FAMILIES), chance.pick(&ROUNDINGS), chance.pick(&SPHERICITIES), chance);
    let (turn, direction) = (chance.rotation(), chance.direction());
    let direction = Vector3::new(direction.x, direction.y, direction.z.abs());
    let rounding = if a.sphericity() == 1.0 { 0.3 } else { a.rounding_radius() };
    let overlap = chance.pick(&DEPTHS) * rounding;
    let at = |distance: f64| Pose::from_rotation((distance * direction).into(), &turn).expect("a pose");
    let (mut deep, mut apart) = (0.0, 20.0);
    for _ in 0..60 {
        let middle = 0.5 * (deep + apart);
        if on(&a, &at(middle), false).force.norm() > 0.0 { deep = middle } else { apart = middle }
    }
    let (start, size) = (*at(deep - overlap).position(), a.bounding_radius());
    let moved = move |shift: Vector3<f64>, by: Vector3<f64>, with_energy| {
        let rotation = UnitQuaternion::from_scaled_axis(by).to_rotation_matrix().into_inner() * turn;
        on(&a, &Pose::from_rotation((start + shift).into(), &rotation).expect("a pose"), with_energy)
    };
    (Box::new(moved), overlap, size)
}

fn plane(chance: &mut Chance) -> (Moved, f64, f64) {
    boundary(chance, |a, pose, with_energy| {
        let wall = Wall::new([0.0; 3], [0.0, 0.0, 1.0]).expect("a plane");
        let contact = contact_with_plane(a, pose, &wall, &Settings::default(), None).expect("a contact");
        let mut wrench = Wrench::default();
        if contact.kind == Kind::Overlapping {
            let found = patch_on_plane(a, pose, &contact, &settings(with_energy), &mut PatchScratch::new(), |_| ());
            wrench.add(&found.expect("a patch"), -1.0, &(contact.on_boundary - pose.position()));
        }
        wrench
    })
}

/// On the outside of a box of triangles.
fn mesh(chance: &mut Chance) -> (Moved, f64, f64) {
    boundary(chance, |a, pose, with_energy| {
        let mut wrench = Wrench::default();
        for vertices in mesh_of_box([0.8, 1.0, 0.6]) {
            let triangle = Triangle::new(vertices).expect("a triangle");
            let contact = contact_with_triangle(a, pose, &triangle, &Settings::default(), None).expect("a contact");
            if contact.kind == Kind::Overlapping {
                let scratch = &mut PatchScratch::new();
                let found =
                    patch_on_triangle(a, pose, &triangle, true, &contact, &settings(with_energy), scratch, |_| ());
                wrench.add(&found.expect("a patch"), -1.0, &(contact.on_boundary - pose.position()));
            }
        }
        wrench
    })
}
