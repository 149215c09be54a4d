//! Equilibrium: closed forms, and how time and memory grow with the number of blocks. Writes
//! out/equilibrium/summary.json, and drawn.json there for the pictures; `-- quick` takes the small scenes only.

use kit::masonry::{arch, block, ferris_tin_loi, pushed, random_rock, random_slope, v, wall, wedge};
use kit::target::{self, at_most, own_time};
use potential_particles::Plane;
use potential_particles::equilibrium::{
    Body, Equilibrium, EquilibriumError, Flow, JointStrength, Scene, Velocity, load_factor, stands, strength_factor,
};
use potential_particles::nalgebra::Vector3;
use potential_particles::rock::{JointSet, SliceSettings, slice};
use serde_json::{Value, json};

const BOTH: [Flow; 2] = [Flow::Associated, Flow::NonDilatant];
/// Bricks of a course and courses of the walls; target of the default load factor, s of the processor, and of the
/// associated one, whose program alone serves the largest walls.
const WALLS: [(usize, usize, Option<f64>); 4] =
    [(10, 10, Some(0.3)), (17, 17, Some(1.5)), (31, 31, None), (100, 99, None)];
/// Load factors of the walls of Ferris and Tin-Loi (2001) without dilatancy.
const PUBLISHED: [(usize, f64); 3] = [(1, 0.640), (2, 0.563), (3, 0.3558)];
/// Joints of each of the three sets of the rock masses: some 500 and 2,000 blocks.
const JOINTS: [u32; 2] = [7, 11];
/// Planes of wedges and faces, (dip, dip direction), that the tests do not have.
const WEDGES: [([[f64; 2]; 2], [f64; 2]); 5] = [
    ([[42.0, 98.0], [66.0, 228.0]], [68.0, 180.0]),
    ([[52.0, 122.0], [57.0, 237.0]], [72.0, 183.0]),
    ([[61.0, 118.0], [44.0, 210.0]], [77.0, 168.0]),
    ([[58.0, 105.0], [63.0, 246.0]], [79.0, 176.0]),
    ([[49.0, 145.0], [54.0, 255.0]], [71.0, 198.0]),
];

fn main() {
    let is_quick = std::env::args().any(|argument| argument == "quick");
    let mut targets = closed_forms();
    let (walls, masses) = if is_quick { (&WALLS[..2], &JOINTS[..1]) } else { (&WALLS[..], &JOINTS[..]) };
    let scene = |&(width, rows, _): &(usize, usize, Option<f64>)| ("wall", pushed(wall(width, rows, 0.6)));
    let scenes = walls.iter().map(scene).chain(masses.iter().map(|&count| ("rock mass", rock_mass(count))));
    let mut rows: Vec<Value> = scenes.map(|(name, scene)| timed(name, &scene, Flow::Associated)).collect();
    let [last, before] = [1, 2].map(|i| &rows[walls.len() - i]);
    let of = |row: &Value, name: &str| row[name].as_f64().expect("a number");
    let growth = (of(last, "seconds") / of(before, "seconds")).ln() / (of(last, "blocks") / of(before, "blocks")).ln();
    targets.push(at_most("largest wall, associated, s", 60.0, of(last, "seconds")));
    targets.push(at_most("growth of the time of associated walls, power of the number of blocks", 1.3, growth));
    targets.push(at_most("largest rock mass, associated, s", 120.0, of(&rows[rows.len() - 1], "seconds")));
    for (wall, target) in walls.iter().filter_map(|wall| Some((wall, wall.2?))) {
        let row = timed("wall", &scene(wall).1, Flow::NonDilatant);
        targets.push(at_most(&format!("load factor of {} blocks, s", row["blocks"]), target, of(&row, "seconds")));
        rows.push(row);
    }
    for (number, published) in PUBLISHED {
        let row = timed("wall of Ferris and Tin-Loi", &ferris_tin_loi(number), Flow::NonDilatant);
        let away = 100.0 * (of(&row, "factor") / published - 1.0).abs();
        targets.push(at_most(&format!("wall {number} of Ferris and Tin-Loi beside {published}, %"), 1.5, away));
        rows.push(row);
    }
    targets.push(at_most("random slopes without a factor of safety, of 100", 0.0, slopes(is_quick)));
    std::fs::create_dir_all("out/equilibrium").expect("out/equilibrium");
    let write = |name: &str, value: &Value| {
        target::write_summary(format!("out/equilibrium/{name}"), value).expect("out/equilibrium");
    };
    write("summary.json", &json!({"rows": rows, "targets": targets}));
    write("drawn.json", &drawn());
}

