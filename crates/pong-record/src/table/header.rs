//! The header of a NumPy file of a structured type (format 1.0), with room for any number of rows.

use super::Field;
use std::fmt::Write as _;

/// Room for the count: as many digits as a number of 64 bits has.
const DIGITS: usize = 20;
/// NumPy aligns the data to this.
const GRAIN: usize = 64;

/// The header of a table with so many rows. Its length does not depend on the number. `columns` is the second axis.
pub fn header(fields: &[Field], rows: u64, columns: Option<usize>) -> Vec<u8> {
    let mut text = String::from("{'descr': [");
    for (index, field) in fields.iter().enumerate() {
        let comma = if index > 0 { ", " } else { "" };
        let _ = write!(text, "{comma}('{}', '{}'", field.name, field.kind);
        if field.count > 0 {
            let _ = write!(text, ", ({},)", field.count);
        }
        text.push(')');
    }
    let _ = write!(text, "], 'fortran_order': False, 'shape': ({rows},");
    if let Some(columns) = columns {
        let _ = write!(text, " {columns}");
    }
    text.push_str("), }");
    let spare = DIGITS - rows.to_string().len();
    let unpadded = 10 + text.len() + spare + 1;
    let padding = unpadded.next_multiple_of(GRAIN) - unpadded + spare;
    text.extend(std::iter::repeat_n(' ', padding));
    text.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend_from_slice(&u16::try_from(text.len()).expect("a table has few fields").to_le_bytes());
    bytes.extend_from_slice(text.as_bytes());
    bytes
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
