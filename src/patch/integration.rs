//! From the potentials to the answer.

use super::cell::RayPlane;
use super::cells::{CellScratch, cells};
use super::centre::{flattest_axis, middle, on_patch};
use super::fan::{Fan, Integral};
use super::field::{Field, FramePlane, Placed};
use super::numbers::{FINEST_OF_PARTS, Limits, OFF_CENTRE, ZONES_FIRST};
use super::patch::{Patch, PatchFlags, PatchPoint};
use super::pieces::{Estimate, PieceScratch, pieces};
use super::ray::{Line, Node, Walker};
use super::rules::order_of;
use super::scratch::PatchScratch;
use super::settings::PatchSettings;
use super::smoothness::norm;
use super::stiffness::{stiffness, turned};
use nalgebra::{Matrix3, Matrix6, Vector3};

/// The data of a patch.
pub(super) struct Task<'a> {
    pub a: Placed<'a>,
    pub b: Option<Placed<'a>>,
    /// The edges of a triangle.
    pub edges: &'a [FramePlane],
    /// A point inside the triangle, in its plane; for the others the origin.
    pub inside: Option<[f64; 2]>,
    /// The frame: columns u, v, normal, world axes.
    pub frame: Matrix3<f64>,
    /// ℓ.
    pub length: f64,
    /// From the centres of A and B to the contact point, world axes, and that of A in the world.
    pub branches: [Vector3<f64>; 2],
    pub position: Vector3<f64>,
    /// Distance within which planes are loaded first.
    pub near: f64,
    pub settings: PatchSettings,
    pub flags: PatchFlags,
}

/// Computes the patch; its points are handed to `visit`.
///
/// In zones or cells where possible; else, or with the energy, by rays. No finer than the rounding of s over the depth
/// allows: faces that touch to rounding would be refined without end.
pub(super) fn patch(task: &Task, scratch: &mut PatchScratch, mut visit: impl FnMut(PatchPoint)) -> Patch {
    let PatchScratch { planes, ray_planes, nodes, points, pieces, cells, rays, sectors, stack } = scratch;
    let mut field = Field::new(task.a, task.b, task.edges, task.near, planes);
    let start = on_patch(&mut field, 0.0, 0.0, 0.0).unwrap_or_default();
    let deepest = field.values(&start)[0].0;
    let rounding = field.rounding(deepest);
    let tolerance = task.settings.above(rounding);
    let state = field.state();
    let mut parts = Parts { task, field: &mut field, start, deepest, tolerance, planes: ray_planes, nodes, points };
    let outcome = if parts.field.is_in_plane() {
        Some(parts.both_sides())
    } else if parts.field.plane_count() <= ZONES_FIRST {
        parts.zones(pieces).or_else(|| parts.cells(cells))
    } else {
        parts.cells(cells).or_else(|| parts.zones(pieces))
    };
    let outcome = outcome.unwrap_or_else(|| {
        parts.field.restore(state);
        let Parts { field, planes, nodes, points, .. } = &mut parts;
        let walker = Walker::new(field, planes, nodes, 2);
        let mut fan = Fan::new(walker, rays, sectors, stack, [0.0; 3], tolerance);
        spread(task, &mut fan, start, points)
    });
    let mut flags = task.flags;
    let is_empty = points.is_empty() || !outcome.error.is_finite();
    if is_empty {
        points.clear();
    }
    flags.set(PatchFlags::EMPTY, is_empty);
    flags.set(PatchFlags::FOLDED, outcome.is_folded);
    let [error, area_error] = [outcome.error, outcome.area_error].map(|e| if is_empty { 0.0 } else { e.max(rounding) });
    flags.set(PatchFlags::TOLERANCE_NOT_REACHED, error > task.settings.tolerance || outcome.is_capped);
    let mut summary = Summary::of(task, points, deepest);
    if !is_empty {
        summary.complete(task, points);
    }
    if task.settings.with_energy {
        summary.patch.energy = task.length * outcome.energy;
    }
    if task.settings.with_stiffness && !is_empty {
        summary.patch.stiffness = task.length * turned(&stiffness(&field, points), &task.frame);
        if field.is_in_plane() {
            only_in_plane(&mut summary.patch.stiffness);
        }
    }
    points.iter().for_each(|node| visit(summary.point(task, node)));
    Patch { flags, error, area_error, rays: outcome.rays, ..summary.patch }
}

