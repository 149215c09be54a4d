//! A scene in units of its own: forces over the mean load of a free body, lengths over the size of each body, stiffness
//! over the mean of contacts.

use super::error::EquilibriumError;
use super::law::Strength;
use super::points::points_of;
use super::scene::{Contact, Load, Scene, Velocity};
use nalgebra::{Matrix3, Matrix6x3, Vector3};
use std::ops::Range;

/// A scene in units of its own.
pub(super) struct Assembly {
    /// Index of each body among the free ones.
    free: Vec<Option<usize>>,
    /// Size of each body: its largest distance from a corner.
    sizes: Vec<f64>,
    /// Unit of force.
    pub unit: f64,
    /// Unit of the live loads.
    live_unit: f64,
    /// Contacts of free bodies.
    pub joints: Vec<Joint>,
    pub points: Vec<Point>,
    /// Numbers of corners and contacts of the scene.
    corner_count: usize,
    pub contact_count: usize,
    /// Six numbers for each free body.
    pub dead: Vec<f64>,
    pub live: Vec<f64>,
}

/// A contact that touches a free body.
pub(super) struct Joint {
    /// Its number in the scene.
    pub contact: usize,
    /// Its free bodies, by their index among these.
    pub ends: [Option<usize>; 2],
    /// The normal and two directions across it, as columns.
    pub frame: Matrix3<f64>,
    pub points: Range<usize>,
}

/// A point at which a force acts.
pub(super) struct Point {
    /// Of each body: the point from the centre over the size.
    pub arms: [Vector3<f64>; 2],
    pub strength: Strength,
    /// Corners of the scene that stand for it, with their parts.
    onto: Vec<(usize, f64)>,
    /// Whether it is a corner.
    pub is_corner: bool,
}

impl Point {
    /// Whether the point adds to the resultants of its contact: without cohesion those at the corners are all.
    pub fn counts(&self) -> bool {
        self.is_corner || self.strength.cohesion > 0.0 || self.strength.tension > 0.0
    }
}

impl Joint {
    /// Free bodies with the sign of the force on them and their place among the ends.
    pub fn bodies(&self) -> impl Iterator<Item = (usize, f64, usize)> {
        let end = |(end, sign)| move |body| (body, sign, end);
        self.ends.into_iter().zip([(0, -1.0), (1, 1.0)]).filter_map(move |(body, of)| body.map(end(of)))
    }

    /// Force and torque on the body at an end of a unit force at a point along each axis of the frame.
    pub fn moves(&self, point: &Point, end: usize) -> Matrix6x3<f64> {
        let along = if end == 0 { -self.frame } else { self.frame };
        let mut found = Matrix6x3::zeros();
        for axis in 0..3 {
            found.fixed_view_mut::<3, 1>(0, axis).copy_from(&along.column(axis));
            found.fixed_view_mut::<3, 1>(3, axis).copy_from(&point.arms[end].cross(&along.column(axis)));
        }
        found
    }

    /// Coefficients, in the scaled velocities, of the velocity of the second body relative to the first along an axis
    /// of the frame.
    pub fn relative(&self, point: &Point, axis: usize) -> impl Iterator<Item = (usize, f64)> {
        self.bodies().flat_map(move |(body, _, end)| {
            let moves = self.moves(point, end);
            (0..6).map(move |i| (6 * body + i, moves[(i, axis)]))
        })
    }

    /// Velocity or displacement of the second body relative to the first, in the axes of the frame.
    pub fn slip(&self, point: &Point, velocities: &[f64]) -> Vector3<f64> {
        let of = |(body, sign, end): (usize, f64, usize)| {
            let [linear, angular] =
                [0, 3].map(|i| Vector3::from_column_slice(&velocities[6 * body + i..6 * body + i + 3]));
            sign * (linear + angular.cross(&point.arms[end]))
        };
        self.frame.tr_mul(&self.bodies().map(of).sum())
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
        let live_unit = if mean(&live) > 0.0 { mean(&live) } else { unit };
        dead.iter_mut().for_each(|load| *load /= unit);
        live.iter_mut().for_each(|load| *load /= live_unit);
        let mut assembly = Self {
            free,
            sizes,
            unit,
            live_unit,
            joints: Vec::new(),
            points: Vec::new(),
            corner_count: scene.corner_count(),
            contact_count: scene.contacts.len(),
            dead,
            live,
        };
        assembly.add_contacts(scene);
        Ok(assembly)
    }

