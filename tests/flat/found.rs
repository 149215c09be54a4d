//! Cases that other methods failed on.

use crate::solved;
use potential_particles::{
    Kind, Particle, Plane, Pose, Settings, Triangle, Wall, contact_with_plane, contact_with_triangle,
};

/// Its edges meet the particle where a search in doubles goes round in circles: a point of it has s = 0.6248.
#[test]
fn a_triangle_that_cuts_a_sharp_body() {
    let planes = [[2.2, 0.5, -1.3, 1.0], [0.0, 0.8, 1.1, 1.0], [-0.8, 2.4, -0.3, 1.0], [-0.4, -0.9, -0.6, 1.0]];
    let particle = Particle::new(&planes.map(Plane::from), 0.01, 0.0, 1.0).unwrap();
    let triangle = Triangle::new([
        [-2.173202568746072, 1.7938942631558152, -0.3898798551062579],
        [2.512086713901693, 0.19989725005296177, 0.7693906998776353],
        [-2.6093495532049915, 0.4099708592823988, 0.6166098931653176],
    ]);
    let pose = Pose::at([0.0; 3]).unwrap();
    for settings in [Settings::default(), solved(), Settings::default().with_gap_tolerance(1e-14)] {
        let contact = contact_with_triangle(&particle, &pose, &triangle.unwrap(), &settings, None).unwrap();
        assert!(contact.kind == Kind::Overlapping && contact.s <= 0.6249 && contact.gap < 1e-6, "{contact:?}");
    }
}

/// A face of a tetrahedron on a plane that is parallel to it but for rounding.
#[test]
fn a_plane_parallel_to_a_face_to_rounding() {
    let planes = [[0.0, 0.0, -1.0, 1.0], [1.0, 0.0, 1.0, 1.0], [-1.0, 1.0, 1.0, 1.0], [-1.0, -1.0, 1.0, 1.0]];
    let particle = Particle::new(&planes.map(Plane::from), 0.1, 0.0, 1.0).unwrap();
    let turn = [1.2905803307424093, -1.1039728053403408, 0.5308791005254664, 0.5222665868689584];
    let pose = Pose::new([0.0; 3], turn).unwrap();
    let wall = Wall::new(
        [-0.48496019871972545, 0.38563360547324593, 0.06974334096396821],
        [-1.3471743716064284, 1.0712543223651303, 0.1937405205444922],
    );
    let contact = contact_with_plane(&particle, &pose, &wall.unwrap(), &Settings::default(), None).unwrap();
    assert!(contact.gap < 1e-6, "{contact:?}");
}