/// Errors, energy and flags of a patch: all but its points.
#[derive(Default)]
struct Outcome {
    error: f64,
    area_error: f64,
    energy: f64,
    is_folded: bool,
    /// Whether it ended at the limit of work.
    is_capped: bool,
    rays: usize,
}

/// The ways to integrate a patch other than by rays from its middle, which always serve: each gives `None` where it
/// does not serve.
///
/// None of them has the energy, or the finest tolerances.
struct Parts<'p, 'f, 'a, 's> {
    task: &'p Task<'a>,
    field: &'f mut Field<'a, 's>,
    start: [f64; 3],
    deepest: f64,
    tolerance: f64,
    planes: &'f mut Vec<RayPlane>,
    nodes: &'f mut Vec<Node>,
    points: &'f mut Vec<Node>,
}

impl<'a, 's> Parts<'_, '_, 'a, 's> {
    fn is_asked(&self) -> bool {
        !self.task.settings.with_energy && self.tolerance >= FINEST_OF_PARTS
    }

    /// In zones that need no search.
    fn zones(&mut self, scratch: &mut PieceScratch) -> Option<Outcome> {
        if !self.is_asked() {
            return None;
        }
        let Self { field, start, deepest, tolerance, points, .. } = self;
        let estimate = pieces(field, start, *deepest, *tolerance, scratch, points)?;
        Some(Outcome::of(&estimate, points))
    }

    /// In the plane, where a patch is a curve: over it from the contact point to both sides.
    fn both_sides(&mut self) -> Outcome {
        let (tolerance, start) = (self.tolerance, self.start);
        let Self { field, planes, nodes, points, .. } = self;
        let mut walker = Walker::new(field, planes, nodes, order_of(tolerance));
        walker.with_energy = self.task.settings.with_energy;
        let walk = |walker: &mut Walker| {
            walker.nodes.clear();
            [1.0, -1.0].map(|sign| walker.walk(&Line { origin: start, direction: [sign, 0.0], is_polar: false }))
        };
        let mut rays = walk(&mut walker);
        // A quarter of the tolerance for each rule, now that the force is known roughly.
        walker.budget = 0.25 * tolerance * rays.iter().map(|ray| ray.sums[2]).sum::<f64>();
        if rays.iter().any(|ray| ray.error > walker.budget) {
            rays = walk(&mut walker);
        }
        points.clear();
        points.append(walker.nodes);
        let force = points.iter().map(|node| node.weight * node.pressure * vector(node)).sum::<Vector3<f64>>().norm();
        Outcome {
            error: (rays[0].error + rays[1].error) / force,
            area_error: f64::NAN,
            energy: rays[0].sums[7] + rays[1].sums[7],
            is_folded: rays.iter().any(|ray| ray.is_folded || ray.turns_back),
            is_capped: false,
            rays: 2,
        }
    }

    /// In the cells of the network.
    fn cells(&mut self, scratch: &mut CellScratch) -> Option<Outcome> {
        if !self.is_asked() {
            return None;
        }
        let axis = flattest_axis(self.field);
        let Self { deepest, tolerance, .. } = *self;
        let Self { field, planes, nodes, points, .. } = self;
        let mut walker = Walker::new(field, planes, nodes, 2);
        let estimate = cells(&mut walker, axis, deepest, tolerance, scratch, points)?;
        Some(Outcome::of(&estimate, points))
    }
}

/// Leaves what shifts along x and y and a turn about z do in the plane.
fn only_in_plane(stiffness: &mut Matrix6<f64>) {
    for leaving in 2..5 {
        stiffness.fill_row(leaving, 0.0);
        stiffness.fill_column(leaving, 0.0);
    }
}

impl Outcome {
    /// The outcome for points whose errors are estimated.
    fn of(estimate: &Estimate, points: &[Node]) -> Self {
        let force = points.iter().map(|node| node.weight * node.pressure * vector(node)).sum::<Vector3<f64>>().norm();
        Self {
            error: estimate.force / force,
            area_error: estimate.area / points.iter().map(|node| node.weight).sum::<f64>(),
            rays: estimate.rays,
            ..Self::default()
        }
    }
}

