//! The recorder's part in the frame: allocates nothing, touches no file, and waits only on request.

use super::capture::Capture;
use super::commits::Commits;
use super::message::{self, Kind};
use super::models::{self, ModelSource};
use super::options::{RecordOptions, WhenFull};
use super::thread::{BLOCK_HEAD, Shared, Writer, block_file};
use super::{describe, folder};
use crate::error::LogError;
use crate::event::{Event, LoggedEvent};
use crate::table::{EnergyRow, FrameRow};
use pong_arena::{keep_small_blocks_free, require_memory};
use pong_engine::{EngineError, InterfaceId, ModelId, ObjectId, PairId, SurfaceMotion, World};
use pong_model::Surface;
use rtrb::{Producer, RingBuffer};
use std::io::Write as _;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Records a sealed world.
///
/// The host reports every evaluation, commit and change to the recorder; [`record`](Self::record) writes the
/// frame last computed. Dropping it closes the log; [`finish`](Self::finish) does so too and returns errors.
#[derive(Debug)]
pub struct Recorder {
    /// `None` once the log is closed.
    producer: Option<Producer<u8>>,
    thread: Option<JoinHandle<()>>,
    shared: Arc<Shared>,
    capture: Capture,
    commits: Commits,
    when_full: WhenFull,
    /// Number of the next frame.
    next: u64,
    lost: u64,
    /// Lost events that are not noted in the log yet: the frame of the first, and their number.
    events_lost: Option<(u64, u64)>,
    events_lost_ever: u64,
    blocks: u64,
    /// Buffer for lines of events. Its memory is reused.
    line: Vec<u8>,
    peak: usize,
    size: usize,
    longest_wait: Duration,
    /// True if the files accepted nothing for so long that the thread is no longer waited for.
    gave_up: bool,
    /// PID of the process that writes the log. The thread does not survive a fork.
    process: u32,
    /// Hash of the scene that is recorded.
    scene: u64,
}

/// Progress of a log.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RecordStatus {
    /// Frames recorded, including lost ones.
    pub frames: u64,
    /// Frames flushed to the files: a run that is cut off now keeps them.
    pub flushed: u64,
    /// Frames missing in the log for good.
    pub lost: u64,
    /// Events missing in the log for good.
    pub events_lost: u64,
    /// Bytes of the rows flushed.
    pub bytes: u64,
    /// Largest number of bytes that waited for the files, at most [`buffer_size`](Self::buffer_size).
    pub buffer_peak: usize,
    /// Bytes that may wait for the files.
    pub buffer_size: usize,
    /// Reason why writing has stopped, if it has.
    pub error: Option<String>,
}

/// Default number of bytes that may wait for the files.
const BUFFER: usize = 16 << 20;
/// Bytes that frames leave free for events.
const ROOM_FOR_EVENTS: usize = 1 << 16;
/// Longest line of an event that is written in a frame, bytes.
const LINE: usize = 768;
const DIGITS_OF_A_PAIR: usize = 11;
/// Upper bound of the other memory of the thread and its files, bytes: a stack and the buffers of tables.
const FILES: usize = 4 << 20;
/// Polling interval of a thread that waits for the files.
const LOOK: Duration = Duration::from_micros(200);
/// Error of a log used in a fork of its process.
const OF_THE_PARENT: &str = "log: it belongs to the process that began it, not to this fork of it; stop it here and begin one in another folder";

