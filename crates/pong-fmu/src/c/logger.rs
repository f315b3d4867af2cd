//! The importer's logger.

use pong_fpenv::lent;
use std::ffi::{CString, c_char, c_int, c_void};

/// `fmi2Status` and `fmi3Status`.
pub(super) type Status = c_int;
pub(super) const OK: Status = 0;
pub(super) const WARNING: Status = 1;
pub(super) const DISCARD: Status = 2;
pub(super) const ERROR: Status = 3;
pub(super) const FATAL: Status = 4;

/// `fmi2CallbackLogger`: the message is a printf format.
pub(super) type Fmi2Log =
    unsafe extern "C" fn(*mut c_void, *const c_char, Status, *const c_char, *const c_char, ...);
/// `fmi3LogMessageCallback`.
pub(super) type Fmi3Log = unsafe extern "C" fn(*mut c_void, Status, *const c_char, *const c_char);

/// Destination of messages.
pub(super) enum Sink {
    /// The importer's function, and the name of the instance.
    Fmi2(Fmi2Log, CString),
    Fmi3(Fmi3Log),
    /// No destination, if the importer gave no function.
    None,
}

pub(super) struct Logger {
    pub sink: Sink,
    /// Passed back to the importer with every message.
    pub environment: *mut c_void,
    /// True if events are logged. Refusals and warnings always are.
    pub tells_events: bool,
}

impl Logger {
    /// Logs a message, in the category of its status.
    pub fn tell(&self, status: Status, text: &str) {
        let category = match status {
            OK if !self.tells_events => return,
            OK => c"logEvents",
            WARNING => c"logStatusWarning",
            DISCARD => c"logStatusDiscard",
            ERROR => c"logStatusError",
            _ => c"logStatusFatal",
        };
        let text = pong_model::printable_lines(text);
        match &self.sink {
            Sink::None => {}
            Sink::Fmi2(log, name) => {
                // `%` begins an argument of printf, `#` a value reference: doubled they are literal.
                let message = c_text(&text.replace('%', "%%").replace('#', "##"));
                // SAFETY: the importer's function with texts that live as long as the call; no arguments
                // follow, because the message has no conversions.
                lent(|| unsafe {
                    log(self.environment, name.as_ptr(), status, category.as_ptr(), message.as_ptr());
                });
            }
            Sink::Fmi3(log) => {
                let message = c_text(&text);
                // SAFETY: as above.
                lent(|| unsafe { log(self.environment, status, category.as_ptr(), message.as_ptr()) });
            }
        }
    }
}

/// Text as a C string. A zero byte would end it early, but printable texts have none.
pub(super) fn c_text(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).unwrap_or_default()
}
