//! The point of a boundary where S is least: on its plane, an edge or a corner.

use super::boundary::{Feature, Triangle};
use super::triangle::PlacedTriangle;
use crate::bounds::point_bound::farthest_apart;
use crate::bounds::scale::Scale;
use crate::bounds::solution::Solution;
use crate::contact::error::DetectError;
use crate::flags::Flags;
use crate::linalg::number::{gamma, larger, smaller};
use crate::model::local_model::Start;
use crate::model::problem::Problem;
use crate::pair::body::{Body, shift_in_a};
use crate::pair::boundary_part::{BoundaryPart, PartFrame, PlacedPart};
use crate::pair::pair::Pair;
use crate::particle::numbers::MARGIN;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::settings::Settings;
use crate::solver::call::Call;
use nalgebra::{Matrix3, Vector2, Vector3};

/// Bound on the rounding of a distance, relative to it (estimated).
const OF_LENGTHS: f64 = gamma(16);

/// The particle, and what its searches on the parts of a boundary have cost so far.
pub(super) struct Search<'a> {
    pub particle: &'a Particle,
    pub pose: &'a Pose,
    pub settings: &'a Settings,
    /// Whether all parts are solved in extended precision, as their bounds in doubles did not tell enough.
    pub precise: bool,
    /// Where a search on the plane of the boundary begins, and where the last one ended: local frame of the particle.
    pub remembered: Option<Vector3<f64>>,
    pub flags: Flags,
    pub iterations: u32,
}

/// The least S on one part of a boundary.
#[derive(Clone, Copy)]
pub(super) struct Least {
    /// The number of coordinates that a point of the part has.
    pub dimensions: usize,
    /// Part to world, the centre of the particle in the frame of the part, and the length that the rounding of its
    /// place is proportional to.
    pub rotation: Matrix3<f64>,
    centre: Vector3<f64>,
    pub lengths: f64,
    /// Whether both are right to the last digits, as the solution is.
    precise: bool,
    pub solution: Solution,
    /// How steeply S falls from there into the triangle, negative where it rises; and an upper bound on that.
    inward_descent: f64,
    descent: f64,
    /// Bound on the distance of the point to that of the whole boundary, if it is certain that this lies on the part.
    point_bound: f64,
}

/// The least S on an edge between its ends.
#[derive(Clone, Copy)]
struct OnEdge {
    least: Least,
    feature: Feature,
    /// That of the line of the edge, and how far from it `least` is where it lies between the ends; else infinite.
    of_line: Least,
    from_line: f64,
}

/// The least S on a whole boundary.
#[derive(Clone, Copy)]
pub(super) struct Closest {
    pub least: Least,
    pub feature: Feature,
    /// Bound on how far S on the whole boundary may be below its upper bound, up to the rounding of the solution.
    duality_gap: f64,
    /// Bound on the way to any point of the boundary.
    extent: f64,
}

