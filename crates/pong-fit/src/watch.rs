//! Reports of progress to the caller.

use crate::error::{FitError, Result};
use std::ops::ControlFlow;

/// Called with what is done at present; may end the identification.
pub type Watch<'a> = &'a mut dyn FnMut(&str) -> ControlFlow<()>;

/// Reports the present activity to the caller.
pub(crate) fn tell(watch: Watch<'_>, doing: &str) -> Result<()> {
    match watch(doing) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(FitError("the identification was ended".to_owned())),
    }
}
