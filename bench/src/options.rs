//! Command line of the benchmark programs.

use std::path::PathBuf;

/// Options of a benchmark program.
#[derive(Clone, Debug)]
pub struct Options {
    /// Small scenes and few frames, as a smoke test.
    pub smoke: bool,
    /// Number of rounds, in each of which everything runs once.
    pub rounds: usize,
    /// Runs without the peers, for profilers.
    pub alone: bool,
    /// Index of the only scene to run, from 0.
    pub only: Option<usize>,
    /// Folder for output files, if the program writes any.
    pub into: Option<PathBuf>,
}

impl Options {
    /// Reads `[--smoke] [--alone] [--rounds N] [--only N] [--into FOLDER]` from the command line.
    ///
    /// # Errors
    /// An argument that is none of these.
    pub fn read(rounds: usize) -> Result<Self, String> {
        let mut arguments = std::env::args().skip(1);
        let mut options = Self { smoke: false, rounds, alone: false, only: None, into: None };
        while let Some(argument) = arguments.next() {
            let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
            match argument.as_str() {
                "--smoke" => (options.smoke, options.rounds) = (true, 1),
                "--alone" => options.alone = true,
                "--rounds" => options.rounds = number(&value()?)?.max(1),
                "--only" => options.only = Some(number(&value()?)?),
                "--into" => options.into = Some(value()?.into()),
                other => {
                    return Err(format!(
                        "{other}: use --smoke, --alone, --rounds N, --only N, --into FOLDER"
                    ));
                }
            }
        }
        Ok(options)
    }

    /// True if the scene of this index should run.
    pub fn wants(&self, scene: usize) -> bool {
        self.only.is_none_or(|only| only == scene)
    }
}

fn number(text: &str) -> Result<usize, String> {
    text.parse().map_err(|error| format!("{text}: {error}"))
}
