//! A potential at a point, and its derivatives in the pose and the shape of its body: in doubles, or in numbers of 32
//! digits.

use super::answer::ShapeGradient;
use crate::linalg::double_double::DoubleDouble;
use crate::linalg::number::{Single, smaller};
use crate::linalg::symmetric::Symmetric;
use crate::linalg::wide::Wide;
use crate::pair::body::shift_in_a;
use crate::pair::extended_body;
use crate::pair::local_point::PlaneList;
use crate::particle::particle::Particle;
use crate::particle::plane::Plane;
use crate::particle::potential::{Sums, Weights};
use crate::pose::Pose;
use nalgebra::{Matrix3, Vector3};

/// The potential of a body, as the solver had it.
pub(super) struct Potential<'a, N: Single = f64> {
    pub particle: &'a Particle,
    /// Local to world.
    rotation: Matrix3<N>,
    /// The weights that the solver used.
    pub weights: Weights<N>,
}

/// A point, seen from the centre of a body.
#[derive(Clone, Copy)]
pub(super) struct Place<'a, N: Single = f64> {
    pub body: &'a Potential<'a, N>,
    /// From the centre to the point, world axes.
    pub branch: Vector3<N>,
    /// Bound on the distance of the point to the optimum, and on what it has lost to rounding, lengths.
    error: f64,
    rounding: f64,
    /// Planes with |depth| up to this are active if they are listed: a stiff plane carries its share with a depth below
    /// the rounding of the point. 0 where the sign of the depth decides.
    blur: f64,
    listed: PlaneList,
}

/// (Regularised) S about a point, in given axes.
#[derive(Clone, Copy)]
pub(super) struct Field<N> {
    pub value: N,
    pub gradient: Vector3<N>,
    pub hessian: Symmetric<N>,
    /// Whether no plane may switch within the error of the point.
    pub clear: bool,
    /// Bound on the relative rounding of the depths that make the gradient; infinite where the sign of one is
    /// uncertain.
    pub lost: f64,
    /// Whether the particle's own potential has a slope, and not that of the regularisation alone.
    pub sloped: bool,
}

impl<'a> Potential<'a> {
    #[inline(always)]
    pub fn new((particle, pose): (&'a Particle, &Pose), least_sphericity: f64) -> Self {
        Self { particle, rotation: *pose.rotation(), weights: Weights::of(particle, least_sphericity) }
    }
}

impl<'a> Potential<'a, DoubleDouble> {
    /// The same with the digits of the pose and the weights as they were given.
    pub fn precise((particle, pose): (&'a Particle, &Pose), least_sphericity: f64) -> Self {
        let (own, sphere) = (Weights::precise(particle), Weights::of(particle, least_sphericity).sphere);
        let is_regularised = sphere > particle.sphere_weight;
        Self {
            particle,
            rotation: Matrix3::from_columns(&extended_body::axes(pose)),
            weights: if is_regularised { Weights { sphere: DoubleDouble::from(sphere), ..own } } else { own },
        }
    }
}

impl<'a> Place<'a> {
    /// A point that is known to within `error`, and in which lengths of `from` were rounded.
    #[inline(always)]
    pub fn new(body: &'a Potential<'a>, branch: Vector3<f64>, [error, from]: [f64; 2]) -> Self {
        let rounding = f64::EPSILON * (branch.norm() + from);
        Self { body, branch, error, rounding, blur: 0.0, listed: PlaneList::default() }
    }
}

impl<'a> Place<'a, DoubleDouble> {
    /// A point that is to be refined.
    pub fn precise(body: &'a Potential<'a, DoubleDouble>, branch: Wide) -> Self {
        let blur = rounding_in_doubles(body.particle, branch.map(DoubleDouble::rounded).norm());
        let place = Self { body, branch, error: 0.0, rounding: 0.0, blur, listed: PlaneList::default() };
        let mut listed = PlaneList::default();
        place.visit_near(&place.local(), |plane, _, depth| {
            if depth.rounded().abs() <= place.blur {
                listed.add(plane);
            }
        });
        Self { listed, ..place }
    }

