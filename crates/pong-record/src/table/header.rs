//! The header of a NumPy file of a structured type (format 1.0), with room for any number of rows.

use super::field::Field;
use std::io::Write as _;

/// Width of the row count: the digits of a number of 64 bits.
const DIGITS: usize = 20;
/// Bytes before the text: magic, version and the length of the text.
const HEAD: usize = 10;
/// NumPy's alignment of the data.
const GRAIN: usize = 64;

/// The header of a table with `rows` rows. Its length does not depend on that number. `columns` is the second
/// axis.
pub fn header(fields: &[Field], rows: u64, columns: Option<usize>) -> Vec<u8> {
    let mut out = Vec::new();
    write_header(fields, rows, columns, &mut out);
    out
}

/// As [`header`], into memory that is reused. Writing to memory cannot fail.
pub(crate) fn write_header(fields: &[Field], rows: u64, columns: Option<usize>, out: &mut Vec<u8>) {
    out.clear();
    out.extend_from_slice(b"\x93NUMPY\x01\x00\x00\x00");
    out.extend_from_slice(b"{'descr': [");
    for (index, field) in fields.iter().enumerate() {
        let comma = if index > 0 { ", " } else { "" };
        let _ = write!(out, "{comma}('{}', '{}'", field.name, field.kind);
        if field.count > 0 {
            let _ = write!(out, ", ({},)", field.count);
        }
        out.push(b')');
    }
    let _ = write!(out, "], 'fortran_order': False, 'shape': (");
    let before = out.len();
    let _ = write!(out, "{rows}");
    let spare = DIGITS - (out.len() - before);
    out.push(b',');
    if let Some(columns) = columns {
        let _ = write!(out, " {columns}");
    }
    out.extend_from_slice(b"), }");
    let length = (out.len() + spare + 1).next_multiple_of(GRAIN);
    out.resize(length - 1, b' ');
    out.push(b'\n');
    let text = u16::try_from(length - HEAD).expect("a table has few fields");
    out[HEAD - 2..HEAD].copy_from_slice(&text.to_le_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::{ContactRow, Row, StateRow};

    #[test]
    fn the_length_does_not_depend_on_the_count() {
        for columns in [None, Some(1), Some(12)] {
            let lengths: Vec<usize> =
                [0, 9, 10, u64::MAX].map(|rows| header(ContactRow::FIELDS, rows, columns).len()).to_vec();
            assert!(lengths.iter().all(|length| *length == lengths[0] && length % 64 == 0), "{lengths:?}");
        }
    }

    #[test]
    fn another_reader_understands_it() {
        let bytes = header(StateRow::FIELDS, 12, Some(3));
        let read = npyz::NpyHeader::from_reader(&bytes[..]).unwrap();
        assert_eq!(read.shape(), [12, 3]);
        assert_eq!(read.dtype().num_bytes(), Some(StateRow::SIZE));
    }
}
