//! Atomic words shared by the caller and its workers, each on a cache line of its own.
//!
//! | word | written by | holds |
//! |---|---|---|
//! | `claim` | caller opens, all threads claim | epoch, workers that take part, blocks left, end flag |
//! | `tally` of a worker | that worker only | epoch, blocks done, panic flag |
//! | `asleep` | all threads | one bit per worker that is parked or about to park |
//! | `alert` | caller | time until which workers stay awake |
//!
//! A comment at each access justifies its memory ordering. README.md explains the whole protocol.

use std::ops::Range;
use std::sync::OnceLock;
use std::sync::atomic::Ordering::{AcqRel, Acquire, Relaxed, Release};

use crossbeam_utils::CachePadded;

use crate::sync::{AtomicU64, Thread, current, mutant};
use crate::word::Word;

/// Progress of one worker, written when it has run the blocks of a claim. Only that worker writes it, so no
/// compare-and-swap is needed. `word` contains the epoch of the blocks, so blocks of an abandoned phase are
/// not counted in a later one.
struct Tally {
    word: AtomicU64,
    /// Blocks finished since the start, in all phases.
    finished: AtomicU64,
    /// Time spent in the blocks of the epoch in `word`, ns.
    busy_ns: AtomicU64,
}

/// Work that one worker, or the caller, has done in one phase.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Done {
    pub blocks: u32,
    pub busy_ns: u64,
    pub panicked: bool,
}

pub struct Board {
    claim: CachePadded<AtomicU64>,
    asleep: CachePadded<AtomicU64>,
    alert: CachePadded<AtomicU64>,
    tallies: Box<[CachePadded<Tally>]>,
    threads: Box<[OnceLock<Thread>]>,
}

/// Value of `alert`: park at once.
pub const PARK: u64 = u64::MAX;
/// Value of `alert`: no alert.
pub const CALM: u64 = 0;

impl Board {
    pub fn new(workers: usize) -> Board {
        let tally = || Tally {
            word: AtomicU64::new(Word::new(0, 0, false).0),
            finished: AtomicU64::new(0),
            busy_ns: AtomicU64::new(0),
        };
        Board {
            claim: CachePadded::new(AtomicU64::new(Word::new(0, 0, false).0)),
            asleep: CachePadded::new(AtomicU64::new(0)),
            alert: CachePadded::new(AtomicU64::new(CALM)),
            tallies: (0..workers).map(|_| CachePadded::new(tally())).collect(),
            threads: (0..workers).map(|_| OnceLock::new()).collect(),
        }
    }

    pub fn workers(&self) -> usize {
        self.tallies.len()
    }

    // ---- claim word

    /// Opens a phase to the first `workers` workers.
    ///
    /// A store without compare-and-swap is enough: the previous phase has no block left, so no thread can
    /// change the word by a claim. The store publishes everything that the caller wrote before. Claims are
    /// read-modify-writes and continue its release sequence, so later claims acquire it too.
    pub fn open(&self, epoch: u64, workers: usize, blocks: u32) {
        debug_assert_eq!(Word(self.claim.load(Relaxed)).number(), 0);
        self.claim.store(Word::new(epoch, blocks, false).among(workers).0, Release);
    }

    /// Takes all unclaimed blocks out of the phase, so that no thread claims them, and returns their number.
    pub fn close(&self, epoch: u64) -> u32 {
        Word(self.claim.swap(Word::new(epoch, 0, false).0, AcqRel)).number()
    }

    /// Claims some of the last blocks left in phase `epoch`; `None` if none is left or the phase is over.
    ///
    /// Compare-and-swap checks the epoch and takes the blocks in one step. So a thread that read the word
    /// before the phase ended takes nothing. (`fetch_sub` without that check could take blocks of the next
    /// phase.)
    pub fn claim(&self, epoch: u64) -> Option<Range<u32>> {
        let mut seen = Word(self.claim.load(Acquire));
        while seen.epoch() == epoch && seen.number() > 0 {
            match self.take(seen, Self::share_of(seen.number(), seen.workers())) {
                Ok(blocks) => return Some(blocks),
                Err(now) => seen = now,
            }
        }
        None
    }

