//! Where more contacts touch the shortest vector than decide it: the λ of least |λ|.
//!
//! Among all λ ≥ 0 with Σ λ_i·n_i = t these are λ_i = max(0, n_i·μ), with a vector μ that is found by solving for the
//! contacts that carry until these no longer change. The condition holds in any stretched space as well, and with it the λ
//! are the same: stretched across t, normals that differ by rounding of single precision lie as far apart as any others.

use super::nearest::Shortest;
use super::shared_contact::SharedContact;
use pong_geometry::{Mat3, Vec3};

/// Relative to |t|: contacts this close to t carry it together.
const TIGHT_MAX: f64 = 1e-12;
/// Relative to |t|: what they carry may differ from it by some roundings.
const RESIDUAL_MAX: f64 = 4e-15;
/// Normals this close to t, of unit length, differ by rounding alone: their contacts carry alike.
const ROUNDING_MAX: f64 = 1e-13;
/// How often the contacts that carry are chosen anew.
const CHOICES_MAX: usize = 50;

/// Fills in every λ. Answers whether it could: not where no more contacts touch t than decide it, nor where rounding keeps
/// the λ from adding up to t.
pub(super) fn share(contacts: &mut [SharedContact], shortest: &Shortest) -> bool {
    let length = shortest.t_b.norm();
    let along = shortest.t_b / length;
    let (mut count, mut widest) = (0, 0.0_f64);
    for index in 0..contacts.len() {
        let is_tight = shortest.slack(contacts, index) <= TIGHT_MAX * length;
        // Until the λ are known they tell which contacts are tight.
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

/// The part of a normal across t.
fn across(normal: &Vec3, along: &Vec3) -> Vec3 {
    normal - along * normal.dot(along)
}

/// The μ of the tight contacts.
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
