//! The whole of packing: bodies look for their places in rounds, and each takes its place if nobody took it before.
//!
//! In a round a few bodies look at once, each on its own, in the pile at the start of the round; then they take their
//! places in order. A body whose place is taken looks again in the next round. How many look at once does not depend on
//! the number of threads, nor does the packing.

use super::numbers::{Limits, ROOM};
use crate::contact::batch::{CHUNK, in_parallel};
use crate::packing::container::Container;
use crate::packing::error::PackError;
use crate::packing::obstacle::Obstacle;
use crate::packing::pile::{Pile, Trial};
use crate::packing::supply::{Supply, Wanted};
use crate::packing::{scattered, settled};
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::random::Random;

/// Where places are sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrangement {
    /// Anywhere in the container: random sequential addition, of a number of bodies the largest first. Of equal bodies
    /// it fills some three tenths of the volume.
    Scattered,
    /// Anywhere, in the order of [`Supply::sequence`], up to the first body that finds no place: a later packing may go
    /// on with that one.
    InSequence,
    /// Each body as low as it gets, from the bottom upwards: a loose packing.
    Settled,
}

/// How bodies are packed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Packing {
    /// Where places are sought.
    pub arrangement: Arrangement,
    /// How many bodies; `None`: as many as fit.
    pub number: Option<usize>,
    /// The first body of the sequence that is to be placed, counted from 0.
    pub first: u64,
    /// Random poses that are tried for a body, of which the first that fits is taken; settled ones do not ask. The
    /// share that is filled nears that of saturation by a small power of the trials.
    pub trials: usize,
    /// The same seed gives the same packing, whatever the number of threads.
    pub seed: u64,
    /// Threads that work on it, the calling one among them; 0 and 1 mean the calling thread alone. Of use where the
    /// container is many bodies wide.
    pub threads: usize,
}

impl Default for Packing {
    /// As many bodies as fit, settled; 5,000 trials where they are scattered.
    fn default() -> Self {
        Self { arrangement: Arrangement::Settled, number: None, first: 0, trials: Limits::TRIALS, seed: 0, threads: 1 }
    }
}

/// A body of a packing: a shape, scaled, at a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Index into the shapes.
    pub shape: usize,
    /// Factor by which d, r and R of the shape are multiplied ([`Particle::scaled`]).
    pub scale: f64,
    /// Where it is.
    pub pose: Pose,
}

/// Fills a container with bodies of random orientation that overlap neither each other nor what is there, as
/// [`crate::detect`] and its like decide.
///
/// `progress` is called after each round with all bodies so far, in the order in which they found their places. When it
/// returns false, the packing ends with these. It also ends when 64 bodies one after the other have found no place (in
/// sequence one): fewer than `number` are given back then.
///
/// ```
/// use potential_particles::Particle;
/// use potential_particles::packing::{Container, Packing, Sizes, Supply, pack};
/// let container = Container::cylinder([0.0, 0.0, 0.0], 2.0, 6.0)?;
/// let shapes = [Particle::sphere(0.5)?];
/// // Diameters, and the share of bodies that have them.
/// let sizes = Sizes::by_number(&[[0.8, 0.5], [1.0, 0.5]])?;
/// let supply = Supply::new(&shapes, &sizes, 0.0)?;
/// let how = Packing { number: Some(20), seed: 1, threads: 2, ..Packing::default() };
/// let bodies = pack(&container, &supply, &[], &how, |placed| placed.len() < 1000)?;
/// assert_eq!(bodies.len(), 20);
/// assert!(bodies.iter().all(|body| (body.scale - 0.8).abs() < 1e-3 || (body.scale - 1.0).abs() < 1e-3));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// More than ten million bodies, no trials, or a container without obstacles into which no body fits.
pub fn pack(
    container: &Container,
    supply: &Supply,
    obstacles: &[Obstacle],
    how: &Packing,
    mut progress: impl FnMut(&[Placement]) -> bool,
) -> Result<Vec<Placement>, PackError> {
    if how.trials == 0 {
        return Err(PackError::Trials(how.trials));
    }
    let width = supply.typical_width();
    let at_once = (container.area() / (ROOM * width * width)).clamp(1.0, Limits::AT_ONCE) as usize;
    let pile = Pile::new(container, obstacles, width);
    let in_sequence = how.arrangement == Arrangement::InSequence;
    let mut rounds = Rounds { pile, placements: Vec::new(), failures: 0, in_sequence };
    let mut queue = queue(supply, container, how)?;
    let (mut looking, mut stopped) = (Vec::new(), false);
    while !stopped && rounds.failures < Limits::FAILURES {
        let missing = at_once.saturating_sub(looking.len());
        looking.extend(queue.by_ref().take(missing).map(Seeker::new));
        if looking.is_empty() {
            break;
        }
        // Each body is work enough for a chunk of its own.
        in_parallel(how.threads, CHUNK * looking.len(), looking.iter_mut(), |seeker| {
            seeker.look(supply, &rounds.pile, how);
        });
        looking = rounds.take_places(looking, supply);
        stopped = !progress(&rounds.placements);
    }
    if rounds.placements.is_empty() && !stopped && how.number != Some(0) && obstacles.is_empty() {
        let (widths, diameter) = (container.widths().into(), supply.least_diameter());
        return Err(PackError::NothingFits { widths, diameter });
    }
    Ok(rounds.placements)
}

