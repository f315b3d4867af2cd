//! All writing to a terminal or its replacement.
//!
//! Names in a model, a scene, a log or a mesh cannot control the terminal: control characters are escaped. A
//! message that cannot be written does not end the work. If the answer on standard output is lost, the
//! program reports it and its exit code says so; only a reader that has closed the pipe (`pong … | head`) is
//! no error.

use indicatif::{ProgressBar, ProgressStyle};
use pong_model::{printable, printable_lines};
use std::error::Error;
use std::fmt::Display;
use std::io::{ErrorKind, Write};
use std::path::Path;
use std::process::ExitCode;
use std::sync::Mutex;
use std::time::Duration;

/// Error of a command: text for standard error, of several lines, in which names are [`printable`].
pub(crate) type Failure = Box<dyn Error>;

/// Result of a command: its exit code, or an error to report.
pub(crate) type Outcome = Result<ExitCode, Failure>;

/// A failure in one line, with line ends in names escaped.
pub(crate) fn failure(line: impl Display) -> Failure {
    printable(&line.to_string()).into_owned().into()
}

/// First reason why the answer could not be written.
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

/// Writes one line to standard error, with line ends in names escaped.
pub(crate) fn tell(line: impl Display) {
    write_to_standard_error(&printable(&line.to_string()));
}

/// Writes a text of several lines to standard error, in which names are [`printable`].
pub(crate) fn tell_lines(text: impl Display) {
    write_to_standard_error(&printable_lines(&text.to_string()));
}

/// Ignores errors: if standard error cannot be written, only the exit code is left.
fn write_to_standard_error(text: &str) {
    let line = format!("{text}\n");
    let _ = std::io::stderr().lock().write_all(line.as_bytes());
}

/// Error of an output file that could not be written.
pub(crate) fn unwritable(path: &Path, reason: &std::io::Error) -> Failure {
    failure(format!("{}: cannot be written: {reason}; name a file in a folder with room", path.display()))
}

/// Progress bar, or a spinner if the total is unknown, on standard error, if that is a terminal.
pub(crate) fn progress(of: Option<u64>, template: &str, quiet: bool) -> ProgressBar {
    if quiet {
        return ProgressBar::hidden();
    }
    let bar = of.map_or_else(ProgressBar::new_spinner, ProgressBar::new);
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

/// The template of a spinner.
pub(crate) const SPINNER: &str = "{spinner} {elapsed} {msg}";

/// Shows the present activity beside a bar.
pub(crate) fn show(bar: &ProgressBar, doing: &str) {
    bar.set_message(printable(doing).into_owned());
}

/// Reports the error of a command, if there is one, and returns its exit code: success only if the answer
/// could be written.
pub(crate) fn exit_code_of(outcome: Outcome) -> ExitCode {
    let code = outcome.unwrap_or_else(|failure| {
        tell_lines(failure);
        ExitCode::FAILURE
    });
    match LOST.lock().ok().and_then(|mut lost| lost.take()) {
        None => code,
        Some(reason) => {
            tell(format!("standard output: cannot be written: {reason}; send it where there is room"));
            if code == ExitCode::SUCCESS { ExitCode::FAILURE } else { code }
        }
    }
}
