//! Shortest vector t that clears all contacts (n_i·t ≥ δ_i) if no two normals are more than 90° apart. It
//! follows from the nearest point of a convex hull. Symbols as in the parent module.
//!
//! With q_i = n_i/δ_i the conditions n_i·t ≥ δ_i read q_i·t ≥ 1, and the shortest t is p/|p|², where p is the
//! point of the convex hull of the q_i nearest to the origin: p = Σ μ_i·q_i, μ ≥ 0, Σ μ = 1, and q_i·p ≥ |p|²
//! for all i. Then λ_i = μ_i/(|p|²·δ_i), and Σ w_i = Σ μ_i·|t|²/δ_i². On a flat plate every δ_i is |t| and
//! the weights sum to one for *any* μ_i. So the μ_i of equal normals, which rounding leaves undetermined, do
//! not affect the force.
//!
//! In three dimensions p is a combination of at most three q_i. The search begins with the q of the deepest
//! contact. While a contact is violated (n_i·t < δ_i), the q of the most violated contact enters. Of the old
//! points and the new one there are at most seven subsets of at most three points that contain the new point.
//! The p of each is computed until one clears all these contacts. |t| grows with every exchange, so no subset
//! repeats.
//!
//! All points q are stored as differences from the q of the deepest contact, multiplied by its depth. For
//! nearly parallel normals these differences are exact, and products are not.

use super::shared_contact::{Coupling, SharedContact, deepest_of};
use pong_geometry::Vec3;

/// Allowed violation of a contact relative to the largest depth; depths are not known more accurately.
const VIOLATION_MAX: f64 = 1e-15;
/// Allowed increase of |p|²·δ_d² in an exchange: a few roundings of this number, which is about 1. δ_d is the
/// depth of the deepest contact.
const GAIN_SLACK: f64 = 1e-15;

/// Shortest vector that clears all contacts, and the at most three contacts that determine it.
#[derive(Clone, Copy)]
pub(super) struct Shortest {
    /// Contacts that determine the vector.
    pub members: [usize; 3],
    /// Their λ, m.
    pub lambdas: [f64; 3],
    /// Number of valid entries in `members` and `lambdas`.
    pub count: usize,
    /// The vector, m.
    pub t_b: Vec3,
    deepest: usize,
    hull_point: HullPoint,
}

impl Shortest {
    /// Computes the shortest vector for one or more contacts of which no two normals are more than 90° apart.
    pub fn new(contacts: &[SharedContact]) -> Self {
        let deepest = deepest_of(contacts);
        let mut best =
            Self::at(contacts, deepest, HullPoint::of_one(QPoint::new(contacts, deepest, deepest)));
        let allowed = VIOLATION_MAX * contacts[deepest].depth;
        // Limited, because contacts that differ only by rounding could replace each other endlessly.
        for _ in 0..8 * contacts.len() {
            let Some(worst) = best.most_violated(contacts, allowed) else { break };
            match best.exchange(contacts, worst, allowed) {
                Some(better) if better.hull_point.gain() <= best.hull_point.gain() + GAIN_SLACK => {
                    best = better
                }
                _ => break,
            }
        }
        best
    }

    fn at(contacts: &[SharedContact], deepest: usize, hull_point: HullPoint) -> Self {
        let base = &contacts[deepest];
        let scale = base.depth / (1.0 + hull_point.gain());
        let lambda = |k: usize| {
            let point = &hull_point.points[k];
            scale * hull_point.parts[k] * (base.depth / contacts[point.contact].depth)
        };
        Self {
            members: hull_point.points.map(|point| point.contact),
            lambdas: std::array::from_fn(lambda),
            count: hull_point.count,
            t_b: (base.normal_b + hull_point.offset) * scale,
            deepest,
            hull_point,
        }
    }

    /// Excess clearance n·t − δ of a contact, m; negative if it is violated.
    pub fn slack(&self, contacts: &[SharedContact], contact: usize) -> f64 {
        let (base, contact) = (&contacts[self.deepest], &contacts[contact]);
        let coupling = Coupling::new(base, contact);
        if !coupling.is_near {
            return contact.normal_b.dot(&self.t_b) - contact.depth;
        }
        // With d the deepest contact, a the offset of the hull point and s = `scale`: t = (n_d + a)·s and δ_d
        // = s·(1 + 2·n_d·a + |a|²). So n·t − δ = (δ_d − δ) + s·((n − n_d)·a − (1 − n·n_d) − n_d·a − |a|²).
        // These differences are exact for nearly parallel normals.
        let HullPoint { offset, rise, .. } = &self.hull_point;
        let scale = base.depth / (1.0 + self.hull_point.gain());
        let turned = (contact.normal_b - base.normal_b).dot(offset) - coupling.gap;
        (base.depth - contact.depth) + scale * (turned - (rise + offset.norm_squared()))
    }

    fn most_violated(&self, contacts: &[SharedContact], allowed: f64) -> Option<usize> {
        let (mut worst, mut least) = (None, -allowed);
        for contact in 0..contacts.len() {
            let slack = self.slack(contacts, contact);
            if slack < least {
                (worst, least) = (Some(contact), slack);
            }
        }
        worst
    }

