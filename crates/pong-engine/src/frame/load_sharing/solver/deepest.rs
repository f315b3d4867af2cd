//! Load sharing with too little scratch memory: as many of the deepest contacts as fit are shared exactly,
//! and all others get the load λ = 0. The result depends only on the contacts and the memory size.

use super::shared_contact::{SharedContact, deepest_of};
use super::solve::solve;
use super::uncoupled;
use pong_arena::{Arena, Full};

/// Computes the load λ of the deepest contacts that fit into `scratch`, at least of one; all others get 0.
pub(super) fn share(contacts: &mut [SharedContact], scratch: &mut Arena) {
    scratch.reset();
    contacts.iter_mut().for_each(|contact| contact.lambda = 0.0);
    let count = (0..contacts.len()).take_while(|&n| bytes(n + 1) <= scratch.capacity()).count();
    if share_some(contacts, count, scratch).is_err() || count == 0 {
        let deepest = deepest_of(contacts);
        contacts[deepest].lambda = contacts[deepest].depth;
    }
}

/// Scratch memory to choose and share this many contacts, bytes.
fn bytes(count: usize) -> usize {
    uncoupled::tableau(count).and::<u32>(count).and::<SharedContact>(count).bytes()
}

/// Shares the `count` deepest contacts, in the order in which they were given.
fn share_some(contacts: &mut [SharedContact], count: usize, scratch: &Arena) -> Result<(), Full> {
    let mut chosen = scratch.list::<u32>(count)?;
    let mut last = None;
    for _ in 0..count {
        last = next_deepest(contacts, last);
        last.map_or(Ok(()), |index| chosen.push(index as u32))?;
    }
    chosen.sort_unstable();
    let mut shared_contacts = scratch.list(count)?;
    for &index in &*chosen {
        shared_contacts.push(contacts[index as usize])?;
    }
    solve(&mut shared_contacts, scratch)?;
    for (&index, shared_contact) in chosen.iter().zip(&*shared_contacts) {
        contacts[index as usize].lambda = shared_contact.lambda;
    }
    Ok(())
}

/// Index of the next contact after `last`, by decreasing depth and then by index; `None` after the last
/// contact.
fn next_deepest(contacts: &[SharedContact], last: Option<usize>) -> Option<usize> {
    let comes_after = |i: usize, j: usize| {
        contacts[i].depth < contacts[j].depth || (contacts[i].depth == contacts[j].depth && i > j)
    };
    let mut best = None;
    for i in (0..contacts.len()).filter(|&i| last.is_none_or(|last| comes_after(i, last))) {
        if best.is_none_or(|b: usize| contacts[i].depth > contacts[b].depth) {
            best = Some(i);
        }
    }
    best
}
