//! Where B must go for potential particles to overlap by what is asked: `placed PAIRS OVERLAP` prints, for each group a
//! line, a list in JSON of [x, y, z, u, v, w]: the translation of B, along the line of centres, and the normal there.
//!
//! Rounding by a potential and by a swept ball give the same faces but other corners, so that poses at which one kind
//! of bodies touches are deep or apart for the other.

use peers::scene::{self, Group, Pair};
use potential_particles::{Contact, Kind, Particle, Plane, Pose, Settings, detect};

fn main() {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().expect("the file of pairs");
    let overlap: f64 = arguments.next().and_then(|text| text.parse().ok()).expect("the overlap");
    for group in scene::read(&path) {
        let placed: Vec<[f64; 6]> = group.pairs.iter().map(|pair| place(&group, pair, overlap)).collect();
        println!("{placed:?}");
    }
}

fn place(group: &Group, pair: &Pair, overlap: f64) -> [f64; 6] {
    let planes: Vec<Plane> = group.planes.iter().map(|&plane| Plane::from(plane)).collect();
    let particle = Particle::new(&planes, group.r, group.k, group.shadow).expect("a particle");
    let (from, to) = (pair.a.position, pair.b[0].position);
    let pose_a = Pose::new(from, pair.a.orientation).expect("a pose");
    // At a factor of the distance of the centres.
    let position = |factor: f64| std::array::from_fn(|i| from[i] + factor * (to[i] - from[i]));
    let contact_at = |factor: f64| -> Contact {
        let pose_b = Pose::new(position(factor), pair.b[0].orientation).expect("a pose");
        detect(&particle, &pose_a, &particle, &pose_b, &Settings::default(), None).expect("a contact")
    };
    let (mut deep, mut apart) = (0.0, 3.0);
    for _ in 0..60 {
        let middle = 0.5 * (deep + apart);
        let contact = contact_at(middle);
        let too_deep = contact.kind == Kind::Overlapping && contact.overlap > overlap;
        if too_deep { deep = middle } else { apart = middle }
    }
    let [x, y, z] = std::array::from_fn(|i| position(deep)[i] - to[i]);
    let normal = contact_at(deep).normal;
    [x, y, z, normal.x, normal.y, normal.z]
}