/// Differences from closed forms; the thickness of the arch by bisection.
fn closed_forms() -> Vec<Value> {
    let angle = 0.31_f64;
    let (mut slope, mut side, mut degrees) = (0.0_f64, 0.0_f64, 0.0_f64);
    for flow in BOTH {
        let found = strength_factor(&block(0.6, angle, 0.7), flow).expect("a factor");
        slope = slope.max((found.factor * angle.tan() / 0.7 - 1.0).abs());
        for (height, friction) in [(0.7, 0.4), (2.6, 0.6)] {
            let found = load_factor(&pushed(block(height, 0.0, friction)), flow).expect("a factor");
            side = side.max((found.factor / f64::min(friction, 1.0 / height) - 1.0).abs());
        }
    }
    for (planes, face) in WEDGES {
        let (scene, expected) = wedge(planes, face, 0.7);
        let [bound, found] = BOTH.map(|flow| strength_factor(&scene, flow).expect("a factor").factor);
        println!("wedge {planes:?}: Hoek and Bray {expected:.6}, without dilatancy {found:.6}, associated {bound:.6}");
        let friction_angle = |factor: f64| (0.7 / factor).atan().to_degrees();
        degrees = degrees.max((friction_angle(found) - friction_angle(expected)).abs());
    }
    let (mut falls, mut holds) = (0.1, 0.115);
    while holds - falls > 1e-6 {
        let middle = 0.5 * (falls + holds);
        if stands(&arch(middle, 240), Flow::Associated).expect("an answer").stands {
            holds = middle
        } else {
            falls = middle
        }
    }
    vec![
        at_most("block on a slope, relative", 1e-6, slope),
        at_most("block under a side load, relative", 1e-6, side),
        at_most("wedges without dilatancy against Hoek and Bray, degrees", 1e-4, degrees),
        at_most(
            "least thickness of a semicircular arch over its radius, against 0.107478",
            1e-4,
            (holds - 0.107478).abs(),
        ),
    ]
}

/// A cube cut by three sets, held below and on all sides but the east, to which it is pushed.
fn rock_mass(count: u32) -> Scene {
    let side = |i: usize| Plane { normal: Vector3::ith(i / 2, [1.0, -1.0][i % 2]), offset: 10.0 };
    let domain: Vec<Plane> = (0..6).map(side).collect();
    let set = |(dip, direction): (f64, f64)| {
        let set =
            JointSet { fisher: 300.0, seed: count.into(), ..JointSet::new(dip, direction, 20.0 / f64::from(count)) };
        set.joints([0.0; 3], 10.0).expect("a joint set")
    };
    let joints: Vec<_> = [(3.0, 10.0), (87.0, 100.0), (86.0, 190.0)].into_iter().flat_map(set).collect();
    let settings = SliceSettings { least_volume: 1e-2, ..SliceSettings::default() };
    let mass = slice(&domain, &joints, &settings).expect("a rock mass");
    let is_inside = |at: &Vector3<f64>| at.x > -9.99 && at.y.abs() < 9.99 && at.z > -9.99;
    let is_held = |block: usize| !mass.blocks[block].corners.iter().all(is_inside);
    let strength = JointStrength { friction: 0.6, ..JointStrength::default() };
    pushed(Scene::of_rock(&mass, v(0.0, 0.0, -26e3), is_held, |_| strength))
}

/// Random slopes of some 10 to 100 free blocks, of which no factor is found, per cent.
fn slopes(is_quick: bool) -> f64 {
    let seed = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).map_or(0, |time| time.as_secs());
    let (mut asked, mut missing) = (0, 0);
    for (i, blocks) in (0..if is_quick { 10 } else { 100 }).zip([60.0, 60.0, 60.0, 150.0].into_iter().cycle()) {
        let scene = random_slope(seed + i, blocks);
        for flow in BOTH {
            match strength_factor(&scene, flow) {
                // All blocks reach the sides.
                Err(EquilibriumError::NoFreeBody) => continue,
                Ok(_) | Err(EquilibriumError::StandsWithoutStrength) => {}
                Err(error) => {
                    missing += 1;
                    println!("slope {} of {blocks} blocks, {flow:?}: {error}", seed + i);
                }
            }
            asked += 1;
        }
    }
    println!("random slopes from {seed}: {missing} of {asked} factors are missing");
    100.0 * f64::from(missing) / f64::from(asked.max(1))
}