impl Search<'_> {
    /// The least S on a part, sought from a point of that.
    fn on_part(&mut self, placed: &PlacedPart, from: Vector2<f64>) -> Result<Least, DetectError> {
        let pair = Pair::on_boundary(self.particle, placed);
        let mut call = Call::new(&pair, self.settings);
        call.precise = self.precise;
        let start = Start { x: from.push(0.0), lambda: 1.0 };
        let mut model = call.model(&start, Problem::OnBoundary);
        let solved = call.solve(Problem::OnBoundary, start.lambda, &mut model)?;
        let solution = solved.solution;
        let (inward_descent, rounding) = match (solution.inward_descent, placed.descent(&solution.gradients[0])) {
            (Some(descent), _) => (descent, 0.0),
            (None, Some(descent)) => (descent, placed.part.descent_rounding(solution.gradient_norms[0])),
            (None, None) => (0.0, 0.0),
        };
        let point_bound = call.point_bound(&solved, Problem::OnBoundary);
        // Where S provably rises into the triangle from everywhere within the bound, the optimum of the part is that of
        // the triangle.
        let planes = f64::from(solved.model.q_a.count) * call.bodies()[0].stiffest_curvature();
        let doubt = solution.slope + rounding + (planes + call.bodies()[0].sphere_curvature()) * point_bound;
        let dimensions = placed.part.dimensions();
        let is_all = dimensions == 2 || -inward_descent > doubt;
        let point_bound = if is_all { point_bound } else { f64::INFINITY };
        self.flags = self.flags.with(call.flags);
        self.iterations += call.iterations;
        // The frame must be as precise as the point.
        let precise = call.flags.contains(Flags::EXTENDED);
        let PartFrame { rotation, centre, lengths } = if precise { placed.precise_frame() } else { placed.frame };
        let descent = larger(inward_descent, 0.0) + rounding + solution.slope;
        Ok(Least { dimensions, rotation, centre, lengths, precise, solution, inward_descent, descent, point_bound })
    }

    /// The least S on the plane of a boundary, sought from the remembered point if there is one. The other parts are
    /// not sought from memory: all triangles that share one find the same bits.
    fn inside(&mut self, plane: &PlacedPart) -> Result<Least, DetectError> {
        let last = self.remembered.map(|x| plane.in_part(&x).xy());
        let least = self.on_part(plane, last.unwrap_or_else(|| self.below(plane)))?;
        self.remembered = Some(self.pose.rotation().tr_mul(&(least.rotation * least.from_centre())));
        Ok(least)
    }

    /// A point of a plane near that of the least S: below the corners of the particle that lie beyond it, seen from the
    /// centre.
    fn below(&self, plane: &PlacedPart) -> Vector2<f64> {
        let frame = &plane.frame;
        let towards = -frame.centre.z.signum() * self.pose.rotation().tr_mul(&frame.rotation.column(2));
        let corner = self.particle.bounds.beyond(&towards, frame.centre.z.abs());
        corner.map_or_else(Vector2::zeros, |corner| plane.in_part(&corner).xy())
    }

    pub fn on_plane(&mut self, plane: &PlacedPart) -> Result<Closest, DetectError> {
        let least = self.inside(plane)?;
        Ok(Closest {
            duality_gap: least.solution.duality_gap,
            least,
            feature: Feature::Interior,
            extent: f64::INFINITY,
        })
    }

    /// The least S on a triangle is that on its plane, or on an edge beyond which that lies.
    pub fn on_triangle(
        &mut self,
        triangle: &Triangle,
        plane: &PlacedPart,
        placed: &PlacedTriangle,
    ) -> Result<Closest, DetectError> {
        let inside = self.inside(plane)?;
        let x = inside.solution.x.xy();
        let mut on_edges = [None; 3];
        // An edge whose distance is 0 within rounding counts as passed: S is no less there than on the triangle.
        let from_edges =
            if inside.precise { plane.wide_from_edges(&triangle.vertices, &x) } else { placed.from_edges(&x) };
        for i in (0..3).filter(|i| from_edges[*i] <= inside.shift()) {
            self.on_edge_once(triangle, &mut on_edges, i)?;
        }
        let Some(mut found) = least_of(&on_edges) else {
            let point_bound =
                if from_edges.iter().all(|d| *d > inside.point_bound) { inside.point_bound } else { f64::INFINITY };
            let (least, extent) = (Least { point_bound, ..inside }, placed.extent(&x));
            return Ok(Closest { duality_gap: inside.solution.duality_gap, least, feature: Feature::Interior, extent });
        };
        if found.least.inward_descent > 0.0 {
            // S falls into the triangle: rounding may have decided which edges the point of the plane lies beyond.
            for i in 0..3 {
                self.on_edge_once(triangle, &mut on_edges, i)?;
            }
            found = least_of(&on_edges).unwrap_or(found);
        }
        found = self.from_vertices(triangle, &mut on_edges, found)?;
        let OnEdge { mut least, feature, .. } = found;
        let body = self.body();
        let extent_from =
            |least: &Least| placed.extent(&inside.rotation.tr_mul(&(least.rotation * least.from_centre())).xy());
        let extent = extent_from(&least);
        // No point of the triangle is below the least of its plane.
        let above = |of: &Least| {
            let lower = of.solution.upper - of.solution.rounding - least.solution.rounding;
            larger(least.solution.upper - lower, f64::EPSILON * least.solution.upper)
        };
        let mut duality_gap = smaller(least.duality_gap(&body, extent), above(&inside) + inside.solution.duality_gap);
        let mut point_bound = least.point_bound;
        // Nor below that of an edge's line but for the descent there: a tighter bound than by a vertex that rounding
        // chose.
        for on_edge in on_edges.iter().flatten() {
            let line = &on_edge.of_line;
            duality_gap = smaller(duality_gap, above(line) + line.duality_gap(&body, extent_from(line)));
            if on_edge.feature == feature {
                point_bound = smaller(point_bound, line.point_bound + on_edge.from_line);
            }
        }
        least.point_bound = point_bound;
        let closest = Closest { duality_gap, least, feature, extent };
        if self.precise { self.as_without_triangle(triangle, closest) } else { Ok(closest) }
    }

    /// From a vertex along the edges that end there: the least S of an edge is no larger, and whether it is smaller
    /// follows from the edge alone, so that all triangles that share it agree. It may lead to another vertex, but not
    /// in a circle.
    fn from_vertices(
        &mut self,
        triangle: &Triangle,
        on_edges: &mut [Option<OnEdge>; 3],
        mut found: OnEdge,
    ) -> Result<OnEdge, DetectError> {
        for _ in 0..3 {
            let at = found.feature;
            for i in ending_at(at) {
                let on_edge = self.on_edge_once(triangle, on_edges, i)?;
                if on_edge.feature != at {
                    found = on_edge;
                    break;
                }
            }
        }
        Ok(found)
    }

    /// Replaces the point of an edge or a vertex that was found in extended precision by the one that the edge finds
    /// without regard to the triangle, so that all triangles that share it get the same bits. Its bounds are those
    /// found, and what the two differ by.
    fn as_without_triangle(&mut self, triangle: &Triangle, precise: Closest) -> Result<Closest, DetectError> {
        let Some(edge) = precise.feature.edge().or_else(|| ending_at(precise.feature).next()) else {
            return Ok(precise);
        };
        let (mut search, mut on_edges) = (Search { precise: false, ..*self }, [None; 3]);
        let found = search.on_edge_once(triangle, &mut on_edges, edge)?;
        let OnEdge { mut least, feature, .. } = search.from_vertices(triangle, &mut on_edges, found)?;
        (self.flags, self.iterations) = (search.flags, search.iterations);
        let place = |least: &Least| least.rotation * least.from_centre();
        let off = (place(&least) - place(&precise.least)).norm();
        least.point_bound = smaller(least.point_bound, precise.least.point_bound + off);
        let above = least.solution.upper - precise.least.solution.upper + precise.least.solution.rounding;
        Ok(Closest {
            duality_gap: larger(above, 0.0) + precise.duality_gap,
            least,
            feature,
            extent: precise.extent + off,
        })
    }

    /// The least S on edge i, found at most once.
    fn on_edge_once(
        &mut self,
        triangle: &Triangle,
        on_edges: &mut [Option<OnEdge>; 3],
        i: usize,
    ) -> Result<OnEdge, DetectError> {
        let on_edge = on_edges[i].map_or_else(|| self.on_edge(triangle, i), Ok)?;
        on_edges[i] = Some(on_edge);
        Ok(on_edge)
    }

    /// The least S on edge i, from the edge alone.
    fn on_edge(&mut self, triangle: &Triangle, i: usize) -> Result<OnEdge, DetectError> {
        let (ends, reversed) = triangle.edge(i);
        let edge = BoundaryPart::Edge { ends, third: triangle.vertices[(i + 2) % 3] };
        let edge = PlacedPart::new(edge, self.pose);
        let along = edge.frame.rotation.column(0).into_owned();
        let [from, to] = ends.map(|end| along.dot(&(end - self.pose.position())));
        let of_line = self.on_part(&edge, Vector2::new(smaller(larger(from, 0.0), to), 0.0))?;
        let [from, to] = if of_line.precise { edge.wide_ends() } else { [from, to] };
        let x = of_line.solution.x.x;
        // Distances from both ends.
        let inside = [x - from, to - x];
        let Some(nearest) = [0, 1].into_iter().find(|end| inside[*end] <= of_line.shift()) else {
            return Ok(OnEdge { least: of_line, feature: Feature::of_edge(i), of_line, from_line: 0.0 });
        };
        // By rounding the point of the line may lie beyond the wrong end.
        let value = |end: &Vector3<f64>| self.body().value(&self.pose.rotation().tr_mul(&(end - self.pose.position())));
        let end = usize::from(value(&ends[0]) > value(&ends[1]));
        let vertex = (i + if reversed { 1 - end } else { end }) % 3;
        let others = [1, 2].map(|i| triangle.vertices[(vertex + i) % 3]);
        let corner = BoundaryPart::Corner { at: triangle.vertices[vertex], others };
        let least = self.on_part(&PlacedPart::new(corner, self.pose), Vector2::zeros())?;
        let from_line =
            if end == nearest && inside[end] >= 0.0 { inside[end] + of_line.shift() } else { f64::INFINITY };
        Ok(OnEdge { least, feature: Feature::of_vertex(vertex), of_line, from_line })
    }

    /// The particle as it is solved for.
    pub fn body(&self) -> Body<'_> {
        Body::alone(self.particle, self.settings.least_sphericity())
    }
}

