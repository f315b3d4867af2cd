//! The size of a test that draws samples: `PONG_TESTS=quick` (the default) takes a tenth of them, `PONG_TESTS=full` all. A short
//! run draws the first samples of a full one, so that a failure of either can be repeated in the other.

use std::sync::OnceLock;

/// The name of the setting.
const SETTING: &str = "PONG_TESTS";

/// True if tests run with all of their samples.
///
/// # Panics
///
/// If `PONG_TESTS` is neither `quick` nor `full`.
pub fn is_full() -> bool {
    static FULL: OnceLock<bool> = OnceLock::new();
    *FULL.get_or_init(|| match std::env::var(SETTING).as_deref() {
        Ok("full") => true,
        Ok("quick") | Err(std::env::VarError::NotPresent) => false,
        other => panic!("{SETTING} is {other:?}: set it to quick or to full, or leave it out"),
    })
}

/// `all` samples in a full run, a tenth of them, rounded up, in a quick one. A test that fails shows which it was.
pub fn samples(all: usize) -> usize {
    let (name, count) = if is_full() { ("full", all) } else { ("quick", all.div_ceil(10)) };
    println!("{SETTING}={name}: {count} of {all} samples");
    count
}
