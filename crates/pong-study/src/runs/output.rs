//! Changed model files: written to a temporary file, read back, and only then renamed.

use crate::runs::subject::Subject;
use crate::{Result, StudyError};
use pong_model::{Model, files, grouping};
use std::path::{Path, PathBuf};

/// Output folder of changed files, and permission to replace files.
#[derive(Clone, Debug, Default)]
pub struct Output {
    /// The folder; beside the model unless given.
    pub folder: Option<PathBuf>,
    /// True if existing files are replaced.
    pub force: bool,
}

impl Output {
    /// The output file for a model; `what` is the suffix of its name.
    pub(crate) fn place(&self, subject: &Subject, what: &str) -> PathBuf {
        let stem = subject.file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let home = subject.file.parent().unwrap_or(Path::new(""));
        self.folder.as_deref().unwrap_or(home).join(format!("{stem}_{what}.ron"))
    }

    /// Refuses files that exist, before anything is run.
    pub(crate) fn check(&self, subjects: &[Subject], what: &str) -> Result<()> {
        let mut places: Vec<PathBuf> = Vec::new();
        for subject in subjects {
            let place = self.place(subject, what);
            if subject.in_log && self.folder.is_none() {
                let line = format!(
                    "it is the copy that a log keeps for itself; name a folder for {what} models with -o"
                );
                return Err(StudyError::file(&subject.file, line));
            }
            if !self.force && place.exists() {
                let line = "it is there already; move it away, name another folder with -o, or replace it with --force";
                return Err(StudyError::file(&place, line));
            }
            if places.contains(&place) {
                let line = "two models of that name would be written there; leave -o out, so that each goes beside its file";
                return Err(StudyError::file(&place, line));
            }
            places.push(place);
        }
        Ok(())
    }

    /// Writes a text as the changed file of a model; the model read back must satisfy `expected`.
    pub(crate) fn write(
        &self,
        (subject, what): (&Subject, &str),
        text: &str,
        expected: &dyn Fn(&Model) -> bool,
    ) -> Result<PathBuf> {
        let place = self.place(subject, what);
        let folder = match place.parent() {
            Some(folder) if folder != Path::new("") => folder.to_owned(),
            _ => PathBuf::from("."),
        };
        let unwritable = |path: &Path, reason: std::io::Error| {
            StudyError::file(path, format!("{reason}; name another folder with -o"))
        };
        std::fs::create_dir_all(&folder).map_err(|reason| unwritable(&folder, reason))?;
        self.copy_meshes(subject, &folder)?;
        let name = place.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let staged = folder.join(format!(".{name}.{}", std::process::id()));
        let moved = files::replace(&staged, text.as_bytes())
            .map_err(|reason| unwritable(&place, reason))
            .and_then(|()| check(&staged, subject, expected))
            .and_then(|()| std::fs::rename(&staged, &place).map_err(|reason| unwritable(&place, reason)));
        if moved.is_err() {
            let _ = std::fs::remove_file(&staged);
        }
        moved.map(|()| place)
    }

    /// Copies meshes, which are found beside a model or below, to another output folder.
    fn copy_meshes(&self, subject: &Subject, folder: &Path) -> Result<()> {
        let home = subject.file.parent().unwrap_or(Path::new(""));
        let meshes =
            grouping::mesh_files(&subject.text).map_err(|line| StudyError::file(&subject.file, line))?;
        for file in meshes {
            let (from, to) = (home.join(&file), folder.join(&file));
            let fails = |reason: std::io::Error| {
                StudyError::file(&to, format!("{reason}; name another folder with -o"))
            };
            let bytes = files::read(&from).map_err(fails)?;
            if files::read(&to).is_ok_and(|there| there == bytes) {
                continue;
            }
            if to.exists() && !self.force {
                let line = "another mesh of that name is there; name another folder with -o, or replace it with --force";
                return Err(StudyError::file(&to, line));
            }
            let written = to
                .parent()
                .map_or(Ok(()), std::fs::create_dir_all)
                .and_then(|()| files::replace(&to, &bytes));
            written.map_err(fails)?;
        }
        Ok(())
    }
}

/// Checks the file by reading it back: it must give the model that was run.
fn check(staged: &Path, subject: &Subject, expected: &dyn Fn(&Model) -> bool) -> Result<()> {
    if expected(&pong_model::load(staged, &subject.extensions)?) {
        return Ok(());
    }
    let line = "what was written does not read as what was run; run it again and leave the model and its meshes as they are";
    Err(StudyError::file(staged, line))
}

/// The text of a changed file, with a line at its head that says what was done, and for which run.
pub(crate) fn headed(text: &str, done: &str, name: &str) -> String {
    let (mark, rest) = text.strip_prefix('\u{feff}').map_or(("", text), |rest| ("\u{feff}", rest));
    let name: String = name.chars().filter(|c| !c.is_control()).collect();
    let line = format!("// {done} for `{name}`; all else is as it was.\n");
    if rest.starts_with(&line) { text.to_owned() } else { format!("{mark}{line}{rest}") }
}
