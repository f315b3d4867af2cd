//! Response logs, written frame by frame beside the run.

use crate::abi::PONG_ABI_VERSION;
use crate::failure::{Failure, Outcome};
use crate::guard::{get, with_world};
use crate::handle::{Inner, pong_world};
use crate::pointers::{Out, one, text};
use crate::status::pong_status;
use pong_record::{LONGEST_WAIT, LogError, RecordOptions, RecordStatus, Recorder, WhenFull};
use pong_threads::system::{lower_priority, without_signals};
use std::ffi::c_char;
use std::path::Path;
use std::time::Duration;

/// Behaviour of a log whose buffer is full: PONG_LOG_...
pub type pong_log_when_full = u32;

/// `when_full`: frames for which there is no room are left out of the log as a whole, counted and marked.
pub const PONG_LOG_DROP: pong_log_when_full = 0;
/// `when_full`: pong_log_frame() waits until there is room: for unattended runs.
pub const PONG_LOG_WAIT: pong_log_when_full = 1;

/// Marks options made by pong_default_log_options().
const COOKIE: u64 = 0x706f_6e67_2d6c_6f67;
/// Longest time between two flushes, ms.
const MOST_MS: u32 = 3_600_000;
/// Upper limit: a larger value is more likely a wrong unit.
const MOST_BYTES: u64 = 1 << 36;

/// Options of a log. Make it with pong_default_log_options(), change what you like, pass it to
/// pong_start_log().
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pong_log_options {
    /// Set by pong_default_log_options(): size of this struct, bytes.
    pub struct_size: u32,
    /// Set by pong_default_log_options(): PONG_ABI_VERSION of the library.
    pub abi_version: u32,
    /// Set by pong_default_log_options(): checked by pong_start_log().
    pub cookie: u64,
    /// Name of the run, UTF-8; NULL (default) for the name of the folder. Read during pong_start_log() only.
    pub name: *const c_char,
    /// Step of the host's integrator, s, for readers of the log; 0 (default) if it varies.
    pub step: f64,
    /// Most bytes that may wait for the disk; raised to the size of the largest frame. 0 (default) for 16
    /// MiB.
    pub buffer_bytes: u64,
    /// Time between two flushes, ms; 1000 by default. A run that is cut off keeps what was flushed.
    pub flush_ms: u32,
    /// Behaviour when the disk is slower than the run: PONG_LOG_DROP (default) or PONG_LOG_WAIT. A disk that
    /// accepts nothing for 30 s has failed.
    pub when_full: pong_log_when_full,
    /// 1: replaces a log that lies in the folder. 0 (default): such a folder is refused.
    pub overwrite: u32,
    /// Number of commits that each logged frame stands for, for readers of the log; 0 (default) if that
    /// varies.
    pub commits_per_frame: u32,
    /// Zero.
    pub reserved: [u64; 8],
}

/// Progress of a log.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct pong_log_report {
    /// Frames logged, lost ones included.
    pub frames: u64,
    /// Frames flushed to the files: a run that is cut off now keeps them.
    pub flushed: u64,
    /// Frames that are not and will not be in the log.
    pub lost: u64,
    /// Changes between frames that are not in the log; it cannot be replayed exactly beyond them.
    pub events_lost: u64,
    /// Bytes of the rows flushed.
    pub bytes: u64,
    /// Largest number of bytes that waited for the disk.
    pub buffer_peak: u64,
    /// Number of bytes that may wait for the disk.
    pub buffer_size: u64,
    /// 1: the files cannot be written any more, and every frame from then on is lost; pong_stop_log()
    /// returns the cause. 0: not so.
    pub failed: u32,
    /// Zero in this version.
    pub reserved_flags: u32,
    /// Zero in this version.
    pub reserved: [u64; 4],
}

/// The default options, as their comments say.
#[unsafe(no_mangle)]
pub extern "C" fn pong_default_log_options() -> pong_log_options {
    pong_log_options {
        struct_size: size_of::<pong_log_options>() as u32,
        abi_version: PONG_ABI_VERSION,
        cookie: COOKIE,
        name: std::ptr::null(),
        step: 0.0,
        buffer_bytes: 0,
        flush_ms: 1000,
        when_full: PONG_LOG_DROP,
        overwrite: 0,
        commits_per_frame: 0,
        reserved: [0; 8],
    }
}

/// Begins a response log (docs/response_logs.md) of a sealed world in a folder (UTF-8 path), which is created
/// if it does not exist. `options` may be NULL for the defaults. The log may begin at any time: it starts
/// with the contact state of the world. Model files are copied; they must be unchanged since they were
/// loaded. Takes memory, files and a thread. PONG_STATUS_LOG_FAILED: the folder cannot be written or holds a
/// log, or a model has changed. PONG_STATUS_OUT_OF_MEMORY: the system does not have the memory for the
/// buffer. The log belongs to this process: a fork of it logs nothing into it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_start_log(
    world: *mut pong_world,
    folder: *const c_char,
    options: *const pong_log_options,
) -> pong_status {
    with_world(world, |inner| {
        let folder = Path::new(text(folder, "folder")?);
        let default = pong_default_log_options();
        let options = if options.is_null() { &default } else { one(options, "options")? };
        let name = if options.name.is_null() { None } else { Some(text(options.name, "name")?) };
        if inner.log.is_some() {
            let message = "log: one is running; stop it with pong_stop_log() first";
            return Err(Failure::new(pong_status::WrongPhase, message));
        }
        let options = options.check(name, folder)?;
        let world = inner.phase.frames("start a log")?;
        let start = || Recorder::start(world, folder, &inner.sources, &options);
        inner.log = Some(without_signals(start)?);
        Ok(())
    })
}

