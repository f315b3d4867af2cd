//! The thread that writes the files of a log.

use super::folder::CONTACT_STATE;
use super::message::{self, Kind};
use super::options::RecordOptions;
use super::tables::Tables;
use crate::error::LogError;
use crate::event;
use crate::run::{self, Run};
use rtrb::Consumer;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Sleep of the thread when there is nothing to write. The ring must hold the data of that time.
const NAP: Duration = Duration::from_millis(5);

/// State shared by the recorder and the thread.
#[derive(Debug, Default)]
pub(super) struct Shared {
    pub failed: AtomicBool,
    pub error: Mutex<Option<String>>,
    pub frames: AtomicU64,
    pub bytes: AtomicU64,
    /// Frames that were handed over and could not be written.
    pub dropped: AtomicU64,
    /// Progress counter: rises with every write, and whenever there was nothing to write. Waiting threads use
    /// it to see whether the files still accept data.
    pub alive: AtomicU64,
    /// Frames lost before they were handed over.
    pub lost: AtomicU64,
}

/// The files of a log.
pub(super) struct Writer {
    folder: PathBuf,
    run: Run,
    tables: Tables,
    events: BufWriter<File>,
    flush_every: Duration,
}

impl Writer {
    /// Creates the files in a prepared folder.
    pub fn create(folder: &Path, run: Run, options: &RecordOptions) -> Result<Self, LogError> {
        let tables = Tables::create(folder, run.bodies.len(), options.energies)?;
        let path = folder.join(event::FILE);
        let events = File::create_new(&path).map_err(|reason| LogError::unwritable(&path, &reason))?;
        write_run(folder, &run)?;
        let events = BufWriter::new(events);
        Ok(Self { folder: folder.to_owned(), run, tables, events, flush_every: options.flush_every })
    }

    /// Writes all messages until the recorder is gone, then closes the log. Allocates nothing for frames and
    /// events: `message` has room for the longest.
    pub fn work(mut self, mut consumer: Consumer<u8>, mut message: Vec<u8>, shared: &Shared) {
        let mut flushed = Instant::now();
        loop {
            // Read before the ring, so that messages handed over before the recorder went are still written.
            let last_round = consumer.is_abandoned();
            while let Some(kind) = message::pop(&mut consumer, &mut message) {
                self.take(kind, &message, shared);
                shared.alive.fetch_add(1, Ordering::Relaxed);
                if flushed.elapsed() >= self.flush_every {
                    self.try_to(shared, Self::flush);
                    flushed = Instant::now();
                }
            }
            if last_round {
                break;
            }
            if flushed.elapsed() >= self.flush_every {
                self.try_to(shared, Self::flush);
                flushed = Instant::now();
            }
            shared.alive.fetch_add(1, Ordering::Relaxed);
            std::thread::park_timeout(NAP);
        }
        let lost = shared.lost.load(Ordering::Relaxed);
        self.try_to(shared, |writer| writer.close(lost));
    }

    fn take(&mut self, kind: Kind, message: &[u8], shared: &Shared) {
        let taken = self.try_to(shared, |writer| match kind {
            Kind::Frame => writer.tables.write(message),
            Kind::Event => writer.event(message),
            Kind::Block => write_block(&writer.folder, message),
        });
        if !taken && kind == Kind::Frame {
            shared.dropped.fetch_add(1, Ordering::Relaxed);
        }
    }

    /// Does some work unless earlier work has failed, and stores the error if it fails.
    fn try_to(&mut self, shared: &Shared, work: impl FnOnce(&mut Self) -> Result<(), LogError>) -> bool {
        if shared.failed.load(Ordering::Relaxed) {
            return false;
        }
        let done = work(self);
        shared.frames.store(self.tables.frames_flushed(), Ordering::Relaxed);
        shared.bytes.store(self.tables.bytes_flushed(), Ordering::Relaxed);
        let Err(error) = done else { return true };
        let frames = self.tables.frames_flushed();
        let text = format!("{error}; the log ends after {frames} frames");
        *shared.error.lock().unwrap_or_else(std::sync::PoisonError::into_inner) = Some(text);
        shared.failed.store(true, Ordering::Release);
        false
    }

    fn event(&mut self, line: &[u8]) -> Result<(), LogError> {
        let written = self.events.write_all(line).and_then(|()| self.events.write_all(b"\n"));
        written.map_err(|reason| LogError::unwritable(&self.folder.join(event::FILE), &reason))
    }

    /// Flushes events before tables, so that the events of a flushed frame are there.
    fn flush(&mut self) -> Result<(), LogError> {
        let flushed = self.events.flush();
        flushed.map_err(|reason| LogError::unwritable(&self.folder.join(event::FILE), &reason))?;
        self.tables.flush()
    }

    fn close(&mut self, lost: u64) -> Result<(), LogError> {
        self.flush()?;
        for (name, rows) in self.tables.rows() {
            if let Some(table) = self.run.tables.get_mut(name) {
                table.rows = Some(rows);
            }
        }
        (self.run.finished, self.run.lost) = (true, lost);
        self.run.frames = Some(self.tables.frames_flushed());
        write_run(&self.folder, &self.run)
    }
}

/// Writes run.json to a temporary file and renames it: it is complete at any time.
fn write_run(folder: &Path, run: &Run) -> Result<(), LogError> {
    let path = folder.join(run::FILE);
    let text =
        serde_json::to_string_pretty(run).map_err(|error| LogError::damaged(&path, error.to_string()))?;
    let written = pong_model::files::replace(&path, (text + "\n").as_bytes());
    written.map_err(|reason| LogError::unwritable(&path, &reason))
}

/// The file of a contact state.
pub(super) fn block_file(number: u64) -> String {
    format!("{CONTACT_STATE}{number}.bin")
}

/// Length of the head of a contact state message: its file number.
pub(super) const BLOCK_HEAD: usize = 8;

fn write_block(folder: &Path, message: &[u8]) -> Result<(), LogError> {
    let (head, block) = message.split_at(BLOCK_HEAD);
    let number = u64::from_le_bytes(std::array::from_fn(|index| head[index]));
    let path = folder.join(block_file(number));
    let write = || File::create_new(&path)?.write_all(block);
    write().map_err(|reason| LogError::unwritable(&path, &reason))
}
