//! A place anywhere in the container: random sequential addition.

use crate::packing::pile::{Pile, Trial};
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::random::Random;
use nalgebra::{UnitQuaternion, Vector3};

/// The first of so many random poses at which the body fits. inner: radius of the ball about its centre within it.
pub(crate) fn find(pile: &Pile, particle: &Particle, inner: f64, trials: usize, random: &mut Random) -> Option<Pose> {
    let mut trial = Trial::new(pile, particle);
    (0..trials).find_map(|_| {
        // Both are drawn in any case: what is taken beforehand does not change the poses that follow.
        let (position, orientation) = (pile.container.point(random)?, random.orientation());
        if pile.is_taken(&position, inner) {
            return None;
        }
        let pose = placed(position, &orientation)?;
        trial.fits(&pose).then_some(pose)
    })
}

/// A pose of nalgebra's numbers.
pub(crate) fn placed(position: Vector3<f64>, q: &UnitQuaternion<f64>) -> Option<Pose> {
    Pose::new(position.into(), [q.w, q.i, q.j, q.k]).ok()
}
