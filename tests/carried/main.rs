//! A contact that is carried on against one that is solved, over walks of random pairs.

mod wide;

use kit::random;
use nalgebra::{UnitQuaternion, Vector3};
use potential_particles::{
    BackEnd, Contact, Flags, Formulation, Kind, PairState, Particle, Plane, Pose, Settings, detect,
};
use proptest::prelude::*;

/// Unit vectors that look like chance.
fn direction(seed: &mut u64) -> Vector3<f64> {
    loop {
        let v = Vector3::from([(); 3].map(|()| 2.0 * chance(seed) - 1.0));
        if v.norm() > 0.1 && v.norm() <= 1.0 {
            return v.normalize();
        }
    }
}

/// A number in [0, 1) (splitmix64).
fn chance(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *seed;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Planes all around at about a distance of 1.
fn particle(planes: usize, r: f64, k: f64, seed: &mut u64) -> Particle {
    let golden = std::f64::consts::PI * (3.0 - f64::sqrt(5.0));
    let normals = (0..planes).map(|i| {
        let z = 1.0 - 2.0 * (i as f64 + 0.5) / planes as f64;
        let (sin, cos) = (golden * i as f64).sin_cos();
        Vector3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z)
    });
    let planes: Vec<Plane> = normals.map(|normal| Plane { normal, offset: 0.8 + 0.2 * chance(seed) - r }).collect();
    Particle::new(&planes, r, k, 2.5).expect("planes all around")
}

/// B touching A at the given overlap.
fn touching(a: &Particle, pose_a: &Pose, b: &Particle, turned: [f64; 4], towards: &Vector3<f64>, overlap: f64) -> Pose {
    let at = |distance: f64| Pose::new((pose_a.position() + distance * towards).into(), turned).unwrap();
    let (mut deep, mut apart) = (0.0, a.bounding_radius() + b.bounding_radius());
    for _ in 0..50 {
        let middle = 0.5 * (deep + apart);
        let contact = detect(a, pose_a, b, &at(middle), &Settings::default(), None).unwrap();
        if contact.kind == Kind::Overlapping && contact.overlap > overlap { deep = middle } else { apart = middle }
    }
    at(deep)
}

/// A little further and turned a little.
fn moved(pose: &Pose, step: f64, seed: &mut u64) -> Pose {
    let [w, i, j, k] = pose.orientation();
    let turn = UnitQuaternion::from_scaled_axis(step * direction(seed));
    let q = turn.into_inner() * nalgebra::Quaternion::new(w, i, j, k);
    Pose::new((pose.position() + step * direction(seed)).into(), [q.w, q.i, q.j, q.k]).unwrap()
}

/// What is off beyond both bounds, if anything.
fn fault(carried: &Contact, solved: &Contact, tolerance: f64) -> Option<String> {
    let (off, bound) = ((carried.s - solved.s).abs(), carried.gap + solved.gap);
    if off > bound {
        return Some(format!("s is off by {off:e}, bound {bound:e}"));
    }
    let (off, bound) = ((carried.branch_b - solved.branch_b).norm(), carried.point_bound + solved.point_bound);
    if off > bound {
        return Some(format!("the point is off by {off:e}, bound {bound:e}"));
    }
    // The way to a surface follows the point and the normal.
    let (off, bound) = ((carried.overlap - solved.overlap).abs(), 20.0 * (tolerance + solved.point_bound) + 1e-13);
    if off > bound {
        return Some(format!("the overlap is off by {off:e}, bound {bound:e}"));
    }
    None
}

