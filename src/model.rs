//! The two quadratics at a point, solved exactly: one step of the fast solver.
//!
//! For weights a, b ≥ 0 let v minimise a·q_A + b·q_B, that is H v = −g with H = a H_A + b H_B, g = a g_A + b g_B. As
//! the weight θ of the target changes, v runs along a curve from the minimum of one particle to that of the other;
//! the wanted point is where the mismatch m(θ) = c − (α q_A + β q_B) is zero, with α, β the rates of a, b and
//! c = 0 for midway, 1 for the two closest points. One search in one variable serves all three.
//!
//! One factorisation of H gives the curve's whole Taylor series: with D = α H_A + β H_B and w₀ = α g_A + β g_B at v₀,
//!
//! ```text
//! v(δ) = Σ δⁿ v_n,   v_n = −H⁻¹ w_{n−1},   w_n = D v_n,   m_n = −(n+1)/2 · v_i·w_j  for any i + j = n, i ≥ 1
//! ```
//!
//! so that v₁ and v₂ give m to the fourth order, and each search multiplies the number of right digits by five.

use crate::number::larger;
use crate::potential::Quadratic;
use crate::symmetric::{Factor, Symmetric};
use crate::target::Target;
use nalgebra::Vector3;

/// The pair of quadratics and the target: what stays the same while λ is searched.
///
/// Rare parts take it and the probes by value: whose address is known has to stay in memory on the common way, too.
#[derive(Clone, Copy)]
pub(crate) struct Model<'a> {
    q_a: &'a Quadratic,
    q_b: &'a Quadratic,
    /// Least curvatures of A and B in any direction (their spheres').
    soft: (f64, f64),
    target: Target,
    /// D, and α·q_A + β·q_B at the point of expansion.
    turning: Symmetric,
    turned: f64,
    /// Rounding of the mismatch that comes from the values at the point of expansion.
    noise: f64,
}

/// Optimum of the two quadratics for a weight ratio λ.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Optimum {
    /// Step from the point of expansion.
    pub step: Vector3<f64>,
    /// ∇S_A and ∇S_B there: a·g_A + b·g_B = 0. Where a stiff plane is on by less than rounding, only the
    /// model knows them.
    pub gradients: [Vector3<f64>; 2],
    /// q_A and q_B there.
    pub values: (f64, f64),
    /// Weight ratio λ = b/a.
    pub lambda: f64,
    /// Whether λ is as good as rounding allows.
    pub settled: bool,
    /// Of H, at λ or very near.
    factor: Factor,
    /// The λ of the factor.
    factored: f64,
    /// dv/dθ and dm/dθ.
    along: Vector3<f64>,
    rate: f64,
}

/// The point of the curve at some λ: as much as the search for λ takes.
#[derive(Clone, Copy)]
struct Probe {
    lambda: f64,
    weights: (f64, f64),
    step: Vector3<f64>,
    factor: Factor,
    along: Vector3<f64>,
    rate: f64,
    /// m.
    mismatch: f64,
    /// q_A and q_B, to what a·q_A + b·q_B loses.
    values: (f64, f64),
}

/// Most searches for λ; a handful is enough where rounding does not interfere.
const MOST_SEARCHES: usize = 40;

/// λ stays in this range: beyond it one particle's weight is lost in rounding altogether.
const LAMBDA_RANGE: (f64, f64) = (1e-30, 1e30);

/// One search moves λ by at most this factor: quadratics that miss the planes further on may not
/// reach the target at all.
const FARTHEST: f64 = 1e6;

/// Largest share of the higher terms of the series in the first one at which the series is used at all: what is left
/// out then is some 1e-3 of the mismatch.
const NEAR: f64 = 0.1;

/// The same share at which what is left out, its fourth power, is below rounding.
const VERY_NEAR: f64 = 3e-4;

/// Slope relative to either force that is but rounding.
const BALANCED: f64 = 16.0 * f64::EPSILON;

/// Relative mismatch below which a search that no longer gains is at the end of its digits.
const STALLING: f64 = 1e-9;