impl Recorder {
    /// Begins a log of a sealed world in a folder. `models` are the sources of the models, in the order in
    /// which they were added. The contact state, switched pairs and changed surfaces go into the log, so that
    /// it may begin at any time.
    ///
    /// # Errors
    /// A folder that cannot be written or holds a log, a model whose files have changed.
    pub fn start(
        world: &World,
        folder: &Path,
        models: &[ModelSource],
        options: &RecordOptions,
    ) -> Result<Self, LogError> {
        let state_size = world.state_size();
        let mut capture = Capture::new(world, options.energies)?;
        let frame = capture.size(world.contact_capacity());
        let pairs = world.scene().pairs().len();
        let line = LINE + pairs * DIGITS_OF_A_PAIR;
        let least = (2 * message::room(&[line, frame])).max(message::room(&[BLOCK_HEAD + state_size]));
        let wanted = options.buffer_bytes.unwrap_or(BUFFER).max(least) + ROOM_FOR_EVENTS;
        let longest = frame.max(BLOCK_HEAD + state_size).max(line);
        // The ring, the buffers of the thread and of the frame, and one copy of the contact state.
        let kept = 2 * frame + line + state_size + FILES;
        require(wanted.saturating_add(longest).saturating_add(kept))?;
        folder::prepare(folder, options.overwrite)?;
        let models = models::keep(world, models, folder)?;
        let run = describe::describe(world, models, options)?;
        capture.take_room(frame);
        let (producer, consumer) = ring(wanted);
        let writer = Writer::create(folder, run, options)?;
        let shared = Arc::new(Shared::default());
        // Before the thread starts, because the allocator reserves address space for it.
        let (line, message) = (Vec::with_capacity(line), Vec::with_capacity(longest));
        let block = if world.has_contact_state() { vec![0; state_size] } else { Vec::new() };
        keep_small_blocks_free();
        let thread = {
            let (shared, on_start) = (Arc::clone(&shared), options.on_thread_start);
            std::thread::Builder::new().name("pong log".to_owned()).spawn(move || {
                on_start.iter().for_each(|call| call());
                writer.work(consumer, message, &shared);
            })
        };
        let thread = thread.map_err(|reason| {
            LogError::refused(
                format!("no thread could be started: {reason}"),
                "let the system have more threads",
            )
        })?;
        let mut recorder = Self {
            producer: Some(producer),
            thread: Some(thread),
            shared,
            capture,
            commits: Commits::new(pairs),
            when_full: options.when_full,
            next: 0,
            lost: 0,
            events_lost: None,
            events_lost_ever: 0,
            blocks: 0,
            line,
            peak: 0,
            size: wanted,
            longest_wait: options.longest_wait,
            gave_up: false,
            process: std::process::id(),
            scene: world.scene_hash(),
        };
        recorder.tell_how_it_begins(world, block)?;
        Ok(recorder)
    }

    /// Notes that the world was evaluated.
    pub fn evaluated(&mut self) {
        self.commits.evaluated();
    }

    /// Notes that the evaluation was committed.
    pub fn committed(&mut self) {
        self.commits.committed();
    }

    /// Notes that the evaluation was committed for these pairs.
    pub fn committed_some(&mut self, pairs: &[PairId]) {
        self.commits.committed_some(pairs);
    }

    /// Records the frame last computed, with this time (s). `evaluate_ns` is 0 if it was not measured. A
    /// frame for which there is no room is lost, or waits, by the options; that is no error.
    ///
    /// # Errors
    /// A world of another scene; one without a frame, or whose states, pairs or surfaces are no longer those of its frame; a
    /// time that is not finite.
    pub fn record(
        &mut self,
        world: &World,
        time: f64,
        evaluate_ns: u64,
        energies: Option<&EnergyRow>,
    ) -> Result<(), LogError> {
        if !time.is_finite() {
            return Err(LogError::refused(format!("the time is {time}"), "give a finite time in s"));
        }
        if world.scene_hash() != self.scene {
            let cause = "this is a frame of a world with other Objects than those that are recorded";
            let cure = "finish this log, and begin one of that world in another folder";
            return Err(LogError::refused(cause, cure));
        }
        if !world.frame_is_current() {
            let call = "record a frame";
            let cure = "record it after it was evaluated and before states, pairs or surfaces change";
            return Err(EngineError::WrongPhase { call, cure }.into());
        }
        let report = world.report();
        let mut row = FrameRow {
            frame: self.next,
            time,
            // The thread fills this in: it knows the number of rows in the table.
            first_contact: 0,
            contacts: report.contacts,
            flags: report.status.bits(),
            evaluate_ns,
            committed: FrameRow::EVALUATED,
            commits_missed: 0,
        };
        self.commits.tell(&mut row);
        if !self.hand_over(world, &row, energies)? {
            self.commits.lost(&row);
            self.lost += 1;
            self.shared.lost.store(self.lost, Ordering::Relaxed);
        }
        self.next += 1;
        Ok(())
    }

