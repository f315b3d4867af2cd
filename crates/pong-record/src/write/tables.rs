//! The growing tables of a log.

use super::describe::file;
use crate::error::LogError;
use crate::table::{ContactRow, EnergyRow, Field, FrameRow, Row, StateRow, WrenchRow, header, write_header};
use std::fs::File;
use std::io::{BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// Size of a table's write buffer, bytes.
const GATHERED: usize = 1 << 17;

/// Offset of `first_contact` in a row of `frames`.
const FIRST_CONTACT: usize = 16;

/// One table.
struct Table {
    name: &'static str,
    path: PathBuf,
    out: BufWriter<File>,
    fields: &'static [Field],
    columns: Option<usize>,
    /// The header last written. Its memory is reused.
    header: Vec<u8>,
    /// Bytes of a row (an entry of the first axis).
    row: usize,
    rows: u64,
    flushed: u64,
}

impl Table {
    fn create<R: Row>(folder: &Path, columns: Option<usize>) -> Result<Self, LogError> {
        let path = folder.join(file(R::TABLE));
        let header = header(R::FIELDS, 0, columns);
        let made = File::create_new(&path).and_then(|mut file| file.write_all(&header).map(|()| file));
        let file = made.map_err(|reason| LogError::unwritable(&path, &reason))?;
        Ok(Self {
            name: R::TABLE,
            out: BufWriter::with_capacity(GATHERED, file),
            path,
            fields: R::FIELDS,
            columns,
            header,
            row: R::SIZE * columns.unwrap_or(1),
            rows: 0,
            flushed: 0,
        })
    }

    fn write(&mut self, rows: u64, bytes: &[u8]) -> Result<(), LogError> {
        self.out.write_all(bytes).map_err(|reason| LogError::unwritable(&self.path, &reason))?;
        self.rows += rows;
        Ok(())
    }

    /// Writes the rows first, then their number.
    fn flush(&mut self) -> Result<(), LogError> {
        if self.rows == self.flushed {
            return Ok(());
        }
        write_header(self.fields, self.rows, self.columns, &mut self.header);
        let mut write = || {
            self.out.flush()?;
            let file = self.out.get_mut();
            file.seek(SeekFrom::Start(0))?;
            file.write_all(&self.header)?;
            file.seek(SeekFrom::End(0))
        };
        write().map_err(|reason| LogError::unwritable(&self.path, &reason))?;
        self.flushed = self.rows;
        Ok(())
    }
}

/// All tables of a log.
pub(super) struct Tables {
    /// Tables in flush order: every row of the last is complete in the others.
    tables: Vec<Table>,
}

impl Tables {
    pub fn create(folder: &Path, bodies: usize, energies: bool) -> Result<Self, LogError> {
        let mut tables = vec![
            Table::create::<ContactRow>(folder, None)?,
            Table::create::<StateRow>(folder, Some(bodies))?,
            Table::create::<WrenchRow>(folder, Some(bodies))?,
        ];
        if energies {
            tables.push(Table::create::<EnergyRow>(folder, None)?);
        }
        tables.push(Table::create::<FrameRow>(folder, None)?);
        Ok(Self { tables })
    }

    /// Writes a frame in the form of [`Capture`](super::capture::Capture).
    pub fn write(&mut self, frame: &[u8]) -> Result<(), LogError> {
        let mut row = [0; FrameRow::SIZE];
        row.copy_from_slice(&frame[..FrameRow::SIZE]);
        row[FIRST_CONTACT..][..8].copy_from_slice(&self.tables[0].rows.to_le_bytes());
        let contacts = (frame.len() - FrameRow::SIZE - self.rest_without_contacts()) / ContactRow::SIZE;
        let mut rest = &frame[FrameRow::SIZE..];
        let others = 1..self.tables.len() - 1;
        for table in &mut self.tables[others] {
            let (bytes, later) = rest.split_at(table.row);
            table.write(1, bytes)?;
            rest = later;
        }
        self.tables[0].write(contacts as u64, rest)?;
        self.frames().write(1, &row)
    }

    fn rest_without_contacts(&self) -> usize {
        self.tables[1..self.tables.len() - 1].iter().map(|table| table.row).sum()
    }

    fn frames(&mut self) -> &mut Table {
        self.tables.last_mut().expect("frames is always there")
    }

    pub fn flush(&mut self) -> Result<(), LogError> {
        self.tables.iter_mut().try_for_each(Table::flush)
    }

    /// Number of frames flushed.
    pub fn frames_flushed(&self) -> u64 {
        self.tables.last().map_or(0, |table| table.flushed)
    }

    /// Bytes of all rows flushed.
    pub fn bytes_flushed(&self) -> u64 {
        self.tables.iter().map(|table| table.flushed * table.row as u64).sum()
    }

    /// Name and row count of each table.
    pub fn rows(&self) -> impl Iterator<Item = (&'static str, u64)> + '_ {
        self.tables.iter().map(|table| (table.name, table.rows))
    }
}
