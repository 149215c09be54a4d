//! Where a search without memory begins.
//!
//! Near contact a few planes of each particle decide, and which ones is a question about the sharp polyhedra behind
//! the particles. With w the weight (1−k)/r² of a particle's planes, let
//!
//! ```text
//! F(x) = max over the planes of A and of B of √w·(n·x − d)
//! ```
//!
//! Its minimum lies where up to four planes balance, Σ c_i g_i = 0 with g_i = √w n_i, c_i ≥ 0 and Σ c_i = 1:
//! a linear program in x and F. It is solved by steepest descent: against the shortest vector y in the convex hull of
//! the g_i in force, until another plane takes over, which joins the hull; those that y no longer needs leave it.
//!
//! As long as the same planes decide, the minimiser of max(S_A, S_B) without the spheres' shares then is known in closed
//! form. Forces balance at excesses √w·(n_i·x − d_i) = τ c_i/α on A and τ c_i/β on B, where α² and β² are the
//! sums of c_i² over the planes of A and of B; both S are τ², τ = F/(α + β), and the ratio of weights is λ = β/α.
//!
//! The same planes prove that bodies are apart, whatever led to them ([`Hull::proof`]).

use crate::flags::Flags;
use crate::linalg::number::{larger, smaller};
use crate::model::local_model::Start;
use crate::pair::body::Body;
use crate::pair::pair::Pair;
use crate::pair::separation::{Apart, MARGIN};
use nalgebra::Vector3;

/// Most planes that take over, one after the other, and most trials for each. A start need not be perfect.
const MOST_PLANES: usize = 24;
const MOST_TRIALS: usize = 24;

/// Most planes of a body that are all followed from one step to the next: in larger bodies it is faster to leave clusters out.
const MOST_FOLLOWED: usize = 32;

/// Planes that share a place of the surface, above which the quadratics there tell more than the planes one by one. With r/size = 0.05,
/// bodies of 40 planes (1.4) take as many instructions either way, of 50 planes (1.75) 44 % fewer without the linear program, of 20
/// planes (0.7) 50 % more (docs/benchmarks.md).
const SMOOTH: f64 = 1.5;

/// Relative to F: no other plane lies higher.
const LEVEL: f64 = 1e-9;

/// Relative to the rate of F: a plane that falls slower than F by no more than this does not take over.
const SLOW: f64 = 1e-6;

/// Square of the shortest vector of the hull, relative to the longest, that counts as 0: the planes balance.
const VANISHING: f64 = 1e-20;

/// A start without memory, with the proof that the bodies are apart if it was found on the way; on a boundary, its point nearest to the centre.
pub(crate) fn cold(pair: &Pair, [a, b]: [&Body; 2]) -> (Start, Option<Apart>) {
    if b.particle.is_boundary() {
        return (Start { x: Vector3::zeros(), lambda: 1.0 }, None);
    }
    let on_centre_line = Start { x: centre_line(pair), lambda: 1.0 };
    if is_smooth(a) || is_smooth(b) {
        return (on_centre_line, None);
    }
    // Rounding may leave the program without a direction.
    let between = between_polyhedra([a, b], on_centre_line.x);
    between.filter(|(start, _)| start.x.iter().all(|c| c.is_finite())).unwrap_or((on_centre_line, None))
}

/// Whether so many planes share each place of the surface that the sharp polyhedron is a poor start. On a ball, a plane is on
/// within a cap as high as the rounding, r/√(1−k), which is the share r/√(1−k)/(2·radius) of the ball.
fn is_smooth(body: &Body) -> bool {
    let (particle, bounds) = (body.particle, &body.particle.bounds);
    let together = particle.len() as f64 * bounds.face_reach / (2.0 * bounds.radius * bounds.longest_normal);
    particle.is_sphere() || together > SMOOTH
}

/// The point of the line of centres that divides it as the bounding radii do.
fn centre_line(pair: &Pair) -> Vector3<f64> {
    let (ra, rb) = (pair.a.bounding_radius(), pair.b.bounding_radius());
    pair.centre * (rb / (ra + rb))
}