    /// Logs that a pair was switched on or off.
    pub fn pair_switched(&mut self, pair: PairId, enabled: bool) {
        self.tell(Event::Pair { pair: pair.index() as u32, enabled });
    }

    /// Logs that the contact history of an Object was cleared.
    pub fn forgot(&mut self, object: ObjectId) {
        self.tell(Event::ClearContactHistory { object: object.index() as u32 });
    }

    /// Logs the new values of a surface. Allocates.
    pub fn surface_set(&mut self, model: ModelId, surface: &Surface) {
        let (model, name) = (model.index() as u32, surface.name.clone());
        self.tell(Event::Surface { model, name, values: surface.into() });
    }

    /// Logs motions of surfaces along themselves.
    pub fn surfaces_moved(&mut self, motions: &[(InterfaceId, SurfaceMotion)]) {
        for (interface, motion) in motions {
            self.tell(Event::SurfaceMotion {
                body: interface.index() as u32,
                velocity: [motion.linear_velocity, motion.angular_velocity, motion.belt_velocity],
                travel: [motion.linear_travel, motion.angular_travel, motion.belt_travel],
            });
        }
    }

    /// Logs a restored contact state; `block` is trimmed to the used length.
    pub fn restored(&mut self, block: &[u8]) {
        if !self.push(Kind::Block, &[&self.blocks.to_le_bytes(), block]) {
            self.event_was_lost();
            return;
        }
        self.line.clear();
        let (frame, file) = (self.next, self.blocks);
        // As `block_file`, which allocates.
        let _ = write!(
            self.line,
            "{{\"frame\":{frame},\"event\":\"restore\",\"file\":\"contact_state_{file}.bin\"}}"
        );
        debug_assert!(String::from_utf8_lossy(&self.line).contains(&block_file(file)));
        self.blocks += 1;
        self.event();
    }

    /// Progress of the log. Allocates only after a failure.
    pub fn status(&self) -> RecordStatus {
        let shared = &self.shared;
        let error = if self.is_forked() {
            // Not read from the shared text: another thread may have held its lock when the process was
            // forked.
            Some(OF_THE_PARENT.to_owned())
        } else if shared.failed.load(Ordering::Acquire) {
            shared.error.lock().unwrap_or_else(std::sync::PoisonError::into_inner).clone()
        } else {
            None
        };
        RecordStatus {
            frames: self.next,
            flushed: shared.frames.load(Ordering::Relaxed),
            lost: self.lost + shared.dropped.load(Ordering::Relaxed),
            events_lost: self.events_lost_ever,
            bytes: shared.bytes.load(Ordering::Relaxed),
            buffer_peak: self.peak,
            buffer_size: self.size,
            error,
        }
    }

    /// Writes the rest and closes the log.
    ///
    /// # Errors
    /// The cause why files could not be written, now or earlier, and where the log ends.
    pub fn finish(mut self) -> Result<RecordStatus, LogError> {
        self.close();
        let status = self.status();
        match status.error {
            None => Ok(status),
            Some(text) => Err(LogError::Ended { text }),
        }
    }

    /// Writes the rest and closes the log; [`status`](Self::status) has the outcome. Nothing is recorded
    /// after that. Files that accept nothing for [`longest_wait`](RecordOptions::longest_wait) are given up.
    pub fn close(&mut self) {
        if self.is_forked() {
            // The thread and its data belong to the parent process.
            std::mem::forget(self.thread.take());
            self.producer = None;
            return;
        }
        self.when_full = WhenFull::Wait;
        self.tell_lost();
        self.producer = None;
        let Some(thread) = self.thread.take().filter(|_| !self.gave_up) else { return };
        thread.thread().unpark();
        let mut limit = WaitLimit::new(&self.shared, self.longest_wait);
        while !thread.is_finished() {
            if limit.is_at_an_end(&self.shared) {
                return self.give_up();
            }
            std::thread::sleep(LOOK);
        }
        if thread.join().is_err() {
            self.fail(
                "log: the thread that writes it has failed; the log ends where it was flushed".to_owned(),
            );
        }
    }

