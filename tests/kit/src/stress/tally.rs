//! Counts and distributions, kept small enough for any number of pairs.

use crate::stress::cases::FAMILIES;
use crate::stress::clock::{CALLS, Call};
use crate::stress::judge::{Doubt, Failure, PATHS, Verdict};
use crate::stress::line::Line;
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
    pub point_bound: Distribution,
    pub normal_error: Distribution,
    pub looseness: Distribution,
    /// Evaluations of the pair itself.
    pub time: Distribution,
    pub extended: u64,
    pub unjudged: u64,
}

/// A failed pair.
#[derive(Clone, Debug)]
pub struct Found {
    pub failure: Failure,
    pub index: u64,
    pub family: &'static str,
    pub detail: String,
    /// The pair itself.
    pub line: Option<Line>,
}

impl Found {
    fn planes(&self) -> usize {
        self.line.as_ref().map_or(0, Line::planes)
    }
}

#[derive(Clone)]
pub struct Tally {
    pub pairs: u64,
    pub families: Vec<OfFamily>,
    pub failures: BTreeMap<Failure, u64>,
    pub found: Vec<Found>,
    /// Evaluations of the pair itself, by call.
    pub times: Vec<Distribution>,
    pub seconds: Vec<Distribution>,
    pub paths: Vec<[u64; PATHS.len()]>,
    /// Pairs put to the second solver.
    pub settled: u64,
    pub doubts: BTreeMap<Doubt, u64>,
    /// Answers that it could judge, and could not.
    pub judged: u64,
    pub unjudged: u64,
    pub unit_digits: u64,
    pub rounding_limited: u64,
    pub cone_program: [u64; 2],
    pub walk_steps: u64,
}

/// Most pairs that are kept of each kind of failure.
const KEPT: usize = 25;

impl Default for Tally {
    fn default() -> Self {
        Self {
            pairs: 0,
            families: vec![OfFamily::default(); FAMILIES.len()],
            failures: BTreeMap::new(),
            found: Vec::new(),
            times: vec![Distribution::default(); CALLS.len()],
            seconds: vec![Distribution::default(); CALLS.len()],
            paths: vec![[0; PATHS.len()]; CALLS.len()],
            settled: 0,
            doubts: BTreeMap::new(),
            judged: 0,
            unjudged: 0,
            unit_digits: 0,
            rounding_limited: 0,
            cone_program: [0; 2],
            walk_steps: 0,
        }
    }
}

pub fn place_of(call: Call) -> usize {
    CALLS.iter().position(|(each, _)| *each == call).expect("every call is listed")
}

impl Tally {
    pub fn add(&mut self, index: u64, family: usize, verdict: &Verdict) {
        self.pairs += 1;
        let of = &mut self.families[family];
        of.pairs += 1;
        let m = &verdict.measures;
        of.gap.add(m.gap, index);
        for (value, distribution) in [
            (m.error, &mut of.error),
            (m.point_error, &mut of.point_error),
            (m.point_bound, &mut of.point_bound),
            (m.normal_error, &mut of.normal_error),
            (m.looseness, &mut of.looseness),
        ] {
            if let Some(value) = value {
                distribution.add(value, index);
            }
        }
        of.unjudged += u64::from(verdict.unjudged > 0);
        self.settled += u64::from(verdict.settled);
        for doubt in &verdict.doubts {
            *self.doubts.entry(*doubt).or_default() += 1;
        }
        self.judged += u64::from(verdict.judged);
        self.unjudged += u64::from(verdict.unjudged);
        for (call, seconds) in &verdict.costs {
            let evaluations = seconds / verdict.evaluation;
            self.times[place_of(*call)].add(evaluations, index);
            self.seconds[place_of(*call)].add(*seconds, index);
            if *call == Call::Full {
                of.time.add(evaluations, index);
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
        self.families[family].failures += u64::from(!verdict.failures.is_empty());
    }

    pub fn find(&mut self, found: Found) {
        *self.failures.entry(found.failure).or_default() += 1;
        self.keep(found);
    }

    /// Of many failures of a kind those of few planes, which are easiest to understand.
    fn keep(&mut self, found: Found) {
        if self.found.iter().filter(|each| each.failure == found.failure).count() < KEPT {
            self.found.push(found);
            return;
        }
        let alike = self.found.iter_mut().filter(|each| each.failure == found.failure);
        let largest = alike.max_by_key(|each| each.planes());
        if let Some(largest) = largest.filter(|largest| largest.planes() > found.planes()) {
            *largest = found;
        }
    }

    pub fn merge(&mut self, other: Self) {
        self.pairs += other.pairs;
        for (mine, others) in self.families.iter_mut().zip(&other.families) {
            mine.pairs += others.pairs;
            mine.failures += others.failures;
            mine.gap.merge(&others.gap);
            mine.error.merge(&others.error);
            mine.point_error.merge(&others.point_error);
            mine.point_bound.merge(&others.point_bound);
            mine.normal_error.merge(&others.normal_error);
            mine.looseness.merge(&others.looseness);
            mine.time.merge(&others.time);
            mine.extended += others.extended;
            mine.unjudged += others.unjudged;
        }
        for (failure, count) in other.failures {
            *self.failures.entry(failure).or_default() += count;
        }
        for found in other.found {
            self.keep(found);
        }
        for (mine, others) in self.times.iter_mut().zip(&other.times) {
            mine.merge(others);
        }
        for (mine, others) in self.seconds.iter_mut().zip(&other.seconds) {
            mine.merge(others);
        }
        for (mine, others) in self.paths.iter_mut().zip(&other.paths) {
            for (count, more) in mine.iter_mut().zip(others) {
                *count += more;
            }
        }
        self.settled += other.settled;
        for (doubt, count) in other.doubts {
            *self.doubts.entry(doubt).or_default() += count;
        }
        self.judged += other.judged;
        self.unjudged += other.unjudged;
        self.unit_digits += other.unit_digits;
        self.rounding_limited += other.rounding_limited;
        self.cone_program[0] += other.cone_program[0];
        self.cone_program[1] += other.cone_program[1];
        self.walk_steps += other.walk_steps;
    }

    /// All of them; one pair may fail in several ways.
    pub fn failures(&self) -> u64 {
        self.failures.values().sum()
    }

    /// All families' times.
    pub fn time(&self, call: Call) -> &Distribution {
        &self.times[place_of(call)]
    }
}
