//! Checks of every call, and generators of all kinds of arguments.

use super::host::{Host, Ids};
use crate::count;
use crate::input::Input;
use pong::status::{pong_last_message, pong_status};
use pong::world::pong_world;
use pong_model::Fnv;
use std::collections::HashSet;
use std::ffi::{CStr, CString, c_char};
use std::mem::MaybeUninit;

/// Validity of an argument, or of a whole call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sure {
    /// The call must be refused.
    Wrong,
    /// The result is not known.
    Unknown,
    /// The call must succeed.
    Right,
}

impl Sure {
    pub fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Wrong, _) | (_, Self::Wrong) => Self::Wrong,
            (Self::Unknown, _) | (_, Self::Unknown) => Self::Unknown,
            _ => Self::Right,
        }
    }

    /// `Wrong` unless the condition holds.
    pub fn only_if(self, condition: bool) -> Self {
        self.and(if condition { Self::Right } else { Self::Wrong })
    }

    /// `Unknown` if the condition holds.
    pub fn unless(self, condition: bool) -> Self {
        self.and(if condition { Self::Unknown } else { Self::Right })
    }
}

/// An output argument of exact size, so that an overrun by a byte is detected; or NULL, or misaligned.
pub struct Place<T> {
    pub pointer: *mut T,
    pub sure: Sure,
    memory: Box<MaybeUninit<T>>,
}

impl<T: Copy> Place<T> {
    /// The value written. Valid only after a success with a valid output argument.
    pub fn get(&self) -> T {
        // SAFETY: by the contract of this function.
        unsafe { self.memory.as_ptr().read() }
    }
}

/// Memory for misaligned pointers.
static mut CROOKED: [u64; 512] = [0; 512];

/// Most worlds of a host at a time.
pub const WORLDS: usize = 3;

/// Most bytes of contact state that an input copies: about a second under the sanitizer.
const COPIED_MAX: usize = 256 << 20;

pub struct Session<'a> {
    pub input: Input<'a>,
    hosts: [Option<Box<Host>>; WORLDS],
    pub current: usize,
    /// Ids of destroyed worlds.
    pub stale: Ids,
    /// Calls so far, and the refused ones.
    made: usize,
    refused: Vec<usize>,
    left_out: HashSet<usize>,
    /// Hash of all frames.
    frames: Fnv,
    /// True if no second thread, worker or clock took part.
    pub alone: bool,
    /// Expensive calls so far.
    pub costs: u32,
    /// Sizes of contact states saved and restored so far, bytes.
    copied: usize,
}

impl<'a> Session<'a> {
    pub fn new(data: &'a [u8]) -> Self {
        Self {
            input: Input::new(data),
            hosts: [const { None }; WORLDS],
            current: 0,
            stale: Ids::default(),
            made: 0,
            refused: Vec::new(),
            left_out: HashSet::new(),
            frames: Fnv::default(),
            alone: true,
            costs: 0,
            copied: 0,
        }
    }

    /// As [`new`](Self::new), skipping these calls.
    pub fn without(data: &'a [u8], refused: Vec<usize>) -> Self {
        Self { left_out: refused.into_iter().collect(), ..Self::new(data) }
    }

    /// Destroys all worlds; returns the refused calls, the hash of the frames, and whether no other thread
    /// took part.
    pub fn finish(mut self) -> (Vec<usize>, Fnv, bool) {
        for slot in 0..WORLDS {
            self.current = slot;
            self.destroy();
        }
        (self.refused, self.frames, self.alone)
    }

    /// Makes a call and checks its status and message.
    pub fn call(&mut self, name: &str, sure: Sure, call: impl FnOnce() -> pong_status) -> bool {
        self.made += 1;
        if self.left_out.contains(&self.made) {
            return false;
        }
        let status = call();
        count::call(status == pong_status::Ok);
        // Skipped calls make later results uncertain.
        check(name, status, if self.is_again() { Sure::Unknown } else { sure });
        if status != pong_status::Ok {
            self.refused.push(self.made);
        }
        status == pong_status::Ok
    }

    /// True if contact state of this size may still be copied: blocks of some scenes are megabytes.
    pub fn may_copy(&mut self, bytes: usize) -> bool {
        self.copied = self.copied.saturating_add(bytes);
        self.copied <= COPIED_MAX
    }

    /// Calls so far.
    pub fn calls(&self) -> usize {
        self.made
    }

    /// True if calls are skipped, so that results which depend on them are not known.
    pub fn is_again(&self) -> bool {
        !self.left_out.is_empty()
    }

