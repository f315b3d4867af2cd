//! Bytes from the fuzzer as choices and numbers. After the end, every further byte is zero.

/// Numbers at which arithmetic or a check may change behaviour.
pub(crate) const NUMBERS: [f64; 24] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    1e-3,
    1e-6,
    1e-9,
    1e-12,
    1e-30,
    1e-300,
    5e-324,
    2.0,
    1e3,
    1e6,
    1e12,
    1e30,
    1e100,
    1.000_000_1e100,
    1e154,
    f64::MAX,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

/// The remaining bytes.
pub struct Input<'a> {
    data: &'a [u8],
}

impl<'a> Input<'a> {
    /// Starts at the first byte.
    pub fn new(data: &'a [u8]) -> Self {
        Self { data }
    }

    /// True if no bytes are left.
    pub fn is_empty(&self) -> bool {
        self.data.is_empty()
    }

    /// The next byte.
    pub fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.data.split_first() else { return 0 };
        self.data = rest;
        *first
    }

    /// The next `N` bytes.
    pub fn bytes<const N: usize>(&mut self) -> [u8; N] {
        std::array::from_fn(|_| self.byte())
    }

    /// At most `length` of the next bytes.
    pub fn slice(&mut self, length: usize) -> &'a [u8] {
        let (taken, rest) = self.data.split_at(length.min(self.data.len()));
        self.data = rest;
        taken
    }

    /// All remaining bytes.
    pub fn rest(&mut self) -> &'a [u8] {
        self.slice(usize::MAX)
    }

    /// A number below `count`, which is at most 256 and not 0.
    pub fn below(&mut self, count: usize) -> usize {
        self.byte() as usize % count
    }

    /// True with a probability of `of_256`/256; false after the end.
    pub fn chance(&mut self, of_256: u8) -> bool {
        !self.is_empty() && 255 - self.byte() < of_256
    }

    /// One of several values.
    pub fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }

    /// A small number, in steps of 1/32 of `scale`.
    pub fn small(&mut self, scale: f64) -> f64 {
        f64::from(self.byte() as i8) / 32.0 * scale
    }

    /// Any number.
    pub fn number(&mut self) -> f64 {
        match self.below(8) {
            0 => f64::from_le_bytes(self.bytes()),
            1 | 2 => self.one_of(&NUMBERS),
            3 => -self.one_of(&NUMBERS),
            4 => f64::from(self.byte()) * 1e3,
            _ => self.small(1.0),
        }
    }
}
