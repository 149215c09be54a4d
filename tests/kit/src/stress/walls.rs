//! Contacts with planes and triangles, each judged against the least S in 32 digits.

use crate::pair_line::{Place, Shape};
use crate::random::Random;
use crate::stress::boundaries::Case;
use crate::stress::cases::stream;
use crate::stress::least::{Least, least};
use crate::stress::ledger::{Fault, Finding, Ledger};
use crate::stress::memories::{Raw, any};
use crate::stress::placed_boundary::{Beside, Boundary, Part, beside};
use crate::stress::reference::Body;
use crate::wide::{Wide, Wide3};
use nalgebra::Vector3;
use potential_particles::{
    DetectError, Feature, Flags, FlatContact, Kind, PairState, Particle, Pose, Settings, Triangle, Wall,
    contact_with_plane, contact_with_triangle,
};
use serde::Serialize;

/// What is judged; anything else must be found out.
pub type Solver =
    fn(&Particle, &Pose, &Boundary, &Settings, Option<&mut PairState>) -> Result<FlatContact, DetectError>;

/// The library.
pub fn solve(
    a: &Particle,
    pose: &Pose,
    boundary: &Boundary,
    settings: &Settings,
    state: Option<&mut PairState>,
) -> Result<FlatContact, DetectError> {
    let refused = "the boundaries that are drawn are boundaries";
    match boundary {
        Boundary::Plane { point, normal } => {
            contact_with_plane(a, pose, &Wall::new(*point, *normal).expect(refused), settings, state)
        }
        Boundary::Triangle(vertices) => {
            contact_with_triangle(a, pose, &Triangle::new(*vertices).expect(refused), settings, state)
        }
    }
}

const EPS: f64 = f64::EPSILON;

/// A gap that says nothing where it leaves open whether they touch.
const MOST_GAP: f64 = 1e-2;

/// k that is as good as 0, as a share of the least that the solver raises it to.
const AS_GIVEN: f64 = 1e-8;

/// What a test of the case needs.
#[derive(Serialize)]
struct Written<'a> {
    #[serde(rename = "A")]
    a: Shape,
    #[serde(rename = "a")]
    at: Place,
    boundary: &'a Boundary,
    settings: Chosen,
    answer: String,
    truth: String,
}

#[derive(Serialize)]
pub struct Chosen {
    gap_tolerance: f64,
    flat_regularisation: f64,
    solve_separated: bool,
}

impl From<&Settings> for Chosen {
    fn from(s: &Settings) -> Self {
        let Settings { gap_tolerance, flat_regularisation, .. } = *s;
        Self { gap_tolerance, flat_regularisation, solve_separated: s.solve_separated() }
    }
}

/// What was found of one case.
#[derive(Default)]
pub struct Verdict {
    pub faults: Vec<(Fault, String)>,
    pub judged: u64,
    pub unsettled: u64,
    /// The answer and the truth, for the reader.
    pub answer: String,
    pub truth: String,
}

impl Verdict {
    fn check(&mut self, holds: bool, fault: Fault, detail: impl FnOnce() -> String) {
        if !holds {
            self.faults.push((fault, detail()));
        }
    }
}

/// Case `index`: what is found is added to the ledger.
pub fn one(seed: u64, index: u64, solver: Solver, ledger: &mut Ledger) {
    let case = Case::of(seed, index);
    let verdict = judge(&case, solver);
    ledger.judged += verdict.judged;
    ledger.unsettled += verdict.unsettled;
    *ledger.families.entry(case.family.clone()).or_default() += 1;
    for (fault, detail) in &verdict.faults {
        let case_written = written(&case, &verdict);
        let (family, detail, planes) = (case.family.clone(), detail.clone(), case.particle.plane_count());
        ledger.find(Finding { fault: *fault, family, seed, index, detail, case: case_written, planes });
    }
}

fn written(case: &Case, verdict: &Verdict) -> serde_json::Value {
    let written = Written {
        a: (&case.particle).into(),
        at: case.at,
        boundary: &case.boundary,
        settings: (&case.settings).into(),
        answer: verdict.answer.clone(),
        truth: verdict.truth.clone(),
    };
    serde_json::to_value(written).unwrap_or_default()
}

