//! Reads the pairs that were solved to 40 digits.

pub use crate::pair_line::{Place, Shape};
use nalgebra::Vector3;
use serde::Deserialize;

/// Decimal strings of 40 digits. [`number`] and [`vector`] round them to doubles, [`minus`] subtracts them without
/// rounding.
#[derive(Deserialize)]
pub struct Truth {
    pub s4: String,
    pub u4: String,
    pub x4: [String; 3],
    pub ok1: bool,
    pub ok2: bool,
    #[serde(rename = "sA")]
    pub s_a: Option<String>,
    #[serde(rename = "sB")]
    pub s_b: Option<String>,
    #[serde(rename = "P1")]
    pub p1: Option<[String; 3]>,
    #[serde(rename = "P2")]
    pub p2: Option<[String; 3]>,
}

#[derive(Deserialize)]
pub struct Pair {
    #[serde(rename = "A")]
    pub shape_a: Shape,
    #[serde(rename = "B")]
    pub shape_b: Shape,
    pub a: Place,
    pub b: Place,
    pub family: String,
    pub truth: Truth,
}

pub fn number(text: &str) -> f64 {
    text.parse().expect("a decimal number")
}

pub fn vector(text: &[String; 3]) -> Vector3<f64> {
    Vector3::new(number(&text[0]), number(&text[1]), number(&text[2]))
}

/// All 360 pairs.
pub fn pairs() -> Vec<Pair> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../data/pairs.jsonl");
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    text.lines().map(|line| serde_json::from_str(line).expect("a pair per line")).collect()
}

/// A decimal number as a whole number of 36 digits and the power of ten of the last of them; digits beyond are cut.
fn decimal(text: &str) -> (i128, i32) {
    const DIGITS: usize = 36;
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let exponent: i32 = exponent.parse().expect("an exponent");
    let (sign, mantissa) = mantissa.strip_prefix('-').map_or((1, mantissa), |positive| (-1, positive));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = format!("{whole}{fraction}");
    let significant = digits.trim_start_matches('0');
    if significant.is_empty() {
        // Zero has no last digit.
        return (0, i32::MIN / 2);
    }
    let places = |digits: usize| i32::try_from(digits).expect("a short text");
    let leading: String = significant.chars().chain(std::iter::repeat('0')).take(DIGITS).collect();
    let last = exponent - places(fraction.len()) + places(significant.len()) - places(DIGITS);
    (sign * leading.parse::<i128>().expect("digits"), last)
}

/// `found` − `truth`, right to 35 digits of the larger of the two: the difference of two numbers that agree in 16
/// digits has digits of its own.
pub fn minus(found: f64, truth: &str) -> f64 {
    // Every double is a decimal number; 60 digits of it are more than are kept.
    let ((a, place_a), (b, place_b)) = (decimal(&format!("{found:.60e}")), decimal(truth));
    let place = place_a.max(place_b);
    let at_place = |value: i128, from: i32| {
        let places = u32::try_from(place - from).expect("the larger of both");
        10_i128.checked_pow(places).map_or(0, |power| value / power)
    };
    format!("{}e{place}", at_place(a, place_a) - at_place(b, place_b)).parse().expect("a number")
}

/// |`found` − `truth`|, with the differences of the components as [`minus`] has them.
pub fn distance(found: &Vector3<f64>, truth: &[String; 3]) -> f64 {
    Vector3::from([0, 1, 2].map(|i| minus(found[i], &truth[i]))).norm()
}