    /// Takes the listed plane of the most negative depth, which pulls, off the list; whether there was one.
    pub fn drop_a_pulling_plane(&mut self) -> bool {
        let mut worst = (0.0, 0);
        self.visit_near(&self.local(), |plane, _, depth| {
            if self.listed.contains(plane) && depth.rounded().abs() <= self.blur && depth.rounded() < worst.0 {
                worst = (depth.rounded(), plane);
            }
        });
        if worst.0 < 0.0 {
            self.listed.remove(worst.1);
        }
        worst.0 < 0.0
    }
}

#[inline(always)]
pub(super) fn dot3<N: Single>(a: &Vector3<N>, b: &Vector3<N>) -> N {
    a.x * b.x + a.y * b.y + a.z * b.z
}

#[inline(always)]
pub(super) fn times<N: Single>(m: &Matrix3<N>, v: &Vector3<N>) -> Vector3<N> {
    let row = |i: usize| m[(i, 0)] * v.x + m[(i, 1)] * v.y + m[(i, 2)] * v.z;
    Vector3::new(row(0), row(1), row(2))
}

/// Bound on the rounding of the depth of a plane at this distance from the centre, in doubles.
fn rounding_in_doubles(particle: &Particle, length: f64) -> f64 {
    let bounds = &particle.bounds;
    bounds.longest_normal * shift_in_a(length, length) + f64::EPSILON * bounds.offset_within(length)
}

impl<N: Single> Potential<'_, N> {
    /// A direction in the local frame.
    #[inline(always)]
    fn local(&self, v: &Vector3<N>) -> Vector3<N> {
        let r = &self.rotation;
        let component = |i: usize| r[(0, i)] * v.x + r[(1, i)] * v.y + r[(2, i)] * v.z;
        Vector3::new(component(0), component(1), component(2))
    }
}

impl<'a, N: Single> Place<'a, N> {
    /// Planes are active by the sign of their depth.
    pub fn by_sign(self) -> Self {
        Self { blur: 0.0, ..self }
    }

    /// The same body and another point, so far from this one.
    pub fn moved(&self, way: &Vector3<N>) -> Self {
        Self { branch: self.branch + way, ..*self }
    }

    /// Distance of the point from the centre.
    pub fn length(&self) -> f64 {
        self.branch.map(N::approximate).norm()
    }

    /// The point in the local frame.
    #[inline(always)]
    fn local(&self) -> Vector3<N> {
        self.body.local(&self.branch)
    }

    /// Calls `visit` with place, normal and depth of each plane that may be active. Returns an upper bound on the
    /// depths of all others.
    #[inline(always)]
    fn visit_near(&self, y: &Vector3<N>, mut visit: impl FnMut(usize, Vector3<N>, N)) -> f64 {
        let (near, shape) = (y.map(N::approximate), self.body.particle);
        let doubles = N::UNIT >= 0.5 * f64::EPSILON;
        let early = if doubles { 0.0 } else { 2.0 * rounding_in_doubles(shape, near.norm()) };
        shape.visit_near(&near, early, |place, n, excess| {
            let normal = n.map(N::of);
            visit(place, normal, N::refined(excess, || normal.dot(y) - N::of(shape.offset(place))));
        })
    }

    /// The same with the active planes alone. Returns the least |depth| of any plane that is not listed.
    #[inline(always)]
    fn visit_active(&self, y: &Vector3<N>, mut visit: impl FnMut(usize, Vector3<N>, N)) -> f64 {
        let mut least = f64::INFINITY;
        let others = self.visit_near(y, |place, normal, depth| {
            let approximate = depth.approximate();
            let is_active =
                if approximate.abs() > self.blur { depth.is_positive() } else { self.listed.contains(place) };
            least = smaller(approximate.abs(), least);
            if is_active {
                visit(place, normal, depth);
            }
        });
        smaller(least, -others)
    }

