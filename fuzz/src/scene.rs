//! The scene parser; a valid scene is run for some steps.

use crate::{count, files, text};
use pong_executive::scene::Scene;
use std::sync::Once;

/// Steps of a valid scene.
const STEPS: u64 = 3;
/// Scenes with more sub-steps are skipped, as too slow.
const WORK_MAX: usize = 4096;
/// Models that seeds name, beside the scene.
const MODELS: [(&str, &str); 3] = [
    ("ball.ron", include_str!("../../models/verification/ball.ron")),
    ("ground.ron", include_str!("../../models/verification/ground.ron")),
    ("bar.ron", include_str!("../../models/verification/bar.ron")),
];

static WRITTEN: Once = Once::new();

/// Parses text; models are found in a folder with three of them.
pub fn run(data: &[u8]) {
    count::input();
    WRITTEN.call_once(|| {
        for (name, text) in MODELS {
            files::write(name, text.as_bytes());
        }
    });
    let Ok(words) = std::str::from_utf8(data) else { return };
    let scene = match Scene::parse(words, "fuzz.ron", files::folder()) {
        Ok(scene) => scene,
        Err(errors) => return assert!(!errors.to_string().is_empty()),
    };
    // Any number of sub-steps is valid, but slow.
    if substeps(words) > WORK_MAX {
        return;
    }
    let mut built = match scene.build() {
        Ok(built) => built,
        Err(errors) => return assert!(!errors.to_string().is_empty()),
    };
    count::accepted();
    text::accepted(data);
    for _ in 0..STEPS.min(built.steps) {
        if built.simulation.step().is_err() {
            return;
        }
        count::frame();
    }
}

/// The largest number after the word `substeps`.
fn substeps(text: &str) -> usize {
    let numbers = text.split("substeps").skip(1).map(|rest| {
        let digits = rest.trim_start_matches([' ', ':', '\n', '\t']);
        let end = digits.find(|c: char| !c.is_ascii_digit() && c != '_').unwrap_or(digits.len());
        digits[..end].replace('_', "").parse().unwrap_or(if end == 0 { 0 } else { usize::MAX })
    });
    numbers.max().unwrap_or(0)
}
