//! Why a scene has no answer.

use thiserror::Error;

/// Why a scene has no answer. A scene that falls is an answer, not an error.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum EquilibriumError {
    /// A number is not finite or outside its range.
    #[error("{name} of {of} {index} is {value}: it must be {range}")]
    OutOfRange {
        /// Which number.
        name: &'static str,
        /// "body" or "contact".
        of: &'static str,
        /// Which of them.
        index: usize,
        /// What was given.
        value: f64,
        /// What it has to be.
        range: &'static str,
    },
    /// A contact names a body that does not exist, or one body twice.
    #[error("contact {contact} joins bodies {first} and {second}: they must be two of the {count} bodies")]
    Bodies {
        /// Which contact.
        contact: usize,
        /// Its first body.
        first: usize,
        /// Its second body.
        second: usize,
        /// Number of bodies.
        count: usize,
    },
    /// A contact has no corner.
    #[error("contact {0} has no corner: give a polygon, the two ends of a line, or a point")]
    NoCorner(usize),
    /// Every body is held.
    #[error("no body is free: there is nothing to solve")]
    NoFreeBody,
    /// No body is held.
    #[error("no body is held: hold those that carry the others, such as the floor")]
    NoSupport,
    /// A free body that touches nothing.
    #[error("body {0} is free and has no contact: hold it, take it out, or look for a gap beside it")]
    NoContact(usize),
    /// No free body is loaded.
    #[error("no free body is loaded: give weights, or another load")]
    NoLoad,
    /// No live load is given.
    #[error("no free body has a live load, so that no load factor exists: give live loads")]
    NoLiveLoad,
    /// No load factor, however large, makes it fall.
    #[error("the load factor is infinite: the live loads can be carried whatever their size")]
    Unlimited,
    /// Any strength will do.
    #[error("the strength factor is infinite: it stands however small friction and cohesion are")]
    StandsWithoutStrength,
    /// The solver reached neither a state nor a mechanism. The scene may stand or fall.
    #[error(
        "the cone program did not converge ({status}): whether it stands is unknown; it may be at its limit, so that \
         strength_factor or load_factor have an answer, or hold contacts of very different sizes"
    )]
    NotConverged {
        /// The status of the solver.
        status: String,
    },
    /// The sequence of programs does not settle.
    #[error(
        "the factor did not settle in {programs} programs: it lay between {least} and {most} in the last ten; the \
         associated bound exists all the same"
    )]
    NotSettled {
        /// Number of programs.
        programs: u32,
        /// Least factor of the last ten programs.
        least: f64,
        /// Largest factor of the last ten programs.
        most: f64,
    },
}