impl Least {
    /// From the centre of the particle to the point, frame of the part.
    pub fn from_centre(&self) -> Vector3<f64> {
        self.solution.x - self.centre
    }

    /// Bound on the rounding of the place of the point beside other parts.
    fn shift(&self) -> f64 {
        let length = self.from_centre().norm();
        shift_in_a(length, if self.precise { length } else { self.lengths })
    }

    /// How far S on a boundary of this extent may be below its upper bound.
    fn duality_gap(&self, body: &Body, extent: f64) -> f64 {
        let (descent, within) = (self.descent, self.within(body, extent));
        self.solution.duality_gap + smaller(descent * within, 0.5 * descent * descent / body.sphere_curvature())
    }

    /// Bound on the way to any point of a boundary of this extent where S is no larger.
    fn within(&self, body: &Body, extent: f64) -> f64 {
        let level = larger(self.solution.upper, 1.0);
        smaller(self.from_centre().norm() + body.particle.reach(level), extent + self.shift()) * (1.0 + OF_LENGTHS)
    }
}

/// The edges that end at a vertex.
fn ending_at(feature: Feature) -> impl Iterator<Item = usize> {
    let edges: &[usize] = feature.vertex().map_or(&[], |vertex| &[[0, 2], [1, 0], [2, 1]][vertex]);
    edges.iter().copied()
}

