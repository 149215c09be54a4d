//! This library. Ways: midway, closest, carried (in a batch, as the YADE plugin asks), cone_program (clarabel on the
//! paper's cone program); `midway@1e-14` sets gap_tolerance; `midway+all` solves pairs that are apart to the
//! end.

use peers::scene::{Group, Placement};
use peers::server::{Answer, Contestant, serve};
use potential_particles::{
    BackEnd, Contact, DetectError, Formulation, Kind, PairState, Particle, Plane, Pose, Settings, detect, detect_batch,
};

/// To what part of the size the point of a contact that is carried on is known: the plugin's default.
const CARRY_TOLERANCE: f64 = 1e-9;

struct Ours {
    particle: Particle,
    settings: Settings,
    a: Vec<Pose>,
    /// Of each time, of each pair.
    b: Vec<Vec<Pose>>,
    states: Vec<PairState>,
    answers: Vec<Answer>,
}

/// All pairs of a time in one call.
struct Batch {
    ours: Ours,
    /// A and B of each pair in turn, at each time.
    poses: Vec<Vec<Pose>>,
    pairs: Vec<[u32; 2]>,
}

fn main() {
    serve(|group, way| {
        let (way, all) = way.strip_suffix("+all").map_or((way, false), |way| (way, true));
        let (way, tolerance) = way.split_once('@').unwrap_or((way, "1e-12"));
        let mut settings = Settings::default().with_solve_separated(all);
        settings.gap_tolerance = tolerance.parse().ok()?;
        match way {
            "midway" => {}
            "carried" => settings.carry_tolerance = CARRY_TOLERANCE,
            "closest" => settings.formulation = Formulation::Closest,
            "cone_program" => settings.back_end = BackEnd::ConeProgram,
            _ => return None,
        }
        let ours = Ours::new(group, settings);
        Some(if way == "carried" { Box::new(Batch::new(ours)) } else { Box::new(ours) })
    });
}

impl Ours {
    fn new(group: &Group, settings: Settings) -> Self {
        let planes: Vec<Plane> = group.planes.iter().map(|&plane| Plane::from(plane)).collect();
        let times = group.pairs[0].b.len();
        Self {
            particle: Particle::new(&planes, group.r, group.k, group.shadow).expect("a particle"),
            settings,
            a: group.pairs.iter().map(|pair| pose(&pair.a)).collect(),
            b: (0..times).map(|time| group.pairs.iter().map(|pair| pose(&pair.b[time])).collect()).collect(),
            states: vec![PairState::default(); group.pairs.len()],
            answers: vec![Answer::Failed; group.pairs.len()],
        }
    }
}

impl Contestant for Ours {
    fn pass(&mut self, time: usize, warm: bool) {
        for i in 0..self.states.len() {
            let state = warm.then_some(&mut self.states[i]);
            let found = detect(&self.particle, &self.a[i], &self.particle, &self.b[time][i], &self.settings, state);
            self.answers[i] = answer(&found);
        }
    }

    fn answers(&self) -> &[Answer] {
        &self.answers
    }
}

impl Batch {
    fn new(ours: Ours) -> Self {
        let both = |b: &Vec<Pose>| ours.a.iter().zip(b).flat_map(|(a, b)| [*a, *b]).collect();
        Self {
            poses: ours.b.iter().map(both).collect(),
            pairs: (0..ours.a.len() as u32).map(|i| [2 * i, 2 * i + 1]).collect(),
            ours,
        }
    }
}

impl Contestant for Batch {
    fn pass(&mut self, time: usize, warm: bool) {
        let ours = &mut self.ours;
        let particles = vec![&ours.particle; 2 * ours.a.len()];
        let states: &mut [PairState] = if warm { &mut ours.states } else { &mut [] };
        let found = detect_batch(&particles, &self.poses[time], &self.pairs, &ours.settings, 1, states);
        for (kept, found) in ours.answers.iter_mut().zip(found.expect("settings in range")) {
            *kept = answer(&found);
        }
    }

    fn answers(&self) -> &[Answer] {
        self.ours.answers()
    }
}

fn pose(placement: &Placement) -> Pose {
    Pose::new(placement.position, placement.orientation).expect("a pose")
}

fn answer(found: &Result<Contact, DetectError>) -> Answer {
    match found {
        Err(_) => Answer::Failed,
        Ok(contact) if contact.kind == Kind::Separated => Answer::Apart,
        Ok(contact) => {
            Answer::Found { overlap: contact.overlap, point: contact.point.into(), normal: contact.normal.into() }
        }
    }
}