/// A walk of a touching pair: how many of its contacts were carried on, of how many.
fn walk(planes: usize, r: f64, k: f64, step: f64, far: f64, seed: u64) -> (usize, usize) {
    let (tolerance, mut seed) = (1e-9, seed);
    let (a, b) = (particle(planes, r, k, &mut seed), particle(planes, r, k, &mut seed));
    let seed = &mut seed;
    let quaternion = |seed: &mut u64| [(); 4].map(|()| chance(seed) - 0.5);
    let pose_a = Pose::new((far * direction(seed)).into(), quaternion(seed)).unwrap();
    let (turned, towards) = (quaternion(seed), direction(seed));
    let mut poses = [pose_a, touching(&a, &pose_a, &b, turned, &towards, 0.1 * r)];
    let (mut state, mut count) = (PairState::default(), (0, 0));
    let settings = Settings::default().with_carry_tolerance(tolerance);
    for _ in 0..40 {
        let contact = detect(&a, &poses[0], &b, &poses[1], &settings, Some(&mut state)).unwrap();
        let solved = detect(&a, &poses[0], &b, &poses[1], &settings, None).unwrap();
        assert_eq!(contact.kind, solved.kind);
        if contact.kind == Kind::Separated {
            break;
        }
        count.1 += 1;
        if contact.flags.contains(Flags::CARRIED) {
            count.0 += 1;
            let fault = fault(&contact, &solved, tolerance);
            assert!(fault.is_none(), "{}; r {r:e}, k {k:e}, step {step:e}\n{contact:?}\n{solved:?}", fault.unwrap());
        }
        poses = poses.map(|pose| moved(&pose, step, seed));
    }
    count
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn a_contact_that_is_carried_on_is_within_its_bounds(
        planes in 4_usize..12,
        log_r in -4.0..-0.7_f64,
        k in prop_oneof![Just(0.0), (-12.0..-0.3_f64).prop_map(|log_k| 10_f64.powf(log_k))],
        log_step in -9.0..-2.0_f64,
        far in prop_oneof![Just(0.0), Just(10.0), Just(1e5)],
        seed: u64,
    ) {
        walk(planes, 10_f64.powf(log_r), k, 10_f64.powf(log_step), far, seed);
    }
}

/// With k = 0, too, where corners and edges hold the point.
#[test]
fn contacts_at_rest_are_carried_on() {
    for k in [0.05, 0.0] {
        let counts = (0..50).map(|seed| walk(6, 0.05, k, 1e-8, 0.0, seed));
        let (carried, all) = counts.fold((0, 0), |sum, count| (sum.0 + count.0, sum.1 + count.1));
        assert!(all > 1500 && carried * 10 > all * 9, "k {k}: {carried} of {all}");
    }
}