/// Logs the frame last evaluated, with this time (s): states, wrenches and contacts. Call it after the commit
/// of the frame (pong_step() or pong_commit()) and before states change: once per commit, if the log is to be
/// replayed exactly. Takes no memory, touches no file and does not wait, unless `when_full` says so. A call
/// whose frame is lost succeeds; the frame is counted: see pong_get_log_report(). PONG_STATUS_WRONG_PHASE:
/// there is no log, or states, pairs or surfaces have changed since the frame.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_log_frame(world: *mut pong_world, time: f64) -> pong_status {
    with_world(world, |inner| {
        inner.law_faults.check()?;
        let evaluate_ns = inner.counters.evaluate_ns;
        let Some(log) = &mut inner.log else { return Err(no_log()) };
        Ok(log.record(inner.phase.frames("log a frame")?, time, evaluate_ns, None)?)
    })
}

/// Copies the progress of the log. PONG_STATUS_WRONG_PHASE: there is no log.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_log_report(
    world: *const pong_world,
    report: *mut pong_log_report,
) -> pong_status {
    get(world, (report, "report"), |inner| Ok((&inner.log.as_ref().ok_or_else(no_log)?.status()).into()))
}

/// Writes the rest and closes the log. Waits for the disk until it has accepted nothing for 30 s; a log that
/// has already failed for that reason closes at once. `report` may be NULL. PONG_STATUS_LOG_FAILED: the files
/// could not be written to the end; the message has the cause and where the log ends. It is closed all the
/// same. pong_destroy_world() closes a log too, without a report. PONG_STATUS_WRONG_PHASE: there is no log.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_stop_log(world: *mut pong_world, report: *mut pong_log_report) -> pong_status {
    with_world(world, |inner| {
        let out = Out::optional(report, "report")?;
        let mut log = inner.log.take().ok_or_else(no_log)?;
        log.close();
        let status = log.status();
        out.set((&status).into());
        match status.error {
            None => Ok(()),
            Some(text) => Err(Failure::new(pong_status::LogFailed, text)),
        }
    })
}

impl Inner {
    /// Records an event in the log, if there is one.
    pub(crate) fn log_event(&mut self, record: impl FnOnce(&mut Recorder)) {
        if let Some(log) = &mut self.log {
            record(log);
        }
    }
}

impl pong_log_options {
    fn check(&self, name: Option<&str>, folder: &Path) -> Outcome<RecordOptions> {
        self.check_origin()?;
        let refused = |what: String| Err(Failure::new(pong_status::BadValue, format!("log options: {what}")));
        if !(self.step.is_finite() && self.step >= 0.0) {
            return refused(format!("step is {}; give a time in s, or 0 if it varies", self.step));
        }
        if self.buffer_bytes > MOST_BYTES {
            return refused(format!("buffer_bytes is {}; give at most {MOST_BYTES}", self.buffer_bytes));
        }
        if !(1..=MOST_MS).contains(&self.flush_ms) {
            return refused(format!("flush_ms is {}; give 1 to {MOST_MS} (1000 by default)", self.flush_ms));
        }
        let when_full = match self.when_full {
            PONG_LOG_DROP => WhenFull::Lose,
            PONG_LOG_WAIT => WhenFull::Wait,
            other => return refused(format!("when_full is {other}; give PONG_LOG_DROP or PONG_LOG_WAIT")),
        };
        if self.overwrite > 1 {
            return refused(format!("overwrite is {}; give 0 or 1", self.overwrite));
        }
        let of_folder = || folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Ok(RecordOptions {
            name: name.map_or_else(of_folder, str::to_owned),
            writer: concat!("libpong ", env!("CARGO_PKG_VERSION")).to_owned(),
            step: (self.step > 0.0).then_some(self.step),
            commits_per_frame: (self.commits_per_frame > 0).then_some(self.commits_per_frame.into()),
            integrator: None,
            energies: false,
            overwrite: self.overwrite == 1,
            when_full,
            buffer_bytes: (self.buffer_bytes > 0).then_some(self.buffer_bytes as usize),
            flush_every: Duration::from_millis(self.flush_ms.into()),
            longest_wait: LONGEST_WAIT,
            on_thread_start: Some(lower_priority),
        })
    }

    fn check_origin(&self) -> Outcome {
        let expected = pong_default_log_options();
        let made_here = (self.cookie, self.struct_size, self.abi_version)
            == (expected.cookie, expected.struct_size, expected.abi_version);
        if made_here && self.reserved == expected.reserved {
            return Ok(());
        }
        let message = "log options: they were not filled in by pong_default_log_options(), or have values in reserved \
                       fields; start from pong_default_log_options() and change only what is documented";
        Err(Failure::new(pong_status::Config, message))
    }
}

impl From<&RecordStatus> for pong_log_report {
    fn from(status: &RecordStatus) -> Self {
        Self {
            frames: status.frames,
            flushed: status.flushed,
            lost: status.lost,
            events_lost: status.events_lost,
            bytes: status.bytes,
            buffer_peak: status.buffer_peak as u64,
            buffer_size: status.buffer_size as u64,
            failed: u32::from(status.error.is_some()),
            reserved_flags: 0,
            reserved: [0; 4],
        }
    }
}

impl From<LogError> for Failure {
    fn from(error: LogError) -> Self {
        match error {
            LogError::Engine(error) => error.into(),
            LogError::Refused { .. } => Self::new(pong_status::BadValue, error.to_string()),
            _ => Self::new(pong_status::LogFailed, error.to_string()),
        }
    }
}

fn no_log() -> Failure {
    Failure::new(pong_status::WrongPhase, "log: there is none; begin one with pong_start_log()")
}