    /// Returns the number of blocks that one claim takes, by guided self-scheduling (C. D. Polychronopoulos
    /// and D. J. Kuck, IEEE Trans. Comput. C-36 (1987) 1425).
    ///
    /// A claim takes an equal share of the blocks left. Once few are left, it takes three quarters of that
    /// share (as in factoring: S. F. Hummel, E. Schonberg, L. E. Flynn, Commun. ACM 35 (1992) 90). Early
    /// claims are large, so that a thread runs neighbouring blocks. Late claims are small, so that all
    /// threads finish together.
    pub fn share_of(left: u32, workers: usize) -> u32 {
        /// Blocks left per thread up to which few are left: one long block may then delay the end of the
        /// phase.
        const FEW: u32 = 8;
        let threads = workers as u32 + 1;
        if left <= FEW * threads { (3 * left).div_ceil(4 * threads) } else { left.div_ceil(threads) }
    }

    fn take(&self, seen: Word, blocks: u32) -> Result<Range<u32>, Word> {
        if mutant("fetch_add") {
            return self.take_unseen(blocks);
        }
        match self.claim.compare_exchange_weak(seen.0, seen.less(blocks).0, AcqRel, Acquire) {
            Ok(_) => Ok(seen.number() - blocks..seen.number()),
            Err(now) => Err(Word(now)),
        }
    }

    /// Claims by `fetch_sub`, without checking the epoch: a fault that the models must find.
    fn take_unseen(&self, blocks: u32) -> Result<Range<u32>, Word> {
        let taken = Word::new(0, blocks, false).0;
        let before = Word(self.claim.fetch_sub(taken, AcqRel));
        if before.number() >= blocks { Ok(before.number() - blocks..before.number()) } else { Err(before) }
    }

    /// Returns the claim word if its epoch differs from `seen` or its end flag is set; otherwise `None`.
    pub fn news(&self, seen: u64) -> Option<Word> {
        let word = Word(self.claim.load(Acquire));
        (word.epoch() != seen || word.flag()).then_some(word)
    }

    /// Sets the end flag: workers return when they see it.
    pub fn end(&self) {
        self.claim.fetch_or(Word::FLAG, AcqRel);
    }

    /// Returns the claim word of the current or the last phase.
    fn phase(&self) -> Word {
        Word(self.claim.load(Relaxed))
    }

    // ---- tallies

    /// Stores the tally of worker number `thread` after it has run the blocks of a claim: its work so far in
    /// phase `epoch`, and the number of blocks that it has finished since the start. The release stores
    /// publish what the blocks wrote.
    pub fn record(&self, thread: usize, epoch: u64, done: Done, finished: u64) {
        let tally = &self.tallies[thread - 1];
        tally.busy_ns.store(done.busy_ns, Relaxed);
        tally.finished.store(finished, Release);
        tally.word.store(Word::new(epoch, done.blocks, done.panicked).0, Release);
    }

    /// Returns the work of worker number `thread` in phase `epoch`.
    pub fn done(&self, thread: usize, epoch: u64) -> Done {
        let tally = &self.tallies[thread - 1];
        let word = Word(tally.word.load(Acquire));
        if word.epoch() != epoch && !mutant("untagged_tally") {
            return Done::default();
        }
        Done { blocks: word.number(), busy_ns: tally.busy_ns.load(Relaxed), panicked: word.flag() }
    }

    /// Returns the number of blocks that the first `workers` workers have done in phase `epoch`, and `true`
    /// if any of them panicked.
    pub fn done_by(&self, workers: usize, epoch: u64) -> (u32, bool) {
        let mut sum = (0, false);
        for thread in 1..=workers {
            let done = self.done(thread, epoch);
            sum = (sum.0 + done.blocks, sum.1 | done.panicked);
        }
        sum
    }

    /// Returns the number of blocks that all workers have finished since the start.
    pub fn finished_by_all(&self) -> u64 {
        self.tallies.iter().map(|tally| tally.finished.load(Acquire)).sum()
    }

    // ---- sleep

    /// Registers the calling thread as worker number `thread`, so that others can wake it. This must precede
    /// the first [`Board::lie_down`].
    pub fn introduce(&self, thread: usize) {
        self.threads[thread - 1].set(current()).expect("one thread per thread");
    }

