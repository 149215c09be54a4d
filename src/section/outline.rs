//! Volume, centroid and inertia of a particle, and for one in the plane area and second moments of its cut and points
//! of its outline.

use super::moments::{Moments, Sector, sectors};
use super::numbers::{FINEST, FIRST_PARTS, Limits};
use crate::linalg::number::larger;
use crate::particle::error::ToleranceError;
use crate::particle::mass_properties::{self, MassProperties};
use crate::particle::numbers::OF_SUMS;
use crate::particle::particle::Particle;
use crate::particle::ray_cast;
use crate::particle::solid::Solid;
use nalgebra::{Matrix3, Vector2, Vector3};
use std::collections::BinaryHeap;
use std::f64::consts::TAU;

impl Particle {
    /// Volume, centroid and inertia to a relative tolerance ([`MASS_TOLERANCE`](crate::MASS_TOLERANCE) = 1e-6 is
    /// usual), by adaptive quadrature over rays from the origin to the surface. The answer says how far off it may be.
    ///
    /// 1e-6 takes milliseconds for some tens of planes.
    ///
    /// In the plane: of the cut, per unit of depth, so that the volume is an area and the inertia that of a sheet. In
    /// closed form, arc by arc of the outline; where rounding leaves more than the tolerance (lines far stiffer than
    /// the rest of the outline), a polygon of points on rays answers.
    ///
    /// # Errors
    /// A tolerance outside [1e-12, 1].
    pub fn mass_properties(&self, tolerance: f64) -> Result<MassProperties, ToleranceError> {
        ToleranceError::refuse_relative(tolerance)?;
        Ok(if self.is_in_plane() { of(self, tolerance) } else { mass_properties::of(self, tolerance) })
    }
}

/// In closed form, from the arcs of the boundary; where rounding leaves more than the tolerance of that, by a polygon
/// of points on rays, if it is surely better.
fn of(shape: &Solid, tolerance: f64) -> MassProperties {
    let tolerance = larger(tolerance, FINEST);
    let mut arcs = Vec::new();
    let traced = sectors(shape, |sector| arcs.push(sector)).map(|()| properties(&arcs)).ok();
    if let Some(found) = traced.filter(|found| found.error <= tolerance) {
        return found;
    }
    // What the error is over the distance of the sides from the boundary, the first polygon says.
    let rough = polygon(shape, tolerance);
    let share = larger(0.5 * tolerance * tolerance / rough.error, FINEST);
    let found = if rough.error > tolerance && share < tolerance { polygon(shape, share) } else { rough };
    traced.filter(|traced| !(found.error < 0.1 * traced.error)).unwrap_or(found)
}

/// Of the polygon of an outline; `share`: its tolerance over the bounding radius.
fn polygon(shape: &Solid, share: f64) -> MassProperties {
    let (points, deviation) = outline(shape, share * shape.bounds.radius);
    let chord = |(from, to): (&Vector2<f64>, &Vector2<f64>)| Sector {
        moments: Moments::triangle(from, to),
        corners: [*from, 0.5 * (from + to), *to],
        // The points are rounded, too.
        deviation: deviation + OF_SUMS * larger(from.norm(), to.norm()),
    };
    properties(&points.iter().zip(points.iter().cycle().skip(1)).map(chord).collect::<Vec<_>>())
}

fn properties(parts: &[Sector]) -> MassProperties {
    let Moments { area, first, second } =
        parts.iter().fold(Moments::default(), |sum, sector| sum.plus(&sector.moments));
    // Lengths are measured in the radii of gyration.
    let root = (second / area).cholesky().and_then(|factor| factor.l().try_inverse());
    let error = root.map_or(f64::INFINITY, |unscaled| {
        let of_part = |Sector { corners, deviation, .. }: &Sector| {
            let length = (corners[1] - corners[0]).norm() + (corners[2] - corners[1]).norm();
            let farthest = corners.iter().map(|corner| (unscaled * corner).norm()).fold(0.0, f64::max);
            deviation * length * (1.0 + farthest).max(farthest * farthest)
        };
        let of_sums = OF_SUMS * (parts.len() as f64).sqrt() * second.trace() / area * unscaled.norm_squared();
        parts.iter().map(of_part).sum::<f64>() / area + of_sums
    });
    // Beyond 1 its units mean nothing; nor does what is not a number.
    let error = if error < 1.0 { error } else { f64::INFINITY };
    let (xx, yy, xy) = (second.m11, second.m22, second.m12);
    let inertia = Matrix3::new(yy, -xy, 0.0, -xy, xx, 0.0, 0.0, 0.0, xx + yy);
    MassProperties { volume: area, centroid: (first / area).push(0.0), inertia, error }
}