/// The settings that are drawn, and where those end with a proof of separation, the same solved to the end.
pub fn judge(case: &Case, solver: Solver) -> Verdict {
    let mut verdict = Verdict::default();
    let pose = case.at.pose();
    let scene = Scene { case, pose: &pose };
    let mut state = scene.memory().map(PairState::from_raw);
    let first = scene.answer(&case.settings, solver, state.as_mut(), &mut verdict);
    if first.is_some_and(|contact| contact.flags.contains(Flags::REJECTED)) {
        scene.answer(&case.settings.with_solve_separated(true), solver, None, &mut verdict);
    }
    verdict
}

struct Scene<'a> {
    case: &'a Case,
    pose: &'a Pose,
}

/// Of one answer: with k as given, and as it may have been regularised.
struct Truth {
    given: Least,
    regularised: Vec<Least>,
}

impl Truth {
    /// s of the particle as it may be regularised.
    fn least(&self) -> f64 {
        self.regularised.iter().map(|l| l.least).fold(f64::INFINITY, f64::min)
    }

    fn most(&self) -> f64 {
        self.regularised.iter().map(|l| l.most).fold(0.0, f64::max)
    }
}

impl Scene<'_> {
    /// What is remembered: of half of the cases nothing, of the others what the particle leaves a little aside of
    /// there, or any numbers.
    fn memory(&self) -> Option<Raw> {
        let Case { particle, at, boundary, memory, .. } = self.case;
        let mut random = stream(memory.seed, 16, memory.index);
        let size = particle.bounding_radius();
        let beside = |random: &mut Random, share: f64| {
            let way = share * size * random.direction_in(particle.is_in_plane());
            let pose = at.at(Vector3::from(at.position) + way).pose();
            let mut state = PairState::default();
            let settings = Settings::default().with_solve_separated(true);
            // Without an answer there is nothing to remember.
            let _ = solve(particle, &pose, boundary, &settings, Some(&mut state));
            state.into_raw()
        };
        match random.whole(0, 4) {
            0 | 1 => None,
            2 => {
                let share = 10f64.powf(-8.0 * random.uniform());
                Some(beside(&mut random, share))
            }
            _ => {
                let own = beside(&mut random, 1e-3);
                Some(any(|| own, |random| beside(random, 1.0), &mut random).0)
            }
        }
    }

    fn least(&self, least_sphericity: f64) -> Least {
        let Case { particle, at, boundary, .. } = self.case;
        least(particle, at, boundary, least_sphericity)
    }

    fn truth(&self, settings: &Settings, flags: Option<Flags>) -> Truth {
        let default = Settings::default().flat_regularisation;
        let raised = settings.flat_regularisation.max(default);
        let told = flags.is_some_and(|flags| flags.contains(Flags::DEFAULT_REGULARISATION));
        let level = if told { default } else { raised };
        let mut levels = vec![level];
        // Beyond what doubles give, less regularisation may be chosen, so that it is no part of the gap.
        if settings.gap_tolerance < 1e-13 && level == default {
            levels.push(1e-5 * settings.gap_tolerance);
        }
        // The weight of the sphere decides, not k: R may be larger than the particle.
        let (particle, weight) = (&self.case.particle, |k: f64, radius: f64| k / (radius * radius));
        let own = weight(particle.sphericity(), particle.shadow_radius());
        let is_raised = |level: f64| !(own >= weight(level, particle.bounding_radius()));
        let flat = is_raised(level);
        let regularised: Vec<Least> =
            levels.iter().filter(|l| **l == levels[0] || flat).map(|level| self.least(*level)).collect();
        let given = if flat { self.as_given(default) } else { regularised[0] };
        Truth { given, regularised }
    }

    /// With k as given, or as good as 0: then what is added bounds what is lost.
    fn as_given(&self, default: f64) -> Least {
        let level = AS_GIVEN * default;
        let found = self.least(level);
        let particle = &self.case.particle;
        if particle.sphericity() / particle.shadow_radius().powi(2) > level / particle.bounding_radius().powi(2) {
            return found;
        }
        // The least S of k = 0 is met within as many bounding radii.
        let added = 4.0 * level * found.most.max(1.0).powi(2);
        Least { least: (found.least * found.least - added).max(0.0).sqrt(), ..found }
    }

    fn answer(
        &self,
        settings: &Settings,
        solver: Solver,
        state: Option<&mut PairState>,
        verdict: &mut Verdict,
    ) -> Option<FlatContact> {
        verdict.judged += 1;
        let contact = match solver(&self.case.particle, self.pose, &self.case.boundary, settings, state) {
            Ok(contact) => contact,
            Err(error) => {
                let truth = self.truth(settings, None);
                verdict.answer = error.to_string();
                verdict.truth = told(&truth);
                verdict.faults.push((Fault::NotSolved, format!("{error}; {}", told(&truth))));
                return None;
            }
        };
        let truth = self.truth(settings, Some(contact.flags));
        let before = verdict.faults.len();
        if contact.flags.contains(Flags::REJECTED) {
            self.rejected(&contact, &truth, verdict);
        } else {
            self.solved(&contact, &truth, verdict);
        }
        if verdict.faults.len() > before || verdict.answer.is_empty() {
            verdict.answer = format!("{contact:?}");
            verdict.truth = told(&truth);
        }
        Some(contact)
    }

    fn rejected(&self, c: &FlatContact, truth: &Truth, verdict: &mut Verdict) {
        let fine = c.kind == Kind::Separated && c.s >= 1.0 && c.distance >= 0.0;
        verdict.check(fine, Fault::Malformed, || format!("rejected with s={:e}, distance {:e}", c.s, c.distance));
        let most = truth.given.most;
        verdict.check(most >= 1.0 - 4.0 * EPS, Fault::WrongSide, || format!("rejected, true s={most:e}"));
        verdict.check(c.s <= most * (1.0 + 4.0 * EPS), Fault::BoundOfS, || {
            format!("s is at least {:e} it says, true s={most:e}", c.s)
        });
        self.distance(c, truth, verdict);
    }

    fn solved(&self, c: &FlatContact, truth: &Truth, verdict: &mut Verdict) {
        let (s, gap) = (c.s, c.gap);
        well_formed(self.case, c, verdict);
        if s.is_nan() || gap.is_nan() {
            return;
        }
        let (least, most) = (truth.least(), truth.most());
        let certain = most - least <= 0.1 * gap + 1e-16 * s.max(1.0) || truth.regularised.len() > 1;
        verdict.unsettled += u64::from(!certain);
        let known = gap.min(MOST_GAP);
        let given = &truth.given;
        let lost = c.kind == Kind::Separated && given.most < 1.0 - known;
        verdict.check(!lost, Fault::WrongSide, || format!("s={s:e} ± {gap:e}, truth {:e}", given.most));
        let invented = c.kind == Kind::Overlapping && given.least > 1.0 + known;
        verdict.check(!invented, Fault::WrongSide, || format!("s={s:e} ± {gap:e}, truth {:e}", given.least));
        let open = s - gap < 1.0 && 1.0 < s + gap;
        // A raised regularisation is asked for with the gap that it leaves.
        let raised = self.case.settings.flat_regularisation > Settings::default().flat_regularisation
            && !c.flags.contains(Flags::DEFAULT_REGULARISATION);
        verdict.check(!(open && gap > MOST_GAP) || raised, Fault::SaysNothing, || {
            format!("s={s:e} ± {gap:e}, truth {most:e}")
        });
        for (fault, least, most) in [(Fault::BoundOfS, least, most), (Fault::GapOfGiven, given.least, given.most)] {
            let off = (s - most).max(least - s);
            // A gap of 0 leaves the last digit of s.
            verdict.check(off <= gap + EPS * s, fault, || {
                format!("s={s:e} ± {gap:e}, truth {most:e} (± {:e}): {:.3e} gaps off", most - least, off / gap)
            });
        }
        self.points(c, truth, verdict);
        self.normal(c, truth, verdict);
        if c.kind == Kind::Overlapping {
            self.overlap(c, verdict);
        } else {
            self.distance(c, truth, verdict);
        }
    }

    /// The point of the boundary, relative to the centre: the branch of overlapping ones ends halfway.
    fn at(&self, c: &FlatContact) -> Vector3<f64> {
        if c.kind == Kind::Overlapping { c.branch - 0.5 * c.overlap * c.normal } else { c.branch }
    }

    fn points(&self, c: &FlatContact, truth: &Truth, verdict: &mut Verdict) {
        let x = self.at(c);
        let overlap = if c.overlap.is_finite() { c.overlap } else { 0.0 };
        let digits = 4.0 * EPS * (x.norm() + overlap);
        let distance = |l: &Least| l.x.minus(&Wide3::from(x)).norm().f64();
        let certain = truth.regularised.iter().all(|l| l.doubt <= 0.05 * c.point_bound + digits);
        let near = |l: &Least| distance(l) <= c.point_bound + l.doubt + digits;
        verdict.unsettled += u64::from(!certain && !truth.regularised.iter().any(near));
        let off = truth.regularised.iter().map(distance).fold(f64::INFINITY, f64::min);
        let size = self.case.particle.bounding_radius();
        verdict.check(!certain || truth.regularised.iter().any(near), Fault::BoundOfPoint, || {
            let bound = c.point_bound;
            format!("{off:e} off, bound {bound:e}, {:.2e} of it, {:.2e} sizes", off / bound, off / size)
        });
        let beside = self.beside(&x, c.feature);
        let allowed = 256.0 * EPS * (beside.farthest + x.norm()) + digits;
        verdict.check(beside.boundary <= allowed, Fault::OffBoundary, || {
            format!("{:e} beside the boundary, allowed {allowed:e}", beside.boundary)
        });
        verdict.check(beside.part <= allowed, Fault::OffBoundary, || {
            format!("{:e} beside {:?}, allowed {allowed:e}", beside.part, c.feature)
        });
    }

    fn beside(&self, x: &Vector3<f64>, feature: Feature) -> Beside {
        beside(&self.case.boundary, &self.case.at, x, part(feature))
    }

    fn normal(&self, c: &FlatContact, truth: &Truth, verdict: &mut Verdict) {
        let Some(nearest) = truth.regularised.first().filter(|_| truth.regularised.len() == 1) else { return };
        let gradient = nearest.gradient.norm().f64();
        let x = self.at(c);
        let beside = self.beside(&x, c.feature);
        let across = if matches!(self.case.boundary, Boundary::Plane { .. }) { 1.0 } else { self.condition() };
        // That of the point as answered: how far that may be off is judged apart.
        let off = nearest.x.minus(&Wide3::from(x)).norm().f64();
        let known = off.max(c.point_bound) + nearest.doubt + 8.0 * EPS * (x.norm() + beside.farthest);
        let turn = 2.0 * nearest.bend * known;
        if c.feature == Feature::Interior {
            let sign = c.normal.dot(&beside.normal).signum();
            let off = (c.normal - sign * beside.normal).norm();
            let allowed = 8.0 * EPS * across;
            verdict.check(off <= allowed, Fault::Normal, || format!("{off:e} off that of the boundary"));
            let slope = nearest.gradient.f64().dot(&c.normal);
            let right = gradient == 0.0 || !turn.is_finite() || slope >= -gradient * turn.max(1e-12);
            verdict.check(right, Fault::Normal, || format!("points into A: slope {slope:e} of {gradient:e}"));
            return;
        }
        if c.flags.contains(Flags::NORMAL_BY_BOUNDARY) || turn > 0.5 || part(c.feature) != nearest.part {
            return;
        }
        let off = (c.normal - nearest.gradient.f64() / gradient).norm();
        // At an edge the part along it, which is 0 at the minimum, is left out.
        let allowed = 16.0 * EPS * (1.0 + beside.farthest / x.norm()) + turn;
        verdict.check(off <= allowed, Fault::Normal, || format!("{off:e} off ∇S, allowed {allowed:e}"));
    }

    /// What the shape of a triangle makes of the rounding of its normal.
    fn condition(&self) -> f64 {
        let Boundary::Triangle(vertices) = &self.case.boundary else { return 1.0 };
        let v = vertices.map(Vector3::from);
        let sides = [v[1] - v[0], v[2] - v[1], v[0] - v[2]];
        let area = sides[0].cross(&sides[1]).norm();
        let mut lengths = sides.map(|side| side.norm());
        lengths.sort_by(f64::total_cmp);
        (lengths[0] * lengths[1] / area).max(1.0) * 2.0
    }

    /// S = 1 at the end of the overlap, for the particle as given.
    fn overlap(&self, c: &FlatContact, verdict: &mut Verdict) {
        let Case { particle, at, .. } = self.case;
        let body = Body::new(particle, at, at.position);
        let x = self.at(c);
        let start = Wide3::from(x);
        let tolerance = 64.0 * EPS * (x.norm() + c.overlap + particle.bounding_radius());
        let at = |way: f64| body.at(&start.plus(&Wide3::from(c.normal).times(Wide::from(way)))).value.f64();
        // Where the surface is met aslant, what it is off is found farther along.
        let end = body.at(&start.plus(&Wide3::from(c.normal).times(Wide::from(c.overlap)))).gradient.f64();
        let tolerance = tolerance
            * (end.norm() / end.dot(&c.normal)).max(self.aslant(&(x + c.overlap * c.normal), &c.normal, tolerance));
        if !(tolerance < particle.bounding_radius()) {
            return;
        }
        let (before, beyond) = (at(c.overlap - tolerance), at(c.overlap + tolerance));
        verdict.check(beyond >= 1.0, Fault::Overlap, || format!("overlap {:e}: S={beyond:e} beyond it", c.overlap));
        let inside = c.overlap <= tolerance || before <= 1.0;
        verdict.check(inside, Fault::Overlap, || format!("overlap {:e}: S={before:e} before it", c.overlap));
    }

    /// How much farther along the normal a plane is met that cannot be told from 0 at a point, where it is met aslant.
    fn aslant(&self, x: &Vector3<f64>, normal: &Vector3<f64>, tolerance: f64) -> f64 {
        let rotation = self.pose.rotation();
        let (local, along) = (rotation.tr_mul(x), rotation.tr_mul(normal));
        let met = self.case.particle.planes().filter(|plane| {
            let excess = plane.normal.dot(&local) - plane.offset;
            excess.abs() <= tolerance * plane.normal.norm()
        });
        let ahead = met.map(|plane| plane.normal.norm() / plane.normal.dot(&along)).filter(|slant| *slant > 0.0);
        ahead.fold(1.0, f64::max)
    }

    /// No farther than a point of the particle that is known: the one on the way to the nearest point of the boundary.
    fn distance(&self, c: &FlatContact, truth: &Truth, verdict: &mut Verdict) {
        let Case { particle, at, .. } = self.case;
        let x = truth.given.x.f64();
        let turned = self.pose.rotation().tr_mul(&x);
        let Some(way) = turned.try_normalize(0.0) else { return };
        let to = particle.surface_distance(&Vector3::zeros(), &way).unwrap_or(0.0);
        let (surface, length) = (to * way, x.norm());
        // From there to the plane along its normal as well, where that meets the boundary; the way to x is one in any
        // case.
        let most = (turned - surface).norm().min((length - to).abs());
        let rounding = 64.0
            * EPS
            * (length + particle.bounding_radius() + at.position.iter().fold(0.0, |m: f64, c| m.max(c.abs())) * EPS);
        let inside = to >= length;
        let allowed = if inside { rounding } else { most * (1.0 + 1e-12) + rounding };
        verdict.check(c.distance >= 0.0 && c.distance <= allowed, Fault::Distance, || {
            format!("at least {:e} apart, but {most:e} at most", c.distance)
        });
    }
}