/// The minimum of F and what follows from it. `None` where the point to begin at is inside both, or no start is found.
fn between_polyhedra(bodies: [&Body; 2], from: Vector3<f64>) -> Option<(Start, Option<Apart>)> {
    let mut envelope = Envelope::of(bodies);
    let mut x = from;
    let (mut level, first) = envelope.first(&x);
    if !(level > 0.0) {
        // Inside both polyhedra, the line of centres is as good.
        return None;
    }
    let mut hull = Hull::of(envelope.face(first));
    for _ in 0..MOST_PLANES {
        let y = hull.shortest();
        let rate = y.norm_squared();
        if hull.count == 4 || rate <= VANISHING * hull.longest {
            let balance = hull.balance()?;
            let apart = if level > balance.alpha + balance.beta { hull.proof(bodies, &x, &balance) } else { None };
            return Some((hull.start(x, level, &balance)?, apart));
        }
        let (way, next) = envelope.next(&x, &y, level, rate);
        x -= way * y;
        let Some(plane) = next else {
            // F = 0: inside both polyhedra.
            return Some((Start { x, lambda: 1.0 }, None));
        };
        level -= way * rate;
        hull.join(envelope.face(plane))?;
    }
    None
}

/// F.
struct Envelope<'a> {
    bodies: [&'a Body<'a>; 2],
    /// √w of A and B.
    roots: [f64; 2],
    /// Whether planes are so few that looking through all is cheaper than leaving groups out.
    few: bool,
    /// If so, √w·(n·x − d) of all at the last x but one, how fast they fell from there, and how far it was to the last.
    heights: [[f64; MOST_FOLLOWED]; 2],
    falls: [[f64; MOST_FOLLOWED]; 2],
    way: f64,
    /// Of many: the last plane that was the highest, of each body.
    last: [usize; 2],
}

/// Body (0, 1) and place of a plane.
type Which = (usize, usize);

impl<'a> Envelope<'a> {
    fn of(bodies: [&'a Body<'a>; 2]) -> Self {
        let few = bodies.iter().all(|body| body.particle.len() <= MOST_FOLLOWED);
        let roots = bodies.map(|body| body.plane_weight().sqrt());
        Self { bodies, roots, few, heights: [[0.0; MOST_FOLLOWED]; 2], falls: [[0.0; MOST_FOLLOWED]; 2], way: 0.0, last: [0; 2] }
    }

    /// F where the search begins, and the plane that it is that of.
    fn first(&mut self, x: &Vector3<f64>) -> (f64, Which) {
        if !self.few {
            self.last = self.bodies.map(|body| body.likely_excess(x).1);
            return self.highest(x);
        }
        let mut highest = (f64::NEG_INFINITY, (0, 0));
        for (i, (body, root)) in self.bodies.iter().zip(self.roots).enumerate() {
            let heights = &mut self.heights[i];
            body.particle.visit_near(&body.local(x), f64::INFINITY, |place, _, excess| {
                heights[place] = root * excess;
                if heights[place] > highest.0 {
                    highest = (heights[place], (i, place));
                }
            });
        }
        highest
    }

    /// F, and the plane that it is that of, by a walk over neighbours from the last planes.
    fn highest(&mut self, x: &Vector3<f64>) -> (f64, Which) {
        let [(of_a, place_a), (of_b, place_b)] =
            [0, 1].map(|i| self.bodies[i].particle.climbed(&self.bodies[i].local(x), self.last[i]));
        self.last = [place_a, place_b];
        let (of_a, of_b) = (self.roots[0] * of_a, self.roots[1] * of_b);
        if of_a > of_b { (of_a, (0, place_a)) } else { (of_b, (1, place_b)) }
    }

    fn face(&self, (body, place): Which) -> Face {
        Face { gradient: self.roots[body] * self.bodies[body].normal(place), on_a: body == 0, place }
    }