/// Rounding of the sums in a slope: twice the root of the terms of S, each right to a few units in the last place.
const SUMS: f64 = 8.0 * f64::EPSILON;

/// Searches in a row that may gain less than half: a side that hardly changes with λ gains late.
const MOST_SLOW: u32 = 4;

/// Rounding of tr(M H M), relative to tr H⁻¹.
const TRACE_ROUNDING: f64 = 16.0 * f64::EPSILON;

impl<'a> Model<'a> {
    #[inline(always)]
    pub fn new(q_a: &'a Quadratic, q_b: &'a Quadratic, soft: (f64, f64), target: Target) -> Self {
        let (alpha, beta) = target.turning();
        let turning = q_a.hessian.weighted(alpha, &q_b.hessian, beta);
        let turned = alpha * q_a.expansion + beta * q_b.expansion;
        let (of_a, of_b) = target.changes(q_a.expansion, q_b.expansion);
        Self { q_a, q_b, soft, target, turning, turned, noise: 2.0 * f64::EPSILON * (of_a + of_b) }
    }

    /// Searches λ from a guess until the mismatch of the two sides is `enough`; 0 for as good as rounding allows.
    /// `None` when a factorisation breaks down.
    #[inline(always)]
    pub fn solve(&self, guess: f64, enough: f64) -> Option<Optimum> {
        self.search(guess.clamp(LAMBDA_RANGE.0, LAMBDA_RANGE.1), enough)
    }

    /// The optimum at a given λ.
    pub fn at(&self, lambda: f64) -> Option<Optimum> {
        Some(self.optimum(&self.probe(lambda)?))
    }

    /// With H v = −g the weighted sum is ½ g·v more than at the point of expansion, and D v gives the other sum: q_A and
    /// q_B follow from the two.
    #[inline(always)]
    fn probe(&self, lambda: f64) -> Option<Probe> {
        let weights @ (a, b) = self.target.weights(lambda);
        let h = self.q_a.hessian.weighted(a, &self.q_b.hessian, b);
        let factor = Factor::of(&h, a * self.soft.0 + b * self.soft.1)?;
        let g = a * self.q_a.gradient + b * self.q_b.gradient;
        let step = -factor.solve(&g);
        let before = self.of_turning(&self.q_a.gradient, &self.q_b.gradient);
        let w0 = before + self.turning.times(&step);
        let along = -factor.solve(&w0);
        let turning = self.turned + 0.5 * step.dot(&(before + w0));
        let fixed = a * self.q_a.expansion + b * self.q_b.expansion + 0.5 * step.dot(&g);
        let (values, mismatch) = (self.target.apart(fixed, turning, weights), self.target.level() - turning);
        Some(Probe { lambda, weights, step, factor, along, rate: -w0.dot(&along), mismatch, values })
    }

    /// α·x + β·y.
    #[inline(always)]
    fn of_turning(&self, x: &Vector3<f64>, y: &Vector3<f64>) -> Vector3<f64> {
        match self.target {
            Target::Midway => y - x,
            Target::OnB => *y,
            Target::OnA => *x,
        }
    }

    /// The optimum at a point of the curve.
    #[inline(always)]
    fn optimum(&self, probe: &Probe) -> Optimum {
        self.after(probe.step, probe.lambda, probe)
    }

    /// What a step and a λ are worth that another model found.
    pub fn held(&self, step: Vector3<f64>, lambda: f64) -> Option<Optimum> {
        Some(Optimum { settled: true, ..self.after(step, lambda, &self.probe(lambda)?) })
    }

    /// The quadratics after a step, which lies on the curve near a probe.
    #[inline(always)]
    fn after(&self, step: Vector3<f64>, lambda: f64, near: &Probe) -> Optimum {
        let gradient = |q: &Quadratic| q.gradient + q.hessian.times(&step);
        let gradients = [gradient(self.q_a), gradient(self.q_b)];
        let value = |q: &Quadratic, g: &Vector3<f64>| q.expansion + 0.5 * step.dot(&(q.gradient + g));
        let values = (value(self.q_a, &gradients[0]), value(self.q_b, &gradients[1]));
        let Probe { factor, along, rate, lambda: factored, .. } = *near;
        Optimum { step, gradients, values, lambda, settled: false, factor, factored, along, rate }
    }

