//! Quadrature along a ray: Gauss points in the cells that it crosses.

use super::cell::Cell;
use super::energy;
use super::half_plane::Tilt;
use super::numbers::{ROUNDED, SHORTEST_CELL};
use super::ray::{Line, Node, Ray, SUMS, Walker};
use super::rules::gauss;

impl Walker<'_, '_, '_> {
    /// Adds the cell to the integrals, in pieces where one rule does not do.
    pub(super) fn integrate(
        &mut self,
        line: &Line,
        tilt: &Tilt,
        cell: &Cell,
        start: (f64, f64),
        h: f64,
        ray: &mut Ray,
    ) -> Result<(), f64> {
        let (mut from, mut step) = (0.0, h);
        while from < h {
            let to = if from + step < h * (1.0 - 1e-6) { from + step } else { h };
            let known = self.nodes.len();
            let Some((sums, error)) = self.piece(line, tilt, cell, start, (from, to))? else {
                self.nodes.truncate(known);
                ray.is_folded = true;
                return Ok(());
            };
            if error > self.budget && to - from > SHORTEST_CELL * h {
                self.nodes.truncate(known);
                step = 0.5 * (to - from);
                continue;
            }
            for (sum, term) in ray.sums.iter_mut().zip(sums) {
                *sum += term;
            }
            if !cell.is_flat {
                (0..3).for_each(|i| ray.curved[i] += sums[i]);
            }
            ray.turns_back |= !tilt.is_upright() && self.nodes[known..].iter().any(|node| node.weight < 0.0);
            ray.error += error;
            (from, step) = (to, 2.0 * step);
        }
        Ok(())
    }

    /// One rule on a part of a cell: its integrals and the estimated error of ∫ p n; `None` where the patch has turned
    /// back. As an error, a distance beyond that within which all planes are loaded.
    #[inline(always)]
    fn piece(
        &mut self,
        line: &Line,
        tilt: &Tilt,
        cell: &Cell,
        (rho, zeta): (f64, f64),
        (from, to): (f64, f64),
    ) -> Result<Option<([f64; SUMS], f64)>, f64> {
        let is_flat = cell.is_flat && !self.with_energy;
        let points = if is_flat { 2 } else { self.order };
        let rule = gauss(points);
        let [e, f] = line.direction;
        let by_distance = |distance: f64| if line.is_polar { distance } else { 1.0 };
        // The gradient of D, along the ray, across and upwards, over its slope in the direction in which the height was
        // found; upwards never quite 0.
        let gradient = |along: f64, up: f64, rise: f64| {
            let run = 1.0 / rise;
            let (of_along, of_across) = (cell.d.by_h(along, up) * run, cell.d.across(along, up) * run);
            let n_up = tilt.sin * of_along + tilt.cos;
            [tilt.cos * of_along - tilt.sin, of_across, if n_up.abs() < ROUNDED { ROUNDED } else { n_up }]
        };
        let turned = |n_along: f64, n_across: f64| [n_along * e - n_across * f, n_along * f + n_across * e];
        let mut sums = [0.0; SUMS];
        // Pressure and its product with the slope of the patch: at the ends by the polynomial through the points, and
        // the largest.
        let (mut ends, mut largest) = ([[0.0; 4]; 2], [0.0_f64; 2]);
        for (i, (place, weight)) in rule.nodes[..points].iter().enumerate() {
            let along = from + place * (to - from);
            let Some((up, rise)) = cell.height(along) else { return Ok(None) };
            let [distance, height] = tilt.upright(rho + along, zeta + up);
            let pressure = 1.0 - cell.s.value(along, up).max(0.0).sqrt();
            let density = by_distance(distance);
            let [n_along, n_across, n_up] = gradient(along, up, rise);
            let weight = weight * (to - from) * density * n_up;
            let normal = turned(n_along / n_up, n_across / n_up);
            let arm = [distance * e, distance * f, height];
            let load = weight * pressure;
            let x = [line.origin[0] + arm[0], line.origin[1] + arm[1], line.origin[2] + arm[2]];
            let node = Node { x, weight, pressure, normal };
            let energy = if self.with_energy { energy::density(self.field, &node)? } else { 0.0 };
            self.nodes.push(node);
            let [n_u, n_v] = normal;
            let torque = [arm[1] - arm[2] * n_v, arm[2] * n_u - arm[0], arm[0] * n_v - arm[1] * n_u];
            let [of_u, of_v, of_w] = torque.map(|c| load * c);
            let terms = [load * n_u, load * n_v, load, of_u, of_v, of_w, node.area(), weight * energy];
            for (sum, term) in sums.iter_mut().zip(terms) {
                *sum += term;
            }
            if !is_flat {
                let values = [n_up * pressure, n_along * pressure, n_across * pressure, n_up * energy];
                let values = values.map(|c| c * density);
                for (j, value) in values.into_iter().enumerate() {
                    ends[0][j] += rule.at_end[i] * value;
                    ends[1][j] += rule.at_end[points - 1 - i] * value;
                    largest[j / 3] = largest[j / 3].max(value.abs());
                }
            }
        }
        if !sums.iter().all(|sum| sum.is_finite()) {
            return Ok(None);
        }
        if is_flat {
            return Ok(Some((sums, 0.0)));
        }
        // That polynomial misses the ends by a term whose square, relative, is that of degree 2n.
        let mut off = [0.0_f64; 2];
        for (end, at) in ends.iter().zip([from, to]) {
            let Some((up, rise)) = cell.height(at) else { return Ok(None) };
            let pressure = 1.0 - cell.s.value(at, up).max(0.0).sqrt();
            let [n_along, n_across, n_up] = gradient(at, up, rise);
            let [distance, height] = tilt.upright(rho + at, zeta + up);
            let energy = if self.with_energy {
                let x = [line.origin[0] + distance * e, line.origin[1] + distance * f, line.origin[2] + height];
                let normal = turned(n_along / n_up, n_across / n_up);
                n_up * energy::density(self.field, &Node { x, weight: 0.0, pressure, normal })?
            } else {
                0.0
            };
            let values = [n_up * pressure, n_along * pressure, n_across * pressure, energy];
            let values = values.map(|c| c * by_distance(distance));
            (0..4).for_each(|j| off[j / 3] = off[j / 3].max((values[j] - end[j]).abs()));
        }
        let error = |i: usize| if off[i] > 0.0 { (to - from) * off[i] * off[i] / (largest[i] + off[i]) } else { 0.0 };
        // Neither has one sign where the patch turns back.
        let of_energy = if largest[1] > 0.0 { error(1) * largest[0] / largest[1] } else { 0.0 };
        Ok(Some((sums, error(0).max(of_energy))))
    }
}