    /// How far F, now `level`, falls by `rate` a unit of way against y, and which plane takes over there; as far as
    /// F = 0 if none does. x has come all the way that the last call gave.
    fn next(&mut self, x: &Vector3<f64>, y: &Vector3<f64>, level: f64, rate: f64) -> (f64, Option<Which>) {
        if self.few { self.next_of_few(y, level, rate) } else { self.next_of_many(x, y, level, rate) }
    }

    fn next_of_few(&mut self, y: &Vector3<f64>, level: f64, rate: f64) -> (f64, Option<Which>) {
        let (mut way, mut next) = (level / rate, None);
        for (i, (body, root)) in self.bodies.iter().zip(self.roots).enumerate() {
            let y = root * body.turn(y);
            let known = self.heights[i].iter_mut().zip(&mut self.falls[i]);
            for (place, (n, (height, fall))) in body.particle.normals().zip(known).enumerate() {
                // Followed on its way, not looked up anew: a start need not be perfect.
                *height -= self.way * *fall;
                *fall = n.dot(&y);
                let (below, closing) = (level - *height, rate - *fall);
                // Planes in force fall as F does.
                if closing > SLOW * rate && below < way * closing {
                    (way, next) = (below / closing, Some((i, place)));
                }
            }
        }
        self.way = way;
        (way, next)
    }

    /// By Newton's method from the far end: what lies above F there takes over earlier.
    fn next_of_many(&mut self, x: &Vector3<f64>, y: &Vector3<f64>, level: f64, rate: f64) -> (f64, Option<Which>) {
        let (mut way, mut next) = (level / rate, None);
        for _ in 0..MOST_TRIALS {
            let (here, plane) = self.highest(&(x - way * y));
            let over = here - (level - way * rate);
            if over <= LEVEL * level {
                break;
            }
            way -= over / (rate - self.face(plane).gradient.dot(y));
            next = Some(plane);
        }
        (way, next)
    }
}

/// A plane in force.
#[derive(Clone, Copy)]
struct Face {
    /// g = √w·n in the solver's frame.
    gradient: Vector3<f64>,
    on_a: bool,
    place: usize,
}

/// α and β.
struct Balance {
    alpha: f64,
    beta: f64,
}

/// Planes that balance each other as far as they can: y = Σ c_i g_i is the shortest vector of their convex hull.
struct Hull {
    faces: [Face; 4],
    /// c_i > 0, Σ c_i = 1.
    shares: [f64; 4],
    count: usize,
    /// Square of the longest g that was ever in it.
    longest: f64,
    /// Vectors in the span of the differences g_i − g_last, each with product 1 with its own and 0 with the others.
    reciprocal: [Vector3<f64>; 3],
}

impl Hull {
    fn of(face: Face) -> Self {
        let longest = face.gradient.norm_squared();
        let reciprocal = [Vector3::zeros(); 3];
        Self { faces: [face; 4], shares: [1.0, 0.0, 0.0, 0.0], count: 1, longest, reciprocal }
    }

    /// y.
    fn shortest(&self) -> Vector3<f64> {
        (1..self.count).fold(self.shares[0] * self.g(0), |sum, i| sum + self.shares[i] * self.g(i))
    }

    fn g(&self, i: usize) -> &Vector3<f64> {
        &self.faces[i].gradient
    }

    /// One more plane; those that y needs no longer go (Wolfe's algorithm). `None` where rounding decides.
    fn join(&mut self, face: Face) -> Option<()> {
        self.longest = larger(face.gradient.norm_squared(), self.longest);
        self.faces[self.count] = face;
        self.shares[self.count] = 0.0;
        self.count += 1;
        loop {
            let wanted = self.affine();
            // The way to `wanted` on which all shares stay positive, and which vanishes first.
            let (mut way, mut first) = (1.0, None);
            // By index: iterators make these short loops longer.
            #[allow(clippy::needless_range_loop)]
            for i in 0..self.count {
                let (have, want) = (self.shares[i], wanted[i]);
                if !want.is_finite() {
                    return None;
                }
                if want <= 0.0 && have <= way * (have - want) {
                    (way, first) = (have / (have - want), Some(i));
                }
            }
            #[allow(clippy::needless_range_loop)]
            for i in 0..self.count {
                self.shares[i] += way * (wanted[i] - self.shares[i]);
            }
            let Some(i) = first else { return Some(()) };
            self.count -= 1;
            if i == self.count {
                return None;
            }
            // The newest stays last.
            for j in i..self.count {
                (self.faces[j], self.shares[j]) = (self.faces[j + 1], self.shares[j + 1]);
            }
        }
    }

