//! The patch in cells, on each of which both potentials are quadratic forms: the faces of the network, cut into curved
//! triangles.

use super::curve::Trouble;
use super::faces::Faces;
use super::form::Form;
use super::network::{Drawing, Network};
use super::numbers::{ErrorBudget, Fitted, HOPELESS, Limits};
use super::pieces::Estimate;
use super::ray::{Node, Walker};
use super::smoothness::norm;
use super::triangle_rule::{CurvedTriangle, INTEGRALS, Integrals, POINTS, Rule, WHOLE, quarters};
use super::triangulation::{Ears, cut};

/// Buffers.
#[derive(Debug, Default)]
pub(super) struct CellScratch {
    network: Network,
    faces: Faces,
    ears: Ears,
    triangles: Vec<(CurvedTriangle, Form)>,
    parts: Vec<Part>,
    /// The least S.
    deepest: f64,
    /// Whether the sides took too much of the tolerance.
    is_off: bool,
    /// Capacity of [`POINTS`] for each part.
    nodes: Vec<Node>,
}

/// A part of a triangle: its corners in barycentric coordinates, and its integrals.
#[derive(Clone, Copy, Debug)]
struct Part {
    triangle: u32,
    corners: [[f64; 3]; 3],
    rule: Rule,
    value: [f64; INTEGRALS],
    error: [f64; 2],
}

/// Fills `points`; `None` where the network does not close, or the error is above the tolerance.
pub(super) fn cells(
    walker: &mut Walker,
    axis: [f64; 2],
    deepest: f64,
    tolerance: f64,
    scratch: &mut CellScratch,
    points: &mut Vec<Node>,
) -> Option<Estimate> {
    scratch.deepest = deepest;
    let mut drawing = Drawing { axis, depth: 1.0 - deepest, tolerance };
    for _ in 0..2 {
        loop {
            if walker.field.planes.len() > Limits::PLANES {
                return None;
            }
            match scratch.network.draw(walker, &drawing) {
                Ok(()) => break,
                Err(Trouble::Far(distance)) if walker.field.loaded().is_finite() => {
                    walker.field.load(distance.max(2.0 * walker.field.loaded()));
                }
                Err(_) => return None,
            }
        }
        scratch.triangulate(walker)?;
        let estimate = scratch.integrate(tolerance, points);
        if estimate.is_some() || !scratch.is_off {
            return estimate;
        }
        drawing.tolerance *= ErrorBudget::PART;
    }
    None
}

impl CellScratch {
    /// Cuts all cells within the edges into triangles; `None` where the network has no cells.
    fn triangulate(&mut self, walker: &Walker) -> Option<()> {
        self.cut_faces(walker, false).or_else(|| self.cut_faces(walker, true))
    }

    fn cut_faces(&mut self, walker: &Walker, is_split: bool) -> Option<()> {
        let Self { network, faces, ears, triangles, .. } = self;
        triangles.clear();
        let field = &*walker.field;
        let (edges, drawn, at_origin) = (network.edges, network.drawn, network.at_origin);
        let mut height = 0.0;
        faces.visit(network, is_split, |outline| {
            let first = triangles.len();
            let mut widest = ([0.0; 2], 0.0);
            // The form is known once a point inside is.
            let form = Form::default();
            cut(outline, ears, |triangle| {
                let (middle, size) = triangle.middle();
                if size > widest.1 {
                    widest = (middle, size);
                }
                triangles.push((triangle, form));
            })?;
            let [u, v] = widest.0;
            height = if field.b.is_some() { field.height(u, v, height)? } else { 0.0 };
            // A plane whose curve does not count is everywhere as at the origin.
            let active = field.look(&[u, v, height]).active & drawn | at_origin & !drawn;
            if active & edges != 0 {
                triangles.truncate(first);
                return Some(());
            }
            let form = Form::new(field, active);
            triangles[first..].iter_mut().for_each(|triangle| triangle.1 = form);
            Some(())
        })
    }

