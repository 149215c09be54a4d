//! Random pairs, walks, walls and their judges, which know no answer beforehand.

pub mod boundaries;
pub mod cases;
pub mod clock;
pub mod exact;
pub mod hulls;
pub mod judge;
pub mod least;
pub mod ledger;
pub mod mass;
pub mod memories;
pub mod pairs;
pub mod patches;
pub mod placed_boundary;
pub mod reference;
pub mod seams;
pub mod shapes;
pub mod sweeps;
pub mod tally;
pub mod walks;
pub mod walls;
