//! The faces of a polyhedron as polygons.

use nalgebra::Vector3;

/// One face after the other; what is read into it again and again allocates nothing.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outlines {
    /// Number of each face, and where its corners end.
    pub(super) faces: Vec<(usize, usize)>,
    /// Counter-clockwise from outside.
    pub(super) corners: Vec<Vector3<f64>>,
    /// The number of the face beyond the edge from each of them to the next one.
    pub(super) beyond: Vec<usize>,
    /// Of each corner of the polyhedron, which of its three faces have been walked around.
    pub(super) seen: Vec<[bool; 3]>,
}

/// A face: its number, its corners counter-clockwise, and with each of them the number of the face beyond the edge to
/// the next one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outline<'a> {
    pub number: usize,
    pub corners: &'a [Vector3<f64>],
    pub beyond: &'a [usize],
}

impl Outlines {
    /// How many faces there are.
    pub fn len(&self) -> usize {
        self.faces.len()
    }

    /// Corners of all faces.
    pub fn corner_count(&self) -> usize {
        self.corners.len()
    }

    /// All faces.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Outline<'_>> + Clone {
        (0..self.faces.len()).map(|i| {
            let (number, end) = self.faces[i];
            let range = if i == 0 { 0 } else { self.faces[i - 1].1 }..end;
            Outline { number, corners: &self.corners[range.clone()], beyond: &self.beyond[range] }
        })
    }

    /// Volume enclosed by the faces, and the sum of their areas.
    pub fn volume_and_area(&self) -> (f64, f64) {
        // About a corner, so that no digits are lost far from the origin.
        let pole = self.corners.first().copied().unwrap_or_default();
        let (mut six_volumes, mut area) = (0.0, 0.0);
        for face in self.iter() {
            let first = face.corners[0] - pole;
            let mut doubled = Vector3::zeros();
            for pair in face.corners[1..].windows(2) {
                let [b, c] = [pair[0] - pole, pair[1] - pole];
                six_volumes += first.dot(&b.cross(&c));
                doubled += (b - first).cross(&(c - first));
            }
            area += 0.5 * doubled.norm();
        }
        (six_volumes / 6.0, area)
    }
}
