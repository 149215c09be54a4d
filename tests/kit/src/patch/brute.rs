//! A patch by brute force from its definition, which shares no code with the library: f·m = ∫ p du dv over the plane
//! across m, with the height at which s_A = s_B by bisection, and Gauss and Kronrod's rule on intervals that are halved
//! until it agrees with itself.

use nalgebra::{Matrix3, Vector3};
use potential_particles::{Particle, Pose};

/// Relative agreement that is asked of a rule over an interval, and most halvings.
const AGREEMENT: f64 = 1e-8;
const DEEPEST: u32 = 14;

/// Directions of the lines over which it integrates, and what of the difference of both areas counts.
const ANGLES: [f64; 2] = [0.77, 1.2];
const OF_AREA: f64 = 0.1;

/// Points and weights of Gauss and Kronrod's rule on [−1, 1], from the middle on, and the weights of Gauss' own.
const KRONROD: [[f64; 3]; 8] = [
    [0.0, 0.209_482_141_084_727_82, 0.417_959_183_673_469_4],
    [0.207_784_955_007_898_48, 0.204_432_940_075_298_89, 0.0],
    [0.405_845_151_377_397_2, 0.190_350_578_064_785_42, 0.381_830_050_505_118_9],
    [0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0],
    [0.741_531_185_599_394_5, 0.140_653_259_715_525_92, 0.279_705_391_489_276_64],
    [0.864_864_423_359_769_1, 0.104_790_010_322_250_17, 0.0],
    [0.949_107_912_342_758_5, 0.063_092_092_629_978_56, 0.129_484_966_168_869_7],
    [0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0],
];

/// Force, torque about the origin of the frame and area, over K, in the frame; and the farthest point.
#[derive(Clone, Copy, Debug)]
pub struct Brute {
    pub force: Vector3<f64>,
    pub torque: Vector3<f64>,
    pub area: f64,
    pub reach: f64,
    /// How far two such integrals differ, relative; of the area a tenth.
    pub doubt: f64,
}

/// S of a body in the frame.
struct Body {
    planes: Vec<(Vector3<f64>, f64)>,
    plane_weight: f64,
    sphere_weight: f64,
    centre: Vector3<f64>,
}

impl Body {
    fn new(particle: &Particle, pose: &Pose, origin: &Vector3<f64>, frame: &Matrix3<f64>) -> Self {
        let k = particle.sphericity();
        let at = pose.rotation().transpose() * (origin - pose.position());
        let axes = pose.rotation().transpose() * frame;
        let planes = particle.planes().map(|p| (axes.transpose() * p.normal, p.normal.dot(&at) - p.offset));
        Self {
            planes: if k < 1.0 { planes.collect() } else { Vec::new() },
            plane_weight: (1.0 - k) / particle.rounding_radius().powi(2),
            sphere_weight: if k > 0.0 { k / particle.shadow_radius().powi(2) } else { 0.0 },
            centre: frame.transpose() * (pose.position() - origin),
        }
    }

    fn s(&self, x: &Vector3<f64>) -> f64 {
        let planes: f64 = self.planes.iter().map(|(n, excess)| (n.dot(x) + excess).max(0.0).powi(2)).sum();
        let planes = if planes > 0.0 { self.plane_weight * planes } else { 0.0 };
        (planes + self.sphere_weight * (x - self.centre).norm_squared()).sqrt()
    }

    fn gradient(&self, x: &Vector3<f64>) -> Vector3<f64> {
        let mut half = self.sphere_weight * (x - self.centre);
        for (n, excess) in &self.planes {
            let depth = n.dot(x) + excess;
            if depth > 0.0 {
                half += self.plane_weight * depth * n;
            }
        }
        half / self.s(x)
    }
}

/// f, f × and area density at a point, over the length.
type Values = [f64; 7];

struct Task {
    a: Body,
    /// Without B the patch lies in the plane of the frame.
    b: Option<Body>,
    /// (a, b, c): within a u + b v ≤ c.
    sides: Vec<[f64; 3]>,
    half: f64,
}