/// A pile of blocks rocks on edges: the contact point runs along one, many times as far as from the plane beside it.
#[test]
fn a_point_that_runs_along_an_edge_is_carried_on() {
    let cube = Particle::new(
        &[[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]
            .map(|[a, b, c]| Plane::from([a, b, c, 0.45])),
        0.05,
        0.02,
        0.85,
    )
    .unwrap();
    let pose_a = Pose::at([0.0; 3]).unwrap();
    let settings = Settings::default().with_carry_tolerance(1e-9);
    let (mut state, mut carried, mut farthest) = (PairState::default(), 0, 0.0_f64);
    let mut last: Option<Contact> = None;
    for step in 0..100 {
        // It stands on an edge that is parallel to y, and tilts along it to and fro.
        let (about_x, about_y) = (1e-3 * (0.3 * f64::from(step)).sin(), 0.01);
        let pose_b = Pose::new([0.2, 0.1, 0.995], [1.0, 0.5 * about_x, 0.5 * about_y, 0.0]).unwrap();
        let contact = detect(&cube, &pose_a, &cube, &pose_b, &settings, Some(&mut state)).unwrap();
        let solved = detect(&cube, &pose_a, &cube, &pose_b, &settings, None).unwrap();
        if let Some(last) = &last {
            farthest = farthest.max((contact.point - last.point).norm());
        }
        last = Some(contact);
        if contact.flags.contains(Flags::CARRIED) {
            carried += 1;
            let fault = fault(&contact, &solved, 1e-9);
            assert!(fault.is_none(), "{}\n{contact:?}\n{solved:?}", fault.unwrap());
        }
    }
    assert!(farthest > 0.01 && carried >= 90, "{carried} of 100 carried on, at most {farthest:e} in a step");
}

/// A regularisation that was raised moves the point on purpose: it may not be left off from one call to the next.
#[test]
fn contacts_with_a_raised_regularisation_are_solved() {
    let mut seed = 5;
    let (a, b) = (particle(6, 0.05, 0.0, &mut seed), particle(6, 0.05, 0.0, &mut seed));
    let pose_a = Pose::at([0.0; 3]).unwrap();
    let pose_b = touching(&a, &pose_a, &b, [1.0, 0.3, 0.2, 0.1], &Vector3::x(), 0.005);
    for (flat_regularisation, carries) in [(1e-13, true), (1e-3, false)] {
        let settings = Settings::default().with_flat_regularisation(flat_regularisation).with_carry_tolerance(1e-9);
        let mut state = PairState::default();
        let mut look = || detect(&a, &pose_a, &b, &pose_b, &settings, Some(&mut state)).unwrap();
        let (solved, next) = (look(), look());
        assert_eq!(next.flags.contains(Flags::CARRIED), carries);
        assert!((next.point - solved.point).norm() < 1e-9, "{next:?}");
    }
}

#[test]
fn only_the_pair_and_the_problem_that_it_was_made_for_are_carried_on() {
    let mut seed = 5;
    let (a, b) = (particle(6, 0.05, 0.05, &mut seed), particle(6, 0.05, 0.05, &mut seed));
    let pose_a = Pose::at([0.0; 3]).unwrap();
    let pose_b = touching(&a, &pose_a, &b, [1.0, 0.3, 0.2, 0.1], &Vector3::x(), 0.005);
    let mut state = PairState::default();
    let mut look = |a: &Particle, b: &Particle, settings: &Settings, carry_tolerance: f64| {
        let settings = settings.with_carry_tolerance(carry_tolerance);
        let contact = detect(a, &pose_a, b, &pose_b, &settings, Some(&mut state)).unwrap();
        contact.flags.contains(Flags::CARRIED)
    };
    let midway = Settings::default();
    assert!(!look(&a, &b, &midway, 1e-9) && look(&a, &b, &midway, 1e-9));
    assert!(look(&a.clone(), &b, &midway, 1e-9), "a clone is the same particle");
    assert!(!look(&a, &b, &midway, 0.0), "a tolerance of 0 always solves");
    let smoother = midway.with_flat_regularisation(1e-3);
    let coarser = midway.with_gap_tolerance(1e-9);
    assert!(!look(&a, &b, &smoother, 1e-9) && !look(&a, &b, &coarser, 1e-9), "each value of the settings solves anew");
    assert!(look(&a, &b, &coarser, 1e-9) && !look(&a, &b, &midway, 1e-9) && look(&a, &b, &midway, 1e-9));
    let twin = particle(6, 0.05, 0.05, &mut 77);
    assert!(!look(&twin, &b, &midway, 1e-9) && look(&twin, &b, &midway, 1e-9));
    assert!(!look(&twin, &b, &midway.with_formulation(Formulation::Closest), 1e-9));
    assert!(!look(&twin, &b, &midway.with_back_end(BackEnd::ConeProgram), 1e-9));
    for carry_tolerance in [0.2, f64::NAN] {
        let settings = midway.with_carry_tolerance(carry_tolerance);
        assert!(detect(&a, &pose_a, &b, &pose_b, &settings, Some(&mut PairState::default())).is_err());
    }
    // What is saved is the solution alone.
    let carrying_on = midway.with_carry_tolerance(1e-9);
    let mut state = PairState::default();
    let flags = |state: &mut PairState| detect(&a, &pose_a, &b, &pose_b, &carrying_on, Some(state)).unwrap().flags;
    flags(&mut state);
    assert!(flags(&mut state.clone()).contains(Flags::CARRIED));
    let loaded = flags(&mut PairState::from_raw(state.into_raw()));
    assert!(loaded.contains(Flags::WARM) && !loaded.contains(Flags::CARRIED));
}

/// What is inherited from the solved contact counts, too.
#[test]
fn no_point_of_a_carried_contact_is_known_worse_than_was_asked_for() {
    let mut counts = [0; 5];
    for seed in 0..60_u64 {
        let mut random = 1000 * seed + 17;
        let (r, k) = (10_f64.powf(-1.0 - 3.0 * chance(&mut random)), 0.1 * chance(&mut random));
        let (a, b) = (particle(8, r, k, &mut random), particle(8, r, k, &mut random));
        let radius = a.bounding_radius().min(b.bounding_radius());
        let pose_a = Pose::at([0.0; 3]).unwrap();
        let towards = direction(&mut random);
        let pose_b = touching(&a, &pose_a, &b, [1.0, 0.3, 0.2, 0.1], &towards, 0.1 * r);
        for (count, tolerance) in counts.iter_mut().zip([1e-9, 1e-11, 1e-12, 1e-13, 1e-14]) {
            let settings = Settings::default().with_carry_tolerance(tolerance);
            let (mut state, mut poses) = (PairState::default(), [pose_a, pose_b]);
            for _ in 0..20 {
                let contact = detect(&a, &poses[0], &b, &poses[1], &settings, Some(&mut state)).unwrap();
                if contact.flags.contains(Flags::CARRIED) {
                    *count += 1;
                    assert!(contact.point_bound <= tolerance * radius, "{tolerance:e}: {contact:?}");
                }
                poses = poses.map(|pose| moved(&pose, 1e-8, &mut random));
            }
        }
    }
    assert!(counts[0] > 800, "{counts:?}");
}

/// The face of a slab whose own sphere is next to nothing: the sphere of the body that stands on it holds the point for
/// both.
#[test]
fn faces_that_rock_on_a_slab_are_carried_on() {
    let planes = |half: f64| {
        [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]
            .map(|[a, b, c]| Plane::from([a, b, c, half]))
    };
    let cube = Particle::new(&planes(0.45), 0.05, 0.02, 0.85).unwrap();
    let slab = Particle::new(&planes(3.0), 0.5, 1e-6, 6.0).unwrap();
    let pose_a = Pose::at([0.0; 3]).unwrap();
    let settings = Settings::default().with_carry_tolerance(1e-9);
    for turned in [0.0, 0.3] {
        let (mut state, mut carried) = (PairState::default(), 0);
        for step in 0..100 {
            let (about_x, about_y) = (1e-5 * (0.3 * f64::from(step)).sin(), 2e-5 * (0.2 * f64::from(step)).cos());
            let pose_b = Pose::new([0.2, 0.1, 3.999], [1.0, about_x, about_y, turned]).unwrap();
            let contact = detect(&slab, &pose_a, &cube, &pose_b, &settings, Some(&mut state)).unwrap();
            let solved = detect(&slab, &pose_a, &cube, &pose_b, &settings, None).unwrap();
            assert_eq!(contact.kind, Kind::Overlapping);
            if contact.flags.contains(Flags::CARRIED) {
                carried += 1;
                let fault = fault(&contact, &solved, 1e-9);
                assert!(fault.is_none(), "{}\n{contact:?}\n{solved:?}", fault.unwrap());
            }
        }
        assert!(carried >= 95, "turned {turned}: {carried} of 100 carried on");
    }
}

/// Pairs that move as much as the gap between them: apart for sure as long as they are said to be, by no more than they
/// are, and a contact begins by a solve.
#[test]
fn pairs_that_are_apart_are_carried_on() {
    let settings = Settings::default().with_carry_tolerance(1e-9);
    let exactly = Settings::default().with_solve_separated(true);
    let (mut carried, mut begun) = (0, 0);
    for seed in 0..100_u64 {
        let mut random = 1000 * seed + 5;
        let k = if seed % 3 == 0 { 0.0 } else { 0.05 };
        let (a, b) = (particle(6, 0.1, k, &mut random), particle(6, 0.1, k, &mut random));
        let (pose_a, towards) = (Pose::at([0.0; 3]).unwrap(), direction(&mut random));
        let near = touching(&a, &pose_a, &b, [1.0, 0.3, 0.2, 0.1], &towards, 1e-5);
        let away = (near.position() + 4e-4 * towards).into();
        let mut poses = [pose_a, Pose::new(away, near.orientation()).unwrap()];
        let (mut state, mut last) = (PairState::default(), Kind::Separated);
        for _ in 0..60 {
            let look = |pose_b: &Pose| detect(&a, &poses[0], &b, pose_b, &exactly, None).unwrap();
            let contact = detect(&a, &poses[0], &b, &poses[1], &settings, Some(&mut state)).unwrap();
            let exact = look(&poses[1]);
            if contact.kind == Kind::Overlapping {
                begun += usize::from(last == Kind::Separated);
                assert!(last == Kind::Overlapping || !contact.flags.contains(Flags::CARRIED), "{contact:?}");
            } else if contact.flags.contains(Flags::CARRIED) {
                carried += 1;
                assert!(contact.flags.contains(Flags::REJECTED) && contact.distance > 0.0, "{contact:?}");
                assert!(contact.s > 1.0 && contact.s <= exact.s + exact.gap, "{contact:?}\n{exact:?}");
                // As near as they are said to be at least, they do not meet.
                let nearer = poses[1].position() - contact.distance * (1.0 - 1e-9) * exact.normal;
                let nearer = look(&Pose::new(nearer.into(), poses[1].orientation()).unwrap());
                assert!(nearer.s + nearer.gap >= 1.0, "{contact:?}\n{nearer:?}");
            }
            last = contact.kind;
            poses = poses.map(|pose| moved(&pose, 5e-5, &mut random));
        }
        let (solved, pose) = (settings.with_solve_separated(true), poses[1]);
        let contact = detect(&a, &poses[0], &b, &pose, &solved, Some(&mut state)).unwrap();
        assert!(contact.kind == Kind::Overlapping || contact.gap.is_finite(), "{contact:?}");
    }
    assert!(carried > 1000 && begun > 5, "{carried} carried on, {begun} begun");
}

/// Walks of all shapes, steps and places from a seed: none is out of its bounds.
fn wide_walks(seed: u64, walks: u64) {
    let mut tally = wide::Tally::default();
    for walk in 0..walks {
        wide::walk(
            &mut random::Random::seeded(seed.wrapping_add(walk.wrapping_mul(0x9e37_79b9_7f4a_7c15)) | 1),
            &mut tally,
        );
    }
    let wide::Tally { contacts, carried, apart, ended, faults, most } = &tally;
    println!(
        "{carried} of {contacts} carried on, {apart} apart, {ended} ended, {} faults; errors / bounds {most:.2?}",
        faults.len()
    );
    assert!(faults.is_empty(), "{:#?}", &faults[..faults.len().min(20)]);
    let enough = *carried > 7 * walks && *apart > walks / 2 && *ended > walks / 10;
    assert!(enough, "{carried} contacts carried on, {apart} pairs apart, {ended} ended");
}

#[test]
fn contacts_of_any_shape_are_within_their_bounds() {
    wide_walks(1, 3000);
}

#[test]
#[ignore = "takes minutes; another seed in each run, or that of SEED"]
fn contacts_of_any_shape_are_within_their_bounds_for_longer() {
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap();
    let seed = std::env::var("SEED").map_or(now.as_secs(), |seed| seed.parse().expect("SEED is a whole number"));
    println!("seed {seed}");
    wide_walks(seed, 30_000);
}
