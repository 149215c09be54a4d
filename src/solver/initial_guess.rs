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
//! As long as the same planes decide, the minimiser of max(S_A, S_B) without the spheres' shares then is known in
//! closed form. Forces balance at excesses √w·(n_i·x − d_i) = τ c_i/α on A and τ c_i/β on B, where α² and β² are the
//! sums of c_i² over the planes of A and of B; both S are τ², τ = F/(α + β), and the ratio of weights is λ = β/α.
//!
//! However found, these planes may prove the pair separated ([`MinimumNorm::proof`]).

use crate::linalg::number::larger;
use crate::model::local_model::Start;
use crate::pair::body::Body;
use crate::pair::minimum_norm_point::{Face, MinimumNorm};
use crate::pair::pair::Pair;
use crate::pair::separation::Apart;
use nalgebra::Vector3;

/// Most planes that take over, one after the other, and most trials for each. A start need not be perfect (chosen).
const MOST_TRIALS: usize = 24;

/// Most planes of a body that are all followed from one step to the next: in larger bodies it is faster to leave
/// clusters out. Measured: with 12, bodies of 20 planes take 5 % fewer instructions and 7 % more time.
const MOST_FOLLOWED: usize = 32;

/// Planes per place of the surface above which the quadratics there are a better guide than single planes (measured).
/// With r/size = 0.05, bodies of 40 planes (1.4) take as many instructions either way, of 50 planes (1.75) 44 % fewer
/// without the linear program, of 20 planes (0.7) 50 % more (docs/design_notes.md).
const SMOOTH: f64 = 1.5;

/// Relative to F: no other plane lies higher. Chosen: far above rounding; a start need not be optimal.
const LEVEL: f64 = 1e-9;

/// Relative to the rate of F: a plane that falls slower than F by no more than this does not take over. Chosen: planes
/// in force fall at the rate of F but for rounding.
const SLOW: f64 = 1e-6;

/// Square of the shortest vector of the hull, relative to the longest, that counts as 0: the planes balance. Chosen:
/// the length is 1e-10 then, between rounding and 1.
const VANISHING: f64 = 1e-20;

/// A start, with the proof that the bodies are apart if it was found on the way, and its planes
/// ([`MinimumNorm::places`]).
pub(crate) type Guess = (Start, Option<(Apart, [f64; 2])>);

/// A start without memory; on a boundary, its point nearest to the centre.
pub(crate) fn cold(pair: &Pair, bodies: [&Body; 2]) -> Guess {
    if bodies[1].particle.is_boundary() {
        return (Start { x: Vector3::zeros(), lambda: 1.0 }, None);
    }
    let on_centre_line = Start { x: centre_line(pair), lambda: 1.0 };
    if !is_sharp(bodies) {
        return (on_centre_line, None);
    }
    // Rounding may leave the program without a direction.
    let between = between_polyhedra(bodies, on_centre_line.x);
    between.filter(|(start, _)| start.x.iter().all(|c| c.is_finite())).unwrap_or((on_centre_line, None))
}

/// Whether the sharp polyhedra are a good start.
pub(crate) fn is_sharp([a, b]: [&Body; 2]) -> bool {
    !is_smooth(a) && !is_smooth(b)
}

/// Whether too many planes are active together for the sharp polyhedron to be a good start. On a ball a plane is active
/// within a cap of height r/√(1−k), which is the share r/√(1−k)/(2·radius) of the surface.
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
fn between_polyhedra(bodies: [&Body; 2], from: Vector3<f64>) -> Option<Guess> {
    let mut envelope = Envelope::of(bodies);
    let mut x = from;
    let (mut level, first) = envelope.first(&x);
    if !(level > 0.0) {
        // Inside both polyhedra, the line of centres is as good.
        return None;
    }
    let mut balance = MinimumNorm::of(envelope.face(first));
    for _ in 0..MOST_TRIALS {
        let y = balance.shortest();
        let rate = y.norm_squared();
        if balance.count == 4 || rate <= VANISHING * balance.longest {
            let (start, tau) = balanced(&balance, &x, level)?;
            // Otherwise the same planes prove nothing.
            let proof = if tau > 1.0 { proof(bodies, &balance, &x, envelope.roots) } else { None };
            return Some((start, proof.map(|apart| (apart, balance.places()))));
        }
        let (way, next) = envelope.next(&x, &y, level, rate);
        x -= way * y;
        let Some(plane) = next else {
            // F = 0: inside both polyhedra.
            return Some((Start { x, lambda: 1.0 }, None));
        };
        level -= way * rate;
        balance.join(envelope.face(plane))?;
    }
    None
}

