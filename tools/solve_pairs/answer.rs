//! The answer for one pair, as it is written.

use crate::arguments::{self, Arguments};
use kit::pair_line::Input;
use nalgebra::Vector3;
use potential_particles::{
    BackEnd, ClosestPoint, Contact, Flags, Formulation, Kind, Role, Settings, closest_point, detect,
};
use serde::Serialize;

/// One line of output. Vectors in world axes, points relative to the position of B.
#[derive(Serialize)]
pub struct Answer {
    line: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    midway: Option<Midway>,
    #[serde(skip_serializing_if = "Option::is_none")]
    closest: Option<Closest>,
}

#[derive(Serialize)]
struct Midway {
    kind: &'static str,
    /// t, the larger of s_A and s_B at the point.
    s: f64,
    /// Weight of B: (1−u)∇S_A + u∇S_B = 0.
    u: f64,
    point: [f64; 3],
    /// From A to B.
    normal: [f64; 3],
    overlap: f64,
    point_on_a: [f64; 3],
    point_on_b: [f64; 3],
    /// Bound on the error of s.
    gap: f64,
    /// Bound on the distance of the point from the optimum.
    bound: f64,
    iterations: u32,
    path: &'static str,
}

/// A half whose constraint is slack has no closest point: its s and point are null.
#[derive(Serialize)]
struct Closest {
    kind: &'static str,
    /// s_A at P2.
    s_a: f64,
    /// s_B at P1.
    s_b: f64,
    /// On A.
    p1: [f64; 3],
    /// On B.
    p2: [f64; 3],
    /// |P1 − P2| of overlapping particles.
    overlap: f64,
    slack: Slack,
    /// Bound on the errors of s_a and s_b.
    gap: f64,
}

/// Whose s ≤ 1 does not bind: "a" leaves P1 without meaning, "b" leaves P2.
#[derive(Serialize)]
struct Slack {
    a: bool,
    b: bool,
}

impl Answer {
    pub fn new(line: usize, input: &Input, arguments: &Arguments) -> Result<Self, String> {
        let wanted = arguments.formulation;
        let back_end = match arguments.back_end {
            arguments::BackEnd::Fast => BackEnd::Fast,
            arguments::BackEnd::ConeProgram => BackEnd::ConeProgram,
        };
        let settings = Settings::default().with_back_end(back_end).with_gap_tolerance(arguments.gap_tolerance);
        let midway = (wanted != arguments::Formulation::Closest).then(|| midway(input, settings)).transpose()?;
        let closest = (wanted != arguments::Formulation::Midway).then(|| closest(input, settings)).transpose()?;
        Ok(Self { line, midway, closest })
    }
}

fn solve(input: &Input, settings: Settings) -> Result<Contact, String> {
    // A warm start would make an answer depend on the line before.
    let settings = settings.with_solve_separated(true);
    detect(&input.a, &input.pose_a, &input.b, &input.pose_b, &settings, None).map_err(|error| error.to_string())
}

fn midway(input: &Input, settings: Settings) -> Result<Midway, String> {
    let contact = solve(input, settings.with_formulation(Formulation::Midway))?;
    // Branches lose no digit to a position far from the origin.
    let relative = |point: Vector3<f64>| (point - input.pose_b.position()).into();
    Ok(Midway {
        kind: name(contact.kind),
        s: contact.s,
        u: contact.weight,
        point: contact.branch_b.into(),
        normal: contact.normal.into(),
        overlap: contact.overlap,
        point_on_a: relative(contact.point_on_a),
        point_on_b: relative(contact.point_on_b),
        gap: contact.gap,
        bound: contact.point_bound,
        iterations: contact.iterations,
        path: path(&contact),
    })
}

fn closest(input: &Input, settings: Settings) -> Result<Closest, String> {
    // With all weight on one of them, the contact point is that closest point, of separated particles as well.
    let weighted =
        |weight_on_a| solve(input, settings.with_formulation(Formulation::Closest).with_weight_on_a(weight_on_a));
    let on_b = weighted(0.0)?;
    if on_b.flags.contains(Flags::SLACK) {
        return slack(input, &on_b, &settings);
    }
    let on_a = weighted(1.0)?;
    Ok(Closest {
        kind: name(on_b.kind),
        s_a: on_b.s,
        s_b: on_b.s_b,
        p1: on_a.branch_b.into(),
        p2: on_b.branch_b.into(),
        overlap: on_b.overlap,
        slack: Slack { a: false, b: false },
        gap: on_b.gap,
    })
}

/// The point that still has an answer, if there is one.
fn slack(input: &Input, contact: &Contact, settings: &Settings) -> Result<Closest, String> {
    let point = |on: Role| {
        closest_point(&input.a, &input.pose_a, &input.b, &input.pose_b, on, settings).map_err(|error| error.to_string())
    };
    let (p1, p2) = (point(Role::A)?, point(Role::B)?);
    let of =
        |half: &Option<ClosestPoint>| half.map_or((f64::NAN, [f64::NAN; 3]), |half| (half.s, half.branch_b.into()));
    let ((s_b, on_a), (s_a, on_b)) = (of(&p1), of(&p2));
    Ok(Closest {
        kind: name(contact.kind),
        s_a,
        s_b,
        p1: on_a,
        p2: on_b,
        overlap: f64::NAN,
        slack: Slack { a: p1.is_none(), b: p2.is_none() },
        gap: p1.iter().chain(&p2).map(|half| half.gap).fold(f64::NAN, f64::max),
    })
}

fn name(kind: Kind) -> &'static str {
    match kind {
        Kind::Separated => "separated",
        Kind::Overlapping => "overlapping",
    }
}

/// Which solver answered, and from which start.
fn path(contact: &Contact) -> &'static str {
    match contact.back_end {
        BackEnd::ConeProgram => "cone_program",
        _ if contact.flags.contains(Flags::EXTENDED) => "extended",
        _ if contact.flags.contains(Flags::WARM) => "fast warm",
        _ => "fast cold",
    }
}
