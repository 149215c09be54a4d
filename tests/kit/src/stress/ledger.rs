//! What was found: counts by kind of fault and family, and some cases in full.

use indicatif::ProgressBar;
use serde::Serialize;
use std::collections::BTreeMap;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// What can be wrong with an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fault {
    Panic,
    /// An error or a status where there is an answer.
    NotSolved,
    /// No number where there should be one, or fields that contradict each other.
    Malformed,
    /// s is further than its gap from the truth.
    BoundOfS,
    /// The same, of the particle as given, without the regularisation.
    GapOfGiven,
    /// A point is further than its bound from the optimum.
    BoundOfPoint,
    /// Overlapping told of a separated pair or the other way round, beyond the gap.
    WrongSide,
    /// s − gap < 1 < s + gap with a gap beyond 1e-2: touching cannot be told from apart.
    SaysNothing,
    /// The gap is much larger than the rounding of the input explains.
    LooseBound,
    /// A surface point is not on its surface.
    OffSurface,
    /// A point beside its boundary, or not on the part that is named.
    OffBoundary,
    /// The normal is not that of both surfaces.
    Normal,
    Overlap,
    /// Farther apart than they are.
    Distance,
    /// B moved by less than the overlap, and they overlap no more.
    FlipsEarly,
    /// B moved beyond the tangent planes, and they still overlap.
    FlipsLate,
    /// A with B is not B with A.
    Swap,
    /// Both turned and shifted together.
    RigidMotion,
    /// Another unit of length.
    Units,
    /// From memory and without.
    Warm,
    /// Rejected, although they overlap; or the quick answer has another kind than the full one.
    Reject,
    /// The cone program disagrees.
    ConeProgram,
    /// A jump along a smooth motion.
    Jump,
    /// A batch and a single call.
    Batch,
    /// The branch from A is off by more than its own rounding.
    Branch,
    /// On a shared edge or vertex, but not the same bits.
    Seam,
    /// A patch is further from its definition than it says.
    Patch,
    /// Mass properties are further off than they say.
    Mass,
}

/// A case that failed.
#[derive(Clone, Debug, Serialize)]
pub struct Finding {
    pub fault: Fault,
    pub family: String,
    pub seed: u64,
    pub index: u64,
    pub detail: String,
    /// Everything that a test of it needs, as JSON.
    pub case: serde_json::Value,
    #[serde(skip)]
    pub planes: usize,
}

/// Counts of one part.
#[derive(Clone, Debug, Default)]
pub struct Ledger {
    pub cases: u64,
    /// Calls of the library that were judged, and those that the reference could not settle.
    pub judged: u64,
    pub unsettled: u64,
    /// Cases of each family.
    pub families: BTreeMap<String, u64>,
    pub faults: BTreeMap<(Fault, String), u64>,
    pub found: Vec<Finding>,
}

/// Most cases that are kept of each kind of fault and family.
const KEPT: usize = 5;
/// Most that are printed of each.
const PRINTED: usize = 2;

impl Ledger {
    pub fn find(&mut self, finding: Finding) {
        *self.faults.entry((finding.fault, finding.family.clone())).or_default() += 1;
        self.keep(finding);
    }

    /// Of many of a kind and family those of few planes.
    fn keep(&mut self, finding: Finding) {
        let alike = |each: &Finding| each.fault == finding.fault && each.family == finding.family;
        if self.found.iter().filter(|each| alike(each)).count() < KEPT {
            return self.found.push(finding);
        }
        let alike = self.found.iter_mut().filter(|each| alike(each));
        if let Some(largest) = alike.max_by_key(|each| each.planes).filter(|each| each.planes > finding.planes) {
            *largest = finding;
        }
    }

    pub fn merge(&mut self, other: Self) {
        self.cases += other.cases;
        self.judged += other.judged;
        self.unsettled += other.unsettled;
        for (family, count) in other.families {
            *self.families.entry(family).or_default() += count;
        }
        for (key, count) in other.faults {
            *self.faults.entry(key).or_default() += count;
        }
        for finding in other.found {
            self.keep(finding);
        }
    }

    pub fn failures(&self) -> u64 {
        self.faults.values().sum()
    }

    pub fn by_fault(&self) -> BTreeMap<Fault, u64> {
        let mut sums = BTreeMap::new();
        for ((fault, _), count) in &self.faults {
            *sums.entry(*fault).or_default() += count;
        }
        sums
    }

    pub fn share_unsettled(&self) -> f64 {
        self.unsettled as f64 / self.judged.max(1) as f64
    }

    /// Counts by kind and family, and some cases in full.
    pub fn print(&self, part: &str) {
        println!(
            "\n{part}: {} cases, {} answers judged, {} not settled by the reference",
            self.cases, self.judged, self.unsettled
        );
        if self.faults.is_empty() {
            return;
        }
        println!("\n| {part}: fault | family | failed | of |\n|---|---|---|---|");
        for ((fault, family), count) in &self.faults {
            println!("| {fault:?} | {family} | {count} | {} |", self.families.get(family).unwrap_or(&0));
        }
        let mut shown = BTreeMap::new();
        for finding in &self.found {
            let shown: &mut usize = shown.entry(finding.fault).or_default();
            *shown += 1;
            if *shown <= PRINTED {
                println!(
                    "{:?}, {}, seed {} index {}: {}",
                    finding.fault, finding.family, finding.seed, finding.index, finding.detail
                );
                println!("{}", finding.case);
            }
        }
    }
}

/// Judges one case again and prints what is found in full; whether it passed.
pub fn replay(one: impl FnOnce(&mut Ledger)) -> bool {
    let mut ledger = Ledger::default();
    one(&mut ledger);
    for finding in &ledger.found {
        println!("{}", serde_json::to_string_pretty(finding).expect("numbers"));
    }
    ledger.failures() == 0
}

/// What of a range of cases, in blocks by several threads, each with a sum of its own, comes to.
pub fn parallel<T: Default + Send>(
    (range, block): (Range<u64>, u64),
    threads: usize,
    stop: &AtomicBool,
    progress: &ProgressBar,
    merge: fn(&mut T, T),
    of: impl Fn(Range<u64>, &mut T) + Sync,
) -> T {
    let (total, next) = (Mutex::new(T::default()), AtomicU64::new(range.start));
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                let mut sum = T::default();
                loop {
                    let begin = next.fetch_add(block, Ordering::Relaxed);
                    if begin >= range.end || stop.load(Ordering::Relaxed) {
                        break;
                    }
                    let end = (begin + block).min(range.end);
                    of(begin..end, &mut sum);
                    progress.inc(end - begin);
                }
                merge(&mut total.lock().expect("no thread panics while it holds the sum"), sum);
            });
        }
    });
    total.into_inner().expect("no thread panics while it holds the sum")
}

/// Cases 0 to `count`, each a function of its index alone. A panic is a finding of no family.
pub fn run(
    (seed, count): (u64, u64),
    threads: usize,
    stop: &AtomicBool,
    progress: &ProgressBar,
    one: impl Fn(u64, &mut Ledger) + Sync,
) -> Ledger {
    // Few long ones are shared among the threads, too.
    let block = (count / 64).clamp(1, 64);
    parallel((0..count, block), threads, stop, progress, Ledger::merge, |range, ledger| {
        for index in range {
            if catch_unwind(AssertUnwindSafe(|| one(index, ledger))).is_err() {
                let (family, detail) = (String::from("any"), String::from("panicked"));
                let case = serde_json::Value::Null;
                ledger.find(Finding { fault: Fault::Panic, family, seed, index, detail, case, planes: 0 });
            }
            ledger.cases += 1;
        }
    })
}
