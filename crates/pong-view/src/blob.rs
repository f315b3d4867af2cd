//! The binary part of the page: packed columns of numbers, in the order in which the page reads them.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::DeflateEncoder;
use serde::Serialize;
use std::io::Write;

/// Range of a column in the unpacked bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub(crate) struct Column {
    /// Type of its numbers: `f64`, `f32`, `u32` or `u8`, little endian.
    #[serde(rename = "type")]
    kind: &'static str,
    /// First byte, a multiple of eight.
    offset: usize,
    /// Number of values.
    length: usize,
}

impl Column {
    pub fn length(&self) -> usize {
        self.length
    }
}

/// Columns one after the other. Each is stored with the first bytes of its numbers first, then their second
/// bytes and so on, because equal high bytes side by side compress much better.
#[derive(Default)]
pub(crate) struct Blob {
    bytes: Vec<u8>,
}

impl Blob {
    pub fn f64s(&mut self, numbers: impl IntoIterator<Item = f64>) -> Column {
        self.add("f64", numbers.into_iter().map(f64::to_le_bytes))
    }

    /// Adds numbers in single precision.
    pub fn f32s(&mut self, numbers: impl IntoIterator<Item = f64>) -> Column {
        self.add("f32", numbers.into_iter().map(|number| (number as f32).to_le_bytes()))
    }

    pub fn u32s(&mut self, numbers: impl IntoIterator<Item = u32>) -> Column {
        self.add("u32", numbers.into_iter().map(u32::to_le_bytes))
    }

    pub fn u8s(&mut self, numbers: impl IntoIterator<Item = u8>) -> Column {
        self.add("u8", numbers.into_iter().map(|number| [number]))
    }

    /// Size before packing, bytes.
    pub fn len(&self) -> usize {
        self.bytes.len()
    }

    fn add<const WIDTH: usize>(
        &mut self,
        kind: &'static str,
        numbers: impl Iterator<Item = [u8; WIDTH]>,
    ) -> Column {
        let numbers: Vec<_> = numbers.collect();
        self.bytes.resize(self.bytes.len().next_multiple_of(8), 0);
        let offset = self.bytes.len();
        for place in 0..WIDTH {
            self.bytes.extend(numbers.iter().map(|number| number[place]));
        }
        Column { kind, offset, length: numbers.len() }
    }

    /// The bytes, deflated and encoded as text.
    pub fn packed(&self) -> std::io::Result<String> {
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(&self.bytes)?;
        Ok(STANDARD.encode(encoder.finish()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    #[test]
    fn columns_come_back() {
        let mut blob = Blob::default();
        let first = blob.u8s([7, 8, 9]);
        let second = blob.f32s([1.5, -2.25]);
        let text = blob.packed().unwrap();
        let packed = STANDARD.decode(text).unwrap();
        let mut bytes = Vec::new();
        flate2::read::DeflateDecoder::new(&packed[..]).read_to_end(&mut bytes).unwrap();
        assert_eq!(bytes[first.offset..first.offset + first.length], [7, 8, 9]);
        assert_eq!((second.offset, second.length), (8, 2));
        let number = |index: usize| {
            f32::from_le_bytes([0, 1, 2, 3].map(|place| bytes[second.offset + place * second.length + index]))
        };
        assert_eq!([number(0), number(1)], [1.5, -2.25]);
    }
}
