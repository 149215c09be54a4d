//! Particles of the plane: the paper's 2-D case (eqs 1 and 5–31), solved by the code for space.
//!
//! A particle of lines a·x + b·y ≤ d is the particle of planes (a, b, 0, d), cut at z = 0. In space
//!
//! ```text
//! S(x, y, z) = S(x, y) + k/R² · z²
//! ```
//!
//! and poses of the plane, a shift and a turn about z, keep that form. Moving a point to z = 0 raises neither
//! S_A nor S_B, so that midway and closest (both are convex problems in S_A and S_B) have an optimum there,
//! and at z = 0 they are the problems of the plane, with the same s, weights and bounds. For k > 0 the
//! optimum is there only. For k = 0 nothing depends on z: in the fast solver the regularisation of flat
//! faces ([`crate::Settings::flat_regularisation`]) holds z at 0, and the cone programs leave z out (eqs 19–31).
//! z begins at 0 and every term that could move it has an exact zero as a factor, so that it stays 0.
//!
//! The one thing not taken over is what bounds a particle: lines that enclose an area are enough, and ball
//! and corners are those of the cut.

mod area_properties;
mod batch;
mod closest_point;
mod contact;
mod particle;
mod polygon;
mod pose;
mod section;

pub use crate::patch::planar::{Patch, PatchPoint, patch_of_contact};
pub use area_properties::AreaProperties;
pub use batch::detect_batch;
pub use closest_point::{ClosestPoint, closest_point};
pub use contact::{Contact, detect};
pub use particle::{Line, Particle};
pub use pose::{Pose, PoseError};
pub use section::Section;

use nalgebra::{Vector2, Vector3};

/// A vector of the plane z = 0 in space.
fn raised(v: &Vector2<f64>) -> Vector3<f64> {
    Vector3::new(v.x, v.y, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BackEnd, Formulation, Kind, PairState, Role, Settings};

    /// The doc of this module says that z stays 0: seen here in the contact of space.
    #[test]
    fn nothing_leaves_the_plane() {
        let square = |k: f64| {
            let lines = [[1.0, 0.0, 0.5], [0.0, 1.0, 0.5], [-1.0, 0.0, 0.5], [0.0, -1.0, 0.5]].map(Line::from);
            Particle::new(&lines, 0.05, k, 0.8).unwrap()
        };
        let triangle =
            Particle::new(&[[0.8, 0.6, 0.3], [-0.8, 0.6, 0.3], [0.0, -1.0, 0.3]].map(Line::from), 1e-6, 0.0, 0.0);
        let particles = [square(0.0), square(0.3), square(1.0), triangle.unwrap()];
        let mut overlapping = 0;
        for (a, b) in particles.iter().flat_map(|a| particles.iter().map(move |b| (a, b))) {
            for i in 0..40 {
                let angle = f64::from(i);
                let distance = 1.2 - f64::from(i % 8) / 8.0;
                let pose_a = Pose::new([1.0, -2.0], 0.7 * angle).unwrap().in_space();
                let pose_b =
                    Pose::new([1.0 + distance * angle.cos(), -2.0 + distance * angle.sin()], angle).unwrap().in_space();
                for (formulation, back_end) in [
                    (Formulation::Midway, BackEnd::Fast),
                    (Formulation::Closest, BackEnd::Fast),
                    (Formulation::Midway, BackEnd::ConeProgram),
                    (Formulation::Closest, BackEnd::ConeProgram),
                ] {
                    let settings = Settings { formulation, back_end, ..Settings::default() }.with_solve_separated(true);
                    let mut state = PairState::default();
                    let contact =
                        crate::contact::detect::detect(&a.0, &pose_a, &b.0, &pose_b, &settings, Some(&mut state))
                            .unwrap();
                    let mut vectors = vec![contact.normal, contact.point, contact.branch_a, contact.branch_b];
                    if contact.kind == Kind::Overlapping {
                        overlapping += 1;
                        vectors.extend([contact.point_on_a, contact.point_on_b]);
                    }
                    assert!(vectors.iter().all(|v| v.z == 0.0), "{contact:?}");
                    // Number 3 of a solution is z.
                    assert_eq!(state.into_raw()[3], 0.0);
                    for on in [Role::A, Role::B] {
                        let found = crate::closest_point(&a.0, &pose_a, &b.0, &pose_b, on, &settings).unwrap();
                        let vectors = found.map(|found| [found.point, found.branch_a, found.branch_b]);
                        assert!(vectors.iter().flatten().all(|v| v.z == 0.0), "{vectors:?}");
                    }
                }
            }
        }
        assert!(overlapping > 500, "{overlapping}");
    }
}
