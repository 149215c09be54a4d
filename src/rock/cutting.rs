//! What one plane makes of one part of a domain.

use crate::particle::cutter::Cutter;
use crate::particle::largest_ball;
use crate::particle::outlines::Outlines;
use crate::particle::polyhedron::{OF_CUBE, Polyhedron, Split};
use crate::rock::block::FaceOf;
use crate::rock::joint::Joint;
use crate::rock::settings::SliceSettings;
use nalgebra::Vector3;
use std::ops::Range;

/// A piece of the domain, and a ball around it: a joint that misses the ball misses the piece.
#[derive(Clone, Debug, Default)]
pub(super) struct Part {
    pub polyhedron: Polyhedron,
    pub middle: Vector3<f64>,
    pub radius: f64,
}

impl Part {
    pub fn of(polyhedron: Polyhedron) -> Self {
        let mut part = Self { polyhedron, ..Self::default() };
        part.enclose();
        part
    }

    /// Finds the ball anew.
    fn enclose(&mut self) {
        self.middle = self.polyhedron.middle();
        self.radius = self.polyhedron.corners().map(|at| (at - self.middle).norm()).fold(0.0, f64::max);
    }

    /// Becomes a copy of another, in its own room.
    pub fn copy_from(&mut self, other: &Self) {
        self.polyhedron.copy_from(&other.polyhedron);
        (self.middle, self.radius) = (other.middle, other.radius);
    }
}

/// How many cuts were not made, and why.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LeftOut {
    pub too_small: usize,
    pub unclosed: usize,
}

impl LeftOut {
    pub fn add(&mut self, other: &Self) {
        self.too_small += other.too_small;
        self.unclosed += other.unclosed;
    }
}

/// What a thread cuts with: its room is kept from one cut to the next, so that cutting allocates nothing.
#[derive(Default)]
pub(super) struct Workbench {
    pub cutter: Cutter,
    pub outlines: Outlines,
    below: Part,
    beyond: Part,
    pub left_out: LeftOut,
}

/// What cuts, about the origin of the polyhedra: all planes by the numbers of their faces, and the joints among them.
pub(super) struct Cuts<'a> {
    planes: &'a [(FaceOf, Vector3<f64>, f64)],
    joints: Vec<Joint>,
    /// Unit normals and heights of the joints once more, close together for the test that most of them fail.
    slabs: Vec<(Vector3<f64>, f64)>,
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
        let slabs = planes[first..][..joints.len()].iter().map(|(_, n, height)| (*n, *height)).collect();
        Self { planes, joints, slabs, first: OF_CUBE + first, settings, thinnest: domain.least_cut() }
    }

    /// What a face comes from, with the unit normal and height of its plane.
    pub fn face(&self, number: usize) -> (FaceOf, Vector3<f64>, f64) {
        self.planes[number - OF_CUBE]
    }

    /// The area that a joint which ends shares with a polygon in its plane, about the origin of the polyhedra.
    pub fn shared_area(&self, joint: usize, polygon: &[Vector3<f64>]) -> Option<f64> {
        let joint = &self.joints[joint];
        joint.radius.is_finite().then(|| joint.shared_area(polygon))
    }

    /// Unit normal and height of the plane of a face.
    pub fn plane(&self, number: usize) -> (Vector3<f64>, f64) {
        let (_, n, height) = self.face(number);
        (n, height)
    }

    /// Of a point above such a plane.
    pub fn height(&self, number: usize, at: &Vector3<f64>) -> f64 {
        let (n, height) = self.plane(number);
        n.dot(at) - height
    }

    /// Number of the first plane of the regions.
    pub fn first_of_regions(&self) -> usize {
        self.first + self.joints.len()
    }

    /// The first joint of a range that comes near a part.
    pub fn next(&self, joints: Range<usize>, part: &Part) -> Option<usize> {
        let begin = joints.start;
        let is_near = |(n, height): &(Vector3<f64>, f64)| (n.dot(&part.middle) - height).abs() < part.radius;
        let mut slabs = self.slabs[joints].iter().zip(begin..).filter(|(slab, _)| is_near(slab));
        slabs.find(|(_, joint)| self.comes_near(*joint, part)).map(|(_, joint)| joint)
    }

    /// Cuts a part by a joint: it becomes what lies below, and `beyond` the rest. Whether it was cut.
    pub fn cut(&self, joint: usize, part: &mut Part, beyond: &mut Part, bench: &mut Workbench) -> bool {
        let number = self.first + joint;
        let (n, height) = self.plane(number);
        let parts = [&mut bench.below.polyhedron, &mut bench.beyond.polyhedron];
        match part.polyhedron.split(&mut bench.cutter, number, &n, height, parts) {
            Split::Missed => return false,
            Split::Unclosed => {
                bench.left_out.unclosed += 1;
                return false;
            }
            Split::Parted => (),
        }
        bench.below.polyhedron.read_outlines(&mut bench.outlines);
        if !self.reaches(joint, &bench.outlines) {
            return false;
        }
        let mut is_too_small = self.is_too_small(&bench.below.polyhedron, &bench.outlines);
        if !is_too_small {
            bench.beyond.polyhedron.read_outlines(&mut bench.outlines);
            is_too_small = self.is_too_small(&bench.beyond.polyhedron, &bench.outlines);
        }
        if is_too_small {
            bench.left_out.too_small += 1;
            return false;
        }
        std::mem::swap(part, &mut bench.below);
        std::mem::swap(beyond, &mut bench.beyond);
        part.enclose();
        beyond.enclose();
        true
    }

    /// Whether a joint does not end before it comes near a part.
    fn comes_near(&self, joint: usize, part: &Part) -> bool {
        let Joint { point, radius, .. } = &self.joints[joint];
        *radius == f64::INFINITY || (point - part.middle).norm() <= part.radius + radius
    }

    /// Whether a joint reaches the face that it made of a part.
    fn reaches(&self, joint: usize, part: &Outlines) -> bool {
        self.joints[joint].radius == f64::INFINITY
            || part
                .iter()
                .filter(|face| face.number == self.first + joint)
                .any(|face| self.joints[joint].meets(face.corners))
    }

    /// Whether a part is smaller than the settings allow.
    pub fn is_too_small(&self, part: &Polyhedron, outlines: &Outlines) -> bool {
        let SliceSettings { least_volume, least_thickness, least_width, largest_aspect, .. } = *self.settings;
        let (volume, area) = outlines.volume_and_area();
        if !(volume > least_volume.max(self.thinnest * area) && 2.0 * volume >= least_thickness * area) {
            return true;
        }
        if least_width == 0.0 && largest_aspect == f64::INFINITY {
            return false;
        }
        let [low, high] = part.extremes();
        let extent = (high - low).max();
        let width = self.width(part, outlines, extent);
        !(width >= least_width && extent <= largest_aspect * width)
    }

    /// Diameter of the largest ball in a part.
    fn width(&self, part: &Polyhedron, outlines: &Outlines, extent: f64) -> f64 {
        let middle = part.middle();
        let about = |number: usize| {
            let ((n, _), height) = (self.plane(number), self.height(number, &middle));
            // A part beyond a plane has it turned.
            if height > 0.0 { (-n, height) } else { (n, -height) }
        };
        let faces: Vec<_> = outlines.iter().map(|face| about(face.number)).collect();
        largest_ball::radius(&faces, extent).map_or(0.0, |radius| 2.0 * radius)
    }
}
