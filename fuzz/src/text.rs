//! Mutations of text that keep most of it a valid model, scene or mesh: libFuzzer's own mutations change
//! single bytes, of which the parser accepted one text in a hundred.
//!
//! A text is divided into numbers, words and pieces (parts between the commas of a bracket, or lines where
//! there are no brackets). Numbers are replaced by other numbers, words by other words of the text; pieces
//! are removed, doubled or replaced by others. Half of the mutations start from an accepted text, because
//! libFuzzer mostly keeps texts that are refused in new ways, from which nothing valid results.

use crate::input::NUMBERS;
use pong_testkit::Random;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Share of mutations by libFuzzer itself, in eighths.
const OWN: usize = 2;
/// Number of accepted texts that are kept.
const KEPT: usize = 512;

static ACCEPTED: Mutex<Vec<Vec<u8>>> = Mutex::new(Vec::new());

/// Keeps an accepted text; replaces another one when there are many.
pub fn accepted(text: &[u8]) {
    let mut kept = ACCEPTED.lock().unwrap_or_else(PoisonError::into_inner);
    if kept.len() < KEPT {
        kept.push(text.to_vec());
    } else {
        let sum =
            text.iter().fold(0, |sum: usize, byte| sum.wrapping_mul(31).wrapping_add(usize::from(*byte)));
        kept[sum % KEPT] = text.to_vec();
    }
}

/// libFuzzer's own mutation; answers the new length.
#[cfg(fuzzing)]
fn change_bytes(data: &mut [u8], size: usize, max_size: usize) -> usize {
    libfuzzer_sys::fuzzer_mutate(data, size, max_size)
}

/// Without libFuzzer nothing changes.
#[cfg(not(fuzzing))]
fn change_bytes(_data: &mut [u8], size: usize, _max_size: usize) -> usize {
    size
}

/// libFuzzer's custom mutator: `data[..size]` is the text, with room for `max_size` bytes; returns the new
/// length.
pub fn mutate(data: &mut [u8], size: usize, max_size: usize, seed: u32) -> usize {
    let mut dice = Random(u64::from(seed) | 1 << 40);
    let is_text = std::str::from_utf8(&data[..size]).is_ok();
    if size == 0 || !is_text || dice.below(8) < OWN {
        return change_bytes(data, size, max_size);
    }
    let mut text = base(&data[..size], &mut dice);
    for _ in 0..=dice.below(4) {
        change(&mut text, &mut dice);
    }
    if text.len() > max_size || text == data[..size] {
        return change_bytes(data, size, max_size);
    }
    data[..text.len()].copy_from_slice(&text);
    text.len()
}

/// Text at which a mutation starts.
fn base(given: &[u8], dice: &mut Random) -> Vec<u8> {
    let kept = ACCEPTED.lock().unwrap_or_else(PoisonError::into_inner);
    if kept.is_empty() || dice.below(2) == 0 { given.to_vec() } else { kept[dice.below(kept.len())].clone() }
}

fn change(text: &mut Vec<u8>, dice: &mut Random) {
    let parts = Parts::new(text);
    let (place, new) = match dice.below(8) {
        0..=3 => {
            let Some(place) = one_of(dice, &parts.numbers) else { return };
            (place.clone(), number(&text[place], &parts, text, dice))
        }
        4 => {
            let (Some(place), Some(other)) = (one_of(dice, &parts.words), one_of(dice, &parts.words)) else {
                return;
            };
            (place, text[other].to_vec())
        }
        5 => {
            let Some(piece) = one_of(dice, &parts.pieces) else { return };
            (with_separator(&piece, text), Vec::new())
        }
        6 => {
            let Some(piece) = one_of(dice, &parts.pieces) else { return };
            let copy = &text[piece.clone()];
            let separator = if text.get(piece.end) == Some(&b'\n') { b'\n' } else { b',' };
            (piece.clone(), [copy, &[separator], copy].concat())
        }
        _ => {
            let (Some(place), Some(other)) = (one_of(dice, &parts.pieces), one_of(dice, &parts.pieces))
            else {
                return;
            };
            (place, text[other].to_vec())
        }
    };
    text.splice(place, new);
}

