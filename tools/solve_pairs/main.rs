//! Solves pairs of particles from a file, one JSON object a line, and writes one JSON object a line.
//!
//!     cargo run --release --example solve_pairs -- PAIRS.jsonl > answers.jsonl
//!
//! Input as in tests/data/pairs.jsonl: `A`, `B`: {n: [[a, b, c], ...], d: [...], r, k, R}; `a`, `b`: {pos, q}, q as
//! (w, x, y, z); whatever else a line holds is ignored. A line that cannot be read or solved gives an error with its
//! number on stderr, the rest is solved all the same, and the exit code is 1.

mod answer;
mod arguments;
mod digits;

use answer::Answer;
use arguments::Arguments;
use clap::Parser;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use kit::pair_line;
use std::fs::File;
use std::io::{self, BufRead, BufReader, ErrorKind, IsTerminal, Write};
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match run(&arguments) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(bad) => {
            eprintln!("{bad} bad line{}", if bad == 1 { "" } else { "s" });
            ExitCode::FAILURE
        }
        // Whoever read the answers has seen enough.
        Err(error) if error.kind() == ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{}: {error}", arguments.file.display());
            ExitCode::FAILURE
        }
    }
}

/// The number of bad lines.
fn run(arguments: &Arguments) -> io::Result<usize> {
    let (mut lines, length): (Box<dyn BufRead>, Option<u64>) = if arguments.file == Path::new("-") {
        (Box::new(io::stdin().lock()), None)
    } else {
        let file = File::open(&arguments.file)?;
        let length = file.metadata()?.len();
        (Box::new(BufReader::new(file)), Some(length))
    };
    let progress = progress(length);
    let mut answers = io::stdout().lock();
    let mut bad = 0;
    let mut text = Vec::new();
    for number in 1.. {
        text.clear();
        let read = lines.read_until(b'\n', &mut text)?;
        if read == 0 {
            break;
        }
        progress.inc(read as u64);
        if text.trim_ascii().is_empty() {
            continue;
        }
        let answer = pair_line::pair(&text).and_then(|pair| Answer::new(number, &pair, arguments));
        match answer {
            Ok(answer) => writeln!(answers, "{}", digits::json(&answer)?)?,
            Err(error) => {
                bad += 1;
                progress.suspend(|| eprintln!("line {number}: {error}"));
            }
        }
    }
    progress.finish_and_clear();
    Ok(bad)
}

/// Bytes read of a file, or as they come. On stderr, if that is a terminal, and unless the answers go to one.
fn progress(length: Option<u64>) -> ProgressBar {
    let target = if io::stdout().is_terminal() { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    match length {
        Some(length) => {
            let style = ProgressStyle::with_template("{bar:40} {percent:>3} %  {eta} left").expect("a valid template");
            ProgressBar::with_draw_target(Some(length), target).with_style(style)
        }
        None => {
            let style = ProgressStyle::with_template("{spinner} {bytes} read").expect("a valid template");
            ProgressBar::with_draw_target(None, target).with_style(style)
        }
    }
}
