//! Reading a table: rows by number, through a window that moves over the file.

use super::field::Field;
use super::rows::Row;
use crate::error::LogError;
use npyz::{DType, NpyHeader, Order};
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::marker::PhantomData;
use std::path::{Path, PathBuf};

/// Bytes read at once in sequential reading.
const WINDOW: usize = 1 << 18;

/// A table of a log, open for reading. A row is one entry of the first axis.
#[derive(Debug)]
pub struct TableFile<R> {
    path: PathBuf,
    file: File,
    /// Offset of the first row, bytes.
    start: u64,
    rows: u64,
    columns: usize,
    item: usize,
    offsets: Vec<usize>,
    window: Vec<u8>,
    window_at: u64,
    kind: PhantomData<R>,
}

impl<R: Row> TableFile<R> {
    /// Opens a table, whose second axis must have length `columns`, if given.
    ///
    /// # Errors
    /// A file that cannot be read, is no NumPy file, or lacks a field.
    pub fn open(path: &Path, columns: Option<usize>) -> Result<Self, LogError> {
        let damaged = |cause: String| LogError::damaged(path, cause);
        let mut file = pong_model::files::open(path).map_err(|reason| LogError::unreadable(path, &reason))?;
        let read = NpyHeader::from_reader(&mut file);
        let header = read.map_err(|reason| damaged(format!("its header cannot be read: {reason}")))?;
        let start = file.stream_position().map_err(|reason| LogError::unreadable(path, &reason))?;
        if header.order() != Order::C {
            return Err(damaged("its rows are in Fortran's order".to_owned()));
        }
        let (offsets, item) = offsets(&header.dtype(), R::FIELDS).map_err(damaged)?;
        let (told, wide) = match (header.shape(), columns) {
            ([rows], None) => (*rows, 1),
            ([rows, wide], Some(columns)) if *wide == columns as u64 => (*rows, columns),
            (shape, Some(columns)) => {
                return Err(damaged(format!("its axes are {shape:?}, not (frames, {columns} bodies)")));
            }
            (shape, None) => return Err(damaged(format!("its axes are {shape:?}, not one of rows"))),
        };
        let row = (wide * item) as u64;
        let length = file.metadata().map_err(|reason| LogError::unreadable(path, &reason))?.len();
        // A truncated file, such as a partial copy, has fewer rows than its header says.
        let there = length.saturating_sub(start).checked_div(row).unwrap_or(told);
        Ok(Self {
            path: path.to_owned(),
            file,
            start,
            rows: told.min(there),
            columns: wide,
            item,
            offsets,
            window: Vec::new(),
            window_at: 0,
            kind: PhantomData,
        })
    }

    /// Number of rows in the file.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Appends `count` rows, from `first` on, to `out`.
    ///
    /// # Errors
    /// Rows that do not exist, or a file that cannot be read.
    pub fn read(&mut self, first: u64, count: u64, out: &mut Vec<R>) -> Result<(), LogError> {
        let end = first.checked_add(count).filter(|end| *end <= self.rows);
        if end.is_none() {
            let cause = format!(
                "rows {first} to {} are asked for, it has {}",
                first.saturating_add(count),
                self.rows
            );
            return Err(LogError::damaged(&self.path, cause));
        }
        let wide = (self.columns * self.item) as u64;
        let at_once = (WINDOW as u64 / wide.max(1)).max(1);
        let mut next = first;
        while next < first + count {
            let some = at_once.min(first + count - next);
            let range = self.bytes(next * wide, (some * wide) as usize)?;
            let rows = self.window[range].chunks_exact(self.item.max(1));
            out.extend(rows.map(|bytes| R::get(bytes, &self.offsets)));
            next += some;
        }
        Ok(())
    }

    /// Loads these bytes, counted from the end of the header, into the window; returns their range there.
    fn bytes(&mut self, at: u64, count: usize) -> Result<std::ops::Range<usize>, LogError> {
        let inside = |at: u64, window_at: u64, len: usize| {
            at >= window_at && at + count as u64 <= window_at + len as u64
        };
        if !inside(at, self.window_at, self.window.len()) {
            let left = self.rows * (self.columns * self.item) as u64 - at;
            let length = (WINDOW.max(count) as u64).min(left) as usize;
            self.window.resize(length, 0);
            let read = self
                .file
                .seek(SeekFrom::Start(self.start + at))
                .and_then(|_| self.file.read_exact(&mut self.window));
            if let Err(reason) = read {
                self.window.clear();
                return Err(LogError::unreadable(&self.path, &reason));
            }
            self.window_at = at;
        }
        let from = (at - self.window_at) as usize;
        Ok(from..from + count)
    }
}

/// Fields with another name in version 1 of the format, and that name.
const FORMER_NAMES: [(&str, &str); 1] = [("depth_rate", "rate")];

/// Offsets of the wanted fields in an item, and the item's size. Other fields are skipped.
fn offsets(dtype: &DType, wanted: &[Field]) -> Result<(Vec<usize>, usize), String> {
    let DType::Record(fields) = dtype else { return Err("its type is not structured".to_owned()) };
    let mut places = Vec::new();
    let mut at = 0;
    for field in fields {
        places.push((field.name.as_str(), &field.dtype, at));
        at += field.dtype.num_bytes().ok_or_else(|| format!("field `{}` has no fixed size", field.name))?;
    }
    let find = |field: &Field| {
        let is = |name: &str| name == field.name || FORMER_NAMES.contains(&(field.name, name));
        let place = places.iter().find(|(name, ..)| is(name));
        let (_, dtype, at) = place.ok_or_else(|| format!("field `{}` is missing", field.name))?;
        if is_like(dtype, field) {
            Ok(*at)
        } else {
            let (name, found) = (field.name, dtype.descr());
            Err(format!("field `{name}` is {found}, not {} × {}", field.count.max(1), field.kind))
        }
    };
    Ok((wanted.iter().map(find).collect::<Result<_, String>>()?, at))
}

fn is_like(dtype: &DType, field: &Field) -> bool {
    match (dtype, field.count) {
        (DType::Plain(kind), 0) => kind.to_string() == field.kind,
        (DType::Array(count, inner), wanted) => {
            *count as usize == wanted
                && matches!(&**inner, DType::Plain(kind) if kind.to_string() == field.kind)
        }
        _ => false,
    }
}
