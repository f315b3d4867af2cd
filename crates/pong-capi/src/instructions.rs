//! The widest vector instructions that the process may use, by its environment.

use crate::failure::{Failure, Outcome};
use crate::status::pong_status;
use pong_geometry::simd::{Level, set_level};
use std::sync::OnceLock;

/// Name of the environment variable.
const VARIABLE: &str = "PONG_SIMD";
const NAMES: [(&str, Level); 3] =
    [("portable", Level::Portable), ("avx2", Level::Avx2), ("avx512", Level::Avx512)];

/// Applies the environment variable, once in a process. Results are the same bits at every level.
pub(crate) fn apply_environment() -> Outcome {
    static APPLIED: OnceLock<Result<(), String>> = OnceLock::new();
    let applied = APPLIED.get_or_init(|| match std::env::var_os(VARIABLE) {
        None => Ok(()),
        Some(text) => level(&text.to_string_lossy()).map(|level| {
            set_level(level);
        }),
    });
    applied.clone().map_err(|message| Failure::new(pong_status::Config, message))
}

fn level(text: &str) -> Result<Level, String> {
    let known = NAMES.iter().find(|(name, _)| *name == text);
    known.map(|(_, level)| *level).ok_or_else(|| {
        let names = NAMES.map(|(name, _)| name).join(", ");
        format!("environment: {VARIABLE} is `{text}`; set it to one of {names}, or leave it out")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_levels() {
        assert_eq!(level("portable"), Ok(Level::Portable));
        assert_eq!(level("avx2"), Ok(Level::Avx2));
        assert!(level("AVX").unwrap_err().contains("portable, avx2, avx512"));
        assert!(level("").is_err());
    }
}
