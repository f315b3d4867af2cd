//! Writing of a model file and its mesh files: to temporary names, read back, then moved into place together.

use crate::findings::Findings;
use pong_model::Extensions;
use std::path::{Path, PathBuf};

/// Writes the model and its mesh files once the engine's loader has accepted them; its faults and warnings are noted.
pub fn write_checked(
    output: &Path,
    text: String,
    mesh_files: Vec<(String, Vec<u8>)>,
    findings: &mut Findings,
) -> Option<Vec<PathBuf>> {
    write_checked_or(output, text, || None, mesh_files, findings)
}

/// Writes files like [`write_checked`]. If the loader refuses shapes as solids, and `instead` gives a text in which
/// they are none, that text is written, and a note gives the reason.
pub fn write_checked_or(
    output: &Path,
    text: String,
    instead: impl FnOnce() -> Option<String>,
    mesh_files: Vec<(String, Vec<u8>)>,
    findings: &mut Findings,
) -> Option<Vec<PathBuf>> {
    let folder = match output.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let name = output.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let staging = folder.join(format!(".{name}.{}", std::process::id()));
    let unwritable = |findings: &mut Findings, reason: std::io::Error| {
        let path = output.display().to_string();
        findings.fault(
            &path,
            "unwritable",
            format!("it cannot be written: {reason}"),
            "name a file in a folder that can be written",
        );
    };
    let mut files = mesh_files;
    files.push((name.clone(), text.into_bytes()));
    if let Err(reason) = stage(&staging, &files) {
        unwritable(findings, reason);
        let _ = std::fs::remove_dir_all(&staging);
        return None;
    }
    let mut checked = check(&staging.join(&name), output);
    if let Some(fault) = checked.faults.iter().find(|fault| is_of_solids(fault.rule)).cloned()
        && let Some(text) = instead()
    {
        match pong_model::files::replace(&staging.join(&name), text.as_bytes()) {
            Ok(()) => checked = check(&staging.join(&name), output),
            Err(reason) => unwritable(findings, reason),
        }
        let cause = format!("its shapes have `contact: Marked`, because one is no solid: {}", fault.cause);
        findings.note(&fault.path, "not-solid", cause, "");
    }
    findings.faults.append(&mut checked.faults);
    findings.notes.append(&mut checked.notes);
    let mut written = Vec::new();
    if findings.faults.is_empty() {
        match move_all(&staging, folder, &files) {
            Ok(paths) => written = paths,
            Err(reason) => unwritable(findings, reason),
        }
    }
    let _ = std::fs::remove_dir_all(&staging);
    // The model comes first in the report.
    written.reverse();
    findings.faults.is_empty().then_some(written)
}

fn stage(staging: &Path, files: &[(String, Vec<u8>)]) -> std::io::Result<()> {
    std::fs::create_dir(staging)?;
    for (name, contents) in files {
        let path = staging.join(name);
        std::fs::create_dir_all(path.parent().unwrap_or(staging))?;
        pong_model::files::replace(&path, contents)?;
    }
    Ok(())
}

fn move_all(staging: &Path, folder: &Path, files: &[(String, Vec<u8>)]) -> std::io::Result<Vec<PathBuf>> {
    let mut written = Vec::new();
    for (name, _) in files {
        let path = folder.join(name);
        std::fs::create_dir_all(path.parent().unwrap_or(folder))?;
        std::fs::rename(staging.join(name), &path)?;
        written.push(path);
    }
    Ok(written)
}

/// Tests whether a rule of the loader is about `contact: Solid`.
fn is_of_solids(rule: &str) -> bool {
    rule.starts_with("solid-") || rule == "open-solid"
}

/// Reads the staged model with the engine's loader; messages give its final path.
fn check(staged: &Path, output: &Path) -> Findings {
    let mut findings = Findings::default();
    let (staged_name, name) = (staged.display().to_string(), output.display().to_string());
    match pong_model::load(staged, &Extensions::new()) {
        Ok(model) => {
            for warning in &model.warnings {
                let cause = warning.strip_prefix(&format!("{staged_name}:")).unwrap_or(warning);
                findings.note(&name, "loader", format!("line {cause}"), "");
            }
        }
        Err(errors) => {
            for error in errors.0 {
                if matches!(error.rule, "unknown-primitive" | "unknown-volume") {
                    let cause = format!("{}: {}", error.path, error.cause);
                    findings.note(&name, error.rule, cause, "the host that loads the model must register it");
                    continue;
                }
                let path = format!("{name}: {}", error.path);
                findings.fault(&path, error.rule, error.cause, error.cure);
            }
        }
    }
    findings
}
