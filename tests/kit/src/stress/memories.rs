//! What a pair remembers is a hint only: from any numbers at all, the answer is the one without.

use crate::pair_line::Line;
use crate::random::Random;
use crate::stress::cases::{Case, Shapes, stream};
use crate::stress::judge::stays_in_plane;
use crate::stress::ledger::{Fault, Finding, Ledger};
use potential_particles::{Contact, DetectError, Flags, Formulation, Kind, PairState, Settings, detect};
use serde::Serialize;

/// What is remembered, as numbers.
pub type Raw = [f64; 8];

/// Memories that each pair is solved from.
const MEMORIES: usize = 6;

#[derive(Serialize)]
struct Written {
    pair: Line,
    /// As bits, since no JSON has NaN.
    memory_bits: [u64; 8],
    memory: String,
    settings: String,
    cold: String,
    warm: String,
}

/// A pair with its state from these numbers: the one place where a state is made.
fn solve(case: &Case, settings: &Settings, raw: Option<&mut Raw>) -> Result<Contact, DetectError> {
    let mut memory = raw.as_ref().map(|raw| PairState::from_raw(**raw));
    let (a, b) = (&case.shapes.a, &case.shapes.b);
    let answer = detect(a, &case.at_a.pose(), b, &case.at_b.pose(), settings, memory.as_mut());
    if let (Some(raw), Some(memory)) = (raw, memory) {
        *raw = memory.into_raw();
    }
    answer
}

/// Any bits, numbers that tend to break things, and memories of this pair or another with some of them in it.
pub fn any(own: impl Fn() -> Raw, another: impl Fn(&mut Random) -> Raw, random: &mut Random) -> (Raw, &'static str) {
    let bits = |random: &mut Random| {
        let word = |random: &mut Random| (random.uniform() * 4_294_967_296.0) as u64;
        f64::from_bits(word(random) << 32 | word(random))
    };
    let sign = |random: &mut Random| if random.uniform() < 0.5 { 1.0 } else { -1.0 };
    let special = |random: &mut Random| match random.whole(0, 8) {
        0 => f64::NAN,
        1 => f64::INFINITY * sign(random),
        2 => 5e-324 * (1.0 + 1e6 * random.uniform()),
        3 => 0.0,
        4 => 1.0,
        5 => sign(random) * 10f64.powf(60.0 + 40.0 * random.uniform()),
        6 => sign(random) * 10f64.powf(-300.0 + 600.0 * random.uniform()),
        _ => bits(random),
    };
    match random.whole(0, 6) {
        0 => ([0; 8].map(|_| bits(random)), "any bits"),
        1 => {
            let mut raw = [0; 8].map(|_| bits(random));
            raw[0] = 1.0;
            (raw, "any bits, marked valid")
        }
        2 => {
            // A point far away, or a weight out of all proportion.
            let mut raw = [1.0, random.normal(), random.normal(), random.normal(), 1.0, 1.0, 1.0, 1.0];
            for number in &mut raw[1..] {
                if random.uniform() < 0.4 {
                    *number = sign(random) * 10f64.powf(60.0 + 40.0 * random.uniform());
                }
            }
            raw[4] = raw[4].abs();
            raw[5] = f64::from(u8::from(random.uniform() < 0.5));
            (raw, "1e60 to 1e100")
        }
        3 => {
            let mut raw = own();
            raw[random.whole(1, 8)] = special(random);
            (raw, "its own but for one number")
        }
        4 => (another(random), "another pair's"),
        _ => {
            let mut raw = [0; 8].map(|_| special(random));
            raw[0] = 1.0;
            (raw, "special numbers")
        }
    }
}

/// What the pair itself remembers.
fn own(case: &Case) -> Raw {
    let mut raw = [0.0; 8];
    let settings = Settings::default().with_solve_separated(true);
    // A pair without an answer has nothing to remember.
    let _ = solve(case, &settings, Some(&mut raw));
    raw
}

