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

/// How long the thread sleeps when there is nothing to write. The ring must hold what comes meanwhile.
const NAP: Duration = Duration::from_millis(5);

/// What the recorder and the thread tell each other.
#[derive(Debug, Default)]
pub(super) struct Shared {
    pub failed: AtomicBool,
    pub error: Mutex<Option<String>>,
    pub frames: AtomicU64,
    pub bytes: AtomicU64,
    /// Frames that were handed over and could not be written.
    pub dropped: AtomicU64,
    /// Rises with everything that the files took, and whenever there was nothing to take: who waits for the files sees
    /// whether they go on.
    pub alive: AtomicU64,
    /// Frames that were never handed over.
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
    /// Begins the files in a folder that was prepared.
    pub fn create(folder: &Path, run: Run, options: &RecordOptions) -> Result<Self, LogError> {
        let tables = Tables::create(folder, run.bodies.len(), options.energies)?;
        let path = folder.join(event::FILE);
        let events = File::create_new(&path).map_err(|reason| LogError::unwritable(&path, &reason))?;
        write_run(folder, &run)?;
        let events = BufWriter::new(events);
        Ok(Self { folder: folder.to_owned(), run, tables, events, flush_every: options.flush_every })
    }

    /// Writes what comes until the recorder is gone, then closes the log. Takes no memory for frames and events:
    /// `message` has room for the longest.
    pub fn work(mut self, mut consumer: Consumer<u8>, mut message: Vec<u8>, shared: &Shared) {
        let mut flushed = Instant::now();
        loop {
            // Asked before the ring is: what was handed over before the recorder went is still written.
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

    /// Does something unless something before it has failed, and keeps why it failed.
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

    /// Events first: those of a frame that counts are there.
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

/// Writes run.json beside itself and puts it in place: it is whole at any time.
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

/// Length of what a message says of a contact state before its bytes: its number.
pub(super) const BLOCK_HEAD: usize = 8;

fn write_block(folder: &Path, message: &[u8]) -> Result<(), LogError> {
    let (head, block) = message.split_at(BLOCK_HEAD);
    let number = u64::from_le_bytes(std::array::from_fn(|index| head[index]));
    let path = folder.join(block_file(number));
    let write = || File::create_new(&path)?.write_all(block);
    write().map_err(|reason| LogError::unwritable(&path, &reason))
}