/// Of bodies with their poses, which ones overlap no obstacle.
pub fn are_free(bodies: &[(Particle, Pose)], obstacles: &[Obstacle]) -> Vec<bool> {
    let boxes: Vec<_> = bodies.iter().map(|(particle, pose)| particle.bounding_box(pose)).collect();
    let Some((lower, upper)) = boxes.iter().copied().reduce(|a, b| (a.0.inf(&b.0), a.1.sup(&b.1))) else {
        return Vec::new();
    };
    let Ok(around) = Container::cuboid(lower.into(), upper.into()) else { return vec![false; bodies.len()] };
    let width = bodies.iter().map(|(particle, _)| 2.0 * particle.bounding_radius()).sum::<f64>() / bodies.len() as f64;
    let pile = Pile::new(&around, obstacles, width);
    bodies.iter().map(|(particle, pose)| Trial::new(&pile, particle).is_free(pose)).collect()
}

/// The bodies in the order in which they are to look for a place.
fn queue<'a>(
    supply: &'a Supply,
    container: &Container,
    how: &Packing,
) -> Result<Box<dyn Iterator<Item = Wanted> + 'a>, PackError> {
    // More bodies than the smallest would fill the container with need no place, nor memory.
    let most = container.volume() / (std::f64::consts::FRAC_PI_6 * supply.least_diameter().powi(3));
    let number = how.number.map_or(f64::INFINITY, |number| number as f64).min(most.ceil());
    if !(number <= Limits::BODIES as f64) {
        return Err(PackError::TooMany { number, most: Limits::BODIES });
    }
    let bodies = supply.bodies(how.seed, how.first).take(number as usize);
    Ok(match how.arrangement {
        Arrangement::Settled | Arrangement::InSequence => Box::new(bodies),
        // Those that do not fit are no reason to leave out as many, where all are wanted that do.
        Arrangement::Scattered if how.number.is_none() => Box::new(supply.bodies(how.seed, how.first)),
        Arrangement::Scattered => {
            let mut all: Vec<_> = bodies.collect();
            all.sort_by(|a, b| supply.width(b).total_cmp(&supply.width(a)));
            Box::new(all.into_iter())
        }
    })
}

/// A body that looks for its place, as it is packed.
struct Seeker {
    wanted: Wanted,
    body: Option<Particle>,
    found: Option<Pose>,
}

impl Seeker {
    fn new(wanted: Wanted) -> Self {
        Self { wanted, body: None, found: None }
    }

    fn look(&mut self, supply: &Supply, pile: &Pile, how: &Packing) {
        // Between the extremes, which were tried, every size is a particle.
        self.body = self.body.take().or_else(|| supply.enlarged(&self.wanted).ok());
        let Some(body) = &self.body else { return };
        let mut random = Random::new(how.seed, self.wanted.number + 1);
        let inner = supply.inner(&self.wanted);
        self.found = match how.arrangement {
            Arrangement::Scattered | Arrangement::InSequence => {
                scattered::find(pile, body, inner, how.trials, &mut random)
            }
            Arrangement::Settled => settled::find(pile, body, inner, &mut random),
        };
    }
}

/// What the rounds have made so far.
struct Rounds {
    pile: Pile,
    placements: Vec<Placement>,
    /// Bodies without a place since the last one that found one.
    failures: usize,
    in_sequence: bool,
}

impl Rounds {
    /// Gives each body its place, in order; those whose places are taken by then are given back, in sequence with all
    /// that come after them.
    fn take_places(&mut self, seekers: Vec<Seeker>, supply: &Supply) -> Vec<Seeker> {
        let mut again = Vec::new();
        let before = self.placements.len();
        for seeker in seekers {
            if self.in_sequence && !again.is_empty() {
                again.push(seeker);
                continue;
            }
            let Seeker { wanted, body, found } = &seeker;
            let (Some(body), &Some(pose)) = (body, found) else {
                self.failures += 1;
                if self.in_sequence {
                    self.failures = Limits::FAILURES;
                    break;
                }
                continue;
            };
            self.failures = 0;
            if self.placements.len() > before && !Trial::new(&self.pile, body).fits(&pose) {
                again.push(seeker);
                continue;
            }
            self.placements.push(Placement { shape: wanted.shape, scale: wanted.scale, pose });
            self.pile.add(body.clone(), pose, supply.inner(wanted));
        }
        again
    }
}
