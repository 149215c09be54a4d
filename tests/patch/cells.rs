//! Patches in cells against the same by rays, which share nothing with them but the walk through a cell.

use kit::patch::bodies::{Chance, FAMILIES, Pair, body, facing, grain};
use kit::patch::boundaries::{Boundary, resting, triangle_over};
use nalgebra::{Matrix3, Vector3};
use potential_particles::{
    Particle, Patch, PatchFlags, PatchScratch, PatchSettings, Pose, Triangle, Wall, patch_of_contact,
};

/// A tolerance for which rays alone serve.
const BY_RAYS: f64 = 5e-9;

/// The patch at a tolerance.
type Taken = Box<dyn Fn(f64) -> Patch>;

fn pair(chance: &mut Chance) -> Option<Taken> {
    let (k, depth) = ([0; 2].map(|_| chance.pick(&[0.0, 1e-6, 0.02, 0.3])), 10f64.powf(-3.0 * chance.uniform()));
    let pair = if chance.uniform() < 0.5 {
        let families = [0; 2].map(|_| chance.pick(&FAMILIES));
        let r = chance.pick(&[1e-4, 1e-2, 0.1, 0.5]);
        Pair::random(families, k, r, 0.8 * depth, chance)
    } else {
        let r = chance.pick(&[1e-3, 0.05]);
        let ((a, of_a), (b, of_b)) = (grain(24, r, k[0], chance), grain(24, r, k[1], chance));
        let way = chance.pick(&of_a);
        let turn = facing(&chance.pick(&of_b), &-way, chance);
        let aside = (way + 0.2 * chance.direction()).normalize();
        Pair::at_overlap(a, &Matrix3::identity(), b, &turn, &aside, 0.8 * depth * r)
    };
    Some(Box::new(move |tolerance| {
        let Pair { a, pose_a, b, pose_b, contact } = &pair;
        let settings = PatchSettings { tolerance, ..PatchSettings::default() };
        patch_of_contact(a, pose_a, b, pose_b, contact, &settings, &mut PatchScratch::new(), |_| ()).unwrap()
    }))
}

/// A body or a grain at rest on the plane z = 0, and that overlap.
fn at_rest(chance: &mut Chance) -> (Particle, Pose) {
    let (k, depth) = (chance.pick(&[0.0, 1e-6, 0.02, 0.3]), 10f64.powf(-3.0 * chance.uniform()));
    let (a, turn, overlap) = if chance.uniform() < 0.5 {
        let a = body(chance.pick(&FAMILIES[..5]), chance.pick(&[1e-4, 1e-2, 0.1, 0.5]), k, chance);
        let overlap = 0.8 * depth * a.rounding_radius();
        (a, chance.rotation(), overlap)
    } else {
        let r = chance.pick(&[1e-3, 0.05]);
        let (a, normals) = grain(24, r, k, chance);
        let turn = facing(&chance.pick(&normals), &-Vector3::z(), chance);
        (a, turn, 0.8 * depth * r)
    };
    let pose = resting(&a, &turn, overlap);
    (a, pose)
}

fn on_a_plane(chance: &mut Chance) -> Option<Taken> {
    let (a, pose) = at_rest(chance);
    let floor = Boundary::Plane(Wall::new([0.0; 3], [0.0, 0.0, 1.0]).unwrap());
    Some(taken_on(floor, a, pose))
}

fn taken_on(boundary: Boundary, a: Particle, pose: Pose) -> Taken {
    Box::new(move |tolerance| {
        boundary.patch(&a, &pose, &PatchSettings { tolerance, ..PatchSettings::default() }).unwrap()
    })
}

/// A triangle of the floor, of 0.3 to 100 times the patch, whose border mostly crosses it.
fn on_a_triangle(chance: &mut Chance) -> Option<Taken> {
    let (a, pose) = at_rest(chance);
    let triangle = Boundary::Triangle(Triangle::new(triangle_over(&a, &pose, chance)?).unwrap());
    triangle.contact(&a, &pose)?;
    Some(taken_on(triangle, a, pose))
}

