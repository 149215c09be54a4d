//! One part of a domain, and what a run of joints makes of it. What is cut off one part never depends on the others.

use crate::particle::largest_ball;
use crate::particle::polyhedron::{OF_CUBE, Polyhedron};
use crate::rock::block::{FaceOf, volume_and_area};
use crate::rock::joint::Joint;
use crate::rock::slicing::SliceSettings;
use nalgebra::Vector3;
use std::ops::Range;

/// A piece of the domain, and a ball around it: a joint that misses the ball misses the piece.
pub(super) struct Part {
    pub polyhedron: Polyhedron,
    pub middle: Vector3<f64>,
    pub radius: f64,
    pub parent: usize,
    pub region: Option<usize>,
}

impl Part {
    pub fn of(polyhedron: Polyhedron) -> Self {
        let middle = polyhedron.middle();
        let radius = polyhedron.corners().map(|at| (at - middle).norm()).fold(0.0, f64::max);
        Self { polyhedron, middle, radius, parent: 0, region: None }
    }
}

/// What cuts, about the origin of the polyhedra: all planes by the numbers of their faces, and the joints among them.
pub(super) struct Cuts<'a> {
    planes: &'a [(FaceOf, Vector3<f64>, f64)],
    joints: Vec<Joint>,
    /// Number of the first joint among the planes.
    first: usize,
    settings: &'a SliceSettings,
    /// The volume of a part no thicker than the rounding of its corners is rounding, too.
    thinnest: f64,
}

impl<'a> Cuts<'a> {
    pub fn new(
        domain: &Polyhedron,
        planes: &'a [(FaceOf, Vector3<f64>, f64)],
        joints: Vec<Joint>,
        first: usize,
        settings: &'a SliceSettings,
    ) -> Self {
        Self { planes, joints, first: OF_CUBE + first, settings, thinnest: domain.least_cut() }
    }

    /// Unit normal and height of the plane of a face.
    pub fn plane(&self, number: usize) -> (Vector3<f64>, f64) {
        let (_, n, height) = self.planes[number - OF_CUBE];
        (n, height)
    }

    /// Of a point above such a plane.
    pub fn height(&self, number: usize, at: &Vector3<f64>) -> f64 {
        let (n, height) = self.plane(number);
        n.dot(at) - height
    }

    /// Whether a joint comes near a part.
    fn comes_near(&self, joint: usize, part: &Part) -> bool {
        let Joint { point, radius, .. } = &self.joints[joint];
        self.height(self.first + joint, &part.middle).abs() < part.radius
            && (point - part.middle).norm() <= part.radius + radius
    }

    /// Whether a joint reaches the face that it made of a part.
    fn reaches(&self, joint: usize, part: &Polyhedron) -> bool {
        self.joints[joint].radius == f64::INFINITY
            || part.faces().into_iter().filter(|face| face.number == self.first + joint).any(|face| {
                let corners: Vec<_> = face.corners.iter().map(|corner| corner.0).collect();
                self.joints[joint].meets(&corners)
            })
    }

    /// Whether a part is smaller than the settings allow.
    pub fn is_too_small(&self, part: &Polyhedron) -> bool {
        let SliceSettings { least_volume, least_thickness, least_width, largest_aspect, .. } = *self.settings;
        let (volume, area) = volume_and_area(part);
        if !(volume > least_volume.max(self.thinnest * area) && 2.0 * volume >= least_thickness * area) {
            return true;
        }
        if least_width == 0.0 && largest_aspect == f64::INFINITY {
            return false;
        }
        let [low, high] = part.extremes();
        let extent = (high - low).max();
        let width = self.width(part, extent);
        !(width >= least_width && extent <= largest_aspect * width)
    }

    /// Diameter of the largest ball in a part.
    fn width(&self, part: &Polyhedron, extent: f64) -> f64 {
        let middle = part.middle();
        let about = |number: usize| {
            let ((n, _), height) = (self.plane(number), self.height(number, &middle));
            // A part beyond a plane has it turned.
            if height > 0.0 { (-n, height) } else { (n, -height) }
        };
        let faces: Vec<_> = part.faces().into_iter().map(|face| about(face.number)).collect();
        largest_ball::radius(&faces, extent).map_or(0.0, |radius| 2.0 * radius)
    }
}

/// A piece that a joint cut off another piece of the same part.
pub(super) struct CutOff {
    pub joint: usize,
    /// The number of that other piece.
    pub from: usize,
    pub part: Part,
}

/// The pieces of one part: piece 0 is what is left of the part itself, cut i made piece i + 1.
#[derive(Default)]
pub(super) struct Pieces {
    pub cut_off: Vec<CutOff>,
    pub too_small: usize,
    pub unclosed: usize,
}

/// Cuts a part by some joints in their order; `None` if none of them did, or tried to.
pub(super) fn cut_in_order(part: &mut Part, cuts: &Cuts<'_>, joints: Range<usize>) -> Option<Pieces> {
    let mut pieces = Pieces::default();
    for joint in joints {
        let number = cuts.first + joint;
        let (n, height) = cuts.plane(number);
        for piece in 0..=pieces.cut_off.len() {
            let whole = if piece == 0 { &mut *part } else { &mut pieces.cut_off[piece - 1].part };
            if !cuts.comes_near(joint, whole) || !whole.polyhedron.is_crossed(&n, height) {
                continue;
            }
            let Some([below, beyond]) = whole.polyhedron.split(number, &n, height) else {
                pieces.unclosed += 1;
                continue;
            };
            if !cuts.reaches(joint, &below) {
                continue;
            }
            if cuts.is_too_small(&below) || cuts.is_too_small(&beyond) {
                pieces.too_small += 1;
                continue;
            }
            *whole = Part::of(below);
            pieces.cut_off.push(CutOff { joint, from: piece, part: Part::of(beyond) });
        }
    }
    let was_met = !pieces.cut_off.is_empty() || pieces.too_small + pieces.unclosed > 0;
    was_met.then_some(pieces)
}