/// Integrates by a fan of rays and copies its points.
fn spread(task: &Task, fan: &mut Fan, start: [f64; 3], points: &mut Vec<Node>) -> Outcome {
    let axis = flattest_axis(fan.walker.field);
    let order = if fan.tolerance >= 1e-3 {
        3
    } else if fan.tolerance >= 1e-7 {
        5
    } else {
        8
    };
    let start = inwards(&mut fan.walker, start, task.inside);
    let (centre, rough) = middle(&mut fan.walker, start, axis);
    fan.centre = centre;
    let mut integral = Integral::default();
    for starts in 0.. {
        (fan.walker.order, fan.walker.with_energy) = (order, task.settings.with_energy);
        integral = fan.integrate(axis, rough);
        let force = norm(&integral.sums[..3]);
        if !(force > 0.0) {
            break;
        }
        // The axis of the wrench in the plane of the frame.
        let [_, _, load, turn_u, turn_v, ..] = integral.sums;
        let off = [-turn_v / load, turn_u / load];
        if starts < Limits::STARTS && !fan.is_capped && off[0].hypot(off[1]) > OFF_CENTRE * fan.extent {
            let [u, v, z] = fan.centre;
            if let Some(better) = on_patch(fan.walker.field, u + off[0], v + off[1], z) {
                fan.centre = better;
                continue;
            }
        }
        break;
    }
    let force = norm(&integral.sums[..3]);
    points.clear();
    let is_folded = fan.has_jump || fan.rays.iter().any(|ray| ray.is_folded || ray.turns_back);
    if !(force > 0.0) {
        return Outcome { is_folded, rays: fan.rays.len(), ..Outcome::default() };
    }
    for sector in fan.sectors.iter() {
        for (ray, angle) in &sector.rays[..sector.count] {
            let (from, to) = fan.rays[*ray].nodes;
            let nodes = &fan.walker.nodes[from as usize..to as usize];
            points.extend(nodes.iter().map(|node| Node { weight: angle * node.weight, ..*node }));
        }
    }
    let of_energy = if task.settings.with_energy { integral.error[3] / integral.sums[7] } else { 0.0 };
    let error = ((integral.error[0] + integral.radial).max(integral.error[1] / fan.extent) / force).max(of_energy);
    Outcome {
        error,
        area_error: integral.error[2] / integral.sums[6],
        energy: integral.sums[7],
        is_folded,
        is_capped: fan.is_capped,
        rays: fan.rays.len(),
    }
}

/// From a point of the patch that may lie on the edge of a triangle to the middle of the line towards a point inside.
fn inwards(walker: &mut Walker, start: [f64; 3], inside: Option<[f64; 2]>) -> [f64; 3] {
    let Some([u, v]) = inside else { return start };
    let way = [u - start[0], v - start[1]];
    let length = way[0].hypot(way[1]);
    if !(length > 0.0) {
        return start;
    }
    let direction = way.map(|c| c / length);
    let ray = walker.walk(&Line { origin: start, direction, is_polar: false });
    let half = 0.5 * ray.length().min(length);
    [start[0] + half * direction[0], start[1] + half * direction[1], start[2]]
}

/// The answer in the making.
struct Summary {
    patch: Patch,
    sums: Sums,
}

/// Sums over the points, about the origin of the frame.
#[derive(Default)]
struct Sums {
    area: f64,
    /// ∫ x, ∫ x xᵀ (xx, yy, zz, xy, xz, yz), ∫ p and ∫ p x.
    first: [f64; 3],
    second: [f64; 6],
    load: f64,
    loaded: [f64; 3],
    /// The square of the largest distance.
    reach: f64,
}

