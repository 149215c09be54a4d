//! Midway and closest solved once more, in 32 digits and by another method: the judge of every answer.
//!
//! For a ratio of weights λ the sum φ = S_A + λS_B is minimised by Newton steps on its pieces; λ is then moved until
//! S_A = S_B (midway), S_B = 1 or S_A = 1 (closest). Whatever it reaches is a proof: φ is convex, so that
//! φ(x) − |∇φ(x)|·D is below its minimum over all points within D, and the optimum lies between dual value and
//! max(S_A, S_B). An answer is judged only where the two meet.

use crate::pair_line::Place;
use crate::wide::{Wide, Wide3, Wide6, solve};
use nalgebra::{Matrix3, Vector3};
use potential_particles::Particle;

/// Which point of two bodies is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// Least common scale: S_A = S_B.
    Midway,
    /// P2: least S_A on B.
    OnB,
    /// P1: least S_B on A.
    OnA,
}

/// A body in world axes about the centre of B.
#[derive(Clone)]
pub struct Body<'a> {
    planes: Vec<([f64; 3], f64)>,
    /// Normals in world axes, to tell in doubles which planes are far.
    turned: Vec<Vector3<f64>>,
    rotation: [Wide3; 3],
    centre: Wide3,
    plane_weight: Wide,
    sphere_weight: Wide,
    pub particle: &'a Particle,
    longest: f64,
}

/// S and its derivatives at a point.
#[derive(Clone, Copy, Debug)]
pub struct Local {
    pub value: Wide,
    pub gradient: Wide3,
    pub hessian: Wide6,
    /// What one unit of length, by which all planes are wrong, does to the value.
    pub pull: f64,
}

impl Local {
    /// The same of the root of the value, with what a unit of length between point and body does.
    pub fn steepness(&self) -> f64 {
        (self.pull + self.gradient.norm().f64()) / (2.0 * self.value.sqrt().f64()).max(f64::MIN_POSITIVE)
    }

    /// How fast the direction of ∇S can turn, radians a length.
    pub fn bend(&self) -> f64 {
        let stiffest: f64 = self.hessian[..3].iter().map(|entry| entry.f64()).sum();
        stiffest / self.gradient.norm().f64()
    }
}

impl<'a> Body<'a> {
    /// At a place, about `origin` in world axes; their difference is exact.
    pub fn new(particle: &'a Particle, at: &Place, origin: [f64; 3]) -> Self {
        let rotation = at.rows();
        let (r, k, shadow) = (particle.rounding_radius(), particle.sphericity(), particle.shadow_radius());
        let plain = Matrix3::from_fn(|i, j| rotation[i].0[j].f64());
        let round = k == 1.0;
        let planes: Vec<_> =
            particle.planes().filter(|_| !round).map(|p| ([p.normal.x, p.normal.y, p.normal.z], p.offset)).collect();
        let turned: Vec<_> = planes.iter().map(|(n, _)| plain * Vector3::from(*n)).collect();
        let longest = turned.iter().map(|n| n.norm()).fold(0.0, f64::max);
        Self {
            planes,
            turned,
            rotation,
            centre: Wide3([0, 1, 2].map(|i| Wide::difference(at.position[i], origin[i]))),
            plane_weight: if round { Wide::ZERO } else { Wide::difference(1.0, k) / Wide::product(r, r) },
            sphere_weight: if k == 0.0 { Wide::ZERO } else { Wide::from(k) / Wide::product(shadow, shadow) },
            particle,
            longest,
        }
    }

    /// A point relative to the centre, world axes.
    pub fn from_centre(&self, x: &Wide3) -> Wide3 {
        x.minus(&self.centre)
    }

    /// The same with at least this weight of the shadow sphere, 1/length²: as the solver regularises flat faces.
    pub fn rounder(&self, weight: f64) -> Self {
        Self { sphere_weight: self.sphere_weight.max(Wide::from(weight)), ..self.clone() }
    }

    pub fn centre(&self) -> Vector3<f64> {
        self.centre.f64()
    }

    /// Least curvature of S, 1/length².
    pub fn softest(&self) -> f64 {
        2.0 * self.sphere_weight.f64()
    }

    /// The same with all planes moved in.
    pub fn inset(&self, depth: f64) -> Self {
        let planes = self.planes.iter().map(|(n, d)| (*n, d - depth)).collect();
        Self { planes, ..self.clone() }
    }