fn least_of(on_edges: &[Option<OnEdge>; 3]) -> Option<OnEdge> {
    let smaller_of = |a: OnEdge, b: OnEdge| if b.least.solution.estimate < a.least.solution.estimate { b } else { a };
    on_edges.iter().flatten().copied().reduce(smaller_of)
}

impl Closest {
    /// s of the regularised particle, with bounds of that of the given one.
    ///
    /// Where a flat face lies on several triangles, or a core of k = 0 reaches through them, the regularisation alone
    /// tells which of them is nearest to the centre: it stays part of s, and of the gap.
    pub fn scale(&self, body: &Body) -> Scale {
        let Solution { upper, rounding, .. } = self.least.solution;
        // A sum of squares that is 0 but for rounding.
        let estimate = larger(self.least.solution.estimate, 0.0);
        let most = body.most_surplus(larger(upper, 1.0));
        Scale::between(estimate, upper - self.duality_gap - most - rounding, larger(estimate, upper) + rounding)
    }

    /// Whether the gap, beside what the regularisation adds, is too wide for an answer.
    pub fn is_inconclusive(&self) -> bool {
        Solution::is_inconclusive(self.duality_gap + self.least.solution.rounding, self.least.solution.upper)
    }

    /// Whether the regularisation may be all that keeps s from being less than 1. The part decides alone, as it does of
    /// s: all triangles that share it have the same answer.
    pub fn may_hide_an_overlap(&self, body: &Body) -> bool {
        let Solution { estimate, lower, upper, rounding, .. } = self.least.solution;
        estimate >= 1.0 && lower - rounding - body.most_surplus(larger(upper, 1.0)) < 1.0
    }

