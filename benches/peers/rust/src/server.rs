//! Answers requests on stdin, one a line, each with a line on stdout that begins with '>'.
//!
//! `time GROUP WAY cold|warm SECONDS`: seconds a call, over whole passes through the pairs, from pose to pose and back.
//! `answers GROUP WAY cold|warm`: what was found at the last pose, after a pass over those before it: a list in JSON of
//! `null` (failed), `[]` (apart), or `[overlap, x, y, z of the point, x, y, z of the normal]`, overlap < 0: minus the
//! distance.

use crate::scene::{self, Group};
use std::fmt::Write;
use std::io::{BufRead, stdin};
use std::time::Instant;

/// What a contestant says of a pair.
#[derive(Clone, Copy)]
pub enum Answer {
    Failed,
    Apart,
    Found { overlap: f64, point: [f64; 3], normal: [f64; 3] },
}

/// A contestant, ready for one group.
pub trait Contestant {
    /// All pairs at the pose of that number, one after the other; warm: from what the pass before left.
    fn pass(&mut self, pose: usize, warm: bool);

    /// What the last pass found.
    fn answers(&self) -> &[Answer];
}

/// `make` prepares a contestant for a group; its second argument is the way, or None of an unknown one.
pub fn serve(make: impl Fn(&Group, &str) -> Option<Box<dyn Contestant>>) {
    let path = std::env::args().nth(1).expect("the file of pairs as argument");
    let groups = scene::read(&path);
    let mut kept: Option<(String, Box<dyn Contestant>)> = None;
    for line in stdin().lock().lines().map_while(Result::ok) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [request, name, way, warmth, ..] = words[..] else { panic!("unknown request: {line}") };
        let group = groups.iter().find(|group| group.name == name).unwrap_or_else(|| panic!("no group {name}"));
        let key = format!("{name} {way}");
        let mut contestant = match kept.take() {
            Some((same, contestant)) if same == key => contestant,
            _ => make(group, way).unwrap_or_else(|| panic!("no way {way}")),
        };
        let (poses, warm) = (group.pairs[0].b.len(), warmth == "warm");
        if request == "time" {
            let least: f64 = words[4].parse().expect("seconds");
            println!(">{:e}", time(contestant.as_mut(), poses, group.pairs.len(), warm, least));
        } else {
            (0..poses).for_each(|pose| contestant.pass(pose, warm));
            println!(">{}", json(contestant.answers()));
        }
        kept = Some((key, contestant));
    }
}

/// Seconds a call. The first walk through the poses, untimed, brings code and data into the caches and fills the
/// memories.
fn time(contestant: &mut dyn Contestant, poses: usize, pairs: usize, warm: bool, least: f64) -> f64 {
    let walk = |contestant: &mut dyn Contestant| {
        let there_and_back = (0..poses).chain((1..poses - 1).rev());
        there_and_back.for_each(|pose| contestant.pass(pose, warm));
        pairs * (2 * poses - 2)
    };
    walk(contestant);
    let begin = Instant::now();
    let mut calls = 0;
    loop {
        calls += walk(contestant);
        let seconds = begin.elapsed().as_secs_f64();
        if seconds >= least {
            return seconds / calls as f64;
        }
    }
}

fn json(answers: &[Answer]) -> String {
    let mut text = String::from("[");
    for (index, answer) in answers.iter().enumerate() {
        let comma = if index == 0 { "" } else { ", " };
        match answer {
            Answer::Failed => write!(text, "{comma}null"),
            Answer::Apart => write!(text, "{comma}[]"),
            Answer::Found { overlap, point: [x, y, z], normal: [u, v, w] } => {
                write!(text, "{comma}[{overlap:e}, {x:e}, {y:e}, {z:e}, {u:e}, {v:e}, {w:e}]")
            }
        }
        .expect("a string takes all");
    }
    text + "]"
}
