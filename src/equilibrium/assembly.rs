//! A scene in units of its own: forces over the mean load of a free body, lengths over the size of each body.

use super::error::EquilibriumError;
use super::scene::{Load, Scene, Velocity};
use nalgebra::Vector3;

/// A scene in units of its own.
pub(super) struct Assembly {
    /// Index of each body among the free ones.
    free: Vec<Option<usize>>,
    /// Size of each body: its largest distance from a corner.
    sizes: Vec<f64>,
    /// Unit of force.
    pub unit: f64,
    pub corners: Vec<Corner>,
    /// Six numbers for each free body.
    pub dead: Vec<f64>,
    pub live: Vec<f64>,
}

/// A corner of a contact.
pub(super) struct Corner {
    /// Its free bodies: their index among these, the sign of the force on them, the corner from the centre over the
    /// size.
    ends: Vec<(usize, f64, Vector3<f64>)>,
    /// The normal and two directions across it.
    pub frame: [Vector3<f64>; 3],
    /// Contact that it belongs to, and the number of corners of that.
    pub contact: usize,
    pub of: f64,
}

impl Corner {
    /// Coefficients, in the scaled velocities, of the velocity of the second body relative to the first along an axis
    /// of the frame.
    pub fn relative(&self, axis: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let along = self.frame[axis];
        self.ends.iter().flat_map(move |(body, sign, arm)| {
            let turn = arm.cross(&along);
            let six = [along.x, along.y, along.z, turn.x, turn.y, turn.z];
            (0..6).map(move |i| (6 * body + i, sign * six[i]))
        })
    }

    /// Whether a free body is there: a contact between held ones carries nothing.
    pub fn counts(&self) -> bool {
        !self.ends.is_empty()
    }
}

impl Assembly {
    pub fn new(scene: &Scene) -> Result<Self, EquilibriumError> {
        scene.validate()?;
        let mut places = 0..;
        let free: Vec<_> = scene.bodies.iter().map(|body| if body.held { None } else { places.next() }).collect();
        let count = places.start;
        let mut sizes = vec![0.0_f64; scene.bodies.len()];
        for contact in &scene.contacts {
            for &body in &contact.bodies {
                let far = contact.corners.iter().map(|at| (at - scene.bodies[body].centre).norm());
                sizes[body] = far.fold(sizes[body], f64::max);
            }
        }
        // A body that touches others at its centre alone has no size: any unit will do.
        sizes.iter_mut().filter(|size| **size == 0.0).for_each(|size| *size = 1.0);
        let of_free = || scene.bodies.iter().zip(&sizes).filter(|(body, _)| !body.held);
        let six = |load: Load, size: f64| [load.force, load.torque / size].map(<[f64; 3]>::from).concat();
        let mut dead: Vec<f64> = of_free().flat_map(|(body, &size)| six(body.dead, size)).collect();
        let mut live: Vec<f64> = of_free().flat_map(|(body, &size)| six(body.live, size)).collect();
        let mean = |load: &[f64]| load.chunks(6).map(largest).sum::<f64>() / count as f64;
        let unit = if mean(&dead) > 0.0 { mean(&dead) } else { mean(&live) };
        if !(unit > 0.0) {
            return Err(EquilibriumError::NoLoad);
        }
        dead.iter_mut().chain(&mut live).for_each(|load| *load /= unit);
        let mut corners = Vec::with_capacity(scene.corner_count());
        for (number, contact) in scene.contacts.iter().enumerate() {
            let normal = contact.normal.normalize();
            let across = normal.cross(&Vector3::ith(normal.iamin(), 1.0)).normalize();
            let frame = [normal, across, normal.cross(&across)];
            for at in &contact.corners {
                let end = |(&body, sign): (&usize, f64)| {
                    free[body].map(|place| (place, sign, (at - scene.bodies[body].centre) / sizes[body]))
                };
                let ends = contact.bodies.iter().zip([-1.0, 1.0]).filter_map(end).collect();
                corners.push(Corner { ends, frame, contact: number, of: contact.corners.len() as f64 });
            }
        }
        Ok(Self { free, sizes, unit, corners, dead, live })
    }

    /// Velocities of all bodies from the scaled ones of the free, the fastest corner at 1.
    pub fn velocities(&self, scaled: &[f64]) -> Vec<Velocity> {
        let fastest = scaled.chunks(6).map(largest).fold(0.0, f64::max);
        let scale = if fastest > 0.0 { 1.0 / fastest } else { 0.0 };
        let of = |(place, size): (&Option<usize>, &f64)| match place {
            Some(place) => {
                let six = &scaled[6 * place..][..6];
                let [linear, angular] = [0, 3].map(|i| scale * Vector3::from_column_slice(&six[i..i + 3]));
                Velocity { linear, angular: angular / *size }
            }
            None => Velocity { linear: Vector3::zeros(), angular: Vector3::zeros() },
        };
        self.free.iter().zip(&self.sizes).map(of).collect()
    }

    /// Forces in the units and axes of the scene.
    pub fn forces(&self, scaled: &[[f64; 3]]) -> Vec<Vector3<f64>> {
        let force = |(corner, of): (&Corner, &[f64; 3])| {
            self.unit * corner.frame.iter().zip(of).map(|(axis, part)| axis * *part).sum::<Vector3<f64>>()
        };
        self.corners.iter().zip(scaled).map(force).collect()
    }

    /// The largest force or torque over size that is not balanced on any body, over the unit, of dead + factor × live
    /// loads.
    pub fn unbalanced(&self, scaled: &[[f64; 3]], factor: f64) -> f64 {
        let mut left: Vec<f64> = self.dead.iter().zip(&self.live).map(|(dead, live)| dead + factor * live).collect();
        for (corner, force) in self.corners.iter().zip(scaled) {
            for (axis, part) in force.iter().enumerate() {
                corner.relative(axis).for_each(|(column, value)| left[column] += value * part);
            }
        }
        left.chunks(6).map(largest).fold(0.0, f64::max)
    }
}

/// The larger of the norms of a force and a torque.
fn largest(six: &[f64]) -> f64 {
    let norm = |three: &[f64]| Vector3::from_column_slice(three).norm();
    norm(&six[..3]).max(norm(&six[3..]))
}