    /// Shortest vector for the current members and the entering contact. Of the subsets that contain the
    /// entering contact, it takes the first whose vector clears all of these contacts, otherwise the one with
    /// the least violation; `None` if no subset has a vector.
    fn exchange(&self, contacts: &[SharedContact], entering: usize, allowed: f64) -> Option<Self> {
        let entering = QPoint::new(contacts, self.deepest, entering);
        let mut best: Option<(f64, Self)> = None;
        // Bit k of the subset is member k.
        for subset in 0..1_usize << self.count {
            if subset.count_ones() > 2 {
                continue;
            }
            let mut points = [entering; 3];
            let mut count = 1;
            for (k, &point) in self.hull_point.points[..self.count].iter().enumerate() {
                if subset >> k & 1 == 1 {
                    points[count] = point;
                    count += 1;
                }
            }
            let Some(hull_point) = HullPoint::nearest(points, count) else { continue };
            let candidate = Self::at(contacts, self.deepest, hull_point);
            let pool = self.members[..self.count].iter().chain([&entering.contact]);
            let missed = pool.map(|&i| -candidate.slack(contacts, i)).fold(0.0, f64::max);
            if missed <= allowed {
                return Some(candidate);
            }
            if best.as_ref().is_none_or(|(least, _)| missed < *least) {
                best = Some((missed, candidate));
            }
        }
        best.map(|(_, candidate)| candidate)
    }
}

/// Point q = n/δ of a contact relative to that of the deepest contact, q_d = n_d/δ_d.
#[derive(Clone, Copy)]
struct QPoint {
    contact: usize,
    /// Offset a = (q − q_d)·δ_d.
    offset: Vec3,
    /// Component along n_d: a·n_d = g·δ_d/δ − 1, with the coupling g = n·n_d.
    rise: f64,
}

impl QPoint {
    fn new(contacts: &[SharedContact], deepest: usize, contact: usize) -> Self {
        let (base, own) = (&contacts[deepest], &contacts[contact]);
        let turned = (own.normal_b - base.normal_b) * base.depth + base.normal_b * (base.depth - own.depth);
        let rise = -Coupling::new(base, own).beyond(own.depth, base.depth) / own.depth;
        Self { contact, offset: turned / own.depth, rise }
    }
}

/// Point p of the convex hull of at most three points q, nearest to the origin.
#[derive(Clone, Copy)]
struct HullPoint {
    points: [QPoint; 3],
    /// Convex coefficients μ, positive, with sum one.
    parts: [f64; 3],
    count: usize,
    /// Offset a = (p − q_d)·δ_d.
    offset: Vec3,
    /// Component of the offset along n_d.
    rise: f64,
}

impl HullPoint {
    fn of_one(point: QPoint) -> Self {
        Self { points: [point; 3], parts: [1.0, 0.0, 0.0], count: 1, offset: point.offset, rise: point.rise }
    }

    /// Increase of |p|²·δ_d² from 1, its value for the deepest contact alone.
    fn gain(&self) -> f64 {
        2.0 * self.rise + self.offset.norm_squared()
    }

    /// Point nearest to the origin on the line through two points or on the plane through three. `None` if it
    /// does not lie between them, or if equal points determine no line or plane.
    fn nearest(points: [QPoint; 3], count: usize) -> Option<Self> {
        let first = &points[0];
        let edge = |k: usize| points[k].offset - first.offset;
        // Rate at which half the squared distance to the origin decreases along an edge e from the first
        // point q: −q·e. Scaled with δ_d, q = a + n_d, and n_d·e is the difference of the two points' rises.
        let gained = |k: usize, edge: &Vec3| first.rise - points[k].rise - first.offset.dot(edge);
        let parts = match count {
            1 => return Some(Self::of_one(*first)),
            2 => {
                let edge = edge(1);
                let square = edge.norm_squared();
                // Equal points determine no line.
                if square <= 0.0 {
                    return None;
                }
                let second = gained(1, &edge) / square.max(f64::MIN_POSITIVE);
                [1.0 - second, second, 0.0]
            }
            _ => {
                let edges = [edge(1), edge(2)];
                let gained = [gained(1, &edges[0]), gained(2, &edges[1])];
                let across = edges[0].dot(&edges[1]);
                let determinant = edges[0].cross(&edges[1]).norm_squared();
                if determinant <= 0.0 {
                    return None;
                }
                let determinant = determinant.max(f64::MIN_POSITIVE);
                let second = (gained[0] * edges[1].norm_squared() - gained[1] * across) / determinant;
                let third = (gained[1] * edges[0].norm_squared() - gained[0] * across) / determinant;
                [1.0 - second - third, second, third]
            }
        };
        if !parts[..count].iter().all(|part| *part > 0.0) {
            return None;
        }
        let mut hull_point = Self { points, parts, count, offset: Vec3::zeros(), rise: 0.0 };
        for (point, part) in points[..count].iter().zip(parts) {
            hull_point.offset += point.offset * part;
            hull_point.rise += point.rise * part;
        }
        Some(hull_point)
    }
}