impl Task {
    /// The point of the surface s_A = s_B.
    fn point(&self, u: f64, v: f64) -> Vector3<f64> {
        let Some(b) = &self.b else { return Vector3::new(u, v, 0.0) };
        let at = |z: f64| Vector3::new(u, v, z);
        let difference = |z: f64| self.a.s(&at(z)) - b.s(&at(z));
        let (mut low, mut high) = (-self.half, self.half);
        let (mut of_low, mut of_high) = (difference(low), difference(high));
        if !(of_low < 0.0 && of_high > 0.0) {
            return at(if of_low >= 0.0 { low } else { high });
        }
        // The secant where it halves, and the middle else.
        for step in 0..200 {
            if high - low <= 1e-15 * self.half {
                break;
            }
            let secant = low - of_low * (high - low) / (of_high - of_low);
            let middle = if step % 3 == 2 { 0.5 * (low + high) } else { secant.clamp(low, high) };
            let of = difference(middle);
            if of == 0.0 {
                return at(middle);
            }
            if of < 0.0 {
                (low, of_low, of_high) = (middle, of, if step % 3 == 1 { of_high } else { 0.5 * of_high });
            } else {
                (high, of_high, of_low) = (middle, of, if step % 3 == 1 { of_low } else { 0.5 * of_low });
            }
            if step % 3 == 2 {
                (of_low, of_high) = (difference(low), difference(high));
            }
        }
        at(0.5 * (low + high))
    }

    fn s(&self, u: f64, v: f64) -> f64 {
        self.a.s(&self.point(u, v))
    }

    fn values(&self, u: f64, v: f64) -> Values {
        let x = self.point(u, v);
        let pressure = 1.0 - self.a.s(&x);
        let normal = self.b.as_ref().map_or_else(Vector3::z, |b| self.a.gradient(&x) - b.gradient(&x));
        let normal = normal / normal.z;
        let (force, area) = (pressure * normal, normal.norm());
        let torque = x.cross(&force);
        [force.x, force.y, force.z, torque.x, torque.y, torque.z, area]
    }

    /// The planes that are active, a bit each.
    fn active(&self, u: f64, v: f64) -> u128 {
        let x = self.point(u, v);
        let planes = self.a.planes.iter().chain(self.b.iter().flat_map(|b| &b.planes));
        planes.fold(0, |bits, (n, excess)| bits << 1 | u128::from(n.dot(&x) + excess > 0.0))
    }

    /// Where v may lie on the line of u.
    fn range(&self, u: f64) -> [f64; 2] {
        let mut range = [-self.half, self.half];
        for [a, b, c] in &self.sides {
            let at = (c - a * u) / b;
            if *b > 0.0 {
                range[1] = range[1].min(at);
            } else if *b < 0.0 {
                range[0] = range[0].max(at);
            } else if a * u > *c {
                return [0.0, 0.0];
            }
        }
        range
    }

    /// The least s on the line of u and where; s is convex there.
    fn least(&self, u: f64) -> (f64, f64) {
        let [low, high] = self.range(u);
        if !(low < high) {
            return (f64::INFINITY, 0.5 * (low + high));
        }
        least(low, high, |v| (self.s(u, v), v))
    }

    fn line(&self, u: f64) -> Values {
        let (s, v) = self.least(u);
        if !(s < 1.0) {
            return [0.0; 7];
        }
        let [low, high] = self.range(u);
        let [low, high] = [low, high].map(|end| rim(v, end, |v| self.s(u, v)));
        let both = [(low, v), (v, high)].map(|(from, to)| {
            let places = pieces(from, to, &|v| self.active(u, v));
            integral(&places, &|v| self.values(u, v))
        });
        std::array::from_fn(|i| both[0][i] + both[1][i])
    }
}

/// The least value of a convex function with what else it says, by the golden section.
fn least(mut low: f64, mut high: f64, f: impl Fn(f64) -> (f64, f64)) -> (f64, f64) {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (mut first, mut last) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut of_first, mut of_last) = (f(first), f(last));
    for _ in 0..50 {
        if of_first.0 < of_last.0 {
            (high, last, of_last) = (last, first, of_first);
            first = high - GOLDEN * (high - low);
            of_first = f(first);
        } else {
            (low, first, of_first) = (first, last, of_last);
            last = low + GOLDEN * (high - low);
            of_last = f(last);
        }
    }
    if of_first.0 < of_last.0 { of_first } else { of_last }
}

