//! Sequences of C calls: any order, any ids, any numbers, checked against the documented results.
//!
//! The bytes are a program for [`Session`]: the call, its world and its arguments. Every argument is known to
//! be valid, invalid or unknown, so that for most calls the harness knows whether they must succeed or be
//! refused.
//!
//! | file | calls |
//! |---|---|
//! | `session.rs` | checks of every call; ids, output pointers, texts and numbers as arguments |
//! | `host.rs` | a world and the harness's knowledge of it |
//! | `laws.rs` | laws by callback, well behaved or not |
//! | `set_up.rs`, `step_plans.rs`, `look_up.rs`, `frames.rs`, `between.rs`, `logs.rs` | the calls, by phase |
//! | `accounts.rs`, `tangents.rs`, `slow_hosts.rs` | energy accounts, tangents of a frame, slow hosts |
//! | `misuse.rs` | two threads on one world |
//!
//! Some inputs run twice, the second time without the calls that were refused the first time. Every frame
//! must have the same bits, since a refused call changes nothing that a later frame can see.

mod accounts;
mod between;
mod frames;
mod host;
mod laws;
mod logs;
mod look_up;
mod misuse;
mod session;
mod set_up;
mod slow_hosts;
mod step_plans;
mod tangents;

use crate::count;
use crate::input::Input;
use session::Session;

/// Number of runs of the same bytes, one after the other in the same worlds: creating a world takes longer
/// than a hundred calls.
const PASSES: [u32; 8] = [1, 1, 2, 4, 8, 16, 32, 64];
/// Calls of an input after which no further pass begins.
const CALLS_MAX: usize = 20_000;

/// Runs the calls encoded by the bytes.
pub fn run(data: &[u8]) {
    count::input();
    let Some((first, rest)) = data.split_first() else { return };
    let passes = PASSES[usize::from(first >> 4) % PASSES.len()];
    let mut session = Session::new(rest);
    session.prologue(first % 8);
    session.all_calls(passes);
    let (refused, frames, alone) = session.finish();
    logs::remove_folders();
    if first & 8 == 0 || !alone || refused.is_empty() {
        return;
    }
    let mut again = Session::without(rest, refused);
    again.prologue(first % 8);
    again.all_calls(passes);
    let (_, frames_again, _) = again.finish();
    logs::remove_folders();
    assert!(frames == frames_again, "a refused call changed a later frame");
}

impl Session<'_> {
    fn all_calls(&mut self, passes: u32) {
        let bytes = self.input.rest();
        for _ in 0..passes {
            self.input = Input::new(bytes);
            while !self.input.is_empty() {
                self.one_call();
            }
            if self.calls() > CALLS_MAX {
                return;
            }
        }
    }

    /// Makes one call; frames are more frequent than others.
    fn one_call(&mut self) {
        match self.input.byte() {
            0..=99 => self.call_of_a_frame(),
            100..=159 => self.look_up(),
            160..=209 => self.between_frames(),
            210..=244 => self.set_up(),
            245..=248 => self.log(),
            249 => self.two_threads(),
            250..=252 => self.switch_world(),
            253 => self.end_world(),
            254 => self.change_laws(),
            255 => self.slow_host(),
        }
    }
}