    /// The same turned about its centre by a small angle along a vector.
    pub fn tilted(&self, by: &Vector3<f64>) -> Self {
        let [x, y, z] = &self.rotation;
        let [of_x, of_y, of_z] = [by.x, by.y, by.z].map(Wide::from);
        let turned = [
            z.times(of_y).minus(&y.times(of_z)),
            x.times(of_z).minus(&z.times(of_x)),
            y.times(of_x).minus(&x.times(of_y)),
        ];
        let rotation = [0, 1, 2].map(|i| self.rotation[i].plus(&turned[i]));
        Self { rotation, ..self.clone() }
    }

    pub fn at(&self, x: &Wide3) -> Local {
        let from = x.minus(&self.centre);
        let plain = from.f64();
        let far = 1e-12 * plain.norm() * self.longest;
        let (mut square, mut excesses) = (Wide::ZERO, 0.0);
        let mut pull = Wide3::default();
        let mut bend: Wide6 = [Wide::ZERO; 6];
        for ((n, d), turned) in self.planes.iter().zip(&self.turned) {
            if turned.dot(&plain) - d < -far - 1e-12 * d.abs() {
                continue;
            }
            let n = n.map(Wide::from);
            let n = Wide3([0, 1, 2].map(|i| self.rotation[i].dot(&Wide3(n))));
            let excess = n.dot(&from) - Wide::from(*d);
            if excess.f64() <= 0.0 {
                continue;
            }
            square += excess * excess;
            excesses += excess.f64();
            pull = pull.plus(&n.times(excess));
            for (entry, (i, j)) in bend.iter_mut().zip([(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)]) {
                *entry += n.0[i] * n.0[j];
            }
        }
        let (w, k) = (self.plane_weight + self.plane_weight, self.sphere_weight + self.sphere_weight);
        let mut hessian = bend.map(|entry| entry * w);
        for entry in &mut hessian[..3] {
            *entry += k;
        }
        Local {
            value: self.plane_weight * square + self.sphere_weight * from.dot(&from),
            gradient: pull.times(w).plus(&from.times(k)),
            hessian,
            pull: w.f64() * excesses,
        }
    }

    /// A point on the way from x to the centre that is surely inside, near the surface: what proves an upper bound has
    /// to be feasible. s is convex along that way.
    fn inward(&self, x: &Wide3, at: &Local) -> Wide3 {
        let (s, s0) = (at.value.sqrt(), Wide::from(self.at_centre()));
        if (s - Wide::ONE).f64() <= 0.0 {
            return *x;
        }
        let share = (Wide::ONE - s0) / (s - s0);
        self.centre.plus(&x.minus(&self.centre).times(share))
    }

    /// s at the centre.
    fn at_centre(&self) -> f64 {
        (self.particle.potential(&Vector3::zeros()) + 1.0).max(0.0).sqrt()
    }

    /// How much S grows when every plane moves in by `depth`.
    pub fn risen(&self, x: &Wide3, depth: f64) -> f64 {
        let plain = x.minus(&self.centre).f64();
        let grown = |(turned, (_, d)): (&Vector3<f64>, &([f64; 3], f64))| {
            let excess = turned.dot(&plain) - d;
            let reached = excess.max(0.0);
            // (e + δ)² − e², where the plane is on before or after.
            if excess + depth > 0.0 { (excess + depth - reached) * (excess + depth + reached) } else { 0.0 }
        };
        self.plane_weight.f64() * self.turned.iter().zip(&self.planes).map(grown).sum::<f64>()
    }

    /// How far S ≤ level reaches from x, at most.
    pub fn farthest(&self, x: &Wide3, level: f64) -> f64 {
        let s0 = self.at_centre();
        let s = level.max(1.0).sqrt();
        // s is convex along the ray to a point of the level set, and 1 at most where the ball ends.
        let reach = self.particle.bounding_radius() * (s - s0) / (1.0 - s0);
        (x.f64() - self.centre()).norm() + reach
    }
}

/// The optimum as far as it is known.
#[derive(Clone, Copy, Debug)]
pub struct Optimum {
    pub x: Wide3,
    pub lambda: Wide,
    pub a: Local,
    pub b: Local,
    /// s lies between these two.
    pub least: f64,
    pub most: f64,
    /// How far x can be from the optimum, length; infinite where nothing says.
    pub doubt: f64,
}

impl Optimum {
    /// Unit normal from A to B: of midway at the point.
    pub fn normal(&self) -> Option<Vector3<f64>> {
        let [a, b] = [self.a, self.b].map(|local| unit(&local.gradient));
        let (a, b) = (a?, b?);
        let sum = a.minus(&b);
        unit(&sum).map(|n| n.f64())
    }
}

