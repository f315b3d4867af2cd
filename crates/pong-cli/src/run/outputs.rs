//! Output files of a run: CSV files, a response log, or both, with the same rows.

use super::arguments::Arguments;
use pong_engine::World;
use pong_executive::Simulation;
use pong_executive::scene::BuiltScene;
use pong_record::{
    AccountsTable, CsvTables, EnergyRow, Frame, LogError, Look, ModelSource, RecordOptions, Recorder,
};
use std::path::{Path, PathBuf};

/// The open files of a run.
pub(super) struct Outputs {
    csv: Option<Csv>,
    log: Option<Recorder>,
    energies: bool,
    /// Number of steps from one line of the CSV files to the next.
    csv_every: u64,
    log_every: u64,
}

struct Csv {
    look: Look,
    tables: CsvTables,
    accounts: Option<AccountsTable>,
    frame: Frame,
}

impl Outputs {
    /// Begins the files. Must precede the first evaluation, because a log begins with the first commit.
    pub fn create(arguments: &Arguments, built: &BuiltScene) -> Result<Self, String> {
        let log_every = if arguments.every_step { 1 } else { built.record_every };
        let mut outputs =
            Self { csv: None, log: None, energies: built.ledger, csv_every: built.record_every, log_every };
        if let Some(folder) = csv_folder(arguments) {
            outputs.csv = Some(Csv::create(&folder, built).map_err(of_csv)?);
        }
        if let Some(folder) = &arguments.log {
            let options = log_options(arguments, built, log_every);
            let models: Vec<_> = built.model_files.iter().cloned().map(ModelSource::File).collect();
            let log = Recorder::start(built.simulation.world(), folder, &models, &options);
            outputs.log = Some(log.map_err(|error| of_log(&error))?);
        }
        Ok(outputs)
    }

    /// Records the instant after `done` steps, which the world has committed. The last one of a run is in the
    /// CSV files even if it is not a multiple of the interval.
    pub fn observe(&mut self, simulation: &Simulation, done: u64, last: bool) -> Result<(), String> {
        let energies = self.energies.then(|| energies(simulation));
        let (world, time) = (simulation.world(), simulation.time());
        if let Some(csv) = self.csv.as_mut().filter(|_| last || done.is_multiple_of(self.csv_every)) {
            csv.frame.energies = energies;
            csv.write(world, time).map_err(of_csv)?;
        }
        if let Some(log) = &mut self.log {
            log.evaluated();
            log.committed();
            if done.is_multiple_of(self.log_every) {
                log.record(world, time, 0, energies.as_ref()).map_err(|error| of_log(&error))?;
            }
        }
        Ok(())
    }

    /// Writes the buffered rest.
    pub fn finish(self) -> Result<(), String> {
        let csv = self.csv.map_or(Ok(()), |csv| csv.finish().map_err(of_csv));
        let log = self.log.map_or(Ok(()), |log| log.finish().map(|_| ()).map_err(|error| of_log(&error)));
        csv.and(log)
    }
}

impl Csv {
    fn create(folder: &Path, built: &BuiltScene) -> Result<Self, LogError> {
        let world = built.simulation.world();
        let look = Look::new(world)?;
        let tables = CsvTables::create(folder, look.run(), built.ledger)?;
        let accounts = built.ledger.then(|| AccountsTable::create(folder, &look)).transpose()?;
        Ok(Self { look, tables, accounts, frame: Frame::default() })
    }

    fn write(&mut self, world: &World, time: f64) -> Result<(), LogError> {
        self.look.frame(world, time, &mut self.frame)?;
        self.tables.write(&self.frame)?;
        self.accounts.as_mut().map_or(Ok(()), |accounts| accounts.write(world, time))
    }

    fn finish(self) -> Result<(), LogError> {
        self.tables.finish()?;
        self.accounts.map_or(Ok(()), AccountsTable::finish)
    }
}

fn csv_folder(arguments: &Arguments) -> Option<PathBuf> {
    let by_name = || {
        let stem = arguments.scene.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        PathBuf::from(format!("{stem}_out"))
    };
    arguments.output.clone().or_else(|| arguments.csv.then(by_name))
}

fn log_options(arguments: &Arguments, built: &BuiltScene, every: u64) -> RecordOptions {
    RecordOptions {
        name: built.name.clone(),
        writer: concat!("pong run ", env!("CARGO_PKG_VERSION")).to_owned(),
        step: Some(built.simulation.step_length()),
        commits_per_frame: Some(every),
        integrator: Some(built.simulation.integrator().to_string()),
        energies: built.ledger,
        overwrite: arguments.overwrite,
        ..RecordOptions::default()
    }
}

fn energies(simulation: &Simulation) -> EnergyRow {
    let e = simulation.energy();
    EnergyRow {
        kinetic: e.kinetic,
        potential: e.potential,
        springs: e.springs,
        contacts: e.contacts,
        contact_loss: e.contact_loss,
        spring_loss: e.spring_loss,
        work_in: e.work_in,
        balance: e.balance(),
    }
}

fn of_csv(error: LogError) -> String {
    match error {
        LogError::Unwritable { path, reason } => {
            format!("{}: cannot be written: {reason}; name another folder with -o", path.display())
        }
        other => other.to_string(),
    }
}

fn of_log(error: &LogError) -> String {
    match error {
        LogError::Unwritable { path, reason } => {
            format!("{}: cannot be written: {reason}; name another folder with --log", path.display())
        }
        LogError::Occupied { path, found } => format!(
            "{}: holds a log already (`{found}`); name another folder with --log, or replace it with --overwrite",
            path.display()
        ),
        other => other.to_string(),
    }
}
