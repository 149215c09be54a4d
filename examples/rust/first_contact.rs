// SPDX-License-Identifier: MIT OR Apache-2.0
//! The contact of two rounded cubes, one on the other.
//!
//!     cargo run --release --example first_contact

use potential_particles::{Kind, PairState, Particle, Plane, Pose, Settings, detect};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let faces =
        [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let cube = Particle::new(&faces.map(|[a, b, c]| Plane::from([a, b, c, 0.9])), 0.1, 0.0, 1.0)?; // r, k, R
    let (lower, upper) = (Pose::at([0.0, 0.0, 0.0])?, Pose::new([0.3, 0.0, 1.95], [1.0, 0.0, 0.0, 0.2])?);
    let mut state = PairState::default(); // one for each pair
    let contact = detect(&cube, &lower, &cube, &upper, &Settings::default(), Some(&mut state))?;
    if contact.kind == Kind::Overlapping {
        println!("overlap {}, normal {}", contact.overlap, contact.normal);
    }
    Ok(())
}