    /// Gives up files that accept nothing: the thread's remaining data are lost.
    fn give_up(&mut self) {
        self.gave_up = true;
        let frames = self.shared.frames.load(Ordering::Relaxed);
        let waited = self.longest_wait.as_secs_f64();
        self.fail(format!("log: the files took nothing for {waited} s; the log ends after {frames} frames"));
    }

    fn fail(&mut self, text: String) {
        *self.shared.error.lock().unwrap_or_else(std::sync::PoisonError::into_inner) = Some(text);
        self.shared.failed.store(true, Ordering::Release);
    }

    /// True if this is a copy of the recorder in a fork of its process.
    fn is_forked(&self) -> bool {
        self.process != std::process::id()
    }

    fn tell_how_it_begins(&mut self, world: &World, mut block: Vec<u8>) -> Result<(), LogError> {
        for (id, model) in world.scene().models() {
            let surfaces = world.surfaces(id)?.iter().zip(&model.surfaces);
            for (surface, _) in surfaces.filter(|(now, authored)| now != authored) {
                self.surface_set(id, surface);
            }
        }
        for (pair, _) in world.scene().pairs() {
            if !world.pair_enabled(pair)? {
                self.pair_switched(pair, false);
            }
        }
        if world.surfaces_may_move() {
            for object in world.scene().objects() {
                for body in world.scene().interfaces(object)? {
                    self.surfaces_moved(&[(body, *world.surface_motion(body)?)]);
                }
            }
        }
        if world.has_contact_state() {
            world.save_state_packed(&mut block);
            self.restored(&block);
        }
        Ok(())
    }

    /// Hands a frame to the thread; false if there was no room.
    fn hand_over(
        &mut self,
        world: &World,
        row: &FrameRow,
        energies: Option<&EnergyRow>,
    ) -> Result<bool, LogError> {
        if self.shared.failed.load(Ordering::Relaxed) {
            return Ok(false);
        }
        let partial = row.committed == FrameRow::COMMITTED_SOME;
        if partial {
            self.line.clear();
            let _ = write!(self.line, "{{\"frame\":{},\"event\":\"commit\",\"pairs\":[", row.frame);
            for (index, pair) in self.commits.pairs().iter().enumerate() {
                let comma = if index > 0 { "," } else { "" };
                let _ = write!(self.line, "{comma}{pair}");
            }
            self.line.extend_from_slice(b"]}");
        }
        let line = if partial { self.line.len() } else { 0 };
        let frame = self.capture.size(row.contacts as usize);
        if !self.wait_for(message::room(&[line, frame]) + ROOM_FOR_EVENTS) {
            return Ok(false);
        }
        if partial {
            let line = std::mem::take(&mut self.line);
            self.push(Kind::Event, &[&line]);
            self.line = line;
        }
        let Some(producer) = &mut self.producer else { return Ok(false) };
        let bytes = self.capture.frame(world, row, energies)?;
        let pushed = message::push(producer, Kind::Frame, &[bytes]);
        self.peak = self.peak.max(producer.buffer().capacity() - producer.slots());
        Ok(pushed)
    }

    /// Hands the line of an event to the thread, after the note of events lost before it.
    fn tell(&mut self, event: Event) {
        self.line.clear();
        let event = LoggedEvent { frame: self.next, event };
        serde_json::to_writer(&mut self.line, &event).expect("an event can be written");
        self.event();
    }

    fn event(&mut self) {
        let line = std::mem::take(&mut self.line);
        if !self.tell_lost() || !self.push(Kind::Event, &[&line]) {
            self.event_was_lost();
        }
        self.line = line;
    }

