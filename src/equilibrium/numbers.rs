//! The numbers that the solution is tuned by, all in one place. Forces are over those on a body, drag over the
//! stiffness of all points of a body, displacements over those of elastic bodies; a part is one of the quantity itself.
//! None is of the law. The accuracy of a factor is in AT_REST and SETTLED, that of a bound in REDUCED, EXCESS and
//! WEAKER.

/// States of rest: the largest force that may be left on a body, over the sum of the sizes of all forces on it.
pub(super) const AT_REST: f64 = 1e-8;
/// Forces beyond this many times all loads together clamp blocks: what is left is then judged by the loads.
pub(super) const CLAMPED: f64 = 10.0;
/// Bodies go without end if so many steps in a row, of a drag that would not hold the softest joints, leave R at least
/// KEEPS of its size: elastic bodies would use it up.
pub(super) const GOING: u32 = 3;
pub(super) const SOFTEST: f64 = 1e-11;
pub(super) const KEEPS: f64 = 0.9;
/// Part of R by which a step may miss it. One that misses more is shortened by SHORTER, down to SHORTEST.
pub(super) const MISSED: f64 = 0.6;
pub(super) const SHORTER: f64 = 0.4;
pub(super) const SHORTEST: f64 = 0.05;
/// Least drag: with less the rounding of the stiffness would hold a mechanism.
pub(super) const LEAST_DRAG: f64 = 1e-13;
/// With more drag even a light stone on a heavy one does not move.
pub(super) const MOST_DRAG: f64 = 1e12;
/// The first drag of a drift from nothing, and from loads that are raised.
pub(super) const DRIFT_DRAG: f64 = 0.1;
pub(super) const RAISED_DRAG: f64 = 1e-2;
/// That of a step along the path and of its tangent, little since the law is linear between two events; a tangent then
/// exists where bodies are loose, too.
pub(super) const STEP_DRAG: f64 = 1e-8;
/// The least weight of a coordinate of a body in the drag, over that of its stiffest one.
pub(super) const LEAST_WEIGHT: f64 = 1e-3;
/// Most factorisations of a step, of a drift, and of a path.
pub(super) const OF_STEP: u32 = 60;
pub(super) const OF_DRIFT: u32 = 400;
pub(super) const OF_PATH: u32 = 40_000;

/// The path: its first step, as a part of the displacements there are; below the least steps lead nowhere, and loads
/// are raised instead.
pub(super) const FIRST_STEP: f64 = 0.05;
pub(super) const LEAST_STEP: f64 = 1e-5;
/// By how much loads are raised, as parts of them: under very little more than they can bear bodies creep.
pub(super) const RAISED: [f64; 3] = [0.01, 0.04, 0.16];
/// Displacements after which bodies then go along a mechanism, over those before.
pub(super) const ASTRAY: f64 = 30.0;
/// Where the parameter falls back by this part, a load that grows has no state to go on with.
pub(super) const BACK: f64 = 2e-3;
/// Live loads this many times the dead ones, or strength of this part, count as without limit.
pub(super) const WITHOUT_LIMIT: f64 = 1e9;
/// Towards the limit the parameter changes with the inverse of the displacements. It is extrapolated whenever these
/// have grown so much, and found when it is as near to its limit as NEAR, and two extrapolations agree to SETTLED.
pub(super) const GROWTH: f64 = 4.0;
pub(super) const NEAR: f64 = 1e-3;
pub(super) const SETTLED: f64 = 1e-5;
/// Doubles of the strength that are tried where a scene does not stand with the given one.
pub(super) const STRONGER: i32 = 20;

/// Cone programs: accuracy that clarabel is asked for, relative to the mean load of a body, and its regularisation.
/// Each fails on different scenes, the most accurate comes first. Above a regularisation of 1e-9 the accuracy of 1e-10
/// is out of reach for walls of 1,000 blocks, and more than half of the iterations look for it in vain.
pub(super) const ATTEMPTS: [(f64, f64); 4] = [(1e-10, 1e-10), (1e-10, 1e-8), (1e-9, 1e-9), (1e-8, 1e-7)];
/// Accuracy that is taken where it gets no further, and to which a factor of safety settles.
pub(super) const REDUCED: f64 = 1e-7;
/// From so many free bodies on, the first attempt is left out: it has no answer for a wall of 3,164 blocks, and solves
/// one of 976 (measured).
pub(super) const MANY: usize = 2000;
/// Iterations without a halving of the residuals after which a program of so many bodies ends: the wall takes 55 in the
/// place of 100. Smaller scenes go on, as an arch at its limit needs all accuracy.
pub(super) const STALLED: u32 = 8;
/// A strength below this part of the unit of force is none: no cone is that thin beside the tolerance.
pub(super) const NO_STRENGTH: f64 = 1e-12;
/// Largest force that may stay unbalanced on a body, over the largest force.
pub(super) const BALANCED: f64 = 1e-6;
/// The largest friction beyond its strength that a program may leave, over the mean load of a body; and the smallest
/// part of the strength by which a bracket is halved.
pub(super) const EXCESS: f64 = 1e-5;
/// From one strength to the next where a bracket has one end alone.
pub(super) const STRIDE: f64 = 5.0;
/// A factor is proved if the scene falls with strength that is weaker by this part.
pub(super) const WEAKER: f64 = 1e-4;
/// Programs after which each halves the bracket, and most programs.
pub(super) const HALVING: u32 = 30;
pub(super) const MOST_PROGRAMS: u32 = 100;

/// Scenes. Corners whose triangle with their neighbours has no more than this part of the square of the extent lie on
/// an edge: they are rounding.
pub(super) const STRAIGHT: f64 = 1e-9;
/// Where corners lie farther from the plane across the normal than this part of their extent, the normal is that of
/// another face: patches of bodies that have turned lean by some 1e-3.
pub(super) const MOST_LEAN: f64 = 0.1;
/// Polygons below this part of their bodies, or of their distance from the origin, are points: the rounding of corners
/// decides how they lean.
pub(super) const A_POINT: f64 = 1e-6;
/// Coefficients of friction above are refused: their cones are half-spaces to rounding.
pub(super) const MOST_FRICTION: f64 = 1e6;