/// The load factor of a scene, its processor time and the largest memory so far.
fn timed(name: &str, scene: &Scene, flow: Flow) -> Value {
    let blocks = scene.bodies.iter().filter(|body| !body.held).count();
    let begin = own_time();
    let found = load_factor(scene, flow);
    let seconds = own_time() - begin;
    let told = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let memory =
        told.lines().find_map(|line| line.strip_prefix("VmHWM:")?.split_whitespace().next()?.parse::<f64>().ok());
    let megabytes = memory.map_or(f64::NAN, |kilobytes| kilobytes / 1024.0);
    let factor = found.as_ref().map_or(f64::NAN, |found| found.factor);
    let status = found.map_or_else(
        |error| error.to_string(),
        |found| if found.stands { "solved" } else { "falls by its weight" }.into(),
    );
    let contacts = scene.contacts.len();
    println!(
        "{name} of {blocks} blocks, {contacts} contacts, {flow:?}: {factor:.6}, {seconds:.2} s, up to {megabytes:.0} MB; {status}"
    );
    json!({"scene": name, "flow": format!("{flow:?}"), "blocks": blocks, "contacts": contacts, "corners": scene.corner_count(), "factor": factor,
        "seconds": seconds, "megabytes": megabytes, "status": status})
}

/// A wall and a slope with held sides at their limits.
fn drawn() -> Value {
    let wall = pushed(wall(6, 8, 0.65));
    let front = |body: &Body| {
        let half = 0.5 * body.dead.force.norm();
        vec![[(-half, -0.5), (half, -0.5), (half, 0.5), (-half, 0.5)].map(|(x, z)| body.centre + v(x, 0.0, z)).to_vec()]
    };
    let fronts: Vec<_> = wall.bodies.iter().map(front).collect();
    let (mass, slope) = random_rock(30, 60.0);
    let outlines: Vec<Faces> = mass
        .blocks
        .iter()
        .map(|block| block.faces.iter().map(|face| block.corners_of(face).to_vec()).collect())
        .collect();
    json!({
        "wall": at_limit("load factor", &wall, &fronts, |flow| load_factor(&wall, flow)),
        "slope": at_limit("factor of safety", &slope, &outlines, |flow| strength_factor(&slope, flow)),
    })
}

/// Polygons of a body.
type Faces = Vec<Vec<Vector3<f64>>>;

/// For both flows: faces, velocities, forces at corners and the use of friction.
fn at_limit(
    name: &str,
    scene: &Scene,
    faces: &[Faces],
    ask: impl Fn(Flow) -> Result<Equilibrium, EquilibriumError>,
) -> Value {
    let list = |v: Vector3<f64>| <[f64; 3]>::from(v);
    let of = |flow: Flow| {
        let found = ask(flow).expect("a factor");
        let used = scene.contacts.iter().zip(&found.contacts);
        let used: Vec<f64> = used.flat_map(|(contact, of)| vec![of.used; contact.corners.len()]).collect();
        let corners: Vec<_> = scene.contacts.iter().flat_map(|contact| &contact.corners).map(|at| list(*at)).collect();
        let body = |((body, faces), velocity): ((&Body, &Faces), &Velocity)| {
            let faces: Vec<Vec<_>> = faces.iter().map(|face| face.iter().map(|at| list(*at)).collect()).collect();
            json!({"centre": list(body.centre), "faces": faces, "held": body.held,
                "linear": list(velocity.linear), "angular": list(velocity.angular)})
        };
        let bodies = scene.bodies.iter().zip(faces).zip(&found.mechanism);
        println!("drawn, {name}, {flow:?}: {:.4}, {} solves", found.factor, found.solves);
        json!({"title": format!("{name} {:.3}", found.factor), "bodies": bodies.map(body).collect::<Vec<_>>(),
            "corners": corners, "forces": found.forces.iter().map(|f| list(*f)).collect::<Vec<_>>(), "used": used})
    };
    json!({"associated": of(Flow::Associated), "without dilatancy": of(Flow::NonDilatant)})
}