    /// Shares, of any sign, of the shortest vector in the affine hull.
    fn affine(&mut self) -> [f64; 4] {
        let last = self.count - 1;
        self.reciprocal = self.reciprocal_to_last();
        let g = self.g(last);
        let shares = self.reciprocal.map(|r| -g.dot(&r));
        let mut all = [0.0; 4];
        all[..last].copy_from_slice(&shares[..last]);
        all[last] = 1.0 - shares[..last].iter().sum::<f64>();
        all
    }

    fn reciprocal_to_last(&self) -> [Vector3<f64>; 3] {
        let last = self.g(self.count - 1);
        let zero = Vector3::zeros();
        match self.count {
            2 => {
                let u = self.g(0) - last;
                [u * (1.0 / u.norm_squared()), zero, zero]
            }
            3 => {
                let (u, v) = (self.g(0) - last, self.g(1) - last);
                let across = u.cross(&v);
                let per_area = 1.0 / across.norm_squared();
                [v.cross(&across) * per_area, across.cross(&u) * per_area, zero]
            }
            _ => {
                let (u, v, w) = (self.g(0) - last, self.g(1) - last, self.g(2) - last);
                let across = v.cross(&w);
                let per_volume = 1.0 / u.dot(&across);
                [across * per_volume, w.cross(&u) * per_volume, u.cross(&v) * per_volume]
            }
        }
    }

    /// `None` of one particle's planes alone: its own centre is meant, not a contact.
    fn balance(&self) -> Option<Balance> {
        let squares = |on_a: bool| {
            let of = (0..self.count).filter(|&i| self.faces[i].on_a == on_a);
            of.map(|i| self.shares[i] * self.shares[i]).sum::<f64>().sqrt()
        };
        let (alpha, beta) = (squares(true), squares(false));
        (alpha > 0.0 && beta > 0.0).then_some(Balance { alpha, beta })
    }

    /// What the planes of the hull at x prove, if that the particles share no point.
    ///
    /// In a particle Σ c_i √w (n_i·x − d_i), over any of its planes, is at most the root of the sum of c_i², since the sum of the w⟨n_i·x − d_i⟩² is at
    /// most 1. Over the planes of both the sum has the slope y and is at most α + β at a point of both, which is no farther from x than
    /// the far side of either ball. Of two points at a distance d, one in A and one in B, the sum at either is at most that and what the planes
    /// of the other one gain on d.
    #[inline(never)]
    fn proof(&self, [a, b]: [&Body; 2], x: &Vector3<f64>, Balance { alpha, beta }: &Balance) -> Option<Apart> {
        let (at_a, at_b) = (a.local(x), b.local(x));
        let (to_a, to_b) = ((x - a.centre()).norm(), x.norm());
        let reach = smaller(to_a + a.particle.bounding_radius(), to_b + b.particle.bounding_radius());
        let lengths = 2.0 * (to_a + to_b + a.particle.bounds.offset_within(to_a) + b.particle.bounds.offset_within(to_b));
        let (mut sum, mut weights, mut steepest) = (0.0, 0.0, 0.0);
        let (mut slope, mut slope_a) = (Vector3::zeros(), Vector3::zeros());
        for (face, share) in self.faces.iter().zip(self.shares).take(self.count) {
            let (body, at) = if face.on_a { (a, &at_a) } else { (b, &at_b) };
            let share = larger(share, 0.0);
            let weight = share * body.plane_weight().sqrt();
            sum += weight * body.particle.excess(face.place, at);
            weights += weight;
            steepest += weight * body.particle.bounds.longest_normal;
            slope += share * face.gradient;
            slope_a += if face.on_a { share * face.gradient } else { Vector3::zeros() };
        }
        let doubt = MARGIN * (lengths * (weights + steepest) + reach * steepest);
        let slope = slope.norm();
        let over = sum - slope * reach - doubt - (alpha + beta) * (1.0 + MARGIN);
        // What the planes of either one gain is no more than that.
        (over > 0.0).then(|| Apart::new(Flags::NONE, over / (slope_a.norm() + slope)))
    }

