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
//! [`Coupling`] works both out from the differences n_i − n_j and δ_i − δ_j, which are exact.

mod deepest;
mod nearest;
mod spread;
mod twofold;
mod uncoupled;

use nearest::Shortest;
use pong_arena::{Arena, Full};
use pong_geometry::Vec3;

/// Cosine below which two normals count as more than 90° apart. Rounding lies below it: in a square corner the products
/// of the normals have either sign, and whether such a pair couples changes λ by no more than this part of it.
const APART_COSINE: f64 = -1e-14;

/// One of several contacts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sharer {
    /// Unit normal.
    pub normal: Vec3,
    /// Depth δ > 0, m.
    pub depth: f64,
    /// λ, m: filled in by [`share_within`].
    pub lambda: f64,
}

impl Sharer {
    /// A contact whose share is not known yet.
    pub fn new(normal: Vec3, depth: f64) -> Self {
        Self { normal, depth, lambda: 0.0 }
    }
}

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
pub fn share_within(contacts: &mut [Sharer], scratch: &mut Arena) -> Result<(), Full> {
    scratch.reset();
    solve(contacts, scratch).inspect_err(|_| deepest::share(contacts, scratch))
}

/// Fills in every λ, or none if the scratch memory is too small.
fn solve(contacts: &mut [Sharer], scratch: &Arena) -> Result<(), Full> {
    match contacts {
        [] => {}
        [only] => only.lambda = only.depth,
        [first, second] => share_two(first, second),
        _ if all_couple(contacts) => share_coupled(contacts),
        _ => uncoupled::share(contacts, scratch)?,
    }
    Ok(())
}

/// For two, in closed form: λ₁ = (δ₁ − g·δ₂)/(1 − g²), or the deeper one alone where that leaves nothing for the other.
fn share_two(first: &mut Sharer, second: &mut Sharer) {
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

/// For more that all couple.
fn share_coupled(contacts: &mut [Sharer]) {
    let shortest = Shortest::new(contacts);
    if spread::share(contacts, &shortest) {
        return;
    }
    contacts.iter_mut().for_each(|contact| contact.lambda = 0.0);
    for (&member, &lambda) in shortest.members.iter().zip(&shortest.lambdas).take(shortest.count) {
        contacts[member].lambda = lambda;
    }
}

fn all_couple(contacts: &[Sharer]) -> bool {
    let couples = |a: &Sharer, b: &Sharer| a.normal.dot(&b.normal) >= APART_COSINE;
    contacts.iter().enumerate().all(|(i, a)| contacts[i + 1..].iter().all(|b| couples(a, b)))
}

fn deepest_of(contacts: &[Sharer]) -> usize {
    let mut best = 0;
    for (i, contact) in contacts.iter().enumerate() {
        if contact.depth > contacts[best].depth {
            best = i;
        }
    }
    best
}

/// How much two contacts couple. Normals more than 90° apart do not.
#[derive(Clone, Copy, Debug)]
struct Coupling {
    /// g = max(0, n₁·n₂).
    cosine: f64,
    /// 1 − g.
    gap: f64,
    /// Whether the normals are near enough to each other for differences to be exact.
    is_near: bool,
}

impl Coupling {
    /// Normals within 60° of each other are near: of two numbers at most a factor of two apart the difference is exact.
    const NEAR_COSINE: f64 = 0.5;

    fn new(a: &Sharer, b: &Sharer) -> Self {
        let cosine = a.normal.dot(&b.normal);
        if cosine > Self::NEAR_COSINE {
            // The two are of unit length: |n₁ − n₂|² = 2 − 2·n₁·n₂.
            let gap = 0.5 * (a.normal - b.normal).norm_squared();
            return Self { cosine: 1.0 - gap, gap, is_near: true };
        }
        let cosine = cosine.max(0.0);
        Self { cosine, gap: 1.0 - cosine, is_near: false }
    }

    /// What is left of a depth where another contact is cleared to its own: δ − g·δ'.
    fn beyond(&self, depth: f64, other_depth: f64) -> f64 {
        if self.is_near {
            (depth - other_depth) + self.gap * other_depth
        } else {
            depth - self.cosine * other_depth
        }
    }
}

#[cfg(test)]
mod tests;