fn told(truth: &Truth) -> String {
    let mut text = format!("s of k as given in [{:e}, {:e}]", truth.given.least, truth.given.most);
    for l in &truth.regularised {
        text += &format!(
            "; regularised in [{:e}, {:e}] at {:?} from the centre (world axes), {:?}, known to {:e}",
            l.least,
            l.most,
            <[f64; 3]>::from(l.x.f64()),
            l.part,
            l.doubt
        );
    }
    text
}

pub fn part(feature: Feature) -> Part {
    match (feature.edge(), feature.vertex()) {
        (Some(i), _) => Part::Edge(i),
        (None, Some(i)) => Part::Vertex(i),
        (None, None) => Part::Inside,
    }
}

fn well_formed(case: &Case, c: &FlatContact, verdict: &mut Verdict) {
    let finite = |v: &Vector3<f64>| v.iter().all(|c| c.is_finite());
    let overlapping = c.kind == Kind::Overlapping;
    let position = Vector3::from(case.at.position);
    let rounding = 4.0 * EPS * (position.norm() + c.branch.norm() + c.overlap.max(0.0));
    let halfway = 0.5 * (c.on_boundary + c.on_particle);
    let fine = c.s.is_finite()
        && c.s >= 0.0
        && c.gap.is_finite()
        && c.gap >= 0.0
        && c.point_bound >= 0.0
        && (c.normal.norm() - 1.0).abs() < 1e-14
        && (!case.particle.is_in_plane() || [c.point, c.branch, c.on_boundary, c.normal].iter().all(|v| v.z == 0.0))
        && [c.point, c.branch, c.on_boundary].iter().all(finite)
        && overlapping == (c.s < 1.0)
        && overlapping == (c.overlap.is_finite() && c.overlap >= 0.0)
        && overlapping == finite(&c.on_particle)
        && overlapping != (c.distance.is_finite() && c.distance >= 0.0)
        && (c.point - position - c.branch).norm() <= rounding
        && (!overlapping || (c.point - halfway).norm() <= rounding)
        && (!overlapping || (c.on_particle - c.on_boundary - c.overlap * c.normal).norm() <= rounding)
        && (overlapping || c.point == c.on_boundary);
    verdict.check(fine, Fault::Malformed, || format!("{c:?}"));
}