    /// Searches λ from one that is in its range.
    #[inline(always)]
    pub fn search(&self, first: f64, enough: f64) -> Option<Optimum> {
        let mut found = self.probe(first)?;
        let (nearest, farthest) = (found.lambda / FARTHEST, found.lambda * FARTHEST);
        let (mut low, mut high) = (nearest, farthest);
        let (mut last, mut slow) = (f64::INFINITY, 0);
        for _ in 0..MOST_SEARCHES {
            let (growing, falling) = self.target.sides(found.values.0, found.values.1);
            let (difference, larger) = (self.target.difference(found.mismatch), larger(growing, falling));
            if !difference.is_finite() {
                return None;
            }
            // To rounding; or the search, which should do far better, does not even halve it any more.
            let noise = self.noise + 4.0 * f64::EPSILON * larger;
            slow = if difference.abs() > 0.5 * last { slow + 1 } else { 0 };
            let settled = difference.abs() <= noise;
            if settled || difference.abs() <= enough {
                return Some(Optimum { settled, ..self.optimum(&found) });
            }
            if slow >= MOST_SLOW && difference.abs() <= STALLING * larger {
                return Some(self.corrected(found));
            }
            last = difference.abs();
            if difference > 0.0 {
                high = found.lambda;
            } else {
                low = found.lambda;
            }
            let next = match self.series(&found) {
                Some(series) if series.share <= VERY_NEAR || (series.share <= NEAR && enough > 0.0) => {
                    let further = self.along(&found, &series);
                    let left = self.target.mismatch(further.values.0, further.values.1);
                    let settled = series.share <= VERY_NEAR && left <= noise && self.is_balanced(&further);
                    if settled || left <= enough {
                        return Some(Optimum { settled, ..further });
                    }
                    series.lambda
                }
                Some(series) if series.share <= NEAR => series.lambda,
                _ => self.far(found, growing, falling),
            };
            // Beyond what is known of the curve: to its end, and no further.
            let next = if next >= high && high == farthest {
                farthest
            } else if next <= low && low == nearest {
                nearest
            } else if low < next && next < high {
                next
            } else {
                (low * high).sqrt()
            };
            if next == found.lambda {
                // No λ does better. At an end of the range there may be a better one, for other quadratics.
                return Some(Optimum { settled: next != nearest && next != farthest, ..self.optimum(&found) });
            }
            found = self.probe(next)?;
        }
        Some(self.optimum(&found))
    }

    /// Root of m(δ) to the fourth order, by reversion of the series; `None` where it would move a weight by more
    /// than half.
    #[inline(always)]
    fn series(&self, found: &Probe) -> Option<Series> {
        let (v1, inverse, (a, b)) = (&found.along, 1.0 / found.rate, found.weights);
        let w1 = self.turning.times(v1);
        let v2 = -found.factor.solve(&w1);
        let w2 = self.turning.times(&v2);
        let (m2, m3, m4) = (-1.5 * v1.dot(&w1), -2.0 * v2.dot(&w1), -2.5 * v2.dot(&w2));
        let y = -found.mismatch * inverse;
        let (c2, c3, c4) = (m2 * inverse * y, m3 * inverse * y * y, m4 * inverse * y * y * y);
        let delta = y * (1.0 - c2 + (2.0 * c2 * c2 - c3) + (5.0 * c2 * (c3 - c2 * c2) - c4));
        let (alpha, beta) = self.target.turning();
        let stays = (alpha * delta).abs() <= 0.5 * a && (beta * delta).abs() <= 0.5 * b;
        let lambda = (b + beta * delta) / (a + alpha * delta);
        stays.then_some(Series { delta, lambda, v2, w2, share: c2.abs() + c3.abs() + c4.abs() })
    }