impl Summary {
    /// All that needs no axis of the wrench; `deepest`: S at the contact point.
    fn of(task: &Task, points: &[Node], deepest: f64) -> Self {
        let (mut force, mut torque, mut sums) = ([0.0; 3], [0.0; 3], Sums::default());
        for node @ Node { x: [x, y, z], weight, pressure, normal: [n_u, n_v] } in points {
            let (load, share) = (weight * pressure, node.area());
            let [f, g] = [load * n_u, load * n_v];
            let at = [share * x, share * y, share * z];
            let products = [at[0] * x, at[1] * y, at[2] * z, at[0] * y, at[0] * z, at[1] * z];
            for (sum, term) in force.iter_mut().zip([f, g, load]) {
                *sum += term;
            }
            for (sum, term) in torque.iter_mut().zip([y * load - z * g, z * f - x * load, x * g - y * f]) {
                *sum += term;
            }
            sums.area += share;
            sums.load += share * pressure;
            for ((first, loaded), term) in sums.first.iter_mut().zip(&mut sums.loaded).zip(at) {
                *first += term;
                *loaded += pressure * term;
            }
            for (sum, term) in sums.second.iter_mut().zip(products) {
                *sum += term;
            }
            sums.reach = sums.reach.max(x * x + y * y + z * z);
        }
        let patch = Patch {
            length: task.length,
            force: task.length * (task.frame * Vector3::from(force)),
            torque: task.length * (task.frame * Vector3::from(torque)),
            pressure_centre: task.position + task.branches[0],
            branch_a: task.branches[0],
            branch_b: task.branches[1],
            couple: 0.0,
            area: 0.0,
            centroid: Vector3::zeros(),
            second_moment: Matrix3::zeros(),
            polar_moment: 0.0,
            twist_lever: 0.0,
            mean_depth: 0.0,
            // Within rounding, s may be above 1.
            largest_depth: (task.length * (1.0 - deepest.max(0.0).sqrt())).max(0.0),
            energy: f64::NAN,
            stiffness: Matrix6::repeat(f64::NAN),
            reach: 0.0,
            error: 0.0,
            area_error: 0.0,
            flags: PatchFlags::default(),
            points: points.len(),
            rays: 0,
        };
        Self { patch, sums }
    }

    /// Adds the quantities that need the axis of the wrench.
    fn complete(&mut self, task: &Task, points: &[Node]) {
        let frame = &task.frame;
        let (force, torque) =
            (frame.tr_mul(&self.patch.force) / task.length, frame.tr_mul(&self.patch.torque) / task.length);
        let axis = force.normalize();
        let Sums { area, first, second: [xx, yy, zz, xy, xz, yz], load, loaded, reach } = self.sums;
        let (first, mean) = (Vector3::from(first), Vector3::from(loaded) / load);
        let centroid = first / area;
        // The point of the axis that is nearest to the origin, and from there to the height of the patch.
        let foot = force.cross(&torque) / force.norm_squared();
        let pole = foot + axis * axis.dot(&(mean - foot));
        let second = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz) - first * centroid.transpose();
        let off = centroid - pole;
        let about_pole = second + area * off * off.transpose();
        let polar = about_pole.trace() - axis.dot(&(about_pole * axis));
        // Distances from the axis, by their parts along two directions across it.
        let across = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
        let [[a, b, c], [d, e, f]]: [[f64; 3]; 2] = [across.into(), axis.cross(&across).into()];
        let [along, aside] = [a * pole.x + b * pole.y + c * pole.z, d * pole.x + e * pole.y + f * pole.z];
        let mut lever = 0.0;
        for node @ Node { x: [x, y, z], pressure, .. } in points {
            let (p, q) = (a * x + b * y + c * z - along, d * x + e * y + f * z - aside);
            lever += node.area() * pressure * (p * p + q * q).sqrt();
        }
        let patch = &mut self.patch;
        let branch = frame * pole;
        patch.pressure_centre = task.position + (task.branches[0] + branch);
        patch.branch_a = task.branches[0] + branch;
        patch.branch_b = task.branches[1] + branch;
        patch.couple = task.length * torque.dot(&axis);
        patch.area = area;
        patch.centroid = frame * (centroid - pole);
        patch.second_moment = frame * second * frame.transpose();
        patch.polar_moment = polar;
        patch.twist_lever = lever / load;
        patch.mean_depth = task.length * load / area;
        patch.reach = reach.sqrt();
    }

    #[inline(always)]
    fn point(&self, task: &Task, node: &Node) -> PatchPoint {
        let normal = vector(node);
        let stretch = normal.norm();
        PatchPoint {
            position: task.frame * Vector3::from(node.x),
            area: node.area(),
            depth: task.length * node.pressure,
            normal: task.frame * (normal / stretch.copysign(node.weight)),
        }
    }
}

/// The normal whose z is 1.
#[inline(always)]
fn vector(node: &Node) -> Vector3<f64> {
    Vector3::new(node.normal[0], node.normal[1], 1.0)
}
