//! The words that the caller and its workers share, each on a line of its own.
//!
//! | word | written by | holds |
//! |---|---|---|
//! | `claim` | caller opens, all claim | epoch, workers that take part, blocks left, end |
//! | `tally` of a lane | that worker alone | epoch, blocks done, panicked |
//! | `asleep` | all | one bit per worker that is parked or about to be |
//! | `alert` | caller | until when to stay awake |
//!
//! Why each order of memory accesses suffices is said where it is used; README.md tells the whole.

use std::ops::Range;
use std::sync::OnceLock;
use std::sync::atomic::Ordering::{AcqRel, Acquire, Relaxed, Release};

use crossbeam_utils::CachePadded;

use crate::sync::{AtomicU64, Thread, current, mutant};
use crate::word::Word;

/// What a worker writes when it has finished a block. It alone writes, so no read-modify-write is needed, and it
/// writes under the epoch of the block, so that a block of an abandoned phase counts for no other.
struct Tally {
    word: AtomicU64,
    /// Blocks finished since the start, whatever their phase.
    finished: AtomicU64,
    /// Time in the blocks of the epoch of `word`.
    busy_ns: AtomicU64,
}

/// What one lane did in one phase.
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

/// `alert`: park at once.
pub const PARK: u64 = u64::MAX;
/// `alert`: nothing special.
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

    // ---- the claim word

    /// Opens a phase to the first so many workers. No block of an earlier phase is left to claim, so no claim can come between: a store will do.
    /// It publishes what the caller wrote before; each claim, as a read-modify-write, passes that on to the next.
    pub fn open(&self, epoch: u64, workers: usize, blocks: u32) {
        debug_assert_eq!(Word(self.claim.load(Relaxed)).number(), 0);
        self.claim.store(Word::new(epoch, blocks, false).among(workers).0, Release);
    }

    /// Takes the blocks that are left out of the phase. Answers how many they were.
    pub fn close(&self, epoch: u64) -> u32 {
        Word(self.claim.swap(Word::new(epoch, 0, false).0, AcqRel)).number()
    }

    /// Claims blocks of the phase `epoch`, its last ones; `None` if it has none left or is over.
    ///
    /// Compare-and-swap looks and takes in one: whoever looked before the phase was over and takes after takes
    /// nothing. (`fetch_add` takes first and looks then. It would take blocks of the next phase.)
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

    /// How many of the blocks that are left a lane claims at once: its part of them, beside so many workers, and three quarters of
    /// that once they are few. Early claims are large, so that a lane works on neighbours, and late ones small, so that all lanes
    /// end together (guided self-scheduling: C. D. Polychronopoulos and D. J. Kuck, IEEE Trans. Comput. C-36 (1987) 1425; less
    /// than a part each, as in factoring: S. F. Hummel, E. Schonberg, L. E. Flynn, Commun. ACM 35 (1992) 90).
    pub fn share_of(left: u32, workers: usize) -> u32 {
        /// So many blocks for each lane are few: one of them may take as long as several others.
        const FEW: u32 = 8;
        let lanes = workers as u32 + 1;
        if left <= FEW * lanes { (3 * left).div_ceil(4 * lanes) } else { left.div_ceil(lanes) }
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

    /// The mistake that the models must find.
    fn take_unseen(&self, blocks: u32) -> Result<Range<u32>, Word> {
        let taken = Word::new(0, blocks, false).0;
        let before = Word(self.claim.fetch_sub(taken, AcqRel));
        if before.number() >= blocks { Ok(before.number() - blocks..before.number()) } else { Err(before) }
    }

    /// The claim word, if its epoch is not `seen` or it tells to end.
    pub fn news(&self, seen: u64) -> Option<Word> {
        let word = Word(self.claim.load(Acquire));
        (word.epoch() != seen || word.flag()).then_some(word)
    }

    /// Tells the workers to end.
    pub fn end(&self) {
        self.claim.fetch_or(Word::FLAG, AcqRel);
    }

    /// The phase that is open, or was.
    fn phase(&self) -> Word {
        Word(self.claim.load(Relaxed))
    }

    // ---- the tallies

    /// Worker `lane` has finished a block: so much has it now done in phase `epoch`, and so much since the start.
    /// Each store publishes what the block wrote.
    pub fn record(&self, lane: usize, epoch: u64, done: Done, finished: u64) {
        let tally = &self.tallies[lane - 1];
        tally.busy_ns.store(done.busy_ns, Relaxed);
        tally.finished.store(finished, Release);
        tally.word.store(Word::new(epoch, done.blocks, done.panicked).0, Release);
    }

    /// What worker `lane` has done in phase `epoch`.
    pub fn done(&self, lane: usize, epoch: u64) -> Done {
        let tally = &self.tallies[lane - 1];
        let word = Word(tally.word.load(Acquire));
        if word.epoch() != epoch && !mutant("untagged_tally") {
            return Done::default();
        }
        Done { blocks: word.number(), busy_ns: tally.busy_ns.load(Relaxed), panicked: word.flag() }
    }

    /// Blocks that the first so many workers have done in phase `epoch`, and whether one panicked.
    pub fn done_by(&self, workers: usize, epoch: u64) -> (u32, bool) {
        let mut sum = (0, false);
        for lane in 1..=workers {
            let done = self.done(lane, epoch);
            sum = (sum.0 + done.blocks, sum.1 | done.panicked);
        }
        sum
    }

    /// Blocks that all workers have finished since the start.
    pub fn finished_by_all(&self) -> u64 {
        self.tallies.iter().map(|tally| tally.finished.load(Acquire)).sum()
    }

    // ---- sleep

    /// Lets others wake the calling thread as worker `lane`. Call it before the first [`Board::lie_down`].
    pub fn introduce(&self, lane: usize) {
        self.threads[lane - 1].set(current()).expect("one thread per lane");
    }

    /// Worker `lane` is about to park. It must look for news once more before it does.
    ///
    /// This and [`Board::asleep`] are read-modify-writes of one word, so one comes first. If this does, the other
    /// sees the bit and wakes the worker; if the other does, the worker's next look sees what was told before it.
    pub fn lie_down(&self, lane: usize) {
        self.asleep.fetch_or(1 << (lane - 1), AcqRel);
    }

    /// Worker `lane` is up, whoever woke it.
    pub fn get_up(&self, lane: usize) {
        let bit = 1 << (lane - 1);
        if self.asleep.load(Relaxed) & bit != 0 {
            self.asleep.fetch_and(!bit, AcqRel);
        }
    }

    /// How many of the first so many workers are asleep, after something was told to them ([`Board::lie_down`] says why it
    /// writes).
    pub fn asleep(&self, workers: usize) -> u32 {
        (self.asleep.fetch_or(0, AcqRel) & first(workers)).count_ones()
    }

    /// Whether a worker seemed awake a moment ago: a hint, on which nothing rests but time.
    pub fn seems_awake(&self) -> bool {
        (self.asleep.load(Relaxed).count_ones() as usize) < self.workers()
    }

    /// Wakes up to `at_most` sleeping ones of the first so many workers. Whoever clears a worker's bit wakes it, so nobody pays
    /// twice.
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

    /// A woken worker wakes two more while there is work or an alert, so that the caller pays for one.
    pub fn wake_others(&self, alerted: bool) {
        let phase = self.phase();
        let (wanted, workers) =
            if alerted { (2, self.workers()) } else { (phase.number().min(2), phase.workers()) };
        self.wake(wanted, workers);
    }

    // ---- alert

    /// [`CALM`], [`PARK`], or the time in ns since the start until which to stay awake.
    pub fn set_alert(&self, alert: u64) {
        self.alert.store(alert, Release);
    }

    pub fn alert(&self) -> u64 {
        self.alert.load(Acquire)
    }
}

/// The bits of the first so many workers.
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
            // The first leaves their part to all others.
            assert_eq!(sizes[0] as usize, (blocks as usize).div_ceil(workers + 1), "{sizes:?}");
            assert_eq!(sizes.last(), Some(&1));
            assert_eq!(board.claim(1), None);
        }
    }
}