/// A point of the boundary, and the angle of its ray.
type BoundaryPoint = (f64, Vector2<f64>);

/// A chord, the point of the boundary between its ends, and how far the boundary is from it at most.
struct Chord {
    ends: [BoundaryPoint; 2],
    middle: BoundaryPoint,
    deviation: f64,
}

impl Chord {
    fn new(ends: [BoundaryPoint; 2], on_ray: &impl Fn(f64) -> BoundaryPoint) -> Self {
        let [start, end] = ends;
        let middle = on_ray(0.5 * (start.0 + end.0));
        let (chord, beyond) = (end.1 - start.1, middle.1 - start.1);
        let share = chord.dot(&beyond) / chord.norm_squared();
        // The boundary is convex: where it is δ from the chord at a share m, it is nowhere further than δ/min(m, 1−m).
        let deviation = chord.perp(&beyond).abs() / (chord.norm() * larger(share.min(1.0 - share), 0.0));
        Self { ends, middle, deviation: if deviation.is_nan() { f64::INFINITY } else { deviation } }
    }

    /// Whether there is a ray between those of its ends.
    fn is_divisible(&self) -> bool {
        self.ends[0].0 < self.middle.0 && self.middle.0 < self.ends[1].0
    }
}

/// Points of the boundary in order, so that no chord between two of them is further than `tolerance` (length) from the
/// boundary, or as many as there may be; and how far the farthest chord is. The farthest chords are divided first.
pub(crate) fn outline(shape: &Solid, tolerance: f64) -> (Vec<Vector2<f64>>, f64) {
    let on_ray = |angle: f64| {
        let direction = Vector3::new(angle.cos(), angle.sin(), 0.0);
        // The origin is inside, so that every ray leaves the particle.
        (angle, ray_cast::distance(shape, &Vector3::zeros(), &direction).unwrap_or(f64::NAN) * direction.xy())
    };
    let ends: Vec<_> = (0..=FIRST_PARTS).map(|i| on_ray(TAU * i as f64 / FIRST_PARTS as f64)).collect();
    let mut left: BinaryHeap<Chord> = ends.windows(2).map(|ends| Chord::new([ends[0], ends[1]], &on_ray)).collect();
    let (mut done, mut deviation) = (Vec::new(), 0.0);
    while let Some(worst) = left.pop() {
        if worst.deviation <= tolerance || left.len() + done.len() >= Limits::POINTS as usize {
            deviation = larger(worst.deviation, deviation);
            done.push(worst);
            break;
        }
        if worst.is_divisible() {
            let [start, end] = worst.ends;
            left.extend([[start, worst.middle], [worst.middle, end]].map(|ends| Chord::new(ends, &on_ray)));
        } else {
            // Rays that cannot be told apart have no point between them that is further than both.
            deviation = larger((worst.ends[1].0 - worst.ends[0].0) * shape.bounds.radius, deviation);
            done.push(worst);
        }
    }
    done.extend(left);
    done.sort_by(|a, b| a.ends[0].0.total_cmp(&b.ends[0].0));
    (done.iter().map(|chord| chord.ends[0].1).collect(), deviation)
}

/// Chords are ordered by how far the boundary is from them.
impl Ord for Chord {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.deviation.total_cmp(&other.deviation)
    }
}

impl PartialOrd for Chord {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Chord {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Chord {}
