//! Response logs of a world whose frames a Python program computes.

use crate::errors::{LogError, PhaseError, of_log};
use crate::world::Inner;
use pong_engine::{ModelId, ObjectId, PairId, World};
use pong_record::{RecordOptions, Recorder, WhenFull};
use pyo3::prelude::*;
use std::path::PathBuf;

/// A log that is being written.
pub(crate) struct Recording {
    recorder: Recorder,
}

/// How a Python program wants its log.
pub(crate) struct LogOptions {
    pub name: String,
    pub step: Option<f64>,
    pub commits_per_frame: Option<u64>,
    pub overwrite: bool,
    /// Whether frames are left out where the files are too slow.
    pub lose: bool,
}

impl Recording {
    pub fn start(py: Python<'_>, inner: &Inner, folder: PathBuf, options: LogOptions) -> PyResult<Self> {
        if inner.recording.is_some() {
            return Err(PhaseError::new_err("log: one is open already; call stop_log first"));
        }
        let options = RecordOptions {
            name: options.name,
            writer: concat!("pong for Python ", env!("CARGO_PKG_VERSION")).to_owned(),
            step: options.step,
            commits_per_frame: options.commits_per_frame,
            overwrite: options.overwrite,
            when_full: if options.lose { WhenFull::Lose } else { WhenFull::Wait },
            ..RecordOptions::default()
        };
        let started = Recorder::start(&inner.world, &folder, &inner.sources, &options);
        Ok(Self { recorder: started.map_err(|error| of_log(py, &error))? })
    }

    pub fn record(&mut self, py: Python<'_>, world: &mut World, time: f64) -> PyResult<()> {
        let recorder = &mut self.recorder;
        // A world may go to another thread but not be seen by two: the closure has it to itself.
        let record = move || {
            let world: &mut World = world;
            recorder.record(world, time, 0, None)
        };
        py.detach(record).map_err(|error| of_log(py, &error))
    }

    pub fn finish(self, py: Python<'_>) -> PyResult<u64> {
        let status = py.detach(|| self.recorder.finish()).map_err(|error| of_log(py, &error))?;
        match status.error {
            None => Ok(status.frames),
            Some(text) => Err(LogError::new_err(text)),
        }
    }

    pub fn evaluated(&mut self) {
        self.recorder.evaluated();
    }

    /// All pairs were committed, or some.
    pub fn committed(&mut self, pairs: Option<&[PairId]>) {
        match pairs {
            None => self.recorder.committed(),
            Some(pairs) => self.recorder.committed_some(pairs),
        }
    }

    pub fn restored(&mut self, block: &[u8]) {
        self.recorder.restored(block);
    }

    pub fn forgot(&mut self, object: ObjectId) {
        self.recorder.forgot(object);
    }

    pub fn pair_switched(&mut self, pair: PairId, enabled: bool) {
        self.recorder.pair_switched(pair, enabled);
    }

    pub fn surface_set(&mut self, model: ModelId, surface: &pong_model::Surface) {
        self.recorder.surface_set(model, surface);
    }
}
