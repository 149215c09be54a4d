//! A closed surface of triangles: corners, neighbours, and the two changes that keep it closed.

/// Corners, counter-clockwise from outside, and for each the triangle across the edge that it does not touch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    pub corners: [u32; 3],
    pub beside: [u32; 3],
}

/// Triangles that cover a closed surface, every edge shared by two.
#[derive(Debug)]
pub(super) struct Triangulation {
    triangles: Vec<Triangle>,
}

impl Triangulation {
    /// The eight faces of an octahedron with the corners +x, −x, +y, −y, +z, −z.
    pub fn octahedron() -> Self {
        let corner = |axis: u32, octant: u32| 2 * axis + (octant >> axis & 1);
        let triangles = (0..8).map(|octant: u32| {
            let (corners, beside) = ([0, 1, 2].map(|axis| corner(axis, octant)), [1, 2, 4].map(|bit| octant ^ bit));
            // A mirror image turns the other way round.
            if octant.count_ones() % 2 == 0 {
                Triangle { corners, beside }
            } else {
                let [p, q, r] = corners;
                let [a, b, c] = beside;
                Triangle { corners: [p, r, q], beside: [a, c, b] }
            }
        });
        Self { triangles: triangles.collect() }
    }

    pub fn len(&self) -> u32 {
        self.triangles.len() as u32
    }

    pub fn triangle(&self, t: u32) -> &Triangle {
        &self.triangles[t as usize]
    }

    /// Corners of all triangles.
    pub fn corners(&self) -> impl Iterator<Item = [u32; 3]> {
        self.triangles.iter().map(|t| t.corners)
    }

    /// Place, among the neighbours of u, of its neighbour t.
    pub fn place(&self, u: u32, t: u32) -> usize {
        let beside = &self.triangle(u).beside;
        (0..3).find(|&j| beside[j] == t).expect("neighbours know each other")
    }

    /// Joins the corners of triangle t to a new point inside it; returns the three triangles, each with the point as
    /// its last corner. The first, second and third lie on the edges from corner 0 to 1, 1 to 2, 2 to 0.
    pub fn split(&mut self, t: u32, point: u32) -> [u32; 3] {
        let Triangle { corners: [a, b, c], beside: [across_a, across_b, across_c] } = *self.triangle(t);
        let (t1, t2) = (self.len(), self.len() + 1);
        self.triangles[t as usize] = Triangle { corners: [a, b, point], beside: [t1, t2, across_c] };
        self.triangles.push(Triangle { corners: [b, c, point], beside: [t2, t, across_a] });
        self.triangles.push(Triangle { corners: [c, a, point], beside: [t, t1, across_b] });
        self.replace_neighbour(across_a, t, t1);
        self.replace_neighbour(across_b, t, t2);
        [t, t1, t2]
    }

    /// Replaces the edge opposite corner `i` of t by the other diagonal of the two triangles that it divides; returns
    /// both, which have corner `i` of t as their first.
    pub fn flip(&mut self, t: u32, i: usize) -> [u32; 2] {
        let turned = |triangle: &Triangle, first: usize| {
            let order = [first, (first + 1) % 3, (first + 2) % 3];
            (order.map(|j| triangle.corners[j]), order.map(|j| triangle.beside[j]))
        };
        let u = self.triangle(t).beside[i];
        let ([a, b, c], [_, across_b, across_c]) = turned(self.triangle(t), i);
        // Seen from the other side the edge runs from c to b.
        let ([d, ..], [_, beyond_c, beyond_b]) = turned(self.triangle(u), self.place(u, t));
        self.triangles[t as usize] = Triangle { corners: [a, b, d], beside: [beyond_c, u, across_c] };
        self.triangles[u as usize] = Triangle { corners: [a, d, c], beside: [beyond_b, across_b, t] };
        self.replace_neighbour(beyond_c, u, t);
        self.replace_neighbour(across_b, t, u);
        [t, u]
    }

    fn replace_neighbour(&mut self, of: u32, old: u32, new: u32) {
        let place = self.place(of, old);
        self.triangles[of as usize].beside[place] = new;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every edge has its triangle on the other side, which has the same edge the other way round.
    fn assert_closed(mesh: &Triangulation) {
        for t in 0..mesh.len() {
            let here = mesh.triangle(t);
            for i in 0..3 {
                let there = mesh.triangle(here.beside[i]);
                let j = mesh.place(here.beside[i], t);
                let (from, to) = (here.corners[(i + 1) % 3], here.corners[(i + 2) % 3]);
                assert_eq!((to, from), (there.corners[(j + 1) % 3], there.corners[(j + 2) % 3]), "{t}, edge {i}");
            }
        }
    }

    #[test]
    fn splits_and_flips_keep_it_closed() {
        let mut mesh = Triangulation::octahedron();
        assert_closed(&mesh);
        for point in 6..40 {
            let t = point * 7 % mesh.len();
            let parts = mesh.split(t, point);
            assert!(parts.iter().all(|&part| mesh.triangle(part).corners[2] == point));
            assert_closed(&mesh);
            let first = mesh.triangle(parts[1]).corners[2];
            let flipped = mesh.flip(parts[1], 2);
            assert!(flipped.iter().all(|&part| mesh.triangle(part).corners[0] == first));
            assert_closed(&mesh);
        }
        assert_eq!(mesh.len(), 8 + 2 * 34);
    }
}
