//! The size of a test that draws samples: `PONG_TESTS=quick` (the default) takes a tenth of them, `PONG_TESTS=full` all, and
//! `PONG_TESTS=night` more of those that take long, and 1e5 random poses. A short run draws the first samples of a longer one,
//! so that a failure of either can be repeated in the other.

use std::sync::OnceLock;

/// The name of the setting.
const SETTING: &str = "PONG_TESTS";

/// Sizes of a run, from short to long.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Size {
    Quick,
    Full,
    Night,
}

/// The size that the setting names.
fn size() -> Size {
    static SIZE: OnceLock<Size> = OnceLock::new();
    *SIZE.get_or_init(|| match std::env::var(SETTING).as_deref() {
        Ok("night") => Size::Night,
        Ok("full") => Size::Full,
        Ok("quick") | Err(std::env::VarError::NotPresent) => Size::Quick,
        other => panic!("{SETTING} is {other:?}: set it to quick, full or night, or leave it out"),
    })
}

/// True if tests run with all of their samples.
///
/// # Panics
///
/// If `PONG_TESTS` is neither `quick` nor `full` nor `night`.
pub fn is_full() -> bool {
    size() >= Size::Full
}

/// `all` samples in a full run, a tenth of them, rounded up, in a quick one. A test that fails shows which it was.
pub fn samples(all: usize) -> usize {
    let (name, count) = if is_full() { ("full", all) } else { ("quick", all.div_ceil(10)) };
    println!("{SETTING}={name}: {count} of {all} samples");
    count
}

/// Samples of a test that takes long: `night` of them in a run of the night, `full` in a full run and a tenth of `full`, rounded
/// up, in a quick one.
pub fn long_samples(full: usize, night: usize) -> usize {
    if size() < Size::Night {
        return samples(full);
    }
    println!("{SETTING}=night: {night} samples");
    night
}

/// Random poses of each property of a pair of solids: 100 in a quick run, 1,000 in a full one, 1e5 in a long one.
pub fn poses() -> usize {
    match size() {
        Size::Quick => 100,
        Size::Full => 1000,
        Size::Night => 100_000,
    }
}
