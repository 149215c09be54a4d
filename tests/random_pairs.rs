//! Random pairs over everything that can be written down, judged without truth: warm and cold agree within their
//! bounds, the cone programs agree on a sample, nothing fails.
//!
//! Kept from a search over 120,000 such pairs:
//! - pair 2,418: planes of r/size = 6e-8 whose push or pull is below the resolution of their depth let a bound
//!   pass for proved that was not. They now count against the bound.
//! - pair 8,130: the same with k = 1e-10.

use nalgebra::Vector3;
use potential_particles::{BackEnd, Flags, Formulation, Kind, Memory, Particle, Plane, Pose, Settings, detect};

/// Pairs tried; the kept ones are among them.
const PAIRS: usize = 9_000;

/// Xorshift (Marsaglia 2003): the pairs must be the same on every machine.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        let (a, b) = (self.unit(), self.unit());
        (-2.0 * (a + 1e-300).ln()).sqrt() * (std::f64::consts::TAU * b).cos()
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        (low.ln() + (high / low).ln() * self.unit()).exp()
    }

    fn vector(&mut self) -> Vector3<f64> {
        Vector3::new(self.normal(), self.normal(), self.normal())
    }

    fn orientation(&mut self) -> [f64; 4] {
        if self.unit() < 0.2 {
            [1.0, 0.0, 0.0, 0.0]
        } else {
            [self.normal(), self.normal(), self.normal(), self.normal()]
        }
    }

    /// Any shape: boxes and random polyhedra, needles and plates, r/size from 1e-8, k from 0 to 1.
    fn particle(&mut self) -> Option<Particle> {
        let size = self.between(1e-3, 1e3);
        let count = match (self.unit() * 5.0) as usize {
            0 => 4,
            1 => 5,
            2 => 6,
            3 => 4 + (self.unit() * 30.0) as usize,
            _ => 4 + (self.unit() * 200.0) as usize,
        };
        let aspect = [1.0, self.between(0.02, 1.0), self.between(0.02, 1.0)];
        let mut planes: Vec<Plane> = Vec::new();
        if count == 6 {
            for (axis, share) in aspect.iter().enumerate() {
                planes.extend([1.0, -1.0].map(|sign| Plane { normal: Vector3::ith(axis, sign), offset: size * share }));
            }
        } else {
            for _ in 0..count {
                let normal = self.vector().normalize();
                let reach: f64 = (0..3).map(|i| (normal[i] * aspect[i]).powi(2)).sum::<f64>().sqrt();
                planes.push(Plane { normal, offset: size * reach * (0.7 + 0.3 * self.unit()) });
            }
        }
        if self.unit() < 0.1 {
            planes.push(planes[0]);
        }
        let k = match (self.unit() * 4.0) as usize {
            0 => 0.0,
            1 => self.between(1e-10, 1.0),
            2 => self.unit(),
            _ => self.between(1e-3, 0.5),
        };
        let nearest = planes.iter().map(|p| p.offset).fold(f64::INFINITY, f64::min);
        let r = nearest * self.between(1e-8, 0.5);
        for plane in &mut planes {
            plane.offset -= r * 0.9;
        }
        Particle::new(&planes, r, k, size * self.between(0.5, 2.0)).ok()
    }
}

#[test]
fn nothing_fails_and_every_bound_holds() {
    let mut random = Random(88_172_645_463_325_252 ^ 0x9E37_79B9_7F4A_7C15);
    let (mut pairs, mut fell_back) = (0, 0);
    while pairs < PAIRS {
        let (Some(a), Some(b)) = (random.particle(), random.particle()) else { continue };
        pairs += 1;
        let apart = a.bounding_radius() + b.bounding_radius();
        let branch = random.vector().normalize() * apart * if random.unit() < 0.05 { 0.0 } else { random.unit() };
        let away = if random.unit() < 0.3 { 1e4 * random.normal() } else { 0.0 };
        let at_a = Pose::new([away, 0.0, 0.0], random.orientation()).unwrap();
        let at_b = Pose::new([away + branch.x, branch.y, branch.z], random.orientation()).unwrap();
        for formulation in [Formulation::Midway, Formulation::Closest] {
            let settings = Settings { solve_separated: true, formulation, ..Settings::default() };
            let cold = |at_b: &Pose| detect(&a, &at_a, &b, at_b, &settings, None);
            let contact = cold(&at_b).unwrap_or_else(|error| panic!("pair {pairs} {formulation:?}: {error}"));
            fell_back += usize::from(contact.flags.contains(Flags::FELL_BACK));
            assert!(contact.kind == Kind::Separated || contact.overlap >= 0.0, "pair {pairs}: {contact:?}");
            if formulation == Formulation::Closest {
                continue;
            }
            let mut memory = Memory::default();
            detect(&a, &at_a, &b, &at_b, &settings, Some(&mut memory)).unwrap();
            let moved = Pose { position: at_b.position + 1e-3 * b.bounding_radius() * random.vector(), ..at_b };
            let (warm, cold) =
                (detect(&a, &at_a, &b, &moved, &settings, Some(&mut memory)).unwrap(), cold(&moved).unwrap());
            assert!((warm.s - cold.s).abs() <= warm.gap + cold.gap, "pair {pairs}: warm {warm:?} cold {cold:?}");
            if pairs % 50 == 0 {
                let judge = Settings { back_end: BackEnd::Conic, ..settings };
                let conic = detect(&a, &at_a, &b, &at_b, &judge, None).unwrap();
                let allowed = 1e-6 * contact.s.max(1e-3) + contact.gap;
                assert!((conic.s - contact.s).abs() <= allowed, "pair {pairs}: conic {conic:?} fast {contact:?}");
            }
        }
    }
    println!("{pairs} pairs, {fell_back} of {} solves answered by the cone program", 2 * pairs);
    assert!(fell_back * 100 < pairs, "{fell_back} fell back");
}
