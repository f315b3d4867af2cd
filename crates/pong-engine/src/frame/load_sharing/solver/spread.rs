//! Loads λ of least norm if more contacts touch the shortest vector t (n_i·t = δ_i) than determine it.
//! Symbols as in the parent module.
//!
//! Among all λ ≥ 0 with Σ λ_i·n_i = t, the one of least |λ| is λ_i = max(0, n_i·μ). The vector μ is found by
//! repeatedly solving for the contacts that have load, until the set of these contacts no longer changes.
//! Stretching space across t changes neither the condition Σ λ_i·n_i = t nor λ. In the stretched space,
//! normals that differ only by single-precision rounding are as far apart as any others.

use super::nearest::Shortest;
use super::shared_contact::SharedContact;
use pong_geometry::{Mat3, Vec3};

/// Slack relative to |t| below which a contact counts as touching t.
const TIGHT_MAX: f64 = 1e-12;
/// Allowed residual of Σ λ_i·n_i relative to |t|: some roundings.
const RESIDUAL_MAX: f64 = 4e-15;
/// Normals this close to the unit vector along t differ only by rounding; their contacts get equal λ.
const ROUNDING_MAX: f64 = 1e-13;
/// Limit on the number of active-set iterations.
const CHOICES_MAX: usize = 50;

/// Computes the load λ of every contact. Returns false, with λ unusable, if no more contacts touch t than
/// determine it, or if rounding keeps Σ λ_i·n_i from reaching t.
pub(super) fn share(contacts: &mut [SharedContact], shortest: &Shortest) -> bool {
    let length = shortest.t_b.norm();
    let along = shortest.t_b / length;
    let (mut count, mut widest) = (0, 0.0_f64);
    for index in 0..contacts.len() {
        let is_tight = shortest.slack(contacts, index) <= TIGHT_MAX * length;
        // Until λ is known, the field marks the contacts that touch t.
        contacts[index].lambda = f64::from(u8::from(is_tight));
        if is_tight {
            count += 1;
            widest = widest.max(across(&contacts[index].normal_b, &along).norm());
        }
    }
    if count <= shortest.count {
        return false;
    }
    let factor = if widest > ROUNDING_MAX { 1.0 / widest.max(ROUNDING_MAX) } else { 0.0 };
    let stretched = |normal: &Vec3| along * normal.dot(&along) + across(normal, &along) * factor;
    let mu = least(contacts, &shortest.t_b, stretched);
    let mut sum = Vec3::zeros();
    for contact in contacts.iter_mut().filter(|contact| contact.lambda > 0.0) {
        contact.lambda = stretched(&contact.normal_b).dot(&mu).max(0.0);
        sum += contact.normal_b * contact.lambda;
    }
    (sum - shortest.t_b).norm() <= RESIDUAL_MAX * length
}

/// Component of a normal perpendicular to t.
fn across(normal: &Vec3, along: &Vec3) -> Vec3 {
    normal - along * normal.dot(along)
}

/// Vector μ with Σ max(0, n_i·μ)·n_i = t, summed over the contacts that touch t; n_i are the stretched
/// normals.
fn least(contacts: &[SharedContact], t: &Vec3, stretched: impl Fn(&Vec3) -> Vec3) -> Vec3 {
    let mut mu = *t;
    for _ in 0..CHOICES_MAX {
        let mut gram = Mat3::zeros();
        for contact in contacts.iter().filter(|contact| contact.lambda > 0.0) {
            let normal = stretched(&contact.normal_b);
            if normal.dot(&mu) > 0.0 {
                gram += normal * normal.transpose();
            }
        }
        let next = solve_symmetric(&gram, t);
        if next == mu {
            break;
        }
        mu = next;
    }
    mu
}

/// Solves G·x = b for a positive semidefinite G by elimination with diagonal pivoting; directions in the null
/// space of G stay 0.
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
