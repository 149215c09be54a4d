//! A place as low as it gets: a body falls from above the pile, and then walks downwards at random.
//!
//! The walk minimises the height of the centre subject to "fits": a move is a step of random direction, never upwards,
//! half of them with a turn. A move that fits is made. Steps grow with success and shrink with failure, such that one
//! move in five is made (Rechenberg's rule), and the walk ends when they have become short. Whether two bodies pass
//! through each other on the way does not matter, but for where they come to rest; meshes and walls are not passed.

use super::numbers::{FALLS, FIRST_STEP, GROWTH, LAST_STEP, Limits, SHRINKAGE};
use crate::packing::pile::{Pile, Trial};
use crate::packing::scattered::placed;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::random::Random;
use nalgebra::{UnitQuaternion, Vector3};

/// The lowest place that a few falls have found.
pub(crate) fn find(pile: &Pile, particle: &Particle, inner: f64, random: &mut Random) -> Option<Pose> {
    let mut trial = Trial::new(pile, particle);
    let longest = pile.longest_step(inner);
    let falls = (0..FALLS).filter_map(|_| {
        let start = start(pile, &mut trial, random)?;
        let landed = fall(&mut trial, start, longest);
        Some(walk(&mut trial, landed, longest, random))
    });
    falls.min_by(|a, b| a.height().total_cmp(&b.height())).and_then(|found| found.pose())
}

/// A pose, as it is moved and turned.
#[derive(Clone, Copy)]
struct Place {
    position: Vector3<f64>,
    turn: UnitQuaternion<f64>,
}

impl Place {
    fn pose(&self) -> Option<Pose> {
        placed(self.position, &self.turn)
    }

    fn height(&self) -> f64 {
        self.position.z
    }

    fn moved(&self, step: Vector3<f64>) -> Self {
        Self { position: self.position + step, ..*self }
    }

    fn fits(&self, trial: &mut Trial) -> bool {
        self.pose().is_some_and(|pose| trial.fits(&pose))
    }
}

/// A random place clear of the pile, or as high as the container allows.
fn start(pile: &Pile, trial: &mut Trial, random: &mut Random) -> Option<Place> {
    let radius = trial.particle.bounding_radius();
    (0..Limits::STARTS).find_map(|_| {
        let mut place = Place { position: pile.container.point(random)?, turn: random.orientation() };
        let (_, upper) = trial.particle.bounding_box(&place.pose()?);
        let highest = pile.container.upper().z - (upper.z - place.position.z);
        // Of the two roundings one would let the body reach out of the container.
        place.position.z = (pile.top() + 2.0 * radius).min(highest - f64::EPSILON * highest.abs());
        place.fits(trial).then_some(place)
    })
}

/// Straight down in steps that double while they fit and else are quartered.
fn fall(trial: &mut Trial, from: Place, longest: f64) -> Place {
    let radius = trial.particle.bounding_radius();
    let (mut place, mut step) = (from, radius.min(longest));
    while step > (FIRST_STEP * radius).min(longest) / 4.0 {
        let below = place.moved(-step * Vector3::z());
        if below.fits(trial) {
            (place, step) = (below, (2.0 * step).min(longest));
        } else {
            step /= 4.0;
        }
    }
    place
}

fn walk(trial: &mut Trial, from: Place, longest: f64, random: &mut Random) -> Place {
    let radius = trial.particle.bounding_radius();
    let (mut place, mut step) = (from, FIRST_STEP);
    for _ in 0..Limits::MOVES {
        let mut direction = random.direction();
        direction.z = -direction.z.abs();
        let mut next = place.moved((step * radius).min(longest) * direction);
        if random.uniform() < 0.5 {
            next.turn = UnitQuaternion::new(step * random.direction()) * next.turn;
        }
        if next.fits(trial) {
            place = next;
            step *= GROWTH;
        } else {
            step *= SHRINKAGE;
        }
        if step < LAST_STEP {
            break;
        }
    }
    place
}
