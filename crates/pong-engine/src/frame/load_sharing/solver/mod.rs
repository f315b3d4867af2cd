//! Load sharing: several contacts of one sphere or ellipsoid with one surface share one spring
//! (docs/theory.md, 2.2).
//!
//! A contact of depth δ_i and normal n_i gets the load λ_i (its weight times its depth, m), the solution of
//!
//! ```text
//! λ_i = max(0, δ_i − Σ_{j≠i} max(0, n_i·n_j)·λ_j)
//! ```
//!
//! and its weight is w_i = λ_i/δ_i. If no two normals are more than 90° apart, this is the problem
//!
//! ```text
//! t = argmin |t|  such that  n_i·t ≥ δ_i for all i,      t = Σ λ_i·n_i,  λ ≥ 0,
//! ```
//!
//! whose solution t is unique and determined by at most three contacts. `solve.rs` solves it for two contacts
//! in closed form, `nearest.rs` for more. If more contacts touch t (n_i·t = δ_i) than determine it, λ is not
//! unique, and `spread.rs` takes the λ of least norm |λ|. If some normals are more than 90° apart,
//! `uncoupled.rs` solves the first equation. It needs scratch memory; if that is too small, `deepest.rs` is
//! the fallback.
//!
//! *Rounding.* The normals of one plate cut into pieces differ by 1e-16 (rounding), 1e-7 (vertices in single
//! precision) or the angle of a fold. 1 − n_i·n_j is then the small difference of two large numbers, and so
//! is δ_i − (n_i·n_j)·δ_j. `Coupling` computes both from n_i − n_j and δ_i − δ_j, which are exact for numbers
//! that are nearly equal.

mod deepest;
mod nearest;
mod shared_contact;
mod solve;
mod spread;
pub(super) mod two_ends;
mod twofold;
mod uncoupled;

pub(crate) use shared_contact::SharedContact;

use pong_arena::{Arena, Full};
use solve::solve;

/// Scratch memory in which [`share_within`] shares any set of this many contacts exactly, bytes.
pub fn scratch_bytes(contacts: usize) -> usize {
    uncoupled::tableau(contacts).bytes()
}

/// Computes the load λ (weight times depth) of every contact of one sphere or ellipsoid with one surface. The
/// order of the contacts matters only for equally deep ones.
///
/// The earlier content of `scratch` is discarded. Scratch memory is needed only for three or more contacts of
/// which some normals are more than 90° apart.
///
/// # Errors
/// [`Full`] if the scratch memory was too small (its peak gives the required size). Then only as many
/// contacts as fit have been shared exactly: the deepest, and of equally deep ones the first. All others have
/// λ = 0.
pub fn share_within(contacts: &mut [SharedContact], scratch: &mut Arena) -> Result<(), Full> {
    scratch.reset();
    solve(contacts, scratch).inspect_err(|_| deepest::share(contacts, scratch))
}

#[cfg(test)]
mod tests;
