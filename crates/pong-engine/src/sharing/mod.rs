//! Several contacts of one ball with one surface share one spring (physics contract, 2.2).
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
//! whose solution t is unique and decided by at most three contacts. It is found exactly: the deepest contact is
//! the first basis; while some contact is violated, the basis of the at most three old ones and the most
//! violated one is solved by trying its at most seven subsets. |t| grows with every exchange, so none repeats.
//! The other case is in `uncoupled.rs`; it needs scratch memory. What happens where there is too little of it is in
//! `deepest.rs`.

mod deepest;
mod uncoupled;

use pong_arena::{Arena, Full};
use pong_geometry::{Mat3, Vec3};

/// Relative to the largest depth: how far a contact may be violated by rounding.
const VIOLATION_MAX: f64 = 1e-14;
/// Relative to the largest depth: contacts this close to the solution carry it together.
const TIGHT_MAX: f64 = 1e-12;

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

fn share_two(first: &mut Sharer, second: &mut Sharer) {
    let g = first.normal.dot(&second.normal).max(0.0);
    (first.lambda, second.lambda) = if g * first.depth >= second.depth {
        (first.depth, 0.0)
    } else if g * second.depth >= first.depth {
        (0.0, second.depth)
    } else {
        let determinant = 1.0 - g * g;
        ((first.depth - g * second.depth) / determinant, (second.depth - g * first.depth) / determinant)
    };
}

fn all_couple(contacts: &[Sharer]) -> bool {
    contacts.iter().enumerate().all(|(i, a)| contacts[i + 1..].iter().all(|b| a.normal.dot(&b.normal) >= 0.0))
}

/// A set of at most four contacts and the shortest t that satisfies them.
#[derive(Clone, Copy)]
struct Basis {
    members: [usize; 3],
    lambdas: [f64; 3],
    count: usize,
    t: Vec3,
}

