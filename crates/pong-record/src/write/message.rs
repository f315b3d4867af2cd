//! Messages from the recorder to the writing thread: bytes in a ring buffer.

use rtrb::{Consumer, Producer};

/// Kind of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A row of `frames`, then the rows of the other tables, contacts last.
    Frame,
    /// A line of events.jsonl.
    Event,
    /// A contact state: number of the file, its length and its last bytes, then its first bytes; zeros
    /// between.
    Block,
}

/// Size of a message's header: length of the rest, and kind.
const HEAD: usize = 8;

/// Bytes that messages of these lengths take in the ring.
pub(super) fn room(lengths: &[usize]) -> usize {
    lengths.iter().map(|length| HEAD + length).sum()
}

/// Writes a message of several parts if there is room for it. Never blocks.
pub(super) fn push(producer: &mut Producer<u8>, kind: Kind, parts: &[&[u8]]) -> bool {
    let length: usize = parts.iter().map(|part| part.len()).sum();
    let Ok(mut chunk) = producer.write_chunk(HEAD + length) else { return false };
    let (first, second) = chunk.as_mut_slices();
    let mut out = Wrapped { first, second };
    out.put(&(length as u32).to_le_bytes());
    out.put(&(kind as u32).to_le_bytes());
    parts.iter().for_each(|part| out.put(part));
    chunk.commit_all();
    true
}

/// The two contiguous parts of a region of the ring.
struct Wrapped<'a> {
    first: &'a mut [u8],
    second: &'a mut [u8],
}

impl Wrapped<'_> {
    fn put(&mut self, bytes: &[u8]) {
        let fits = bytes.len().min(self.first.len());
        let (now, later) = bytes.split_at(fits);
        let (filled, rest) = std::mem::take(&mut self.first).split_at_mut(fits);
        filled.copy_from_slice(now);
        self.first = rest;
        if !later.is_empty() {
            self.first = std::mem::take(&mut self.second);
            self.put(later);
        }
    }
}

/// Reads the next message into `out`, if there is one.
pub(super) fn pop(consumer: &mut Consumer<u8>, out: &mut Vec<u8>) -> Option<Kind> {
    take(consumer, HEAD, out)?;
    let word = |at: usize| u32::from_le_bytes([out[at], out[at + 1], out[at + 2], out[at + 3]]);
    let (length, kind) = (word(0) as usize, word(4));
    take(consumer, length, out).expect("a message is written whole");
    Some(match kind {
        0 => Kind::Frame,
        1 => Kind::Event,
        _ => Kind::Block,
    })
}

fn take(consumer: &mut Consumer<u8>, count: usize, out: &mut Vec<u8>) -> Option<()> {
    let chunk = consumer.read_chunk(count).ok()?;
    out.clear();
    let (first, second) = chunk.as_slices();
    out.extend_from_slice(first);
    out.extend_from_slice(second);
    chunk.commit_all();
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_come_out_as_they_went_in_wherever_the_ring_ends() {
        let (mut producer, mut consumer) = rtrb::RingBuffer::new(61);
        let mut out = Vec::new();
        for number in 0..1000_u32 {
            let text: Vec<u8> = (0..number % 40).map(|k| (number + k) as u8).collect();
            let (a, b) = text.split_at(text.len() / 3);
            assert!(push(&mut producer, Kind::Event, &[a, b]));
            assert_eq!(pop(&mut consumer, &mut out), Some(Kind::Event));
            assert_eq!(out, text);
        }
        assert!(push(&mut producer, Kind::Block, &[&[1; 40]]));
        assert!(!push(&mut producer, Kind::Frame, &[&[2; 6]]), "61 bytes are not enough for 48 and 14");
        assert_eq!(pop(&mut consumer, &mut out), Some(Kind::Block));
        assert_eq!((pop(&mut consumer, &mut out), out.len()), (None, 40));
    }
}
