//! The model parser: text to a model, or to a list of readable faults.

use crate::input::Input;
use crate::{count, exercise, text};
use pong_model::Extensions;

/// Parses text; the states of the frames are taken from the same bytes.
pub fn run(data: &[u8]) {
    count::input();
    let Ok(words) = std::str::from_utf8(data) else { return };
    match pong_model::parse(words, "fuzz.ron", None, &Extensions::new()) {
        Ok(model) => {
            count::accepted();
            text::accepted(data);
            exercise::run(model, &mut states(data));
        }
        Err(errors) => {
            assert!(!errors.0.is_empty(), "refused without a fault");
            for error in &errors.0 {
                assert!(error.line > 0 && error.column > 0 && !error.cause.is_empty(), "{error:?}");
                assert!(!error.rule.is_empty() && !error.cure.is_empty(), "{error:?}");
            }
            assert!(!errors.to_string().is_empty());
        }
    }
}

/// The end of the text, so that a mutation there changes the states.
fn states(data: &[u8]) -> Input<'_> {
    Input::new(&data[data.len().saturating_sub(90)..])
}