/// Every third patch of a pair, on a plane and on a triangle.
fn taken(round: u64, chance: &mut Chance) -> Option<Taken> {
    match round % 3 {
        0 => pair(chance),
        1 => on_a_plane(chance),
        _ => on_a_triangle(chance),
    }
}

/// PATCH_SEED and PATCH_ROUNDS in the environment choose other ones.
fn seed_and_rounds(rounds: u64) -> (u64, u64) {
    let of = |name: &str, otherwise| std::env::var(name).map_or(otherwise, |value| value.parse().expect("a number"));
    (of("PATCH_SEED", 21), of("PATCH_ROUNDS", rounds))
}

fn is_whole(patch: &Patch) -> bool {
    !patch.flags.contains(PatchFlags::FOLDED) && !patch.flags.contains(PatchFlags::EMPTY)
}

/// How far force and torque are off, relative; of a sliver the root of the area is no measure of its reach.
fn off(found: &Patch, exact: &Patch) -> f64 {
    let reach = exact.area.max(exact.second_moment.trace() / exact.area).sqrt();
    let force = exact.force.norm();
    ((found.force - exact.force).norm() / force).max(0.1 * (found.torque - exact.torque).norm() / (force * reach))
}

#[test]
fn cells_are_as_rays() {
    let (seed, rounds) = seed_and_rounds(400);
    let mut chance = Chance::new(seed);
    let (mut in_cells, mut above, mut far, mut estimated, mut compared) = (0, 0, 0, 0, 0);
    for round in 0..rounds {
        let Some(taken) = taken(round, &mut chance) else { continue };
        let (found, exact) = (taken(1e-4), taken(BY_RAYS));
        if !is_whole(&found) || !is_whole(&exact) {
            continue;
        }
        let off = off(&found, &exact);
        let area = (found.area / exact.area - 1.0).abs();
        compared += 1;
        in_cells += u64::from(found.rays == 0);
        above += u64::from(off > 1e-4);
        far += u64::from(off > 1e-3);
        estimated += u64::from(off > 2.0 * found.error.max(1e-5));
        assert!(off < 1e-2, "seed {seed}, round {round}: force off by {off:e}, estimated {:e}", found.error);
        assert!(area < 0.02, "seed {seed}, round {round}: area off by {area:e}, estimated {:e}", found.area_error);
    }
    println!(
        "seed {seed}: of {compared} patches {in_cells} without rays, {above} off by more than 1e-4, {far} by more than 1e-3, {estimated} by \
         more than twice the estimate"
    );
    assert!(compared > rounds * 9 / 10 && in_cells > compared * 8 / 10, "{in_cells} of {compared}");
    assert!(far == 0, "{far} of {compared}");
    assert!(200 * above <= compared + 199 && 50 * estimated <= compared + 49, "{above} and {estimated} of {compared}");
}

/// With few rays a tip of the patch may lie between two of them.
#[test]
fn coarse_patches_are_within_their_tolerance() {
    let (seed, rounds) = seed_and_rounds(1000);
    let mut chance = Chance::new(seed);
    let (mut compared, mut above, mut far, mut estimated) = (0, 0, 0, 0);
    for round in 0..rounds {
        let Some(taken) = taken(round, &mut chance) else { continue };
        let exact = taken(BY_RAYS);
        if !is_whole(&exact) {
            continue;
        }
        for tolerance in [1e-2, 1e-3] {
            let found = taken(tolerance);
            let off = off(&found, &exact);
            compared += 1;
            above += u64::from(off > tolerance);
            far += u64::from(off > 3.0 * tolerance);
            estimated += u64::from(off > 3.0 * found.error.max(0.1 * tolerance));
            assert!(off < 10.0 * tolerance, "seed {seed}, round {round}: off by {off:e}, estimated {:e}", found.error);
        }
    }
    println!(
        "seed {seed}: of {compared} patches {above} off by more than the tolerance, {far} by more than three times that, {estimated} by more \
         than three times the estimate"
    );
    assert!(compared > rounds * 18 / 10);
    assert!(far <= compared / 5000, "{far} of {compared}");
    assert!(
        1000 * above <= compared + 999 && 1000 * estimated <= compared + 999,
        "{above} and {estimated} of {compared}"
    );
}
