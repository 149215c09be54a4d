//! The point of a boundary where S is least: on its plane, an edge or a corner.

use super::boundary::{Feature, Triangle};
use super::triangle::PlacedTriangle;
use crate::bounds::scale::Scale;
use crate::bounds::solution::Solution;
use crate::contact::detect::DetectError;
use crate::flags::Flags;
use crate::linalg::number::{larger, smaller};
use crate::model::local_model::Start;
use crate::model::problem::Problem;
use crate::pair::body::Body;
use crate::pair::boundary_part::{BoundaryPart, PartFrame};
use crate::pair::pair::Pair;
use crate::pair::separation::MARGIN;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::settings::Settings;
use crate::solver::call::Call;
use nalgebra::{Matrix3, Vector2, Vector3};

/// The particle, and what its searches on the parts of a boundary have cost so far.
pub(super) struct Search<'a> {
    pub particle: &'a Particle,
    pub pose: &'a Pose,
    pub settings: &'a Settings,
    pub flags: Flags,
    pub iterations: u32,
}

/// The least S on one part of a boundary.
#[derive(Clone, Copy)]
pub(super) struct Least {
    pub part: BoundaryPart,
    /// Part to world, the centre of the particle in the frame of the part, and the length that the rounding of its place is proportional to.
    pub rotation: Matrix3<f64>,
    centre: Vector3<f64>,
    pub lengths: f64,
    pub solution: Solution,
    /// Bound on the distance of the point to the exact one.
    pub point_bound: f64,
}

/// The least S on a whole boundary.
#[derive(Clone, Copy)]
pub(super) struct Closest {
    pub least: Least,
    pub feature: Feature,
    /// Lower bound of S on the whole boundary, up to the rounding of the solution.
    pub lower: f64,
    /// How steeply S may descend into the boundary from there, in doubt: 0 but for rounding.
    pub descent: f64,
    /// Bound on the way to any point of the boundary.
    pub extent: f64,
}

impl Search<'_> {
    /// The least S on a part, sought from a point of its frame.
    pub fn on_part(&mut self, part: BoundaryPart, from: Vector2<f64>) -> Result<Least, DetectError> {
        let frame = part.frame(self.pose);
        let pair = Pair::on_boundary(self.particle, self.pose, &part, &frame);
        let mut call = Call::new(&pair, self.settings);
        let start = Start { x: from.push(0.0), lambda: 1.0 };
        let model = call.model(&start, Problem::OnBoundary);
        let solved = call.solve(Problem::OnBoundary, start.lambda, model)?;
        let (solution, point_bound) = (solved.solution, call.point_bound(&solved, Problem::OnBoundary));
        self.flags = self.flags.with(call.flags);
        self.iterations += call.iterations;
        // Of a point that is known to the last digits the frame has to be, too.
        let precise = call.flags.contains(Flags::EXTENDED);
        let PartFrame { rotation, centre, lengths } = if precise { part.precise_frame(self.pose) } else { frame };
        Ok(Least { part, rotation, centre, lengths, solution, point_bound })
    }

    pub fn on_plane(&mut self, plane: BoundaryPart) -> Result<Closest, DetectError> {
        let least = self.on_part(plane, Vector2::zeros())?;
        let Solution { lower, slope, .. } = least.solution;
        Ok(Closest { least, feature: Feature::Interior, lower, descent: slope, extent: f64::INFINITY })
    }

    /// The least S on a triangle is that on its plane, or on an edge beyond which that lies.
    pub fn on_triangle(&mut self, triangle: &Triangle, placed: &PlacedTriangle) -> Result<Closest, DetectError> {
        let inside = self.on_part(triangle.inside(), placed.nearest())?;
        let x = inside.solution.x.xy();
        let mut on_edges = [None; 3];
        for i in (0..3).filter(|i| placed.is_beyond(*i, &x)) {
            on_edges[i] = Some(self.on_edge(triangle, i)?);
        }
        let smaller_of = |a: (Least, Feature), b: (Least, Feature)| {
            if b.0.solution.estimate < a.0.solution.estimate { b } else { a }
        };
        let Some((mut least, mut feature)) = on_edges.iter().flatten().copied().reduce(smaller_of) else {
            let Solution { lower, slope: descent, .. } = inside.solution;
            let (feature, extent) = (Feature::Interior, placed.extent(&x));
            return Ok(Closest { least: inside, feature, lower, descent, extent });
        };
        // On an edge that ends at the vertex the least S is no more than there, and whether it is less is an answer of the edge
        // alone: so all triangles that share it have the same.
        if let Feature::Vertex(vertex) = feature {
            for i in [usize::from(vertex), (usize::from(vertex) + 2) % 3] {
                let found = on_edges[i].map_or_else(|| self.on_edge(triangle, i), Ok)?;
                if found.1 != feature {
                    (least, feature) = found;
                    break;
                }
            }
        }
        Ok(self.on_rim(placed, (least, feature), &inside))
    }

    /// The least S on edge i, from the edge alone.
    fn on_edge(&mut self, triangle: &Triangle, i: usize) -> Result<(Least, Feature), DetectError> {
        let (ends, reversed) = triangle.edge(i);
        let edge = BoundaryPart::Edge(ends);
        let along = edge.frame(self.pose).rotation.column(0).into_owned();
        let [from, to] = ends.map(|end| along.dot(&(end - self.pose.position())));
        let least = self.on_part(edge, Vector2::new(smaller(larger(from, 0.0), to), 0.0))?;
        let x = least.solution.x.x;
        let end = match () {
            () if x < from => usize::from(reversed),
            () if x > to => usize::from(!reversed),
            () => return Ok((least, Feature::Edge(i as u8))),
        };
        let vertex = (i + end) % 3;
        Ok((self.on_part(triangle.corner(vertex), Vector2::zeros())?, Feature::Vertex(vertex as u8)))
    }

    /// The least S on an edge or at a corner, as that on the whole triangle, beside that in its plane.
    fn on_rim(&self, placed: &PlacedTriangle, (least, feature): (Least, Feature), inside: &Least) -> Closest {
        let solution = &least.solution;
        let to_plane = |v: &Vector3<f64>| inside.rotation.tr_mul(&(least.rotation * v)).xy();
        let (gradient, point) = (to_plane(&solution.gradients[0]), to_plane(&least.from_centre()));
        let into = match feature {
            Feature::Edge(i) => placed.descent_from_edge(usize::from(i), &gradient),
            Feature::Vertex(i) => placed.descent_from_vertex(usize::from(i), &gradient),
            Feature::Interior => 0.0,
        };
        let (descent, extent) = (into + solution.slope, placed.extent(&point));
        let level = larger(solution.upper, 1.0);
        let within = smaller(least.from_centre().norm() + self.particle.reach(level), extent);
        let height = smaller(descent * within, 0.5 * descent * descent / self.body().sphere_curvature());
        // No point of the triangle is below the least of its plane.
        let of_plane = inside.solution.lower - inside.solution.rounding - solution.rounding;
        Closest { least, feature, lower: larger(solution.estimate - height, of_plane), descent, extent }
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
}

