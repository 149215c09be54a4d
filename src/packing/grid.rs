//! Which boxes are near a box: a grid of cells, each with the boxes that reach into it.

use super::numbers::Limits;
use nalgebra::Vector3;
use std::ops::Range;

pub(crate) struct Grid {
    lower: Vector3<f64>,
    edge: f64,
    counts: [usize; 3],
    cells: Vec<Vec<u32>>,
}

impl Grid {
    /// Of a region, with cells of about this edge.
    pub fn new(lower: Vector3<f64>, upper: Vector3<f64>, mut edge: f64) -> Self {
        let widths = upper - lower;
        let counts = |edge: f64| widths.map(|width| (width / edge).ceil().max(1.0));
        while counts(edge).product() > Limits::CELLS {
            edge *= 1.25;
        }
        let counts: [usize; 3] = counts(edge).map(|count| count as usize).into();
        Self { lower, edge, counts, cells: vec![Vec::new(); counts.iter().product()] }
    }

    /// Enters a box under a number.
    pub fn insert(&mut self, number: u32, lower: &Vector3<f64>, upper: &Vector3<f64>) {
        let [x, y, z] = self.cells_of(lower, upper);
        for k in z {
            for j in y.clone() {
                for i in x.clone() {
                    let cell = self.index(i, j, k);
                    self.cells[cell].push(number);
                }
            }
        }
    }

    /// The numbers of all boxes that may meet this one, each once, in rising order.
    pub fn near(&self, lower: &Vector3<f64>, upper: &Vector3<f64>, numbers: &mut Vec<u32>) {
        numbers.clear();
        let [x, y, z] = self.cells_of(lower, upper);
        for k in z {
            for j in y.clone() {
                for i in x.clone() {
                    numbers.extend_from_slice(&self.cells[self.index(i, j, k)]);
                }
            }
        }
        numbers.sort_unstable();
        numbers.dedup();
    }

    /// The numbers of the boxes that reach into the cell of a point.
    pub fn at(&self, point: &Vector3<f64>) -> &[u32] {
        let [x, y, z] = self.cells_of(point, point);
        &self.cells[self.index(x.start, y.start, z.start)]
    }

    /// The cells that a box reaches into; what lies outside the region counts for the cells at its border.
    fn cells_of(&self, lower: &Vector3<f64>, upper: &Vector3<f64>) -> [Range<usize>; 3] {
        [0, 1, 2].map(|axis| {
            let place = |x: f64| (((x - self.lower[axis]) / self.edge).max(0.0) as usize).min(self.counts[axis] - 1);
            place(lower[axis])..place(upper[axis]) + 1
        })
    }

    fn index(&self, i: usize, j: usize, k: usize) -> usize {
        i + self.counts[0] * (j + self.counts[1] * k)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn cells_are_few_in_regions_of_any_shape() {
        for upper in [[100.0, 100.0, 1e-4], [1e9, 1e-9, 1e-9], [1e100, 1e100, 1e100], [1.0, 1.0, 1.0]] {
            let grid = Grid::new(Vector3::zeros(), upper.into(), 1e-4);
            assert!(
                grid.cells.len() as f64 <= Limits::CELLS && grid.counts.iter().product::<usize>() == grid.cells.len()
            );
        }
    }

    #[test]
    fn every_box_that_meets_one_is_near_it() {
        let mut random = Random::new(1, 0);
        let mut grid = Grid::new(Vector3::zeros(), Vector3::new(4.0, 3.0, 2.0), 0.3);
        // Boxes that reach out of the region, too.
        let boxes: Vec<_> = (0..500)
            .map(|_| {
                let lower = Vector3::from_fn(|_, _| random.between(-0.5, 4.5));
                (lower, lower + Vector3::from_fn(|_, _| random.between(0.0, 0.8)))
            })
            .collect();
        for (number, (lower, upper)) in boxes.iter().enumerate() {
            grid.insert(number as u32, lower, upper);
        }
        let (mut near, mut most) = (Vec::new(), 0);
        for (lower, upper) in &boxes {
            grid.near(lower, upper, &mut near);
            most = most.max(near.len());
            assert!(near.windows(2).all(|pair| pair[0] < pair[1]));
            for (number, (low, high)) in boxes.iter().enumerate() {
                if (0..3).all(|axis| low[axis] <= upper[axis] && lower[axis] <= high[axis]) {
                    assert!(near.contains(&(number as u32)));
                }
            }
        }
        assert!(most < boxes.len() / 2, "{most}");
    }
}