    /// Marks worker number `thread` as about to park. Before it parks, the worker must check once more
    /// whether a phase, the end flag or an alert has come.
    ///
    /// This function and [`Board::asleep`] are read-modify-writes of the same word, so one of them comes
    /// first. If it is this function, the thread that calls `asleep` sees the bit and wakes the worker.
    /// Otherwise the worker's last check sees what that thread published.
    pub fn lie_down(&self, thread: usize) {
        self.asleep.fetch_or(1 << (thread - 1), AcqRel);
    }

    /// Marks worker number `thread` as awake, whoever woke it.
    pub fn get_up(&self, thread: usize) {
        let bit = 1 << (thread - 1);
        if self.asleep.load(Relaxed) & bit != 0 {
            self.asleep.fetch_and(!bit, AcqRel);
        }
    }

    /// Returns the number of sleeping workers among the first `workers`. It must be called after something
    /// was published to them. It is a read-modify-write for the reason given at [`Board::lie_down`].
    pub fn asleep(&self, workers: usize) -> u32 {
        (self.asleep.fetch_or(0, AcqRel) & first(workers)).count_ones()
    }

    /// Returns `true` if some worker was awake a moment ago. This is a hint for speed only; correctness does
    /// not depend on it.
    pub fn seems_awake(&self) -> bool {
        (self.asleep.load(Relaxed).count_ones() as usize) < self.workers()
    }

    /// Wakes up to `at_most` sleeping workers among the first `workers`. The thread that clears a worker's
    /// bit wakes this worker, so no worker is woken twice.
    pub fn wake(&self, at_most: u32, workers: usize) {
        let mut left = at_most;
        let mut asleep = self.asleep.load(Relaxed) & first(workers);
        while left > 0 && asleep != 0 {
            let bit = asleep & asleep.wrapping_neg();
            let before = self.asleep.fetch_and(!bit, AcqRel);
            if before & bit != 0 {
                self.unpark(bit.trailing_zeros() as usize);
                left -= 1;
            }
            asleep = before & !bit & first(workers);
        }
    }

    fn unpark(&self, worker: usize) {
        if let Some(thread) = self.threads[worker].get() {
            thread.unpark();
        }
    }

    /// Wakes up to two more workers if blocks are left or an alert holds. Each woken worker calls this
    /// function, so the caller makes only one wake-up call.
    pub fn wake_others(&self, alerted: bool) {
        let phase = self.phase();
        let (wanted, workers) =
            if alerted { (2, self.workers()) } else { (phase.number().min(2), phase.workers()) };
        self.wake(wanted, workers);
    }

    // ---- alert

    /// Sets the alert: [`CALM`], [`PARK`], or the time until which workers stay awake, ns since the start.
    pub fn set_alert(&self, alert: u64) {
        self.alert.store(alert, Release);
    }

    pub fn alert(&self) -> u64 {
        self.alert.load(Acquire)
    }
}

/// Returns the bit mask of the first `workers` workers.
fn first(workers: usize) -> u64 {
    u64::MAX.checked_shr(u64::BITS - workers as u32).unwrap_or(0)
}

#[cfg(all(test, not(loom)))]
mod tests {
    use super::*;

    #[test]
    fn bits_are_those_of_the_first_workers() {
        assert_eq!([0, 1, 3, 63, 64].map(first), [0, 1, 7, u64::MAX >> 1, u64::MAX]);
    }

    #[test]
    fn claims_are_neighbors_from_the_last_to_the_first_and_get_smaller() {
        for (workers, blocks) in [(1, 2), (1, 28), (2, 3), (3, 100), (16, 5), (63, 4000)] {
            let board = Board::new(workers);
            board.open(1, workers, blocks);
            let (mut end, mut sizes) = (blocks, Vec::new());
            while let Some(claimed) = board.claim(1) {
                assert_eq!(claimed.end, end, "{workers} workers, {blocks} blocks");
                assert!(claimed.start < claimed.end);
                sizes.push(claimed.end - claimed.start);
                end = claimed.start;
            }
            assert_eq!(end, 0);
            assert!(sizes.is_sorted_by(|earlier, later| earlier >= later), "{sizes:?}");
            // The first claim is an equal share.
            assert_eq!(sizes[0] as usize, (blocks as usize).div_ceil(workers + 1), "{sizes:?}");
            assert_eq!(sizes.last(), Some(&1));
            assert_eq!(board.claim(1), None);
        }
    }
}