    /// Hands the note of lost events to the thread, if there is one; false if there is no room.
    fn tell_lost(&mut self) -> bool {
        let Some((frame, count)) = self.events_lost else { return true };
        let mut note = [0; 96];
        let mut rest = &mut note[..];
        let _ = write!(rest, "{{\"frame\":{frame},\"event\":\"lost\",\"count\":{count}}}");
        let length = 96 - rest.len();
        let told = self.push(Kind::Event, &[&note[..length]]);
        if told {
            self.events_lost = None;
        }
        told
    }

    fn event_was_lost(&mut self) {
        let (frame, count) = self.events_lost.unwrap_or((self.next, 0));
        self.events_lost = Some((frame, count + 1));
        self.events_lost_ever += 1;
    }

    fn push(&mut self, kind: Kind, parts: &[&[u8]]) -> bool {
        let length = parts.iter().map(|part| part.len()).sum();
        if !self.wait_for(message::room(&[length])) {
            return false;
        }
        self.producer.as_mut().is_some_and(|producer| message::push(producer, kind, parts))
    }

    /// True if the ring has this much room, now or, with waiting allowed, soon. False in a fork, because no
    /// thread empties the ring.
    fn wait_for(&mut self, room: usize) -> bool {
        let forked = self.is_forked();
        let Some(producer) = self.producer.as_ref().filter(|_| !forked) else { return false };
        let mut limit = None;
        loop {
            if producer.slots() >= room {
                return true;
            }
            if self.when_full == WhenFull::Lose || self.shared.failed.load(Ordering::Relaxed) {
                return false;
            }
            let Some(thread) = self.thread.as_ref().filter(|thread| !thread.is_finished()) else {
                return false;
            };
            thread.thread().unpark();
            let limit = limit.get_or_insert_with(|| WaitLimit::new(&self.shared, self.longest_wait));
            if limit.is_at_an_end(&self.shared) {
                self.give_up();
                return false;
            }
            std::thread::sleep(LOOK);
        }
    }
}

/// Time limit for files that accept nothing.
struct WaitLimit {
    alive: u64,
    since: Instant,
    at_most: Duration,
}

impl WaitLimit {
    fn new(shared: &Shared, at_most: Duration) -> Self {
        Self { alive: shared.alive.load(Ordering::Relaxed), since: Instant::now(), at_most }
    }

    fn is_at_an_end(&mut self, shared: &Shared) -> bool {
        let alive = shared.alive.load(Ordering::Relaxed);
        if alive != self.alive {
            *self = Self::new(shared, self.at_most);
        }
        self.since.elapsed() >= self.at_most
    }
}

impl Drop for Recorder {
    fn drop(&mut self) {
        self.close();
    }
}

/// A ring of this size, with all pages touched to avoid page faults in a frame.
fn ring(bytes: usize) -> (Producer<u8>, rtrb::Consumer<u8>) {
    let (mut producer, mut consumer) = RingBuffer::new(bytes);
    if let Ok(chunk) = producer.write_chunk_uninit(bytes) {
        chunk.fill_from_iter(std::iter::repeat(1));
    }
    if let Ok(chunk) = consumer.read_chunk(bytes) {
        chunk.commit_all();
    }
    (producer, consumer)
}

/// Checks that this much memory is available before any of it is allocated.
fn require(bytes: usize) -> Result<(), EngineError> {
    const WHAT: &str = "response log: what may wait for the disk, and the largest frame";
    const CURE: &str = "ask for fewer `buffer_bytes`, or for a smaller `contact_capacity` of the world";
    if memory_available().is_some_and(|available| bytes as u64 > available) {
        return Err(EngineError::OutOfMemory { what: WHAT, bytes, cure: CURE });
    }
    Ok(require_memory(WHAT, bytes, CURE)?)
}

/// Memory that the system can give without taking it from other processes, bytes, where it is known. Linux
/// overcommits, and kills the process that touches more.
fn memory_available() -> Option<u64> {
    let told = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = told.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}
