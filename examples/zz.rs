use potential_particles::*;
fn main() {
    let n: usize = std::env::args().nth(1).unwrap().parse().unwrap();
    let mode = std::env::args().nth(2).unwrap();
    let (r, k) = (0.01, 0.01);
    let planes = [
        [0.0, 0.0, -1.0, 0.5],
        [0.894427, 0.0, 0.447214, 0.4],
        [-0.894427, 0.0, 0.447214, 0.4],
        [0.0, 0.894427, 0.447214, 0.4],
        [0.0, -0.894427, 0.447214, 0.4],
    ]
    .map(|p| Plane::from(p));
    let k = if mode.ends_with('0') { 0.0 } else { k };
    let p = Particle::new(&planes, r, k, 1.0).unwrap();
    let mut seed = 12345u64;
    let mut rnd = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1u64 << 53) as f64 * 2.0 - 1.0
    };
    let mut sum = 0.0;
    let formulation = if mode.starts_with("closest") { Formulation::Closest } else { Formulation::Midway };
    let settings = Settings { formulation, ..Settings::default() };
    for _ in 0..n {
        let q = [rnd(), rnd(), rnd(), rnd()];
        let d = [rnd(), rnd(), rnd()];
        let l = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
        let a = Pose::new([0.0; 3], [rnd(), rnd(), rnd(), rnd()]).unwrap();
        let dist = 0.75;
        let b = Pose::new(d.map(|c| c / l * dist), q).unwrap();
        let b2 = Pose::new(d.map(|c| c / l * dist + 1e-5), q).unwrap();
        if mode.starts_with("wall") {
            let w = Wall::new(d.map(|c| c / l * 0.4), d).unwrap();
            sum += contact_with_plane(&p, &a, &w, &settings, None).unwrap().s;
            continue;
        }
        let mut m = PairState::default();
        sum += detect(&p, &a, &p, &b, &settings, Some(&mut m)).unwrap().s;
        if mode.contains("warm") {
            for _ in 0..10 {
                sum += detect(&p, &a, &p, &b2, &settings, Some(&mut m)).unwrap().s;
                sum += detect(&p, &a, &p, &b, &settings, Some(&mut m)).unwrap().s;
            }
        }
    }
    println!("{sum}");
}
