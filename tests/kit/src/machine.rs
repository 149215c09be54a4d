//! What the figures were measured on and with.

use serde::Serialize;
use std::fs;
use std::process::Command;

/// Machine, date and versions.
#[derive(Serialize)]
pub struct Machine {
    pub processor: String,
    pub cores: usize,
    pub system: String,
    pub date: String,
    pub library: String,
    pub rustc: String,
    pub clarabel: String,
}

impl Machine {
    pub fn here() -> Self {
        Self {
            processor: field("/proc/cpuinfo", "model name", ':').unwrap_or_else(|| std::env::consts::ARCH.into()),
            cores: std::thread::available_parallelism().map_or(0, usize::from),
            system: field("/etc/os-release", "PRETTY_NAME", '=').unwrap_or_else(|| std::env::consts::OS.into()),
            date: output("date", &["--iso-8601=seconds"]),
            library: version_of("potential-particles"),
            rustc: output("rustc", &["--version"]),
            clarabel: version_of("clarabel"),
        }
    }
}

/// The version that Cargo.lock pins.
fn version_of(package: &str) -> String {
    let lock = include_str!("../../../Cargo.lock");
    let name = format!("name = \"{package}\"\n");
    lock.split("[[package]]")
        .find(|package| package.contains(&name))
        .and_then(|package| package.lines().find_map(|line| line.strip_prefix("version = ")))
        .map_or_else(|| "unknown".into(), |version| version.trim_matches('"').into())
}

fn output(program: &str, arguments: &[&str]) -> String {
    let done = Command::new(program).args(arguments).output();
    done.map_or_else(|_| "unknown".into(), |output| String::from_utf8_lossy(&output.stdout).trim().into())
}

/// The value of the first line "key <separator> value".
fn field(path: &str, key: &str, separator: char) -> Option<String> {
    let text = fs::read_to_string(path).ok()?;
    let line = text.lines().find(|line| line.starts_with(key))?;
    let (_, value) = line.split_once(separator)?;
    Some(value.trim().trim_matches('"').into())
}