fn unit(v: &Wide3) -> Option<Wide3> {
    let length = v.norm();
    (length.f64() > 0.0).then(|| v.times(Wide::ONE / length))
}

struct Problem<'a> {
    a: &'a Body<'a>,
    b: &'a Body<'a>,
    wanted: Wanted,
}

/// Most Newton steps in all, and most whole ones in a row.
const MOST_STEPS: usize = 300;
const MOST_WHOLE: usize = 30;

/// Relative to S, two sides that all but meet.
const MET: f64 = 1e-9;

/// A point with both bodies at it.
#[derive(Clone, Copy)]
struct Point {
    x: Wide3,
    a: Local,
    b: Local,
    gradient: Wide3,
    value: Wide,
}

impl Point {
    /// Newton's step for φ, and what the slope promises of it.
    fn newton(&self, lambda: Wide, hold: f64) -> (Wide3, f64) {
        let mut hessian = sum(&self.a.hessian, &self.b.hessian, lambda);
        let largest = (0..3).map(|i| hessian[i].f64()).fold(0.0, f64::max);
        for entry in &mut hessian[..3] {
            *entry += Wide::from(hold * largest);
        }
        let step = solve(&hessian, &self.gradient).times(-Wide::ONE);
        (step, self.gradient.dot(&step).f64())
    }

    fn steepness(&self) -> f64 {
        self.gradient.norm().f64()
    }
}

/// Solves from a start near the optimum, or from anywhere: then it takes longer.
pub fn optimum(a: &Body, b: &Body, wanted: Wanted, start: &Vector3<f64>, lambda: f64) -> Option<Optimum> {
    let problem = Problem { a, b, wanted };
    let mut lambda = Wide::from(if lambda > 0.0 && lambda.is_finite() { lambda } else { 1.0 });
    let mut x = Wide3::from(*start);
    let (mut low, mut high) = (0.0_f64, f64::INFINITY);
    let mut best: Option<Optimum> = None;
    let mut steps = 0;
    while steps < MOST_STEPS {
        let at = problem.least(&x, lambda, &mut steps)?;
        let (local_a, local_b) = (at.a, at.b);
        x = at.x;
        let found = problem.bounds(x, lambda, local_a, local_b);
        let narrower = |best: &Optimum| found.most - found.least < best.most - best.least;
        if best.as_ref().is_none_or(narrower) {
            best = Some(found);
        }
        let miss = problem.miss(&local_a, &local_b);
        let size = local_a.value.f64().max(local_b.value.f64()).max(f64::MIN_POSITIVE);
        if miss.f64().abs() <= 1e-27 * size {
            break;
        }
        if miss.f64() > 0.0 {
            low = low.max(lambda.f64())
        } else {
            high = high.min(lambda.f64())
        }
        let hessian = sum(&local_a.hessian, &local_b.hessian, lambda);
        let bend = local_b.gradient.dot(&solve(&hessian, &local_b.gradient));
        let slope = match wanted {
            Wanted::Midway => (Wide::ONE + lambda) * bend,
            Wanted::OnB => bend,
            Wanted::OnA => lambda * bend,
        };
        let newton = lambda + miss / slope;
        let inside = |v: f64| v.is_finite() && v > 0.0 && v >= low && v <= high;
        let next = if inside(newton.f64()) && newton != lambda {
            newton
        } else if high.is_finite() && low > 0.0 {
            Wide::from(low.sqrt() * high.sqrt())
        } else if high.is_finite() {
            Wide::from(high / 64.0)
        } else {
            Wide::from(low * 64.0)
        };
        if next == lambda || !(1e-60..1e60).contains(&next.f64()) {
            break;
        }
        lambda = next;
    }
    best
}

pub fn sum(a: &Wide6, b: &Wide6, lambda: Wide) -> Wide6 {
    let mut sum = *a;
    for (entry, other) in sum.iter_mut().zip(b) {
        *entry += *other * lambda;
    }
    sum
}