fn share_coupled(contacts: &mut [Sharer]) {
    let deepest = deepest_of(contacts);
    let scale = contacts[deepest].depth;
    let mut basis = Basis {
        members: [deepest, 0, 0],
        lambdas: [scale, 0.0, 0.0],
        count: 1,
        t: contacts[deepest].normal * scale,
    };
    // The bound only guards against endless exchange of contacts that differ by rounding.
    for _ in 0..8 * contacts.len() {
        let Some(worst) = most_violated(contacts, &basis.t, VIOLATION_MAX * scale) else { break };
        match exchange(contacts, &basis, worst, scale) {
            Some(better) if better.t.norm_squared() > basis.t.norm_squared() => basis = better,
            _ => break,
        }
    }
    if !spread_evenly(contacts, &basis, scale) {
        for contact in contacts.iter_mut() {
            contact.lambda = 0.0;
        }
        for k in 0..basis.count {
            contacts[basis.members[k]].lambda = basis.lambdas[k];
        }
    }
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

fn most_violated(contacts: &[Sharer], t: &Vec3, allowed: f64) -> Option<usize> {
    let mut worst = None;
    let mut largest = allowed;
    for (i, contact) in contacts.iter().enumerate() {
        let violation = contact.depth - contact.normal.dot(t);
        if violation > largest {
            largest = violation;
            worst = Some(i);
        }
    }
    worst
}

/// The solution for the members of a basis and one more contact.
fn exchange(contacts: &[Sharer], basis: &Basis, entering: usize, scale: f64) -> Option<Basis> {
    let mut pool = [entering; 4];
    pool[1..=basis.count].copy_from_slice(&basis.members[..basis.count]);
    let pool = &pool[..=basis.count];
    let mut best: Option<(f64, Basis)> = None;
    // Every subset of up to three that contains the entering contact; bit k stands for pool[k + 1].
    for subset in 0..1_usize << basis.count {
        if subset.count_ones() > 2 {
            continue;
        }
        let mut members = [entering; 3];
        let mut count = 1;
        for (k, &member) in pool[1..].iter().enumerate() {
            if subset >> k & 1 == 1 {
                members[count] = member;
                count += 1;
            }
        }
        let Some(candidate) = solve_equalities(contacts, members, count) else { continue };
        let violation = pool
            .iter()
            .map(|&i| contacts[i].depth - contacts[i].normal.dot(&candidate.t))
            .fold(0.0, f64::max);
        let violation = if violation <= VIOLATION_MAX * scale { 0.0 } else { violation };
        if best.as_ref().is_none_or(|(least, _)| violation < *least) {
            best = Some((violation, candidate));
        }
    }
    best.map(|(_, basis)| basis)
}

/// t = Σ λ_i·n_i with n_i·t = δ_i for all members; `None` unless every λ is positive.
fn solve_equalities(contacts: &[Sharer], members: [usize; 3], count: usize) -> Option<Basis> {
    let n = members.map(|i| contacts[i].normal);
    let d = members.map(|i| contacts[i].depth);
    let lambdas = match count {
        1 => [d[0], 0.0, 0.0],
        2 => {
            let g = n[0].dot(&n[1]);
            // |n₀ × n₁|² = 1 − g² without the cancellation.
            let determinant = n[0].cross(&n[1]).norm_squared();
            [(d[0] - g * d[1]) / determinant, (d[1] - g * d[0]) / determinant, 0.0]
        }
        _ => {
            let volume = n[0].dot(&n[1].cross(&n[2]));
            let duals = [n[1].cross(&n[2]), n[2].cross(&n[0]), n[0].cross(&n[1])].map(|dual| dual / volume);
            let t = duals[0] * d[0] + duals[1] * d[1] + duals[2] * d[2];
            duals.map(|dual| dual.dot(&t))
        }
    };
    if !lambdas[..count].iter().all(|lambda| *lambda > 0.0 && lambda.is_finite()) {
        return None;
    }
    let t = n[0] * lambdas[0] + n[1] * lambdas[1] + n[2] * lambdas[2];
    Some(Basis { members, lambdas, count, t })
}

/// Where more contacts touch the solution than decide it, takes the λ of least |λ|: λ_i = max(0, n_i·μ) with
/// Σ λ_i·n_i = t. Answers whether that reproduced t; the basis' own λ serve otherwise.
fn spread_evenly(contacts: &mut [Sharer], basis: &Basis, scale: f64) -> bool {
    let t = basis.t;
    let tight = |contact: &Sharer| contact.depth - contact.normal.dot(&t) >= -TIGHT_MAX * scale;
    if contacts.iter().filter(|contact| tight(contact)).count() <= basis.count {
        return false;
    }
    let mut mu = t;
    for _ in 0..50 {
        let mut gram = Mat3::zeros();
        for contact in contacts.iter().filter(|contact| tight(contact) && contact.normal.dot(&mu) > 0.0) {
            gram += contact.normal * contact.normal.transpose();
        }
        let next = solve_symmetric(&gram, &t);
        if next == mu {
            break;
        }
        mu = next;
    }
    let mut sum = Vec3::zeros();
    for contact in contacts.iter_mut() {
        contact.lambda = if tight(contact) { contact.normal.dot(&mu).max(0.0) } else { 0.0 };
        sum += contact.normal * contact.lambda;
    }
    (sum - t).norm() <= TIGHT_MAX * scale
}

/// x with G·x = b for a positive semidefinite G, by elimination with diagonal pivots; directions that G does not
/// reach stay 0.
fn solve_symmetric(gram: &Mat3, b: &Vec3) -> Vec3 {
    const RANK_PIVOT_MIN: f64 = 1e-10;
    let smallest = RANK_PIVOT_MIN * gram.trace();
    let (mut g, mut b) = (*gram, *b);
    let mut order = [0; 3];
    let mut done = [false; 3];
    let mut rank = 0;
    while rank < 3 {
        let mut pivot = None;
        for i in (0..3).filter(|&i| !done[i]) {
            if g[(i, i)] > smallest && pivot.is_none_or(|p: usize| g[(i, i)] > g[(p, p)]) {
                pivot = Some(i);
            }
        }
        let Some(p) = pivot else { break };
        done[p] = true;
        order[rank] = p;
        rank += 1;
        for i in (0..3).filter(|&i| !done[i]) {
            let factor = g[(i, p)] / g[(p, p)];
            for j in 0..3 {
                let subtract = factor * g[(p, j)];
                g[(i, j)] -= subtract;
            }
            b[i] -= factor * b[p];
        }
    }
    let mut x = Vec3::zeros();
    for &p in order[..rank].iter().rev() {
        let known: f64 = (0..3).filter(|&j| j != p).map(|j| g[(p, j)] * x[j]).sum();
        x[p] = (b[p] - known) / g[(p, p)];
    }
    x
}

/// The coupling of two contacts: normals more than 90° apart do not couple.
fn coupling(a: &Sharer, b: &Sharer) -> f64 {
    a.normal.dot(&b.normal).max(0.0)
}

#[cfg(test)]
mod tests;