/// What the planes in force prove at x.
#[inline(never)]
fn proof(bodies: [&Body; 2], balance: &MinimumNorm, x: &Vector3<f64>, roots: [f64; 2]) -> Option<Apart> {
    let local = bodies.map(|body| body.local(x));
    let excess = |face: &Face| bodies[face.of].particle.excess(face.place, &local[face.of]);
    balance.proof(bodies.map(|body| body.particle), roots, bodies.map(|body| (x - body.centre()).norm()), excess)
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
        Self {
            bodies,
            roots,
            few,
            heights: [[0.0; MOST_FOLLOWED]; 2],
            falls: [[0.0; MOST_FOLLOWED]; 2],
            way: 0.0,
            last: [0; 2],
        }
    }

    /// F at the start of the search, and the plane that attains it.
    fn first(&mut self, x: &Vector3<f64>) -> (f64, Which) {
        if !self.few {
            return self.higher(self.bodies.map(|body| body.likely_excess(x)));
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

    /// F, and the plane that attains it, by ascent over neighbours from the last planes.
    fn highest(&mut self, x: &Vector3<f64>) -> (f64, Which) {
        self.higher([0, 1].map(|i| self.bodies[i].particle.climbed(&self.bodies[i].local(x), self.last[i])))
    }

    /// The larger √w·(n·x − d) of a plane of A and one of B, and its plane.
    fn higher(&mut self, [(of_a, place_a), (of_b, place_b)]: [(f64, usize); 2]) -> (f64, Which) {
        self.last = [place_a, place_b];
        let (of_a, of_b) = (self.roots[0] * of_a, self.roots[1] * of_b);
        if of_a > of_b { (of_a, (0, place_a)) } else { (of_b, (1, place_b)) }
    }

    fn face(&self, (of, place): Which) -> Face {
        Face { gradient: self.roots[of] * self.bodies[of].normal(place), of, place }
    }

    /// The step along −y, in units of y, on which F falls from `level` at `rate`, and the plane that takes over there;
    /// if none does, the step to F = 0. x is where the last step led.
    fn next(&mut self, x: &Vector3<f64>, y: &Vector3<f64>, level: f64, rate: f64) -> (f64, Option<Which>) {
        if self.few { self.next_of_few(y, level, rate) } else { self.next_of_many(x, y, level, rate) }
    }

    fn next_of_few(&mut self, y: &Vector3<f64>, level: f64, rate: f64) -> (f64, Option<Which>) {
        let (mut way, mut next) = (level / rate, None);
        for (i, (body, root)) in self.bodies.iter().zip(self.roots).enumerate() {
            let y = root * body.turn(y);
            let known = self.heights[i].iter_mut().zip(&mut self.falls[i]);
            for (place, (n, (height, fall))) in body.particle.normals().zip(known).enumerate() {
                // Updated, not evaluated again: a start need not be perfect.
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

    /// First among the neighbours of the last planes; then by Newton's method from there: what lies above F there takes
    /// over earlier.
    fn next_of_many(&mut self, x: &Vector3<f64>, y: &Vector3<f64>, level: f64, rate: f64) -> (f64, Option<Which>) {
        let (mut way, mut next) = (level / rate, None);
        for i in 0..2 {
            let (body, last) = (self.bodies[i], self.last[i]);
            let (at, fall) = (body.local(x), self.roots[i] * body.turn(y));
            let around = body.particle.neighbours.around(last).iter().map(|&place| usize::from(place));
            for place in around.chain([last]) {
                let below = larger(level - self.roots[i] * body.particle.excess(place, &at), 0.0);
                let closing = rate - body.particle.normal(place).dot(&fall);
                if closing > SLOW * rate && below < way * closing {
                    (way, next) = (below / closing, Some((i, place)));
                }
            }
        }
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

/// The minimiser of max(S_A, S_B) from that of F, and its λ. `None` if all planes are of one particle: they give its
/// centre, no contact.
fn balanced(balance: &MinimumNorm, x: &Vector3<f64>, level: f64) -> Option<(Start, f64)> {
    let mut squares = [0.0; 2];
    (0..balance.count).for_each(|i| squares[balance.faces[i].of] += balance.shares[i] * balance.shares[i]);
    let [alpha, beta] = squares.map(f64::sqrt);
    if !(alpha > 0.0 && beta > 0.0) {
        return None;
    }
    let tau = level / (alpha + beta);
    let per_share = [tau / alpha, tau / beta];
    let excess = |i: usize| per_share[balance.faces[i].of] * balance.shares[i];
    let last = balance.count - 1;
    let to_last = excess(last);
    let step = (0..last).fold(Vector3::zeros(), |sum, i| sum + (excess(i) - to_last) * balance.reciprocal[i]);
    let (x, lambda) = (x + step, beta / alpha);
    lambda.is_finite().then_some((Start { x, lambda }, tau))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::particle::Particle;
    use crate::pose::Pose;

    /// With k = 0 a face of B, at x = 0.5, and a face or an edge of A meet where s·(r_A + r_B) is what is between the
    /// sharp ones.
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
}
