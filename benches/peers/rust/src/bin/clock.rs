//! Prints nanoseconds a cycle: each multiplication of integers waits for the one before, which takes three cycles on
//! x86-64 since 2008.

use std::hint::black_box;
use std::time::Instant;

const MULTIPLICATIONS: u32 = 20_000_000;
const CYCLES_EACH: f64 = 3.0;
/// The shortest of so many counts: another program may hold up a few.
const TRIALS: usize = 20;

fn main() {
    let shortest = (0..TRIALS).map(|_| nanoseconds()).fold(f64::INFINITY, f64::min);
    println!("{:e}", shortest / (f64::from(MULTIPLICATIONS) * CYCLES_EACH));
}

fn nanoseconds() -> f64 {
    let begin = Instant::now();
    // Squares: powers of a number that stays would be multiplied out in advance by the compiler.
    black_box((0..MULTIPLICATIONS).fold(black_box(3u64), |x, _| x.wrapping_mul(x)));
    begin.elapsed().as_secs_f64() * 1e9
}