/// Case `index`: what is found is added to the ledger.
pub fn one(seed: u64, index: u64, ledger: &mut Ledger) {
    let shapes = Shapes::of(seed, index);
    let case = Case::of(&shapes, seed, index);
    let mut random = stream(seed, 15, index);
    let default = Settings::default();
    let settings = match random.whole(0, 4) {
        0 => default,
        1 => default.with_formulation(Formulation::Closest).with_solve_separated(true),
        2 => default.with_gap_tolerance(1e-14).with_solve_separated(true),
        _ => default.with_solve_separated(true),
    };
    let cold = solve(&case, &settings, None);
    for _ in 0..MEMORIES {
        let another = |random: &mut Random| {
            let index = 1_000_000 + 8 * random.whole(0, 20_000) as u64;
            let shapes = Shapes::of(seed, index);
            own(&Case::of(&shapes, seed, index))
        };
        let (raw, kind) = any(|| own(&case), another, &mut random);
        let family = format!("{kind} | {}", case.family());
        *ledger.families.entry(family.clone()).or_default() += 1;
        let mut after = raw;
        let warm = solve(&case, &settings, Some(&mut after));
        // From what it has just remembered, once more.
        let again = solve(&case, &settings, Some(&mut after));
        for warm in [warm, again] {
            ledger.judged += 1;
            let leaves = warm.as_ref().is_ok_and(|warm| !stays_in_plane(&shapes, warm));
            let leaves = leaves.then(|| "leaves the plane".into());
            let Some(detail) = leaves.or_else(|| wrong(&cold, &warm)) else { continue };
            let written = Written {
                pair: case.line(detail.clone()),
                memory_bits: raw.map(f64::to_bits),
                memory: format!("{raw:?}"),
                settings: format!("{settings:?}"),
                cold: format!("{cold:?}"),
                warm: format!("{warm:?}"),
            };
            let planes = written.pair.planes();
            let written = serde_json::to_value(written).unwrap_or_default();
            let family = family.clone();
            ledger.find(Finding { fault: Fault::Warm, family, seed, index, detail, case: written, planes });
        }
    }
}

/// What of an answer from memory is not that without.
pub fn wrong(cold: &Result<Contact, DetectError>, warm: &Result<Contact, DetectError>) -> Option<String> {
    let (cold, warm) = match (cold, warm) {
        (Ok(cold), Ok(warm)) => (cold, warm),
        (Ok(_), Err(error)) => return Some(format!("failed from memory: {error}")),
        (Err(_), _) => return None,
    };
    let rejected = |c: &Contact| c.flags.contains(Flags::REJECTED);
    let near = |c: &Contact| !rejected(c) && (c.s - 1.0).abs() <= c.gap;
    if cold.kind != warm.kind && !near(cold) && !near(warm) {
        let side = if cold.kind == Kind::Overlapping { "apart though overlapping" } else { "overlapping though apart" };
        return Some(format!("{side}: s={:e} ± {:e}, cold {:e} ± {:e}", warm.s, warm.gap, cold.s, cold.gap));
    }
    if rejected(cold) || rejected(warm) {
        // Of these s is a lower bound.
        let broken = match (rejected(cold), rejected(warm)) {
            (true, false) => cold.s > warm.s + warm.gap,
            (false, true) => warm.s > cold.s + cold.gap,
            _ => false,
        };
        return broken
            .then(|| format!("rejected with s={:e} or more, else {:e}", warm.s.max(cold.s), warm.s.min(cold.s)));
    }
    let (off, both) = ((cold.s - warm.s).abs(), cold.gap + warm.gap);
    // Whether a scale can be told from 0 depends on its gap.
    let comparable = cold.formulation == warm.formulation;
    (comparable && !(off <= both)).then(|| format!("s={:e}, cold {:e}, gaps {both:e}", warm.s, cold.s))
}
