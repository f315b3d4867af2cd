//! Several contacts of one ball with one surface share one spring (docs/theory.md, 2.2).
//!
//! Contacts of depth δ_i and normal n_i get λ_i, the solution of
//!
//! ```text
//! λ_i = max(0, δ_i − Σ_{j≠i} max(0, n_i·n_j)·λ_j)
//! ```
//!
//! and their weight is w_i = λ_i/δ_i. Where no two normals are more than 90° apart this is the problem
//!
//! ```text
//! t = argmin |t|  such that  n_i·t ≥ δ_i for all i,      t = Σ λ_i·n_i,  λ ≥ 0,
//! ```
//!
//! whose solution t is unique and decided by at most three contacts. For two contacts it is written down below, for more
//! it is found by `nearest.rs`; `spread.rs` takes the λ of least |λ| where more contacts than decide t carry it. The
//! other case is in `uncoupled.rs`; it needs scratch memory. What happens where there is too little of it is in
//! `deepest.rs`.
//!
//! *Rounding.* The normals of one plate in many pieces differ by 1e-16 (rounding), 1e-7 (vertices in single precision) or
//! whatever it is folded by. 1 − n_i·n_j is then the small difference of two large numbers, and so is δ_i − (n_i·n_j)·δ_j.
//! `Coupling` works both out from the differences n_i − n_j and δ_i − δ_j, which are exact.

mod deepest;
mod nearest;
mod shared_contact;
mod solve;
mod spread;
mod twofold;
mod uncoupled;

pub(crate) use shared_contact::SharedContact;

use pong_arena::{Arena, Full};
use solve::solve;

/// Bytes of scratch memory in which [`share_within`] shares any set of so many contacts exactly.
pub fn scratch_bytes(contacts: usize) -> usize {
    uncoupled::tableau(contacts).bytes()
}

/// Fills in the λ of every contact of one ball with one surface. The order of the contacts decides ties only.
///
/// Everything in `scratch` ends. Only sets of three and more that do not all couple need it.
///
/// # Errors
/// [`Full`] if the scratch memory was too small (its peak tells the size that would have been enough): the deepest
/// contacts that it could hold have then been shared exactly, ties in their order, and the others have λ = 0.
pub fn share_within(contacts: &mut [SharedContact], scratch: &mut Arena) -> Result<(), Full> {
    scratch.reset();
    solve(contacts, scratch).inspect_err(|_| deepest::share(contacts, scratch))
}

#[cfg(test)]
mod tests;