/// Another number: one at which a check may change behaviour, one from elsewhere in the text, or a multiple.
fn number(old: &[u8], parts: &Parts, text: &[u8], dice: &mut Random) -> Vec<u8> {
    const FACTORS: [f64; 8] = [-1.0, 0.0, 0.5, 0.999_999_9, 1.000_000_1, 2.0, 10.0, 1e-3];
    let value: f64 = std::str::from_utf8(old).ok().and_then(|word| word.parse().ok()).unwrap_or(1.0);
    let new = match dice.below(8) {
        0 => NUMBERS[dice.below(NUMBERS.len())],
        1 => dice.below(12) as f64,
        2 | 3 => return one_of(dice, &parts.numbers).map_or_else(Vec::new, |other| text[other].to_vec()),
        4 => value + (dice.below(9) as f64 - 4.0) * 0.25,
        _ => value * FACTORS[dice.below(FACTORS.len())],
    };
    // An integer stays an integer.
    let is_whole = !old.iter().any(|byte| b".eE".contains(byte));
    if is_whole && new.fract() == 0.0 && new.abs() < 1e15 { format!("{new:.0}") } else { format!("{new:?}") }
        .into_bytes()
}

/// A piece with the following comma or line end.
fn with_separator(piece: &Range<usize>, text: &[u8]) -> Range<usize> {
    let follows = matches!(text.get(piece.end), Some(b',' | b'\n'));
    piece.start..piece.end + usize::from(follows)
}

/// Positions of the numbers, words and pieces of a text.
#[derive(Default)]
struct Parts {
    numbers: Vec<Range<usize>>,
    words: Vec<Range<usize>>,
    pieces: Vec<Range<usize>>,
}

impl Parts {
    fn new(text: &[u8]) -> Self {
        let mut parts = Self::default();
        // Starts of the open pieces, the outermost first.
        let mut open = Vec::new();
        let mut line = 0;
        let mut at = 0;
        while at < text.len() {
            let start = at;
            at += match text[at] {
                b'"' => {
                    let length =
                        text[at + 1..].iter().position(|byte| *byte == b'"').map_or(1, |end| end + 2);
                    parts.words.push(start..start + length);
                    length
                }
                byte if is_of_word(byte) => {
                    let length =
                        text[at..].iter().position(|byte| !is_of_word(*byte)).unwrap_or(text.len() - at);
                    parts.word(start..start + length, byte);
                    length
                }
                byte => {
                    parts.punctuation(byte, start, &mut open, &mut line);
                    1
                }
            };
        }
        parts
    }

    fn word(&mut self, place: Range<usize>, first: u8) {
        if first.is_ascii_digit() || b"+-.".contains(&first) {
            self.numbers.push(place);
        } else {
            self.words.push(place);
        }
    }

    fn punctuation(&mut self, byte: u8, at: usize, open: &mut Vec<usize>, line: &mut usize) {
        match byte {
            b'(' | b'[' | b'{' => open.push(at + 1),
            b',' => self.piece(open.last_mut(), at),
            b')' | b']' | b'}' => {
                self.piece(open.last_mut(), at);
                open.pop();
            }
            b'\n' if open.is_empty() => self.piece(Some(line), at),
            _ => {}
        }
    }

    /// Ends a piece; the next one begins behind it.
    fn piece(&mut self, start: Option<&mut usize>, end: usize) {
        let Some(start) = start else { return };
        if *start < end {
            self.pieces.push(*start..end);
        }
        *start = end + 1;
    }
}

fn is_of_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || b"_+-.".contains(&byte)
}

fn one_of(random: &mut Random, places: &[Range<usize>]) -> Option<Range<usize>> {
    if places.is_empty() { None } else { Some(places[random.below(places.len())].clone()) }
}