/// Where s = 1 between a place inside and one that may be outside.
fn rim(inside: f64, outside: f64, s: impl Fn(f64) -> f64) -> f64 {
    if s(outside) <= 1.0 {
        return outside;
    }
    let (mut inside, mut outside) = (inside, outside);
    for _ in 0..46 {
        let middle = 0.5 * (inside + outside);
        if s(middle) < 1.0 { inside = middle } else { outside = middle }
    }
    inside
}

fn rule(from: f64, to: f64, f: &dyn Fn(f64) -> Values) -> [Values; 2] {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let mut sums = [[0.0; 7]; 2];
    for (i, [x, kronrod, gauss]) in KRONROD.into_iter().enumerate() {
        for sign in if i == 0 { &[1.0][..] } else { &[1.0, -1.0][..] } {
            let values = f(middle + sign * half * x);
            for j in 0..7 {
                sums[0][j] += half * kronrod * values[j];
                sums[1][j] += half * gauss * values[j];
            }
        }
    }
    sums
}

/// The ends of an interval and all places between at which the active planes change, as far as they do from one end to
/// the other.
fn pieces(from: f64, to: f64, active: &dyn Fn(f64) -> u128) -> Vec<f64> {
    fn add(
        places: &mut Vec<f64>,
        [from, to]: [f64; 2],
        [first, last]: [u128; 2],
        least: f64,
        active: &dyn Fn(f64) -> u128,
    ) {
        if first == last {
            return;
        }
        let middle = 0.5 * (from + to);
        if (to - from).abs() <= least || middle == from || middle == to {
            return places.push(to);
        }
        let there = active(middle);
        add(places, [from, middle], [first, there], least, active);
        add(places, [middle, to], [there, last], least, active);
    }
    let mut places = vec![from];
    add(&mut places, [from, to], [active(from), active(to)], 1e-11 * (to - from).abs(), active);
    places.push(to);
    places
}

/// Over all pieces between these places.
fn integral(places: &[f64], f: &dyn Fn(f64) -> Values) -> Values {
    let rules: Vec<_> = places.windows(2).map(|ends| rule(ends[0], ends[1], f)).collect();
    let size = [2, 6].map(|j| rules.iter().map(|rule| rule[0][j].abs()).sum());
    let mut sums = [0.0; 7];
    for (ends, rule) in places.windows(2).zip(rules) {
        let part = halved(ends[0], ends[1], rule, size, DEEPEST, f);
        (0..7).for_each(|j| sums[j] += part[j]);
    }
    sums
}

fn halved(
    from: f64,
    to: f64,
    [fine, coarse]: [Values; 2],
    size: [f64; 2],
    deeper: u32,
    f: &dyn Fn(f64) -> Values,
) -> Values {
    let off = |j: usize| (fine[j] - coarse[j]).abs();
    // Of the load in all directions, and of the area, which ends steeply.
    let agrees = (0..3).all(|j| off(j) <= AGREEMENT * size[0]) && off(6) <= 10.0 * AGREEMENT * size[1];
    if agrees || deeper == 0 || !(to - from > 0.0) {
        return fine;
    }
    let middle = 0.5 * (from + to);
    let parts =
        [(from, middle), (middle, to)].map(|(from, to)| halved(from, to, rule(from, to, f), size, deeper - 1, f));
    std::array::from_fn(|j| parts[0][j] + parts[1][j])
}

