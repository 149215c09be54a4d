//! The file of pairs that benches/peers/pairs.py writes.

use std::str::SplitWhitespace;

/// Position, and quaternion (w, x, y, z).
#[derive(Clone, Copy)]
pub struct Placement {
    pub position: [f64; 3],
    pub orientation: [f64; 4],
}

/// Pairs of one body at some poses of a smooth motion.
pub struct Group {
    pub name: String,
    pub r: f64,
    pub k: f64,
    pub shadow: f64,
    /// Radius of the ball that sweeps the hull of the corners, for those who round so.
    pub swept: f64,
    /// Normal and offset, before r is added.
    pub planes: Vec<[f64; 4]>,
    pub corners: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
    pub pairs: Vec<Pair>,
}

pub struct Pair {
    pub a: Placement,
    /// From time to time.
    pub b: Vec<Placement>,
}

/// All groups of a file.
pub fn read(path: &str) -> Vec<Group> {
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let mut words = Words(text.split_whitespace());
    let groups = words.whole();
    (0..groups).map(|_| words.group()).collect()
}

struct Words<'a>(SplitWhitespace<'a>);

impl Words<'_> {
    fn next(&mut self) -> &str {
        self.0.next().expect("the file of pairs ends too early")
    }

    fn whole(&mut self) -> usize {
        self.next().parse().expect("a whole number")
    }

    fn number(&mut self) -> f64 {
        self.next().parse().expect("a number")
    }

    fn numbers<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.number())
    }

    fn group(&mut self) -> Group {
        let name = self.next().to_owned();
        let [r, k, shadow, swept] = self.numbers();
        let [planes, corners, triangles, pairs, poses] = std::array::from_fn(|_| self.whole());
        Group {
            name,
            r,
            k,
            shadow,
            swept,
            planes: (0..planes).map(|_| self.numbers()).collect(),
            corners: (0..corners).map(|_| self.numbers()).collect(),
            triangles: (0..triangles).map(|_| std::array::from_fn(|_| self.whole() as u32)).collect(),
            pairs: (0..pairs)
                .map(|_| Pair { a: self.placement(), b: (0..poses).map(|_| self.placement()).collect() })
                .collect(),
        }
    }

    fn placement(&mut self) -> Placement {
        Placement { position: self.numbers(), orientation: self.numbers() }
    }
}
