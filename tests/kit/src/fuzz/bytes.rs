//! Numbers from bytes: ordinary ones, those that tend to break things, and any bits at all.

pub struct Bytes<'a>(pub &'a [u8]);

const SPECIAL: [f64; 24] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    1e-3,
    1e-8,
    1e-16,
    1e-150,
    1e150,
    1e-300,
    1e300,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN_POSITIVE,
    5e-324,
    f64::EPSILON,
    1.0 - f64::EPSILON / 2.0,
    1.0 + f64::EPSILON,
    0.577_350_269_189_625_8,
    1e7,
    -1e-12,
];

impl Bytes<'_> {
    pub fn byte(&mut self) -> u8 {
        match self.0 {
            [first, rest @ ..] => {
                let first = *first;
                self.0 = rest;
                first
            }
            [] => 0,
        }
    }

    /// In [-8, 8), in steps of 1/4096.
    pub fn ordinary(&mut self) -> f64 {
        f64::from(i16::from_le_bytes([self.byte(), self.byte()])) / 4096.0
    }

    /// Two thirds ordinary, the rest special or any bits.
    pub fn number(&mut self) -> f64 {
        match self.byte() {
            0..=170 => self.ordinary(),
            171..=220 => SPECIAL[usize::from(self.byte()) % SPECIAL.len()],
            _ => f64::from_bits(u64::from_le_bytes([0; 8].map(|_: u8| self.byte()))),
        }
    }

    /// A positive number, mostly 10^-8 to 10^0 of something.
    pub fn small(&mut self) -> f64 {
        match self.byte() {
            0..=230 => 10f64.powf(-8.0 * f64::from(self.byte()) / 255.0),
            _ => self.number(),
        }
    }

    pub fn triple(&mut self) -> [f64; 3] {
        [self.number(), self.number(), self.number()]
    }
}
