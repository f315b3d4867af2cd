//! Reading a log: whole frames by number.

use crate::error::LogError;
use crate::event::{self, LoggedEvent};
use crate::run::Run;
use crate::table::{ContactRow, EnergyRow, FrameRow, Row, StateRow, TableFile, WrenchRow};
use std::path::{Path, PathBuf};

/// A log opened for reading.
///
/// A log that was cut off is read up to the last frame that is complete in every table:
/// [`frame_count`](Self::frame_count) frames.
#[derive(Debug)]
pub struct Log {
    folder: PathBuf,
    run: Run,
    events: Vec<LoggedEvent>,
    frames: TableFile<FrameRow>,
    states: TableFile<StateRow>,
    wrenches: TableFile<WrenchRow>,
    contacts: TableFile<ContactRow>,
    energies: Option<TableFile<EnergyRow>>,
    count: u64,
}

/// One frame of a log.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Number, time, limits.
    pub row: FrameRow,
    /// State of every body, in the order of [`Run::bodies`].
    pub states: Vec<StateRow>,
    /// Wrench on every body, likewise.
    pub wrenches: Vec<WrenchRow>,
    /// The contacts in the engine's order.
    pub contacts: Vec<ContactRow>,
    /// Energies, if the log has them.
    pub energies: Option<EnergyRow>,
}

impl Log {
    /// Opens a log by its folder.
    ///
    /// # Errors
    /// Files that cannot be read, are of another version, or do not fit together.
    pub fn open(folder: &Path) -> Result<Self, LogError> {
        let run = Run::load(folder)?;
        let mut log = Self {
            frames: table(folder, &run, None)?,
            states: table(folder, &run, Some(run.bodies.len()))?,
            wrenches: table(folder, &run, Some(run.bodies.len()))?,
            contacts: table(folder, &run, None)?,
            energies: match run.tables.contains_key(EnergyRow::TABLE) {
                true => Some(table(folder, &run, None)?),
                false => None,
            },
            folder: folder.to_owned(),
            events: event::load(folder)?,
            run,
            count: 0,
        };
        log.count = log.whole_frames()?;
        Ok(log)
    }

    /// The folder of the log.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Description of the tables: run.json.
    pub fn run(&self) -> &Run {
        &self.run
    }

    /// The host's changes between frames, in order.
    pub fn events(&self) -> &[LoggedEvent] {
        &self.events
    }

    /// The file of a model.
    pub fn model_path(&self, model: usize) -> Option<PathBuf> {
        self.run.models.get(model).map(|model| self.folder.join(&model.file))
    }

    /// Number of whole frames.
    pub fn frame_count(&self) -> u64 {
        self.count
    }

    /// True if the log was closed and all its frames are there.
    pub fn is_whole(&self) -> bool {
        self.run.finished && self.run.frames == Some(self.count)
    }

    /// Rows of the table of frames from index `first` on, at most `count`; fewer at the end of the log.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn frame_rows(&mut self, first: u64, count: u64) -> Result<Vec<FrameRow>, LogError> {
        let first = first.min(self.count);
        let mut rows = Vec::new();
        self.frames.read(first, count.min(self.count - first), &mut rows)?;
        Ok(rows)
    }

    /// Reads one frame, by its index in the log, into `frame`, whose memory is reused.
    ///
    /// # Errors
    /// A frame that does not exist, or a file that cannot be read or does not fit the others.
    pub fn read(&mut self, index: u64, frame: &mut Frame) -> Result<(), LogError> {
        frame.row = self.row(index)?;
        frame.states.clear();
        frame.wrenches.clear();
        frame.contacts.clear();
        self.states.read(index, 1, &mut frame.states)?;
        self.wrenches.read(index, 1, &mut frame.wrenches)?;
        self.contacts.read(frame.row.first_contact, frame.row.contacts.into(), &mut frame.contacts)?;
        self.check_contacts(frame)?;
        let mut energies = Vec::new();
        if let Some(table) = &mut self.energies {
            table.read(index, 1, &mut energies)?;
        }
        frame.energies = energies.pop();
        Ok(())
    }

    /// As [`read`](Self::read), into a new frame.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn frame(&mut self, index: u64) -> Result<Frame, LogError> {
        let mut frame = Frame::default();
        self.read(index, &mut frame)?;
        Ok(frame)
    }

    fn row(&mut self, index: u64) -> Result<FrameRow, LogError> {
        if index >= self.count {
            let cause = format!("frame {index} is asked for, the log has {}", self.count);
            return Err(LogError::refused(cause, "ask for one that is there"));
        }
        let mut rows = Vec::with_capacity(1);
        self.frames.read(index, 1, &mut rows)?;
        Ok(rows[0])
    }

    /// Number of rows of `frames` that are complete in every other table.
    fn whole_frames(&mut self) -> Result<u64, LogError> {
        let energies = self.energies.as_ref().map_or(u64::MAX, TableFile::rows);
        let others = [self.states.rows(), self.wrenches.rows(), energies];
        self.count = others.into_iter().fold(self.frames.rows(), u64::min);
        while self.count > 0 {
            let last = self.row(self.count - 1)?;
            if last.first_contact.saturating_add(last.contacts.into()) <= self.contacts.rows() {
                break;
            }
            self.count -= 1;
        }
        Ok(self.count)
    }

    fn check_contacts(&self, frame: &Frame) -> Result<(), LogError> {
        let run = &self.run;
        for contact in &frame.contacts {
            let known = (contact.pair as usize) < run.pairs.len()
                && [contact.primitive_a, contact.primitive_b]
                    .iter()
                    .all(|index| (*index as usize) < run.primitives.len());
            if contact.frame != frame.row.frame || !known {
                let cause = format!(
                    "a contact of frame {} is of frame {}, pair {} and primitives {} and {}, which do not fit run.json",
                    frame.row.frame, contact.frame, contact.pair, contact.primitive_a, contact.primitive_b
                );
                let file = &run.tables[ContactRow::TABLE].file;
                return Err(LogError::damaged(&self.folder.join(file), cause));
            }
        }
        Ok(())
    }
}

fn table<R: Row>(folder: &Path, run: &Run, columns: Option<usize>) -> Result<TableFile<R>, LogError> {
    let Some(table) = run.tables.get(R::TABLE) else {
        let cause = format!("it names no table `{}`", R::TABLE);
        return Err(LogError::damaged(&folder.join(crate::run::FILE), cause));
    };
    TableFile::open(&folder.join(&table.file), columns)
}