impl Problem<'_> {
    /// Grows with λ's distance below the right one.
    fn miss(&self, a: &Local, b: &Local) -> Wide {
        match self.wanted {
            Wanted::Midway => b.value - a.value,
            Wanted::OnB => b.value - Wide::ONE,
            Wanted::OnA => Wide::ONE - a.value,
        }
    }

    fn phi(a: &Local, b: &Local, lambda: Wide) -> Wide {
        a.value + lambda * b.value
    }

    fn point(&self, x: Wide3, lambda: Wide) -> Point {
        let (a, b) = (self.a.at(&x), self.b.at(&x));
        let gradient = a.gradient.plus(&b.gradient.times(lambda));
        Point { x, a, b, gradient, value: a.value + lambda * b.value }
    }

    /// The minimiser of S_A + λS_B. Whole Newton steps first, which find the right planes in a few even where some
    /// point on the way is far off; where those go round in circles, steps that must descend.
    fn least(&self, start: &Wide3, lambda: Wide, steps: &mut usize) -> Option<Point> {
        let begin = self.point(*start, lambda);
        let (mut at, mut best) = (begin, begin);
        for _ in 0..MOST_WHOLE {
            *steps += 1;
            let (step, _) = at.newton(lambda, 0.0);
            let next = self.point(at.x.plus(&step), lambda);
            if !next.value.is_finite() {
                break;
            }
            let same = (next.value - at.value).abs().f64() <= 1e-28 * at.value.f64();
            // The last steps change φ by less than its own digits: then the gradient tells.
            if same && next.steepness() >= 0.5 * at.steepness() {
                return Some(if next.steepness() < at.steepness() { next } else { at });
            }
            at = next;
            if (at.value - best.value).f64() < 0.0 {
                best = at;
            }
        }
        self.descend(best, lambda, steps)
    }

    /// Newton steps, held back by a growing multiple of the identity while they do not descend.
    fn descend(&self, mut at: Point, lambda: Wide, steps: &mut usize) -> Option<Point> {
        let mut hold = 0.0;
        while *steps < MOST_STEPS {
            *steps += 1;
            let (step, drop) = at.newton(lambda, hold);
            if !at.value.is_finite() || !drop.is_finite() {
                return None;
            }
            if drop == 0.0 {
                break;
            }
            let next = self.point(at.x.plus(&step), lambda);
            let last = drop.abs() <= 1e-26 * at.value.f64();
            let better = if last {
                next.steepness() < 0.5 * at.steepness()
            } else {
                (next.value - at.value).f64() <= 0.1 * drop
            };
            if better {
                at = next;
                hold = if hold < 1e-24 { 0.0 } else { 1e-3 * hold };
            } else if last || hold >= 1.0 {
                break;
            } else {
                hold = if hold == 0.0 { 1e-24 } else { 1e2 * hold };
            }
        }
        Some(at)
    }

    fn bounds(&self, x: Wide3, lambda: Wide, a: Local, b: Local) -> Optimum {
        let gradient = a.gradient.plus(&b.gradient.times(lambda)).norm().f64();
        let midway = self.wanted == Wanted::Midway;
        // At a feasible point: both S are at most this, or 1, at the optimum. x itself may be infeasible, and S of the
        // free body smaller there.
        let most = match self.wanted {
            Wanted::Midway => a.value.max(b.value),
            Wanted::OnB => self.a.at(&self.b.inward(&x, &b)).value,
            Wanted::OnA => self.b.at(&self.a.inward(&x, &a)).value,
        };
        let level = most.f64().max(1.0);
        let reach = self.a.farthest(&x, level).min(self.b.farthest(&x, level));
        let slack = Wide::from(gradient * reach * (1.0 + 1e-10));
        let phi = Self::phi(&a, &b, lambda);
        let dual = match self.wanted {
            Wanted::Midway => (phi - slack) / (Wide::ONE + lambda),
            Wanted::OnB => phi - slack - lambda,
            Wanted::OnA => (phi - slack - Wide::ONE) / lambda,
        };
        let soft = self.a.softest() + lambda.f64() * self.b.softest();
        let curve = solve(&sum(&a.hessian, &b.hessian, lambda), &b.gradient);
        let bend = b.gradient.dot(&curve);
        let per_lambda = if midway { Wide::ONE + lambda } else { Wide::ONE } * bend;
        let miss = self.miss(&a, &b).abs();
        let off = if self.wanted == Wanted::OnA { miss / (lambda * bend) } else { miss / per_lambda };
        // How far λ is off is told by the pieces at hand, and only near the wanted side.
        let near = miss.f64() <= MET * a.value.f64().max(b.value.f64());
        let doubt = if near { gradient / soft + 4.0 * (off * curve.norm()).f64() } else { f64::INFINITY };
        Optimum {
            x,
            lambda,
            a,
            b,
            least: dual.max(Wide::ZERO).sqrt().f64(),
            most: most.sqrt().f64(),
            doubt: if doubt.is_finite() { doubt } else { f64::INFINITY },
        }
    }
}
