//! Contact patches: accuracy against closed forms and the gradient of their energy, time by kind of contact. Results go
//! to out/patch/summary.json; `-- quick` takes a little of everything, `-- pairs=500` as many pairs for the gradient of
//! the energy, `-- seed=7` the same random families again.

mod accuracy;
mod cases;
mod families;
mod gradients;
mod in_plane;
mod speed;

use kit::target::{at_most, write_summary};
use serde_json::{Value, json};

/// The most units of a kind at a tolerance.
fn units(kinds: &[Value], tolerance: f64, is_meant: impl Fn(&str) -> bool) -> f64 {
    let meant = kinds.iter().filter(|kind| is_meant(kind["kind"].as_str().unwrap_or_default()));
    let rows = meant.flat_map(|kind| kind["rows"].as_array().into_iter().flatten());
    let at = rows.filter(|row| row["tolerance"] == json!(tolerance));
    at.filter_map(|row| row["units"].as_f64()).fold(0.0, f64::max)
}

fn main() {
    let quick = std::env::args().any(|argument| argument == "quick");
    let mut targets = Vec::new();
    let [within, beyond] = accuracy::faces();
    targets.push(at_most("flat faces: N and M, tilt within the base, relative error", 1e-4, within));
    targets.push(at_most("flat faces: N and contact length, uplift, relative error", 1e-4, beyond));
    targets.push(at_most("sphere on plane and sphere, crossed cylinders: N, relative error", 1e-3, accuracy::round()));
    let [square, disc] = accuracy::levers();
    targets.push(at_most("twist of a square: lever, relative error", 2e-3, square));
    targets.push(at_most("twist of a disc: lever, relative error", 2e-3, disc));
    targets.push(at_most("couple of crossed edges, relative error", 1e-3, accuracy::crossed()[1]));
    let asked = std::env::args().find_map(|argument| argument.strip_prefix("pairs=")?.parse().ok());
    let pairs = asked.unwrap_or(if quick { 60 } else { 8000 });
    let mut gradients = Vec::new();
    for gradients::Outcome { kind, worst, of_99, counts: [count, folded, unsettled] } in gradients::measure(pairs) {
        println!("{kind}: {count}, besides {folded} that fold and {unsettled} that use up their rays");
        let name = format!("force and torque against the gradient of the energy, {kind}");
        targets.push(at_most(&format!("{name}: worst"), 1e-6, worst));
        targets.push(at_most(&format!("{name}: 99 of 100"), 1e-6, of_99));
        gradients.push(json!({"kind": kind, "compared": count, "folded": folded, "unsettled": unsettled}));
    }
    let places = if quick { 10 } else { 100 };
    targets.push(at_most("tiles and one slab, at a tolerance of 1e-4: N", 1e-9, accuracy::tiles(places, 1e-4)));
    targets.push(at_most("tiles and one slab, at a tolerance of 1e-10: N", 1e-9, accuracy::tiles(places, 1e-10)));
    let (unit, kinds) = speed::measure(quick);
    let face = |kind: &str| kind.starts_with("face");
    let corner = |kind: &str| kind.starts_with("corner") || kind.starts_with("crossed");
    for (tolerance, factor) in [(1e-4, 1.0), (1e-6, 2.0)] {
        let name = |kind: &str| format!("{kind} at {tolerance:e}: evaluations of both bodies");
        targets.push(at_most(&name("face on face"), 250.0 * factor, units(&kinds, tolerance, face)));
        targets.push(at_most(&name("corner on face, crossed edges"), 120.0 * factor, units(&kinds, tolerance, corner)));
        targets.push(at_most(
            &name("edge on face"),
            300.0 * factor,
            units(&kinds, tolerance, |k| k.starts_with("edge")),
        ));
    }
    let many = units(&kinds, 1e-4, |kind| kind.starts_with("300"));
    targets.push(at_most("300 + 300 planes at 1e-4: evaluations of both bodies", 1500.0, many));
    targets.push(at_most("carried on by its stiffness: evaluations of both bodies", 40.0, speed::carried(unit)));
    let in_plane = in_plane::measure(unit);
    let drawn = std::time::UNIX_EPOCH.elapsed().map_or(1, |since| u64::from(since.subsec_nanos()));
    let seed = std::env::args().find_map(|argument| argument.strip_prefix("seed=")?.parse().ok()).unwrap_or(drawn);
    let (families, rays) = families::measure(if quick { 100 } else { 1000 }, seed);
    targets.push(at_most("patches of a family that need rays and do not fold, most", 0.01, rays));
    let summary = json!({"targets": targets, "unit_seconds": unit, "gradients": gradients, "in_plane": in_plane,
        "kinds": kinds, "families": families, "seed": seed});
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/out/patch/summary.json");
    write_summary(path, &summary).expect("out/patch/summary.json");
}
