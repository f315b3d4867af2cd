//! Selects the cheapest solver for the number of contacts and their normals.

use super::nearest::Shortest;
use super::shared_contact::{Coupling, SharedContact, all_couple};
use super::{spread, uncoupled};
use pong_arena::{Arena, Full};

/// Computes the load λ of every contact. If the scratch memory is too small, no λ is written.
pub(super) fn solve(contacts: &mut [SharedContact], scratch: &Arena) -> Result<(), Full> {
    match contacts {
        [] => {}
        [only] => only.lambda = only.depth,
        [first, second] => share_two(first, second),
        _ if all_couple(contacts) => share_coupled(contacts),
        _ => uncoupled::share(contacts, scratch)?,
    }
    Ok(())
}

/// Computes the load λ of two contacts in closed form: λ₁ = (δ₁ − g·δ₂)/(1 − g²) with the coupling g, and λ₂
/// likewise. If one numerator is not positive, the deeper contact has all the load.
fn share_two(first: &mut SharedContact, second: &mut SharedContact) {
    let coupling = Coupling::new(first, second);
    let beyond_first = coupling.beyond(second.depth, first.depth);
    let beyond_second = coupling.beyond(first.depth, second.depth);
    (first.lambda, second.lambda) = if beyond_first <= 0.0 {
        (first.depth, 0.0)
    } else if beyond_second <= 0.0 {
        (0.0, second.depth)
    } else {
        let determinant = coupling.gap * (1.0 + coupling.cosine);
        (beyond_second / determinant, beyond_first / determinant)
    };
}

/// Computes the load λ of three or more contacts of which no two normals are more than 90° apart.
fn share_coupled(contacts: &mut [SharedContact]) {
    let shortest = Shortest::new(contacts);
    if spread::share(contacts, &shortest) {
        return;
    }
    contacts.iter_mut().for_each(|contact| contact.lambda = 0.0);
    for (&member, &lambda) in shortest.members.iter().zip(&shortest.lambdas).take(shortest.count) {
        contacts[member].lambda = lambda;
    }
}
