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
//! The other case is in `uncoupled.rs`.

mod uncoupled;

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
    /// λ, m: filled in by [`share`].
    pub lambda: f64,
}

impl Sharer {
    /// A contact whose share is not known yet.
    pub fn new(normal: Vec3, depth: f64) -> Self {
        Self { normal, depth, lambda: 0.0 }
    }
}

/// Fills in the λ of every contact of one ball with one surface. The order of the contacts decides ties only.
pub fn share(contacts: &mut [Sharer]) {
    match contacts {
        [] => {}
        [only] => only.lambda = only.depth,
        [first, second] => share_two(first, second),
        _ if all_couple(contacts) => share_coupled(contacts),
        _ => uncoupled::share(contacts),
    }
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
mod tests {
    use super::*;

    fn solved(contacts: &[(Vec3, f64)]) -> (Vec<f64>, Vec3) {
        let mut sharers: Vec<Sharer> = contacts.iter().map(|(n, d)| Sharer::new(n.normalize(), *d)).collect();
        share(&mut sharers);
        let t = sharers.iter().map(|s| s.normal * s.lambda).sum();
        (sharers.iter().map(|s| s.lambda).collect(), t)
    }

    #[test]
    fn both_walls_of_a_square_corner_push_fully() {
        let (lambda, _) = solved(&[(Vec3::x(), 2e-3), (Vec3::y(), 1e-3)]);
        assert_eq!(lambda, [2e-3, 1e-3]);
    }

    #[test]
    fn many_pieces_of_one_plate_push_like_one_plane() {
        let n = Vec3::new(0.2, -0.3, 0.9);
        let (lambda, t) = solved(&[(n, 1e-3); 6]);
        assert!((t - n.normalize() * 1e-3).norm() < 1e-17);
        assert!(lambda.iter().all(|l| (l - 1e-3 / 6.0).abs() < 1e-17), "{lambda:?}");
    }

    #[test]
    fn rounding_in_the_normals_of_a_plate_does_not_show() {
        let wobble = |a: f64, b: f64| Vec3::new(3e-8 * a, 3e-8 * b, 1.0);
        let plate = [
            (wobble(1.0, 0.0), 1e-3),
            (wobble(0.0, 1.0), 1e-3 * (1.0 + 1e-9)),
            (wobble(-1.0, 0.5), 1e-3),
            (wobble(0.3, -1.0), 1e-3 * (1.0 - 1e-9)),
        ];
        let (_, t) = solved(&plate);
        assert!((t - Vec3::z() * 1e-3).norm() < 1e-3 * 5e-8);
    }

    /// Known answer: the shortest vector that clears three walls is the corner point where all three are tight.
    #[test]
    fn three_walls_meet_in_their_corner() {
        let walls = [
            (Vec3::new(1.0, 0.1, 0.0), 1.0),
            (Vec3::new(0.0, 1.0, 0.2), 0.8),
            (Vec3::new(0.1, 0.0, 1.0), 0.9),
        ];
        let (lambda, t) = solved(&walls);
        for (n, d) in walls {
            assert!((n.normalize().dot(&t) - d).abs() < 1e-14);
        }
        assert!(lambda.iter().all(|l| *l > 0.0));
    }

    fn scatter(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (*seed >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Independent method: projected gradient on the dual, run to convergence.
    #[test]
    fn random_sets_agree_with_slow_descent() {
        let mut seed = 7;
        for _ in 0..300 {
            let count = 3 + (scatter(&mut seed) * 6.0) as usize;
            let contacts: Vec<(Vec3, f64)> = (0..count)
                .map(|_| {
                    let n = Vec3::from_fn(|_, _| scatter(&mut seed)).normalize();
                    (n, 0.5 + 0.5 * scatter(&mut seed))
                })
                .collect();
            let mut lambda = vec![0.0_f64; count];
            for _ in 0..60_000 {
                for i in 0..count {
                    let covered: f64 = (0..count)
                        .filter(|&j| j != i)
                        .map(|j| contacts[i].0.dot(&contacts[j].0) * lambda[j])
                        .sum();
                    lambda[i] = (contacts[i].1 - covered).max(0.0);
                }
            }
            let slow: Vec3 = contacts.iter().zip(&lambda).map(|((n, _), l)| n * *l).sum();
            let (_, t) = solved(&contacts);
            let worst = contacts.iter().map(|(n, d)| d - n.dot(&t)).fold(f64::MIN, f64::max);
            assert!(worst < 1e-13, "violated by {worst}");
            assert!(t.norm() <= slow.norm() * (1.0 + 1e-9), "{} > {}", t.norm(), slow.norm());
            assert!((t - slow).norm() < 1e-4);
        }
    }

    /// Normals more than 90° apart do not couple: the fixed point of the definition itself.
    #[test]
    fn opposed_normals_satisfy_the_definition() {
        let mut seed = 21;
        for _ in 0..200 {
            let mut sharers: Vec<Sharer> = (0..5)
                .map(|_| {
                    let n = Vec3::from_fn(|_, _| scatter(&mut seed) - 0.5).normalize();
                    Sharer::new(n, 0.5 + 0.5 * scatter(&mut seed))
                })
                .collect();
            share(&mut sharers);
            for i in 0..sharers.len() {
                let others: f64 = (0..sharers.len())
                    .filter(|&j| j != i)
                    .map(|j| coupling(&sharers[i], &sharers[j]) * sharers[j].lambda)
                    .sum();
                let expected = (sharers[i].depth - others).max(0.0);
                assert!((sharers[i].lambda - expected).abs() < 1e-12, "{sharers:?}");
            }
        }
    }
}
