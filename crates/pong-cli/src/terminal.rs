//! The one place from which the program writes to a terminal, or to whatever stands for it.
//!
//! Names of a model, a scene, a log or a mesh reach nothing that they could steer: characters that steer a display are
//! written as escapes. Messages that cannot be written never end the work. If it is the answer on standard output that is
//! lost, the program says so and its exit code tells; only a reader that has seen enough (`pong … | head`) is no error.

use indicatif::ProgressBar;
use pong_model::{printable, printable_lines};
use std::fmt::Display;
use std::io::{ErrorKind, Write};
use std::process::ExitCode;
use std::sync::Mutex;

/// Why the answer could not be written; the first reason.
static LOST: Mutex<Option<String>> = Mutex::new(None);

/// Writes to standard output: a text of several lines, in which names are [`printable`].
pub(crate) fn print(text: &str) {
    let mut out = std::io::stdout().lock();
    let written = out.write_all(printable_lines(text).as_bytes()).and_then(|()| out.flush());
    drop(out);
    let Err(reason) = written else { return };
    if reason.kind() == ErrorKind::BrokenPipe {
        return;
    }
    if let Ok(mut lost) = LOST.lock()
        && lost.is_none()
    {
        *lost = Some(reason.to_string());
    }
}

/// Writes one line to standard error, whatever line ends the names in it hold.
pub(crate) fn tell(line: impl Display) {
    write_to_standard_error(&printable(&line.to_string()));
}

/// Writes a text of several lines to standard error, in which names are [`printable`].
pub(crate) fn tell_lines(text: impl Display) {
    write_to_standard_error(&printable_lines(&text.to_string()));
}

/// If standard error cannot be written there is nobody left to tell: the exit code still does.
fn write_to_standard_error(text: &str) {
    let line = format!("{text}\n");
    let _ = std::io::stderr().lock().write_all(line.as_bytes());
}

/// Shows what is being done beside a bar.
pub(crate) fn show(bar: &ProgressBar, doing: &str) {
    bar.set_message(printable(doing).into_owned());
}

/// The exit code of a command: success only if the answer could be written.
pub(crate) fn exit_code_of(code: ExitCode) -> ExitCode {
    match LOST.lock().ok().and_then(|mut lost| lost.take()) {
        None => code,
        Some(reason) => {
            tell(format!("standard output: cannot be written: {reason}; send it where there is room"));
            if code == ExitCode::SUCCESS { ExitCode::FAILURE } else { code }
        }
    }
}
