//! The bodies that have their place, and whether one more fits at a pose.

use super::numbers::NEIGHBOURS_HOLD;
use crate::contact::contact::Kind;
use crate::contact::detect::detect;
use crate::packing::container::Container;
use crate::packing::grid::Grid;
use crate::pair::pair_state::PairState;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::settings::Settings;
use nalgebra::Vector3;

/// Bodies that do not overlap, in a container.
pub(crate) struct Pile {
    pub container: Container,
    bodies: Vec<(Particle, Pose)>,
    grid: Grid,
    /// Height below which all of them lie.
    top: f64,
}

impl Pile {
    /// Empty, for bodies of which most are about so wide.
    pub fn new(container: Container, width: f64) -> Self {
        let grid = Grid::new(container.lower(), container.upper(), width);
        Self { container, bodies: Vec::new(), grid, top: container.lower().z }
    }

    /// Gives a body its place, where it is known to fit.
    pub fn add(&mut self, particle: Particle, pose: Pose) {
        let (lower, upper) = particle.bounding_box(&pose);
        self.top = self.top.max(upper.z);
        // Fewer bodies than 2³² fit into memory.
        self.grid.insert(self.bodies.len() as u32, &lower, &upper);
        self.bodies.push((particle, pose));
    }

    /// Height below which all bodies lie.
    pub fn top(&self) -> f64 {
        self.top
    }
}

/// One body that is tried at many poses. It keeps the bodies near by, and the state of each pair, from pose to pose.
pub(crate) struct Trial<'a> {
    pile: &'a Pile,
    pub particle: &'a Particle,
    settings: Settings,
    /// Bodies that may be met while the centre is within `reach` of `from`; the one that was in the way last stands
    /// first.
    near: Vec<(u32, PairState)>,
    from: Vector3<f64>,
    reach: f64,
    numbers: Vec<u32>,
}

impl<'a> Trial<'a> {
    pub fn new(pile: &'a Pile, particle: &'a Particle) -> Self {
        let from = Vector3::from_element(f64::NAN);
        let reach = NEIGHBOURS_HOLD * particle.bounding_radius();
        Self { pile, particle, settings: Settings::default(), near: Vec::new(), from, reach, numbers: Vec::new() }
    }

    /// Whether the container holds the body at this pose, and every other body is proved or solved to be separated from
    /// it.
    pub fn fits(&mut self, pose: &Pose) -> bool {
        if !self.pile.container.holds(self.particle, pose) {
            return false;
        }
        // Written so that NaN, before the first pose, looks up.
        if !((pose.position() - self.from).norm() <= self.reach) {
            self.look_up(pose.position());
        }
        let (particle, settings, bodies) = (self.particle, &self.settings, &self.pile.bodies);
        let in_the_way = self.near.iter_mut().position(|(number, state)| {
            let (other, place) = &bodies[*number as usize];
            let contact = detect(particle, pose, other, place, settings, Some(state));
            // A pair that cannot be solved may overlap.
            !matches!(contact, Ok(contact) if contact.kind == Kind::Separated)
        });
        if let Some(i) = in_the_way {
            self.near.swap(0, i);
        }
        in_the_way.is_none()
    }

    fn look_up(&mut self, centre: &Vector3<f64>) {
        self.from = *centre;
        let within = self.particle.bounding_radius() + self.reach;
        let around = Vector3::from_element(within);
        self.pile.grid.near(&(centre - around), &(centre + around), &mut self.numbers);
        let bodies = &self.pile.bodies;
        let close = self.numbers.iter().filter(|&&number| {
            let (other, pose) = &bodies[number as usize];
            (pose.position() - centre).norm() <= within + other.bounding_radius()
        });
        self.near.clear();
        self.near.extend(close.map(|&number| (number, PairState::default())));
    }
}