/// The patch of two bodies, or of one and the plane through `origin` within `sides` (a, b, c: a u + b v ≤ c in the
/// frame), in a frame whose third axis is the normal. `None` where there is none.
///
/// `half`: beyond this distance lies nothing of it. Much farther out both potentials may be equal on the other side of
/// a body, too. Twice as far as the points of a patch will do: where it goes on there, that is seen.
///
/// Of particles in the plane it is the integral over the one line there.
///
/// It is integrated twice, over lines in two directions that are along no side, and the difference tells how far either
/// can be trusted: the line along which the outer integral has a kink may be missed.
pub fn brute(
    a: (&Particle, &Pose),
    b: Option<(&Particle, &Pose)>,
    origin: &Vector3<f64>,
    frame: &Matrix3<f64>,
    sides: &[[f64; 3]],
    half: f64,
) -> Option<Brute> {
    if a.0.is_in_plane() {
        let frame =
            Matrix3::from_columns(&[Vector3::z(), frame.column(2).cross(&Vector3::z()), frame.column(2).into()]);
        return over_lines(a, b, origin, &frame, sides, half);
    }
    let [first, second] = ANGLES.map(|angle: f64| {
        let (sin, cos) = angle.sin_cos();
        let turned = frame * Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
        let sides: Vec<_> = sides.iter().map(|[u, v, c]| [cos * u + sin * v, cos * v - sin * u, *c]).collect();
        over_lines(a, b, origin, &turned, &sides, half)
    });
    let (first, second) = (first?, second?);
    let (size, reach) = (first.force.norm(), first.reach.max(second.reach));
    let of_force = (first.force - second.force).norm() / size;
    let of_torque = (first.torque - second.torque).norm() / (size * reach);
    let doubt = of_force.max(of_torque).max((first.area / second.area - 1.0).abs() * OF_AREA);
    Some(Brute { reach, doubt, ..first })
}

/// The same over the lines across the first axis of the frame.
fn over_lines(
    a: (&Particle, &Pose),
    b: Option<(&Particle, &Pose)>,
    origin: &Vector3<f64>,
    frame: &Matrix3<f64>,
    sides: &[[f64; 3]],
    half: f64,
) -> Option<Brute> {
    let body = |(particle, pose): (&Particle, &Pose)| Body::new(particle, pose, origin, frame);
    let length = a.0.depth_length() + b.map_or(0.0, |b| b.0.depth_length());
    let task = Task { a: body(a), b: b.map(body), sides: sides.to_vec(), half };
    let whole = |sums: Values, reach: f64| {
        let force = length * Vector3::new(sums[0], sums[1], sums[2]);
        let torque = frame * (length * Vector3::new(sums[3], sums[4], sums[5]));
        (force.z > 0.0).then_some(Brute { force: frame * force, torque, area: sums[6], reach, doubt: 0.0 })
    };
    if a.0.is_in_plane() {
        let (s, v) = task.least(0.0);
        let ends = [-half, half].map(|end| if s < 1.0 { rim(v, end, |v| task.s(0.0, v)) } else { 0.0 });
        return whole(task.line(0.0), ends[1].max(-ends[0]));
    }
    let (least_s, u) = least(-half, half, |u| (task.least(u).0, u));
    if !(least_s < 1.0) {
        return None;
    }
    let ends = [-half, half].map(|end| rim(u, end, |u| task.least(u).0));
    let mut sums = [0.0; 7];
    for [from, to] in [[ends[0], u], [u, ends[1]]] {
        // The line ends like a root where it leaves a round patch: with the square of a number it is smooth.
        let way = to - from;
        let at = |t: f64| {
            let (place, rate) = if from == u {
                (from + way * (1.0 - (1.0 - t) * (1.0 - t)), 2.0 * way * (1.0 - t))
            } else {
                (from + way * t * t, 2.0 * way * t)
            };
            task.line(place).map(|value| rate * value)
        };
        let places = pieces(0.0, 1.0, &|t| {
            let place = if from == u { from + way * (1.0 - (1.0 - t) * (1.0 - t)) } else { from + way * t * t };
            task.active(place, task.least(place).1)
        });
        let part = integral(&places, &at);
        (0..7).for_each(|j| sums[j] += part[j]);
    }
    whole(sums, ends.iter().fold(0.0_f64, |most, end| most.max(end.abs())))
}

/// A frame whose third axis is this.
pub fn frame_of(normal: &Vector3<f64>) -> Matrix3<f64> {
    let first = normal.cross(&Vector3::ith(normal.iamin(), 1.0)).normalize();
    Matrix3::from_columns(&[first, normal.cross(&first), *normal])
}
