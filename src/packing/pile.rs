//! What has its place, and whether one more body fits at a pose.

use super::numbers::NEIGHBOURS_HOLD;
use crate::packing::container::Container;
use crate::packing::grid::Grid;
use crate::packing::obstacle::Obstacle;
use crate::pair::pair_state::PairState;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::settings::Settings;
use nalgebra::Vector3;

/// Bodies that do not overlap, in a container, among obstacles.
pub(crate) struct Pile {
    pub container: Container,
    placed: Vec<Placed>,
    grid: Grid,
    /// Of `placed`, those without a box.
    unbounded: Vec<u32>,
    /// Height below which all of it lies.
    top: f64,
    /// Whether there is something so thin that a step might lead through it.
    thin: bool,
}

struct Placed {
    what: Obstacle,
    /// Of the ball about its centre within it.
    inner: f64,
}

impl Pile {
    /// Of obstacles alone, for bodies of which most are about so wide.
    pub fn new(container: &Container, obstacles: &[Obstacle], width: f64) -> Self {
        let (container, lowest) = (container.clone(), container.lower().z);
        let grid = Grid::new(container.lower(), container.upper(), width);
        let mut pile = Self { container, placed: Vec::new(), grid, unbounded: Vec::new(), top: lowest, thin: false };
        for obstacle in obstacles {
            pile.add_obstacle(obstacle);
        }
        let top = pile.top;
        for side in pile.container.sides() {
            pile.add_obstacle(&Obstacle::Triangle(side));
        }
        pile.top = top;
        pile
    }

    fn add_obstacle(&mut self, obstacle: &Obstacle) {
        let (low, high) = (self.container.lower(), self.container.upper());
        let place = match obstacle.bounding_box() {
            Some((lower, upper)) => {
                if (0..3).any(|axis| upper[axis] < low[axis] || lower[axis] > high[axis]) {
                    return;
                }
                Some((lower, upper))
            }
            None => None,
        };
        self.thin |= !matches!(obstacle, Obstacle::Body(..));
        let highest = match obstacle {
            Obstacle::Plane(wall) | Obstacle::HalfSpace(wall) if wall.is_horizontal() => {
                low.z - wall.height(&low) * wall.height(&(low + Vector3::z())).signum()
            }
            _ => place.map_or(high.z, |(_, upper)| upper.z),
        };
        self.top = self.top.max(highest.min(high.z));
        self.enter(obstacle.clone(), obstacle.inner_radius(), place);
    }

    /// Gives a body its place, where it is known to fit. inner: radius of the ball about its centre within it.
    pub fn add(&mut self, particle: Particle, pose: Pose, inner: f64) {
        let (lower, upper) = particle.bounding_box(&pose);
        self.top = self.top.max(upper.z);
        self.enter(Obstacle::Body(particle, pose), inner, Some((lower, upper)));
    }

    fn enter(&mut self, what: Obstacle, inner: f64, place: Option<(Vector3<f64>, Vector3<f64>)>) {
        // Fewer than 2³² fit into memory.
        let number = self.placed.len() as u32;
        match place {
            Some((lower, upper)) => self.grid.insert(number, &lower, &upper),
            None => self.unbounded.push(number),
        }
        self.placed.push(Placed { what, inner });
    }

    /// Height below which all bodies lie.
    pub fn top(&self) -> f64 {
        self.top
    }

    /// Whether a body with a ball of this radius about its centre, which is here, overlaps another however it is
    /// turned. Not all such places are found: it is a test to come before others.
    pub fn is_taken(&self, centre: &Vector3<f64>, inner: f64) -> bool {
        self.grid.at(centre).iter().any(|&number| {
            let Placed { what, inner: other } = &self.placed[number as usize];
            matches!(what, Obstacle::Body(_, pose)
                if (pose.position() - centre).norm_squared() < (inner + other) * (inner + other))
        })
    }

    /// The longest step of a body whose inner ball has this radius: where balls at both ends of it meet, and lie free
    /// of a closed surface, they lie on one side of it.
    pub fn longest_step(&self, inner: f64) -> f64 {
        if self.thin { 1.999 * inner } else { f64::INFINITY }
    }
}

/// One body that is tried at many poses. It keeps what is near by, and the state of each pair, from pose to pose.
pub(crate) struct Trial<'a> {
    pile: &'a Pile,
    pub particle: &'a Particle,
    settings: Settings,
    /// What may be met while the centre is within `reach` of `from`; what was in the way last stands first.
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

    /// Whether the container holds the body at this pose, and it is free there.
    pub fn fits(&mut self, pose: &Pose) -> bool {
        self.pile.container.holds(self.particle, pose) && self.is_free(pose)
    }

    /// Whether all that is near is proved or solved to be separated from the body at this pose.
    pub fn is_free(&mut self, pose: &Pose) -> bool {
        // Written so that NaN, before the first pose, looks up.
        if !((pose.position() - self.from).norm() <= self.reach) {
            self.look_up(pose.position());
        }
        let (particle, settings, placed) = (self.particle, &self.settings, &self.pile.placed);
        let in_the_way = self
            .near
            .iter_mut()
            .position(|(number, state)| placed[*number as usize].what.overlaps(particle, pose, settings, state));
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
        self.numbers.extend_from_slice(&self.pile.unbounded);
        let placed = &self.pile.placed;
        let distance = |number: u32| placed[number as usize].what.distance_at_most(centre);
        self.near.clear();
        let close = self.numbers.iter().filter(|&&number| distance(number) <= within);
        self.near.extend(close.map(|&number| (number, PairState::default())));
    }
}