    fn add_contacts(&mut self, scene: &Scene) {
        let is_free = |&body: &usize| self.free[body].is_some();
        let areas = scene.contacts.iter().filter(|contact| contact.area > 0.0 && contact.bodies.iter().any(is_free));
        let (areas, count) = areas.fold((0.0, 0.0), |(sum, n), contact| (sum + contact.area, n + 1.0));
        // Lines and points are as stiff as a mean contact.
        let mean_area = if count > 0.0 { areas / count } else { 1.0 };
        let area_of = |area: f64| if area > 0.0 { area } else { mean_area };
        let normal = |contact: &Contact| area_of(contact.area) * contact.stiffness[0];
        let mean_stiffness = scene.contacts.iter().map(normal).sum::<f64>() / scene.contacts.len() as f64;
        let mut first_corner = 0;
        for (number, contact) in scene.contacts.iter().enumerate() {
            let ends = contact.bodies.map(|body| self.free[body]);
            let along = contact.normal.normalize();
            let across = along.cross(&Vector3::ith(along.iamin(), 1.0)).normalize();
            let frame = Matrix3::from_columns(&[along, across, along.cross(&across)]);
            let begin = self.points.len();
            for point in points_of(contact).into_iter().filter(|_| ends != [None, None]) {
                let arm = |body: usize| (point.at - scene.bodies[body].centre) / self.sizes[body];
                let area = contact.area * point.share / self.unit;
                let cohesion = contact.cohesion * area;
                let tension = contact.tension * area;
                let stiffness = contact.stiffness.map(|of| of * area_of(contact.area) * point.share / mean_stiffness);
                let strength = Strength {
                    stiffness,
                    initial: frame.tr_mul(&contact.initial) * area,
                    friction: contact.friction,
                    cohesion,
                    tension: if contact.friction > 0.0 { tension.min(cohesion / contact.friction) } else { tension },
                };
                let onto = point.onto.into_iter().map(|(corner, part)| (first_corner + corner, part)).collect();
                self.points.push(Point { arms: contact.bodies.map(arm), strength, onto, is_corner: point.is_corner });
            }
            if ends != [None, None] {
                self.joints.push(Joint { contact: number, ends, frame, points: begin..self.points.len() });
            }
            first_corner += contact.corners.len();
        }
    }

    /// Each point with its contact.
    pub fn each_point(&self) -> impl Iterator<Item = (&Joint, &Point)> {
        self.joints.iter().flat_map(|joint| self.points[joint.points.clone()].iter().map(move |point| (joint, point)))
    }

    /// What a factor on the scaled live loads is on those of the scene.
    pub fn live_factor(&self, scaled: f64) -> f64 {
        scaled * (self.unit / self.live_unit)
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

    /// Forces at the corners, in the units and axes of the scene, of those at the points.
    pub fn forces(&self, scaled: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let mut found = vec![Vector3::zeros(); self.corner_count];
        for ((joint, point), force) in self.each_point().zip(scaled) {
            let force = self.unit * (joint.frame * force);
            point.onto.iter().for_each(|(corner, part)| found[*corner] += *part * force);
        }
        found
    }

    /// Dead and live loads.
    pub fn loads(&self, live: f64) -> Vec<f64> {
        self.dead.iter().zip(&self.live).map(|(dead, of)| dead + live * of).collect()
    }

    /// Forces and torques left on the free bodies, of forces at the points and dead + live loads, and the sum of the
    /// sizes of all forces on each.
    pub fn left(&self, forces: impl Iterator<Item = Vector3<f64>>, live: f64) -> (Vec<f64>, Vec<f64>) {
        let mut left = self.loads(live);
        let mut sizes: Vec<f64> = left.chunks(6).map(largest).collect();
        for ((joint, point), force) in self.each_point().zip(forces) {
            let (size, force) = (force.norm(), joint.frame * force);
            for (body, sign, end) in joint.bodies() {
                let torque = point.arms[end].cross(&force);
                for i in 0..3 {
                    left[6 * body + i] += sign * force[i];
                    left[6 * body + 3 + i] += sign * torque[i];
                }
                sizes[body] += size;
            }
        }
        (left, sizes)
    }
}

/// The larger of the norms of a force and a torque.
pub(super) fn largest(six: &[f64]) -> f64 {
    let norm = |three: &[f64]| Vector3::from_column_slice(three).norm();
    norm(&six[..3]).max(norm(&six[3..]))
}