impl Closest {
    /// s of the regularised particle, with bounds of that of the given one.
    ///
    /// Where a flat face lies on several triangles, or a core of k = 0 reaches through them, the regularisation alone tells which of
    /// them is nearest to the centre: it stays part of s, and of the gap.
    pub fn scale(&self, body: &Body) -> Scale {
        let Solution { estimate, upper, rounding, .. } = self.least.solution;
        let most = body.most_surplus(larger(upper, 1.0));
        Scale::between(estimate, self.lower - most - rounding, larger(estimate, upper) + rounding)
    }

    /// Whether the regularisation may be all that keeps s from being less than 1. The part decides alone, as it does of s: all triangles
    /// that share it have the same answer.
    pub fn may_hide_an_overlap(&self, body: &Body) -> bool {
        let Solution { estimate, lower, upper, rounding, .. } = self.least.solution;
        estimate >= 1.0 && lower - rounding - body.most_surplus(larger(upper, 1.0)) < 1.0
    }

    /// Lower bound of the distance of particle and boundary, from the tangent of s at the point, which lies below s everywhere.
    ///
    /// In the particle the tangent is at most 1, or what the regularisation makes of that; on the boundary it is at least s but for
    /// what is in doubt; and it rises by no more than its slope. The point of the boundary nearest to the particle is no farther
    /// from the centre than this one and the radius of the particle together.
    pub fn distance(&self, body: &Body) -> f64 {
        let Solution { estimate, rounding, gradient_norms, .. } = self.least.solution;
        let within = smaller(2.0 * (body.particle.bounding_radius() + self.least.from_centre().norm()), self.extent);
        let most = (estimate * (1.0 + body.most_surplus(1.0))).sqrt();
        let above = 2.0 * (estimate - most) - self.descent * within - rounding;
        larger(above / (gradient_norms[0] + self.descent) * (1.0 - MARGIN), 0.0)
    }

    /// Bound on the way to any point of the boundary where S is no larger.
    pub fn within(&self, body: &Body) -> f64 {
        let level = larger(self.least.solution.upper, 1.0);
        smaller(self.least.from_centre().norm() + body.particle.reach(level), self.extent)
    }
}