    /// The optimum at the end of a series, without another factorisation.
    #[inline(always)]
    fn along(&self, found: &Probe, series: &Series) -> Optimum {
        let v3 = -found.factor.solve(&series.w2);
        let delta = series.delta;
        let step = found.step + delta * (found.along + delta * (series.v2 + delta * v3));
        self.after(step, series.lambda, found)
    }

    /// Where the rounding of the factorisation moves a side by more than its noise, at random for each λ: the way to the root
    /// along the curve is smooth.
    #[cold]
    fn corrected(self, found: Probe) -> Optimum {
        let here = self.optimum(&found);
        let further = self.series(&found).map(|series| self.along(&found, &series));
        let left = |optimum: &Optimum| self.target.mismatch(optimum.values.0, optimum.values.1);
        let best = further.filter(|further| left(further) < left(&here)).unwrap_or(here);
        Optimum { settled: true, ..best }
    }

    /// Whether the slope a·g_A + b·g_B is zero to rounding. In a pair that is alike on both sides the terms of the mismatch
    /// cancel and say nothing about those of the curve.
    #[inline(always)]
    fn is_balanced(&self, found: &Optimum) -> bool {
        let (a, _) = self.target.weights(found.lambda);
        let force = a * a * (self.q_a.gradient.norm_squared() + found.gradients[0].norm_squared());
        found.slope(self.target).norm_squared() <= BALANCED * BALANCED * force
    }

    /// The next λ where the series is of no use: far off, the logarithms of both sides are nearly linear in ln λ.
    #[cold]
    fn far(self, found: Probe, growing: f64, falling: f64) -> f64 {
        // The weighted sum stays what it is on the curve, to first order.
        let turning = -self.target.per_logarithm(found.weights) * found.rate;
        let (rate_a, rate_b) = self.target.apart(0.0, turning, found.weights);
        let (rate_growing, rate_falling) = self.target.changes(rate_a, rate_b);
        let change = if growing.min(falling) > 0.0 {
            (falling / growing).ln() / (rate_growing / growing - rate_falling / falling)
        } else {
            (falling - growing) / (rate_growing - rate_falling)
        };
        found.lambda * change.clamp(-60.0, 60.0).exp()
    }
}

/// The way to the root along the series of the curve.
struct Series {
    /// Change of θ.
    delta: f64,
    /// λ after it.
    lambda: f64,
    v2: Vector3<f64>,
    w2: Vector3<f64>,
    /// Share of the higher terms in the first.
    share: f64,
}

impl Optimum {
    /// a·g_A + b·g_B: zero but for rounding.
    pub fn slope(&self, target: Target) -> Vector3<f64> {
        let (a, b) = target.weights(self.lambda);
        a * self.gradients[0] + b * self.gradients[1]
    }

    /// Bound on the rounding of the sums by which S of one body is taken along the step, axis by axis: along a face a long
    /// step has but the curvature of the face. By Cauchy's inequality no sum in the Hessian has terms above √(h_ii·h_jj).
    pub fn rounding(&self, q: &Quadratic) -> f64 {
        2.0 * f64::EPSILON * (2.0 * q.terms(&self.step) + self.step.abs().dot(&q.gradient.abs()))
    }

    /// The same of the sums by which the slope was made to vanish, in whatever direction.
    pub fn rounding_of_slope(&self, q: &Quadratic) -> f64 {
        SUMS * (q.terms(&self.step) * q.hessian.trace()).sqrt()
    }

    /// How fast the sides part with ln λ.
    pub fn rate(&self, target: Target) -> f64 {
        self.rate * target.per_logarithm(target.weights(self.lambda))
    }

    /// How the optimum answers to small changes of the data, with least curvatures `soft` of A and B.
    #[inline(always)]
    pub fn response(&self, target: Target, soft: (f64, f64)) -> Option<Response> {
        if !(self.rate > 0.0) {
            return None;
        }
        let inverse = self.factor.inverse();
        let mut squares = Symmetric::default();
        squares.add_square(&self.along);
        let to_slope = squares.weighted(1.0 / self.rate, &inverse, -1.0);
        let (a, b) = target.weights(self.factored);
        // tr(M H M) = −tr M, less the spheres' share of H; the difference is known to the rounding of its terms.
        let (trace, traces) = (-to_slope.trace(), [inverse.trace(), inverse.xx + inverse.yy]);
        let of_planes = trace - (a * soft.0 + b * soft.1) * to_slope.square() + TRACE_ROUNDING * traces[0];
        Some(Response {
            to_slope,
            traces,
            per_value: self.along.norm() / self.rate,
            to_all_planes: larger(of_planes, 0.0),
            slope: self.slope(target),
            values: self.values.into(),
        })
    }
}

