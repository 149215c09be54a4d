//! What is done with arbitrary bytes; shared by the fuzzer and by the replay among the tests.

pub mod bytes;
pub mod detect;
pub mod mass;
pub mod memories;
pub mod pairs_file;
pub mod particle;
pub mod walls;
mod whole;
