//! Debian YADE's own functor, asked through a child process that answers pair by pair.

use crate::baselines::Placed;
use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use potential_particles::{Particle, Pose};
use serde::Deserialize;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::Duration;

/// YADE's default `accuracyTol`.
pub const DEFAULT_TOLERANCE: f64 = 1e-7;

/// Longest wait for an answer. Ordinary pairs take milliseconds; some never end.
const PATIENCE: Duration = Duration::from_secs(5);

/// YADE, started when first asked and again after each crash.
pub struct BuiltIn {
    program: PathBuf,
    running: Option<Running>,
    version: Option<String>,
    /// Why there is no YADE to ask.
    missing: Option<String>,
}

struct Running {
    child: Child,
    lines: Receiver<String>,
}

/// What the functor found.
#[derive(Clone, Deserialize)]
pub struct Found {
    version: String,
    /// Per call of the functor.
    pub seconds: f64,
    pub touching: bool,
    /// Relative to B, world axes; meaningless unless touching.
    pub point: [f64; 3],
}

impl BuiltIn {
    pub fn new(program: &Path) -> Self {
        let missing = (!program.exists()).then(|| format!("{} is not installed", program.display()));
        Self { program: program.into(), running: None, version: None, missing }
    }

    /// The version of YADE, once it has answered.
    pub fn version(&self) -> Option<String> {
        self.version.clone()
    }

    /// Why there is no YADE to ask, if so.
    pub fn missing(&self) -> Option<&str> {
        self.missing.as_deref()
    }

    /// Solves a pair, with or without the contact area. `quaternions` of A and B as written, or those of the poses.
    pub fn ask(
        &mut self,
        pair: &Placed,
        quaternions: Option<[[f64; 4]; 2]>,
        tolerance: f64,
        area: bool,
    ) -> Result<Found, String> {
        if let Some(missing) = &self.missing {
            return Err(missing.clone());
        }
        let [a, b] = quaternions.unwrap_or_else(|| [pair.pose_a, pair.pose_b].map(quaternion));
        let question = json!({
            "A": shape(pair.a), "B": shape(pair.b),
            "a": {"pos": pair.pose_a.position().as_slice(), "q": a},
            "b": {"pos": pair.pose_b.position().as_slice(), "q": b},
            "tolerance": tolerance, "area": area,
        });
        let mut running = match self.running.take() {
            Some(running) => running,
            None => Running::start(&self.program).map_err(|error| error.to_string())?,
        };
        let found = running.ask(&question)?;
        self.running = Some(running);
        self.version = Some(found.version.clone());
        Ok(found)
    }
}

impl Running {
    fn start(program: &Path) -> std::io::Result<Self> {
        let script = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/yade/built_in.py");
        let mut child = Command::new(program)
            .args(["-x", "-n", "-j1", script])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()?;
        let output = BufReader::new(child.stdout.take().expect("stdout is piped"));
        let (sender, lines) = mpsc::channel();
        std::thread::spawn(move || {
            // YADE's own messages share the stream; answers are marked. An error is the end of the stream.
            for line in output.lines().map_while(Result::ok) {
                let sent = line.strip_prefix('>').map(|answer| sender.send(answer.to_owned()));
                if matches!(sent, Some(Err(_))) {
                    break;
                }
            }
        });
        Ok(Self { child, lines })
    }

    fn ask(&mut self, question: &Value) -> Result<Found, String> {
        let input = self.child.stdin.as_mut().expect("stdin is piped");
        // A process that died before is told apart below.
        let _ = writeln!(input, "{question}");
        match self.lines.recv_timeout(PATIENCE) {
            Ok(line) => serde_json::from_str(&line).map_err(|error| format!("unexpected answer: {error}")),
            Err(RecvTimeoutError::Timeout) => Err(format!("no answer in {} s", PATIENCE.as_secs())),
            Err(RecvTimeoutError::Disconnected) => match self.child.wait() {
                Ok(status) => Err(format!("crashed ({status})")),
                Err(error) => Err(format!("crashed ({error})")),
            },
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // Either may find the process gone already, which is what they are for.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn shape(particle: &Particle) -> Value {
    let normals: Vec<[f64; 3]> = particle.planes().map(|plane| plane.normal.into()).collect();
    let offsets: Vec<f64> = particle.planes().map(|plane| plane.offset).collect();
    let (r, k, shadow) = (particle.rounding_radius(), particle.sphericity(), particle.shadow_radius());
    json!({"n": normals, "d": offsets, "r": r, "k": k, "R": shadow})
}

/// (w, x, y, z).
fn quaternion(pose: &Pose) -> [f64; 4] {
    let unit = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*pose.rotation()));
    [unit.w, unit.i, unit.j, unit.k]
}

impl Found {
    pub fn point(&self) -> Vector3<f64> {
        Vector3::from(self.point)
    }
}
