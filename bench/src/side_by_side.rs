//! Two worlds side by side, on a core each: what two cores can do together at best.
//!
//! Cores may share more than memory: two that are threads of one processor core, or run slower when both are busy, do less
//! together than twice what one does alone. Two worlds that know nothing of each other have no other reason to be slow.

use crate::rig::{Rig, bind_other, cores};
use pong_engine::State;
use std::hint::{black_box, spin_loop};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::*};
use std::thread::{JoinHandle, Thread};
use std::time::{Duration, Instant};

/// How long the second thread waits for the next pass before it sleeps: longer than between a warm-up and its pass, and shorter
/// than the warm-up of whoever comes next, whom it would slow down where both cores are one.
const WAITS: Duration = Duration::from_micros(50);

/// One world for the caller, and one with a thread and a core of its own.
pub struct SideBySide {
    own: Frames,
    pass: Arc<Pass>,
    thread: Option<JoinHandle<()>>,
}

/// What both are at.
#[derive(Default)]
struct Pass {
    /// Frames that nobody has begun.
    left: AtomicUsize,
    /// Frames that are done.
    done: AtomicUsize,
    /// Passes that were begun.
    number: AtomicUsize,
    ends: AtomicBool,
}

/// A world, and where it is on its path.
struct Frames {
    rig: Rig,
    states: Vec<Vec<State>>,
    next: usize,
}

impl SideBySide {
    /// Of two worlds of one thread each, and a path of frames that closes; `None` where there is one core.
    pub fn new(rigs: [Rig; 2], states: &[Vec<State>]) -> Option<Self> {
        if cores().len() < 2 {
            return None;
        }
        let pass = Arc::new(Pass::default());
        let [own, other] = rigs.map(|rig| Frames { rig, states: states.to_vec(), next: 0 });
        let shared = Arc::clone(&pass);
        let thread = std::thread::spawn(move || serve(other, &shared));
        Some(Self { own, pass, thread: Some(thread) })
    }

    /// As many frames as the path has, shared out: whoever is ready begins the next one of its own world.
    pub fn pass(&mut self) {
        let frames = self.own.states.len();
        self.pass.done.store(0, Relaxed);
        self.pass.left.store(frames, Release);
        self.pass.number.fetch_add(1, AcqRel);
        self.other().unpark();
        self.own.run(&self.pass);
        while self.pass.done.load(Acquire) < frames {
            spin_loop();
        }
    }

    fn other(&self) -> &Thread {
        self.thread.as_ref().expect("it runs until the end").thread()
    }
}

impl Drop for SideBySide {
    fn drop(&mut self) {
        self.pass.ends.store(true, Release);
        self.other().unpark();
        if let Some(thread) = self.thread.take() {
            // Its panic has been told.
            let _ = thread.join();
        }
    }
}

impl Frames {
    /// Runs frames until none is left.
    fn run(&mut self, pass: &Pass) {
        while pass.left.fetch_update(AcqRel, Acquire, |left| left.checked_sub(1)).is_ok() {
            black_box(self.rig.step(&self.states[self.next]));
            self.next = (self.next + 1) % self.states.len();
            pass.done.fetch_add(1, AcqRel);
        }
    }
}

/// The second thread.
fn serve(mut own: Frames, pass: &Pass) {
    bind_other();
    let mut seen = 0;
    while !pass.ends.load(Acquire) {
        let waits = Instant::now();
        while pass.number.load(Acquire) == seen && waits.elapsed() < WAITS {
            spin_loop();
        }
        let number = pass.number.load(Acquire);
        if number == seen {
            std::thread::park();
            continue;
        }
        seen = number;
        own.run(pass);
    }
}
