//! Counts and distributions, kept small enough for any number of pairs.

use crate::stress::cases::FAMILIES;
use crate::stress::clock::{CALLS, Call};
use crate::stress::judge::{Doubt, PATHS, Verdict};
use crate::stress::ledger::Ledger;
use std::collections::BTreeMap;

/// Values by powers of ten, 32 bins each: quantiles to 7 %.
#[derive(Clone)]
pub struct Distribution {
    bins: Vec<u64>,
    pub count: u64,
    pub most: f64,
    /// Index of the pair with the largest value.
    pub worst: u64,
}

const LOWEST: f64 = -22.0;
const HIGHEST: f64 = 8.0;
const PER_DECADE: f64 = 32.0;

impl Default for Distribution {
    fn default() -> Self {
        let bins = vec![0; ((HIGHEST - LOWEST) * PER_DECADE) as usize];
        Self { bins, count: 0, most: f64::NEG_INFINITY, worst: 0 }
    }
}

impl Distribution {
    pub fn add(&mut self, value: f64, index: u64) {
        let place = ((value.log10() - LOWEST) * PER_DECADE).clamp(0.0, self.bins.len() as f64 - 1.0);
        self.bins[place as usize] += 1;
        self.count += 1;
        if value > self.most {
            (self.most, self.worst) = (value, index);
        }
    }

    pub fn merge(&mut self, other: &Self) {
        for (bin, more) in self.bins.iter_mut().zip(&other.bins) {
            *bin += more;
        }
        self.count += other.count;
        if other.most > self.most {
            (self.most, self.worst) = (other.most, other.worst);
        }
    }

    /// The upper edge of the bin of this share of values; NaN of none.
    pub fn quantile(&self, share: f64) -> f64 {
        let wanted = (share * self.count as f64).ceil().max(1.0) as u64;
        let mut seen = 0;
        for (place, bin) in self.bins.iter().enumerate() {
            seen += bin;
            if seen >= wanted {
                return self.edge(place + 1).min(self.most);
            }
        }
        f64::NAN
    }

    fn edge(&self, place: usize) -> f64 {
        10f64.powf(LOWEST + place as f64 / PER_DECADE)
    }

    /// (upper edge, count) of the bins that hold something.
    pub fn filled(&self) -> impl Iterator<Item = (f64, u64)> + '_ {
        self.bins.iter().enumerate().filter(|(_, bin)| **bin > 0).map(|(place, bin)| (self.edge(place + 1), *bin))
    }
}

/// What is kept of each family.
#[derive(Clone, Default)]
pub struct OfFamily {
    pub pairs: u64,
    pub failures: u64,
    pub gap: Distribution,
    pub error: Distribution,
    pub point_error: Distribution,
    /// Of midway solved to the end, s.
    pub time: Distribution,
    pub extended: u64,
    pub unjudged: u64,
}

impl OfFamily {
    fn merge(&mut self, other: &Self) {
        self.pairs += other.pairs;
        self.failures += other.failures;
        self.extended += other.extended;
        self.unjudged += other.unjudged;
        for (mine, others) in [
            (&mut self.gap, &other.gap),
            (&mut self.error, &other.error),
            (&mut self.point_error, &other.point_error),
            (&mut self.time, &other.time),
        ] {
            mine.merge(others);
        }
    }
}

/// Of the pairs.
#[derive(Clone)]
pub struct Tally {
    /// What was found; the answers that the second solver could judge, and could not.
    pub ledger: Ledger,
    pub families: Vec<OfFamily>,
    /// Of each call, s.
    pub seconds: Vec<Distribution>,
    pub paths: Vec<[u64; PATHS.len()]>,
    /// Pairs put to the second solver.
    pub settled: u64,
    pub doubts: BTreeMap<Doubt, u64>,
    pub unit_digits: u64,
    pub rounding_limited: u64,
    pub cone_program: [u64; 2],
}

impl Default for Tally {
    fn default() -> Self {
        Self {
            ledger: Ledger::default(),
            families: vec![OfFamily::default(); FAMILIES.len()],
            seconds: vec![Distribution::default(); CALLS.len()],
            paths: vec![[0; PATHS.len()]; CALLS.len()],
            settled: 0,
            doubts: BTreeMap::new(),
            unit_digits: 0,
            rounding_limited: 0,
            cone_program: [0; 2],
        }
    }
}

fn place_of(call: Call) -> usize {
    CALLS.iter().position(|(each, _)| *each == call).expect("every call is listed")
}

impl Tally {
    pub fn add(&mut self, index: u64, family: usize, verdict: &Verdict) {
        self.ledger.cases += 1;
        let of = &mut self.families[family];
        of.pairs += 1;
        *self.ledger.families.entry(FAMILIES[family].name.into()).or_default() += 1;
        let m = &verdict.measures;
        for (value, distribution) in
            [(Some(m.gap), &mut of.gap), (m.error, &mut of.error), (m.point_error, &mut of.point_error)]
        {
            if let Some(value) = value {
                distribution.add(value, index);
            }
        }
        of.unjudged += u64::from(verdict.unjudged > 0);
        of.failures += u64::from(!verdict.faults.is_empty());
        self.settled += u64::from(verdict.settled);
        for doubt in &verdict.doubts {
            *self.doubts.entry(*doubt).or_default() += 1;
        }
        self.ledger.judged += u64::from(verdict.judged + verdict.unjudged);
        self.ledger.unsettled += u64::from(verdict.unjudged);
        for (call, seconds) in &verdict.costs {
            self.seconds[place_of(*call)].add(*seconds, index);
            if *call == Call::Full {
                of.time.add(*seconds, index);
            }
        }
        for (call, path) in &verdict.paths {
            self.paths[place_of(*call)][*path] += 1;
            of.extended += u64::from(*path == 6);
        }
        self.unit_digits += u64::from(verdict.unit_digits);
        self.rounding_limited += u64::from(verdict.rounding_limited);
        if let Some(answered) = verdict.cone_program {
            self.cone_program[usize::from(!answered)] += 1;
        }
    }

    pub fn merge(&mut self, other: Self) {
        self.ledger.merge(other.ledger);
        self.families.iter_mut().zip(&other.families).for_each(|(mine, others)| mine.merge(others));
        self.seconds.iter_mut().zip(&other.seconds).for_each(|(mine, others)| mine.merge(others));
        for (mine, others) in self.paths.iter_mut().zip(&other.paths) {
            mine.iter_mut().zip(others).for_each(|(count, more)| *count += more);
        }
        self.settled += other.settled;
        for (doubt, count) in other.doubts {
            *self.doubts.entry(doubt).or_default() += count;
        }
        self.unit_digits += other.unit_digits;
        self.rounding_limited += other.rounding_limited;
        self.cone_program[0] += other.cone_program[0];
        self.cone_program[1] += other.cone_program[1];
    }
}