    /// The minimiser of max(S_A, S_B) from that of F, and its λ.
    fn start(&self, x: Vector3<f64>, level: f64, &Balance { alpha, beta }: &Balance) -> Option<Start> {
        let tau = level / (alpha + beta);
        let per_share = [tau / beta, tau / alpha];
        let excess = |i: usize| per_share[usize::from(self.faces[i].on_a)] * self.shares[i];
        let last = self.count - 1;
        let to_last = excess(last);
        let step = (0..last).fold(Vector3::zeros(), |sum, i| sum + (excess(i) - to_last) * self.reciprocal[i]);
        let (x, lambda) = (x + step, beta / alpha);
        (lambda.is_finite() && x.iter().all(|v| v.is_finite())).then_some(Start { x, lambda })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::scattered;
    use crate::particle::particle::Particle;
    use crate::pose::Pose;

    /// With k = 0 a face of B, at x = 0.5, and a face or an edge of A meet where s·(r_A + r_B) is what is between the sharp ones.
    #[test]
    fn the_start_is_the_optimum_where_its_planes_are_those_that_are_on() {
        let (of_a, of_b, s) = (0.1, 0.02, 0.6);
        let (blunt, sharp) = (Particle::cube(0.4, of_a, 0.0, 0.0), Particle::cube(0.5, of_b, 0.0, 0.0));
        let eighth = 0.125 * std::f64::consts::PI;
        for (q, corner) in [([1.0, 0.0, 0.0, 0.0], 0.4), ([eighth.cos(), 0.0, 0.0, eighth.sin()], 0.4 * 2f64.sqrt())] {
            let pose_a = Pose::new([0.5 + corner + s * (of_a + of_b), 0.03, -0.02], q).unwrap();
            let pose_b = Pose::at([0.0; 3]).unwrap();
            let pair = Pair::new(&blunt, &pose_a, &sharp, &pose_b);
            let (a, b) = Body::both(&pair, 0.0);
            let (start, _) = cold(&pair, [&a, &b]);
            assert!((start.x.x - (0.5 + s * of_b)).abs() < 1e-14, "{start:?}");
            assert!((start.lambda / (of_b / of_a) - 1.0).abs() < 1e-12, "{start:?}");
            assert!([&a, &b].iter().all(|body| (body.value(&start.x) - s * s).abs() < 1e-11), "{start:?}");
        }
    }

    /// Each plane that joins shortens y, which has the same product with all that are left: none is nearer to the origin.
    #[test]
    fn the_hull_gives_the_shortest_vector() {
        let mut joined = 0;
        for seed in 0..300 {
            let mut chance = scattered(40 * seed);
            let mut face = || {
                let gradient = Vector3::new(0.4, 0.0, 0.0) + Vector3::<f64>::from_fn(|_, _| chance());
                Face { gradient, on_a: true, place: 0 }
            };
            let mut hull = Hull::of(face());
            for _ in 0..10 {
                let (next, last) = (face(), hull.shortest());
                // Others do not take over.
                if hull.count == 4 || next.gradient.dot(&last) >= 0.9 * last.norm_squared() {
                    continue;
                }
                if hull.join(next).is_none() {
                    break;
                }
                joined += 1;
                let (y, shares) = (hull.shortest(), &hull.shares[..hull.count]);
                assert!(hull.count == 4 || y.norm() < last.norm(), "{y:?}");
                assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12 && shares.iter().all(|share| *share > 0.0));
                let scale = 1e-9 * hull.longest;
                assert!((0..hull.count).all(|i| (y.dot(hull.g(i)) - y.norm_squared()).abs() < scale), "{y:?}");
            }
        }
        assert!(joined > 300, "{joined}");
    }
}
