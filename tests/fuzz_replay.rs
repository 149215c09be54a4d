//! The fuzz targets without a fuzzer: the seeds, and a fixed sequence of changes of them, for some seconds.

use kit::fuzz as targets;

use std::path::Path;

/// Marsaglia's xorshift: the same changes on every machine.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 16) as usize % limit.max(1)
    }
}

fn seeds(target: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/seeds").join(target);
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("a folder can be read").path()).collect();
    paths.sort();
    assert!(paths.len() >= 3, "{} has lost its seeds", folder.display());
    paths.iter().map(|path| std::fs::read(path).expect("a seed can be read")).collect()
}

/// Changes bytes, cuts, repeats and splices.
fn changed(seed: &[u8], other: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..1 + random.below(6) {
        let at = random.below(bytes.len());
        match random.below(6) {
            0 | 1 if !bytes.is_empty() => bytes[at] = random.below(256) as u8,
            2 if !bytes.is_empty() => bytes[at] ^= 1 << random.below(8),
            3 => bytes.insert(at, random.below(256) as u8),
            4 => bytes.truncate(at),
            _ => {
                let from = random.below(other.len());
                let piece = &other[from..(from + 1 + random.below(40)).min(other.len())];
                bytes.splice(at..at, piece.iter().copied());
            }
        }
    }
    bytes
}

fn replay(target: &str, run: impl Fn(&[u8]) + std::panic::RefUnwindSafe, changes: usize) {
    let seeds = seeds(target);
    let mut random = Random(88_172_645_463_325_252);
    let attempt = |bytes: &[u8]| {
        if std::panic::catch_unwind(|| run(bytes)).is_err() {
            panic!("{target}: these bytes fail: {bytes:?}");
        }
    };
    seeds.iter().for_each(|seed| attempt(seed));
    // make test-all asks for more.
    let changes = if std::env::var_os("PP_LONG").is_some() { 10 * changes } else { changes };
    for _ in 0..changes {
        let (one, other) = (&seeds[random.below(seeds.len())], &seeds[random.below(seeds.len())]);
        attempt(&changed(one, other, &mut random));
    }
}

#[test]
fn particles_of_any_bytes() {
    replay("particle", targets::particle::run, 160_000);
}

#[test]
fn detection_of_any_bytes() {
    replay("detect", targets::detect::run, 16_000);
}

#[test]
fn pairs_files_of_any_bytes() {
    replay("pairs_file", targets::pairs_file::run, 600_000);
}

#[test]
fn walls_of_any_bytes() {
    replay("walls", targets::walls::run, 100_000);
}

#[test]
fn memories_of_any_bytes() {
    replay("memories", targets::memories::run, 40_000);
}

#[test]
fn mass_properties_of_any_bytes() {
    replay("mass", targets::mass::run, 250);
}
