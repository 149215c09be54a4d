//! What tests, benchmarks, tools and fuzz targets share: bodies, references and judges. Of no use to users.

pub mod fuzz;
pub mod machine;
pub mod masonry;
pub mod pair_line;
pub mod patch;
pub mod random;
pub mod scene;
pub mod stress;
pub mod target;
pub mod truth;
pub mod wide;