    /// Adds the bits of a frame to the hash.
    pub fn note(&mut self, words: impl Iterator<Item = u64>) {
        for word in words {
            self.frames.word(word);
        }
    }

    pub fn host(&mut self) -> Option<&mut Host> {
        self.hosts[self.current].as_deref_mut()
    }

    pub fn hosts(&mut self) -> &mut [Option<Box<Host>>; WORLDS] {
        &mut self.hosts
    }

    /// The present world; occasionally NULL, always if there is none.
    pub fn world(&mut self) -> (*mut pong_world, Sure) {
        let nothing = self.input.chance(2);
        match self.host() {
            Some(host) if !nothing => (host.world, Sure::Right),
            _ => (std::ptr::null_mut(), Sure::Wrong),
        }
    }

    /// An id: mostly valid, else zero, one of another world, one of a destroyed world, or any number.
    pub fn id<T: Copy>(&mut self, of: impl Fn(&Ids) -> &Vec<T>, make: impl Fn(u64) -> T) -> (T, Sure) {
        let good = !self.input.chance(12);
        if good {
            let at = self.input.byte() as usize;
            let ids = self.host().map(|host| of(&host.ids));
            return match ids {
                Some(ids) if !ids.is_empty() => (ids[at % ids.len()], Sure::Right),
                _ => (make(0), Sure::Wrong),
            };
        }
        let at = self.input.byte() as usize;
        let any = |ids: &Vec<T>| (!ids.is_empty()).then(|| ids[at % ids.len().max(1)]);
        let wrong = match self.input.below(4) {
            0 => any(of(&self.stale)),
            1 => {
                let other = self.hosts[(self.current + 1) % WORLDS].as_deref();
                other.and_then(|host| any(of(&host.ids)))
            }
            2 => return (make(u64::from_le_bytes(self.input.bytes())), Sure::Unknown),
            _ => None,
        };
        (wrong.unwrap_or(make(0)), Sure::Wrong)
    }

    /// An output argument for a result.
    pub fn place<T>(&mut self) -> Place<T> {
        let mut memory = Box::<T>::new_uninit();
        let (pointer, sure) = match (self.input.chance(6), align_of::<T>()) {
            (false, _) => (memory.as_mut_ptr(), Sure::Right),
            (true, 8) if self.input.chance(128) => {
                let start: *mut u8 = (&raw mut CROOKED).cast();
                (start.wrapping_add(4).cast(), Sure::Wrong)
            }
            (true, _) => (std::ptr::null_mut(), Sure::Wrong),
        };
        Place { pointer, sure, memory }
    }

    /// One of several texts, or an invalid one.
    pub fn text(&mut self, all: &[&str]) -> Text {
        match self.input.byte() {
            0..=2 => Text { text: None, sure: Sure::Wrong },
            3 | 4 => Text { text: Some(c"\xff\xfe".into()), sure: Sure::Wrong },
            5 => Text { text: CString::new("long ".repeat(300)).ok(), sure: Sure::Unknown },
            6 => Text { text: CString::new(self.input.slice(12)).ok(), sure: Sure::Unknown },
            byte => Text { text: CString::new(all[byte as usize % all.len()]).ok(), sure: Sure::Unknown },
        }
    }
}

/// A text and its validity.
pub struct Text {
    pub text: Option<CString>,
    pub sure: Sure,
}

impl Text {
    pub fn pointer(&self) -> *const c_char {
        self.text.as_ref().map_or(std::ptr::null(), |text| text.as_ptr())
    }
}

/// Checks the conditions that hold after any call.
pub fn check(name: &str, status: pong_status, sure: Sure) {
    // SAFETY: the message is never NULL, ends with a zero byte and lives until the thread's next call.
    let message = unsafe { CStr::from_ptr(pong_last_message()) }.to_string_lossy();
    assert!(status != pong_status::Panic, "{name}: {message}");
    assert!(
        (status == pong_status::Ok) == message.is_empty(),
        "{name}: {status:?} with the message {message:?}"
    );
    match sure {
        Sure::Right => assert!(status == pong_status::Ok, "{name}: refused with {status:?}: {message}"),
        Sure::Wrong => assert!(status != pong_status::Ok, "{name}: succeeded and should not"),
        Sure::Unknown => {}
    }
}

/// Reads a text of the library to its end.
pub fn read_text(text: *const c_char) {
    assert!(!text.is_null(), "a text that is NULL after a success");
    // SAFETY: the library promises a text that ends with a zero byte.
    let length = unsafe { CStr::from_ptr(text) }.to_bytes().len();
    std::hint::black_box(length);
}