/// How the optimum answers to small changes of the data: the derivative of the conditions
/// a·g_A + b·g_B = 0 and m = 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Response {
    /// The answer of v to a slope that is left:
    ///
    /// ```text
    /// M = (along ⊗ along)/rate − H⁻¹
    /// ```
    to_slope: Symmetric,
    /// Traces of H⁻¹: over all three axes, and over the first two.
    traces: [f64; 2],
    /// |dv/dθ| / (dm/dθ), with dv/dθ = −H⁻¹w and dm/dθ = wᵀH⁻¹w.
    per_value: f64,
    /// Σ of weight·2w·tr(M N M) over both bodies, N = Σ n nᵀ over the planes of one.
    to_all_planes: f64,
    /// What is left of a·g_A + b·g_B.
    slope: Vector3<f64>,
    /// q_A and q_B.
    values: [f64; 2],
}

impl Response {
    /// The move that would take away what is left of the slope.
    pub fn unsolved(&self) -> f64 {
        self.to_slope.times(&self.slope).norm()
    }

    /// Bound on the move by the rounding of the sums in the slope of a body of this weight, after a step v: on axis k they
    /// are as large as √h_kk.
    pub fn to_sums(&self, q: &Quadratic, weight: f64, v: &Vector3<f64>) -> f64 {
        let m = &self.to_slope;
        let square = |x: f64, y: f64, z: f64| x * x + y * y + z * z;
        let moves = Vector3::new(square(m.xx, m.yx, m.zx), square(m.yx, m.yy, m.zy), square(m.zx, m.zy, m.zz));
        SUMS * weight * (3.0 * q.terms(v) * q.hessian.diagonal().dot(&moves)).sqrt()
    }

    /// The move of the optimum when a·g_A + b·g_B grows by a slope.
    pub fn to(&self, slope: &Vector3<f64>) -> Vector3<f64> {
        self.to_slope.times(slope)
    }

    /// Bound on the move when α·q_A + β·q_B is off by `value`.
    pub fn to_value(&self, value: f64) -> f64 {
        self.per_value * value
    }

    /// Bound on the moves, summed, when each plane of A (0) or B (1) moves by one unit of length.
    ///
    /// A plane with depth p turns the slope by 2wn and raises S by 2wp, and the optimum answers with
    /// 2w·(a·M n + along·α·p/rate). By Cauchy's inequality Σ|M n| ≤ √(m·tr(M N M)), and Σp ≤ √(m·S/w), so that no plane is
    /// looked at again. H·along = −w makes M H M = −M, of which the planes' share is what the spheres leave: one trace
    /// for all planes of both.
    pub fn to_planes(&self, body: usize, q: &Quadratic, target: Target, lambda: f64, plane_weight: f64) -> f64 {
        if plane_weight == 0.0 || q.count == 0 {
            return 0.0;
        }
        let ((a, b), (alpha, beta)) = (target.weights(lambda), target.turning());
        let (weight, rate) = if body == 0 { (a, alpha) } else { (b, beta) };
        let count = f64::from(q.count);
        let turned = (2.0 * plane_weight * weight * count * self.to_all_planes).sqrt();
        let raised = rate.abs() * self.per_value * (count * plane_weight * larger(self.values[body], 0.0)).sqrt();
        turned + 2.0 * raised
    }

    /// Bound on the move per unit of slope, in whatever direction (in the plane: of its first two axes).
    pub fn per_slope(&self, dimensions: usize) -> f64 {
        self.traces[usize::from(dimensions == 2)]
    }
}
