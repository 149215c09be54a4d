//! Results in files.

use serde::Serialize;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

/// Writes results beside, and moves them over only when they are whole and on the disk, as `files.write_summary` of the
/// Python packages does.
pub fn write_summary(path: impl AsRef<Path>, summary: &impl Serialize) -> io::Result<()> {
    let path = path.as_ref();
    fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
    let mut part = path.as_os_str().to_owned();
    part.push(".part");
    let mut file = File::create(&part)?;
    file.write_all((serde_json::to_string_pretty(summary)? + "\n").as_bytes())?;
    file.sync_all()?;
    fs::rename(part, path)
}