    /// S about the point in the axes that are the columns of a matrix, world axes.
    #[inline(always)]
    pub fn field(&self, axes: &Matrix3<N>) -> Field<N> {
        // Unrolled by hand: compilers do not unroll products of generic matrices.
        let axis = |i: usize| self.body.local(&axes.column(i).into_owned());
        let (first, second, normal) = (axis(0), axis(1), axis(2));
        let turn = |v: &Vector3<N>| Vector3::new(dot3(&first, v), dot3(&second, v), dot3(&normal, v));
        let y = self.local();
        let (mut sums, mut squares) = (Sums::default(), Symmetric::default());
        let clear = self.visit_active(&y, |_, n, depth| {
            sums.add(&n, depth);
            squares.add_square(&turn(&n));
        });
        let (weights, count) = (&self.body.weights, f64::from(sums.count));
        let bounds = &self.body.particle.bounds;
        let length = self.branch.map(N::approximate).norm();
        let is_told = clear > N::UNIT / f64::EPSILON * 2.0 * rounding_in_doubles(self.body.particle, length);
        let lost = count * bounds.longest_normal * self.rounding / sums.depth.approximate();
        Field {
            value: weights.value(&sums, &self.branch),
            gradient: turn(&weights.gradient(&sums.linear, &y)),
            hessian: weights.hessian(&squares),
            clear: is_told && clear > bounds.longest_normal * self.error,
            lost: match count {
                _ if !is_told => f64::INFINITY,
                0.0 => 0.0,
                _ => lost,
            },
            sloped: count > 0.0 || self.body.particle.sphere_weight > 0.0,
        }
    }

    /// S and ∇S at the point, world axes, of the particle itself.
    #[inline(always)]
    pub fn tangent(&self) -> (N, Vector3<N>) {
        let y = self.local();
        let mut sums = Sums::default();
        self.visit_active(&y, |_, n, depth| sums.add(&n, depth));
        let (own, used) = (self.body.particle.sphere_weight, self.body.weights);
        // The sphere of a regularised particle is its own to a double, which is enough of it.
        let weights = if used.sphere.approximate() > own { Weights { sphere: N::of(own), ..used } } else { used };
        (weights.value(&sums, &y), times(&self.body.rotation, &weights.gradient(&sums.linear, &y)))
    }

    /// Adds the derivative of σ·S + Γ·∇S at the point, Γ in world axes, in the shape.
    pub fn add_to_shape(&self, sigma: N, gamma: &Vector3<N>, sum: &mut ShapeGradient) {
        let shape = self.body.particle;
        let (y, gamma) = (self.local(), self.body.rotation.tr_mul(gamma));
        let w2 = self.body.weights.twice().plane;
        let mut of_weight = N::of(0.0);
        let mut add = |place: usize, n: Vector3<N>, depth: N| {
            let turned = gamma.dot(&n);
            let pull = sigma * depth + turned;
            let Plane { normal, offset } = &mut sum.planes[shape.given_index(place)];
            *normal += ((y * pull + gamma * depth) * w2).map(N::approximate);
            *offset -= (w2 * pull).approximate();
            of_weight += depth * (pull + turned);
        };
        let (r, k, shadow) = (shape.rounding_radius(), shape.sphericity(), shape.shadow_radius());
        if shape.plane_weight > 0.0 {
            self.visit_active(&y, &mut add);
        } else if r > 0.0 {
            // At k = 1 the planes count with the first step below it.
            for place in 0..shape.len() {
                let n = shape.normal(place).map(N::of);
                let depth = n.dot(&y) - N::of(shape.offset(place));
                if depth.is_positive() {
                    add(place, n, depth);
                }
            }
        }
        let of_weight = of_weight.approximate();
        let of_sphere = (sigma * y.dot(&y) + N::of(2.0) * gamma.dot(&y)).approximate();
        if r > 0.0 {
            sum.r -= w2.approximate() / r * of_weight;
            sum.k -= of_weight / (r * r);
        }
        if shadow > 0.0 {
            sum.k += of_sphere / (shadow * shadow);
            sum.shadow_radius -= 2.0 * k / shadow.powi(3) * of_sphere;
        }
    }
}
