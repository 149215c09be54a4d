//! JSON with 17 significant digits, enough for any f64 and the same width for all.

use serde::Serialize;
use serde_json::Serializer;
use serde_json::ser::Formatter;
use std::io::{self, Write};

struct Digits;

impl Formatter for Digits {
    fn write_f64<W: Write + ?Sized>(&mut self, writer: &mut W, value: f64) -> io::Result<()> {
        write!(writer, "{value:.16e}")
    }
}

/// One line; what is not a finite number becomes null.
pub fn json(value: &impl Serialize) -> io::Result<String> {
    let mut text = Vec::new();
    value.serialize(&mut Serializer::with_formatter(&mut text, Digits))?;
    String::from_utf8(text).map_err(io::Error::other)
}
