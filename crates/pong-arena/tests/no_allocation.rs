//! Once created, nothing in this crate allocates or frees memory.
//!
//! A program of its own, because it counts the calls of the process's allocator.

use pong_arena::{Arena, Table};
use pong_testkit::heap::{COUNTING, Telling, calls_during};

#[global_allocator]
static HEAP: Telling = COUNTING;

#[test]
fn the_counter_counts() {
    assert_eq!(calls_during(|| drop(std::hint::black_box(Box::new(1)))), 2);
    // One block for the whole arena.
    let mut arena = None;
    assert_eq!(calls_during(|| arena = Some(Arena::with_capacity(12_345))), 1);
    assert_eq!(arena.map(|arena| arena.capacity()), Some(12_352));
}

#[test]
fn an_arena_neither_allocates_nor_frees_however_much_is_asked_of_it() {
    for capacity in [0, 16, 100, 4096, 70_000] {
        let mut arena = Arena::with_capacity(capacity);
        let mut refused = 0;
        let calls = calls_during(|| {
            for frame in 0..1000 {
                arena.reset();
                for request in 0..20 {
                    let len = (frame * 7 + request * 13) % 97;
                    refused += usize::from(arena.slice(len, 1.5).is_err());
                    let Ok(mut list) = arena.list(len) else { continue };
                    for i in 0..len + 2 {
                        refused += usize::from(list.push(i as u32).is_err());
                    }
                    std::hint::black_box(&*list);
                }
                // Larger than the arena: the block must not be replaced by a larger one.
                refused += usize::from(arena.slice(capacity + 1, 0_u8).is_err());
            }
        });
        assert_eq!(calls, 0);
        assert!(refused >= 1000 && arena.peak() > arena.capacity());
    }
}

#[test]
fn a_table_neither_allocates_nor_frees_however_much_is_asked_of_it() {
    let mut table = Table::with_capacity(100, [0.0; 3]);
    let mut other = table.clone();
    let mut refused = 0;
    let calls = calls_during(|| {
        for frame in 0..1000 {
            table.clear();
            for i in 0..frame % 131 {
                refused += usize::from(table.push([f64::from(i); 3]).is_err());
            }
            table.retain(|x| x[0] > 10.0);
            refused += usize::from(other.extend_from_slice(&table).is_err());
            std::mem::swap(&mut table, &mut other);
        }
    });
    assert_eq!(calls, 0);
    assert!(refused > 0);
}
