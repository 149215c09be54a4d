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
    /// The cone program of the associated answer did not converge. The scene may stand or fall.
    #[error(
        "the cone program did not converge ({status}): whether any forces can hold the scene is unknown; it may be at \
         its limit, or hold contacts of very different sizes"
    )]
    NotConverged {
        /// The status of the solver.
        status: String,
    },
    /// Bodies neither came to rest nor went along a mechanism.
    #[error(
        "bodies neither came to rest nor fell in {solves} steps: {left:.1e} of the forces on a body are left; the scene \
         is near its limit, or holds contacts or stiffnesses of very different sizes"
    )]
    Undecided {
        /// Number of factorisations.
        solves: u32,
        /// The largest force left on a body, over the sum of the sizes of all on it.
        left: f64,
    },
    /// The path to the limit was lost.
    #[error(
        "the path to the limit was lost: the scene stands with the factor {stands}, and with more than {bound} it \
         falls; contacts or stiffnesses may be of very different sizes"
    )]
    NotFound {
        /// The factor of the last state of rest.
        stands: f64,
        /// The associated factor, which no state of equilibrium exceeds; NaN if that is unknown, too.
        bound: f64,
    },
}
