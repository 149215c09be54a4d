//! What the Rust contestants share: the file of pairs, and the server that times one pass over a group on request.

pub mod scene;
pub mod server;