    /// Integrates over all triangles, in parts where one rule does not do.
    fn integrate(&mut self, tolerance: f64, points: &mut Vec<Node>) -> Option<Estimate> {
        self.parts.clear();
        self.nodes.clear();
        self.is_off = false;
        let most = ErrorBudget::MAIN * tolerance * self.network.rough_load;
        let mut is_hopeless = false;
        for triangle in 0..self.triangles.len() {
            let place = self.parts.len();
            let mut may_do = !is_hopeless;
            if may_do {
                let error = self.part(triangle as u32, &WHOLE, Rule::Coarse, place)?.error[0];
                (may_do, is_hopeless) = (error <= most, error > HOPELESS * most);
            }
            if !may_do {
                self.part(triangle as u32, &WHOLE, Rule::Fine, place)?;
            }
        }
        loop {
            let mut sums = [0.0; INTEGRALS];
            let misfit = self.network.misfit;
            let mut errors = [Fitted::OPTIMISM * misfit.load, misfit.area];
            let mut worst = 0.0_f64;
            for part in &self.parts {
                (0..INTEGRALS).for_each(|j| sums[j] += part.value[j]);
                (0..2).for_each(|j| errors[j] += part.error[j]);
                worst = worst.max(part.error[0]);
            }
            let allowed = ErrorBudget::MAIN * tolerance * norm(&sums[..3]);
            // No finer rule reduces the sides' error.
            self.is_off = Fitted::OPTIMISM * misfit.load >= ErrorBudget::SIDES * allowed;
            if self.is_off || !(allowed > 0.0) {
                return None;
            }
            if errors[0] <= allowed {
                points.clear();
                for (part, nodes) in self.parts.iter().zip(self.nodes.chunks_exact(POINTS)) {
                    points.extend_from_slice(&nodes[..part.rule.count()]);
                }
                return Some(Estimate { force: errors[0], area: errors[1], rays: 0 });
            }
            if self.parts.len() > Limits::TRIANGLES {
                return None;
            }
            let least = (0.5 * worst).min(allowed / self.parts.len() as f64);
            for i in 0..self.parts.len() {
                if self.parts[i].error[0] >= least {
                    let Part { triangle, corners, rule, .. } = self.parts[i];
                    if rule == Rule::Coarse {
                        self.part(triangle, &corners, Rule::Fine, i)?;
                        continue;
                    }
                    for (which, quarter) in quarters(&corners).iter().enumerate() {
                        let place = if which == 0 { i } else { self.parts.len() };
                        self.part(triangle, quarter, Rule::Fine, place)?;
                    }
                }
            }
        }
    }

    /// Integrates over a part of a triangle, and puts it in the place of another or after the last; `None` where the
    /// patch is no graph.
    #[inline(always)]
    fn part(&mut self, triangle: u32, corners: &[[f64; 3]; 3], rule: Rule, place: usize) -> Option<&Part> {
        let none = Node { x: [0.0; 3], weight: 0.0, pressure: 0.0, normal: [0.0; 2] };
        self.nodes.resize(self.nodes.len().max(POINTS * (place + 1)), none);
        let nodes = &mut self.nodes[POINTS * place..][..rule.count()];
        let (curved, form) = &self.triangles[triangle as usize];
        let Integrals { value, off } = curved.integrate(corners, form, rule, nodes)?;
        let square = |node: &Node| node.x[0] * node.x[0] + node.x[1] * node.x[1];
        let reach = nodes.iter().map(square).fold(0.0, f64::max).sqrt();
        let (size, difference) = (norm(&value[..3]), norm(&off[..3]).max(norm(&off[3..6]) / reach));
        let factor = Fitted::DIFFERENCE[usize::from(rule == Rule::Fine)];
        let of = |off: f64, size: f64| {
            if off > 0.0 { off * (factor * off / (self.deepest * size)).min(1.0) } else { 0.0 }
        };
        let error = [of(difference, size), of(off[6].abs(), value[6])];
        let part = Part { triangle, corners: *corners, rule, value, error };
        match self.parts.get_mut(place) {
            Some(other) => *other = part,
            None => self.parts.push(part),
        }
        self.parts.get(place)
    }
}
