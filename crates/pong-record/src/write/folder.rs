//! Preparation of the folder of a log.

use super::describe::file;
use super::models;
use crate::error::LogError;
use crate::run::Run;
use crate::table::{ContactRow, EnergyRow, FrameRow, Row, StateRow, WrenchRow};
use crate::{event, run};
use std::path::Path;

/// Prefix of the files of contact states.
pub(super) const CONTACT_STATE: &str = "contact_state_";

/// Creates the folder, or removes another log from it if allowed.
pub(super) fn prepare(folder: &Path, overwrite: bool) -> Result<(), LogError> {
    if folder == Path::new("") {
        return Err(LogError::refused(
            "the name of its folder is empty",
            "name the folder that is to hold it",
        ));
    }
    std::fs::create_dir_all(folder).map_err(|reason| LogError::unwritable(folder, &reason))?;
    let entries = std::fs::read_dir(folder).map_err(|reason| LogError::unwritable(folder, &reason))?;
    let mut found: Vec<String> =
        entries.filter_map(|entry| Some(entry.ok()?.file_name().to_string_lossy().into_owned())).collect();
    found.retain(|name| belongs_to_a_log(name));
    found.sort();
    match found.first() {
        None => Ok(()),
        Some(first) if !overwrite => {
            Err(LogError::Occupied { path: folder.to_owned(), found: first.clone() })
        }
        Some(_) => remove(folder, &found),
    }
}

fn belongs_to_a_log(name: &str) -> bool {
    let tables = [FrameRow::TABLE, StateRow::TABLE, WrenchRow::TABLE, ContactRow::TABLE, EnergyRow::TABLE];
    [run::FILE, event::FILE].contains(&name)
        || tables.iter().any(|table| file(table) == name)
        || (name.starts_with(CONTACT_STATE) && name.ends_with(".bin"))
}

fn remove(folder: &Path, found: &[String]) -> Result<(), LogError> {
    // Removes models only if run.json lists them: another folder of that name may be the user's.
    if found.iter().any(|name| name == run::FILE) && Run::load(folder).is_ok_and(|run| !run.models.is_empty())
    {
        let models = folder.join(models::FOLDER);
        match std::fs::remove_dir_all(&models) {
            Err(reason) if reason.kind() != std::io::ErrorKind::NotFound => {
                return Err(LogError::unwritable(&models, &reason));
            }
            _ => {}
        }
    }
    for name in found {
        let path = folder.join(name);
        std::fs::remove_file(&path).map_err(|reason| LogError::unwritable(&path, &reason))?;
    }
    Ok(())
}
