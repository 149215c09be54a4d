use potential_particles::Plane;
use potential_particles::rock::*;
use std::hash::{DefaultHasher, Hash, Hasher};
fn cuboid(h: [f64; 3], at: [f64; 3]) -> Vec<Plane> {
    (0..6)
        .map(|i| {
            let (a, s) = (i / 2, [1.0, -1.0][i % 2]);
            let mut p = [0.0; 4];
            p[a] = s;
            p[3] = h[a] + s * at[a];
            Plane::from(p)
        })
        .collect()
}
struct R(u64);
impl R {
    fn f(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}
fn random(seed: u64, n: usize, at: [f64; 3], reach: f64) -> Vec<Joint> {
    let mut r = R(seed * 7919 + 13);
    (0..n)
        .map(|i| {
            let p = [0, 1, 2].map(|k| at[k] + reach * (2.0 * r.f() - 1.0));
            let d = [2.0 * r.f() - 1.0, 2.0 * r.f() - 1.0, 2.0 * r.f() - 1.0];
            let j = Joint::through(p, d);
            if i % 5 == 4 { j.with_radius(0.4).unwrap() } else { j }
        })
        .collect()
}
fn h(m: &RockMass) -> u64 {
    let mut s = DefaultHasher::new();
    format!("{m:?}").hash(&mut s);
    s.finish()
}
fn main() {
    for threads in [1usize, 2, 3] {
        for seed in 0..6u64 {
            let at = [[0.0; 3], [1e3, -2e3, 5e2]][seed as usize % 2];
            let s = SliceSettings {
                threads,
                least_volume: [0.0, 1e-5][(seed / 2) as usize % 2],
                least_width: if seed == 5 { 0.02 } else { 0.0 },
                ..Default::default()
            };
            let m = slice_with_regions(
                &cuboid([1.0, 1.5, 1.0], at),
                &random(seed, 50, at, 0.8),
                &[cuboid([0.3, 9.0, 0.3], at), cuboid([0.2, 0.2, 9.0], at)],
                &s,
                |_, _| true,
            )
            .unwrap();
            println!("{threads} {seed} {} {} {} {:x}", m.blocks.len(), m.too_small, m.unclosed, h(&m));
        }
        for count in [10u32, 22] {
            let js: Vec<Joint> = [(5.0, 10.0), (85.0, 100.0), (80.0, 190.0)]
                .into_iter()
                .flat_map(|(d, a)| {
                    JointSet { fisher: 200.0, seed: count.into(), ..JointSet::new(d, a, 100.0 / f64::from(count)) }
                        .joints([0.0; 3], 60.0)
                        .unwrap()
                })
                .collect();
            let m = slice(&cuboid([50.0; 3], [0.0; 3]), &js, &SliceSettings { threads, ..Default::default() }).unwrap();
            println!("{threads} set {} {:x}", m.blocks.len(), h(&m));
        }
        let js: Vec<Joint> = (0..3)
            .flat_map(|a| {
                (-4..=4).map(move |i| {
                    let mut p = [0.0; 3];
                    p[a] = 0.25 * f64::from(i);
                    let mut n = [0.0; 3];
                    n[a] = 1.0;
                    Joint::through(p, n)
                })
            })
            .collect();
        let m = slice(&cuboid([1.0; 3], [0.0; 3]), &js, &SliceSettings { threads, ..Default::default() }).unwrap();
        println!("{threads} grid {} {:?} {:x}", m.blocks.len(), m.missing.len(), h(&m));
    }
}
