//! The whole of packing: bodies look for their places in rounds, and each takes its place if nobody took it before.
//!
//! In a round a few bodies look at once, each on its own, in the pile at the start of the round; then they take their
//! places in order. A body whose place is taken looks again in the next round. How many look at once does not depend on
//! the number of threads, nor does the packing.

use super::numbers::{Limits, ROOM};
use crate::contact::batch::{CHUNK, in_parallel};
use crate::packing::container::Container;
use crate::packing::error::PackError;
use crate::packing::pile::{Pile, Trial};
use crate::packing::sizes::Sizes;
use crate::packing::supply::{Supply, Wanted};
use crate::packing::{scattered, settled};
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::random::Random;

/// Where places are sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrangement {
    /// Anywhere in the container, the largest bodies first: random sequential addition. Of equal bodies it
    /// fills some three tenths of the volume.
    Scattered,
    /// Each body as low as it gets, from the bottom upwards: a loose packing.
    Settled,
}

/// How bodies are packed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Packing {
    /// Where places are sought.
    pub arrangement: Arrangement,
    /// How many bodies; `None`: as many as fit (settled only).
    pub number: Option<usize>,
    /// Least distance between two bodies, length; that of a body to the container is half of it. Bodies are a millionth
    /// of their size apart in any case.
    pub margin: f64,
    /// The same seed gives the same packing, whatever the number of threads.
    pub seed: u64,
    /// Threads that work on it, the calling one among them; 0 and 1 mean the calling thread alone. Of use where the
    /// container is many bodies wide.
    pub threads: usize,
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

/// Fills a container with bodies of random orientation that do not overlap, as [`crate::detect`] decides.
///
/// `progress` is called after each round with all bodies so far, in the order in which they found their places. When it
/// returns false, the packing ends with these. It also ends when 64 bodies one after the other have found no place:
/// fewer than `number` are given back then.
///
/// ```
/// use potential_particles::Particle;
/// use potential_particles::packing::{Arrangement, Container, Packing, Sizes, pack};
/// let container = Container::cylinder([0.0, 0.0, 0.0], 2.0, 6.0)?;
/// let shapes = [Particle::sphere(0.5)?];
/// // Diameters, and the share of bodies that have them.
/// let sizes = Sizes::by_number(&[[0.8, 0.5], [1.0, 0.5]])?;
/// let how = Packing { arrangement: Arrangement::Settled, number: Some(20), margin: 0.0, seed: 1, threads: 2 };
/// let bodies = pack(&container, &shapes, &sizes, &how, |placed| placed.len() < 1000)?;
/// assert_eq!(bodies.len(), 20);
/// assert!(bodies.iter().all(|body| (body.scale - 0.8).abs() < 1e-3 || (body.scale - 1.0).abs() < 1e-3));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// No shapes, more than ten million bodies, a margin that is no distance, a scattered packing without a number, shapes
/// that are no particles once they are scaled, or a container into which no body fits.
pub fn pack(
    container: &Container,
    shapes: &[Particle],
    sizes: &Sizes,
    how: &Packing,
    mut progress: impl FnMut(&[Placement]) -> bool,
) -> Result<Vec<Placement>, PackError> {
    if how.arrangement == Arrangement::Scattered && how.number.is_none() {
        return Err(PackError::NoNumber);
    }
    let supply = Supply::new(shapes, sizes, how.margin)?;
    let width = supply.typical_width();
    let at_once = (container.area() / (ROOM * width * width)).clamp(1.0, Limits::AT_ONCE) as usize;
    let mut rounds = Rounds { pile: Pile::new(*container, width), placements: Vec::new(), failures: 0 };
    let mut queue = queue(&supply, container, how)?;
    let (mut looking, mut stopped) = (Vec::new(), false);
    while !stopped && rounds.failures < Limits::FAILURES {
        let missing = at_once.saturating_sub(looking.len());
        looking.extend(queue.by_ref().take(missing).map(Seeker::new));
        if looking.is_empty() {
            break;
        }
        // Each body is work enough for a chunk of its own.
        in_parallel(how.threads, CHUNK * looking.len(), looking.iter_mut(), |seeker| {
            seeker.look(&supply, &rounds.pile, how);
        });
        looking = rounds.take_places(looking);
        stopped = !progress(&rounds.placements);
    }
    if rounds.placements.is_empty() && !stopped && how.number != Some(0) {
        let (widths, diameter) = (container.widths().into(), supply.least_diameter());
        return Err(PackError::NothingFits { widths, diameter });
    }
    Ok(rounds.placements)
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
    let bodies = supply.bodies(how.seed).take(number as usize);
    Ok(match how.arrangement {
        Arrangement::Settled => Box::new(bodies),
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
        self.found = match how.arrangement {
            Arrangement::Scattered => scattered::find(pile, body, &mut random),
            Arrangement::Settled => settled::find(pile, body, &mut random),
        };
    }
}

/// What the rounds have made so far.
struct Rounds {
    pile: Pile,
    placements: Vec<Placement>,
    /// Bodies without a place since the last one that found one.
    failures: usize,
}

impl Rounds {
    /// Gives each body its place, in order; those whose places are taken by then are given back.
    fn take_places(&mut self, seekers: Vec<Seeker>) -> Vec<Seeker> {
        let mut again = Vec::new();
        let before = self.placements.len();
        for seeker in seekers {
            let Seeker { wanted: Wanted { shape, scale, .. }, body, found } = &seeker;
            let (Some(body), &Some(pose)) = (body, found) else {
                self.failures += 1;
                continue;
            };
            self.failures = 0;
            if self.placements.len() > before && !Trial::new(&self.pile, body).fits(&pose) {
                again.push(seeker);
                continue;
            }
            self.placements.push(Placement { shape: *shape, scale: *scale, pose });
            self.pile.add(body.clone(), pose);
        }
        again
    }
}