    /// Lower bound of the distance of particle and boundary, from the tangent of s at the point, which lies below s
    /// everywhere.
    ///
    /// In the particle the tangent is at most 1, or what the regularisation makes of that; on the boundary it is at
    /// least s but for what is in doubt; and it rises by no more than its slope. The point of the boundary nearest to
    /// the particle is no farther from the centre than this one and the radius of the particle together.
    pub fn distance(&self, body: &Body) -> f64 {
        let Solution { estimate, rounding, gradient_norms, .. } = self.least.solution;
        let within = smaller(2.0 * (body.particle.bounding_radius() + self.least.from_centre().norm()), self.extent);
        let most = (estimate * (1.0 + body.most_surplus(1.0))).sqrt();
        let descent = self.least.descent;
        let above = 2.0 * (estimate - most) - descent * within - rounding;
        larger(above / (gradient_norms[0] + descent) * (1.0 - MARGIN), 0.0)
    }

    /// Bound on the distance of the point to the minimum: that of its part, or since S rises from the minimum at least
    /// as the square of the way times the least curvature, or from where it can be at all.
    pub fn point_bound(&self, body: &Body) -> f64 {
        // Of the particle without its regularisation.
        let surplus = body.most_surplus(larger(self.least.solution.upper, 1.0));
        let above = self.duality_gap + 2.0 * self.least.solution.rounding + surplus;
        let by_convexity = farthest_apart(above, 2.0 * body.particle.sphere_weight);
        smaller(smaller(self.least.point_bound, by_convexity), self.least.within(body, self.extent))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::scattered;

    fn on_triangle(particle: &Particle, pose: &Pose, triangle: &Triangle, precise: bool) -> Closest {
        let settings = Settings::DEFAULT.with_solve_separated(true);
        let (plane, flags) = (PlacedPart::new(triangle.inside(), pose), Flags::NONE);
        let pair = Pair::on_boundary(particle, &plane);
        let placed = PlacedTriangle::of(triangle, pose, &pair);
        let mut search =
            Search { particle, pose, settings: &settings, precise, remembered: None, flags, iterations: 0 };
        search.on_triangle(triangle, &plane, &placed).unwrap()
    }

    #[test]
    fn an_edge_ends_at_its_two_vertices() {
        for vertex in 0..3 {
            let edges: Vec<usize> = ending_at(Feature::of_vertex(vertex)).collect();
            assert!(edges.len() == 2 && (0..3).all(|i| edges.contains(&i) == (i == vertex || (i + 1) % 3 == vertex)));
        }
        assert_eq!(ending_at(Feature::Interior).chain(ending_at(Feature::Edge1)).count(), 0);
    }

    /// Whether all parts of a triangle are solved in extended precision depends on the triangle: what it shares with
    /// others may not.
    #[test]
    fn edges_and_vertices_have_the_same_bits_whether_the_triangle_is_solved_precisely_or_not() {
        let cube = Particle::cube(0.4, 0.1, 0.02, 0.9);
        let (mut shared, mut inside) = (0, 0);
        for seed in 0..150 {
            let mut chance = scattered(30 * seed);
            let mut vector = || Vector3::<f64>::from_fn(|_, _| chance());
            let (at, turn) = (vector(), vector());
            let pose = Pose::new((0.5 * at).into(), [0.5, turn.x, turn.y, turn.z]).unwrap();
            let corners = [vector(), vector(), vector()].map(|v| (0.7 * at + v).into());
            let Ok(triangle) = Triangle::new(corners) else { continue };
            let [doubles, wide] = [false, true].map(|precise| on_triangle(&cube, &pose, &triangle, precise));
            let off = (doubles.least.solution.estimate - wide.least.solution.estimate).abs();
            assert!(off <= doubles.duality_gap + wide.duality_gap + 2.0 * doubles.least.solution.rounding, "{off:e}");
            if wide.feature == Feature::Interior || wide.feature != doubles.feature {
                inside += 1;
                continue;
            }
            shared += 1;
            let bits = |found: &Closest| {
                let place = found.least.rotation * found.least.from_centre();
                (found.least.solution.estimate.to_bits(), [place.x, place.y, place.z].map(f64::to_bits))
            };
            assert_eq!(bits(&doubles), bits(&wide));
        }
        assert!(shared > 50 && inside > 10, "{shared}, {inside}");
    }
}
