//! Derivatives of the weights of contacts that share a spring (docs/theory.md, 2.2 and 2.8).

use super::contact::Moving;
use crate::frame::forces::{bristle_share, share_a_bristle};
use crate::frame::narrow_phase::candidate::ContactCandidate;
use crate::frame::narrow_phase::element_pair::{BETWEEN_DISCS, BETWEEN_ENDS};
use nalgebra::{DMatrix, Matrix3xX, RowVector6};
use pong_geometry::primitive::PrimitiveKind::{
    self, Bore, Capsule, Cone, Cylinder, LineSegment, Polyhedron, Ray, Triangle,
};
use pong_geometry::{Mat3, Vec3};

/// Number and its derivatives with respect to (u, φ).
#[derive(Clone, Copy, Debug)]
struct Slope {
    value: f64,
    by: RowVector6<f64>,
}

impl Slope {
    const ZERO: Self = Self { value: 0.0, by: RowVector6::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0) };

    fn plus(&self, other: &Self) -> Self {
        Self { value: self.value + other.value, by: self.by + other.by }
    }

    fn times(&self, other: &Self) -> Self {
        Self { value: self.value * other.value, by: self.by * other.value + other.by * self.value }
    }

    fn over(&self, other: &Self) -> Self {
        let value = self.value / other.value;
        Self { value, by: (self.by - other.by * value) / other.value }
    }
}

/// Sets the derivatives of the weights of the contacts of one primitive of A with one surface of B. Returns
/// `None` if load sharing has no unique derivative.
pub(super) fn weigh(kind_a: PrimitiveKind, contacts: &mut [Moving<'_>]) -> Option<()> {
    let kind_b = contacts[0].contact.found.kind_b;
    let two_ended = matches!(kind_a, Capsule | LineSegment);
    // Where the ends of a bar yield, the derivatives of the weights come with those of their places.
    if two_ended && (kind_b == Capsule || kind_b == Polyhedron && !contacts[0].contact.found.shares) {
        return Some(());
    }
    if two_ended_in(kind_a, kind_b) {
        return weigh_in_bore(contacts);
    }
    let on_flat = matches!(kind_b, Polyhedron | Triangle);
    if two_ended && !on_flat && !contacts[0].contact.found.shares {
        weigh_overlap(contacts);
        return Some(());
    }
    if matches!(kind_a, Ray) {
        return Some(());
    }
    contacts.sort_by_key(|moving| moving.contact.found.key.end);
    // A cylinder has a closed form on what is flat. On edges its side shares with its discs, and the plate between two
    // cylinders with all places.
    let is_on_face = |moving: &Moving<'_>| moving.contact.found.feature.is_face();
    if matches!(kind_a, Cylinder | Cone)
        && (matches!(kind_b, Cylinder | Cone) || on_flat && !contacts.iter().all(is_on_face))
    {
        return None;
    }
    // Neither have bodies that yield as one on triangles: their places move with both ends.
    let between = if kind_a == Capsule { BETWEEN_ENDS } else { BETWEEN_DISCS };
    let is_between = |moving: &Moving<'_>| moving.contact.found.key.end >= between;
    if matches!(kind_a, Capsule | Cylinder | Cone) && kind_b == Triangle && contacts.iter().any(is_between) {
        return None;
    }
    let middle = contacts.partition_point(|moving| moving.contact.found.key.end < BETWEEN_ENDS);
    let (ends, middle) = match kind_a == Capsule && on_flat {
        true => contacts.split_at_mut(middle),
        false => (contacts, &mut [][..]),
    };
    let coupled = !middle.is_empty();
    let mut moved = [Slope::ZERO; 2];
    for end in ends.chunk_by_mut(|a, b| a.contact.found.key == b.contact.found.key) {
        let number = end[0].contact.found.key.end as usize;
        let translation = weigh_shared(end, coupled)?;
        if coupled {
            moved[number] = translation;
        }
    }
    if let [crossing] = middle {
        couple(ends, crossing, &moved);
    }
    Some(())
}

fn two_ended_in(kind_a: PrimitiveKind, kind_b: PrimitiveKind) -> bool {
    kind_b == Bore && matches!(kind_a, LineSegment | Capsule | Cylinder)
}

/// Weights at the ends of a rod in a bore. Those of two tips of a wide rod on opposite sides of the wall follow from
/// their normals; the places of two contacts of a rim or at a mouth move with both, which has no closed form here.
fn weigh_in_bore(contacts: &mut [Moving<'_>]) -> Option<()> {
    contacts.sort_by_key(|moving| moving.contact.found.key.end);
    for end in contacts.chunk_by_mut(|a, b| a.contact.found.key == b.contact.found.key) {
        let is_tip =
            |moving: &Moving<'_>| moving.kind_a != Cylinder && moving.contact.found.feature.is_face();
        if end.len() > 1 {
            end.iter().all(is_tip).then_some(())?;
            weigh_together(end, false)?;
        }
    }
    Some(())
}

/// Weights of a segment or capsule on a round solid: δ₁²/δ², δ₀²/δ² and 1 − δ₀²δ₁²/δ⁴.
fn weigh_overlap(contacts: &mut [Moving<'_>]) {
    let square = |end: u32| {
        let at_end = contacts.iter().find(|moving| moving.contact.found.key.end == end);
        at_end.map(|moving| squared_depth(moving))
    };
    let Some(deepest) = square(BETWEEN_ENDS) else { return };
    let [first, second] = [0, 1].map(|end| square(end).map_or(Slope::ZERO, |square| square.over(&deepest)));
    let both = first.times(&second);
    for moving in contacts {
        moving.weight = match moving.contact.found.key.end {
            0 => second.by,
            1 => first.by,
            _ => -both.by,
        };
    }
}

fn squared_depth(moving: &Moving<'_>) -> Slope {
    let depth = moving.contact.found.depth;
    Slope { value: depth * depth, by: moving.moves.depth * (2.0 * depth) }
}

/// Weights of contacts that share one spring, and the square of the translation that clears them, m². `again`
/// recomputes the loads: the weights of a capsule's ends hold a factor of the edge between them.
fn weigh_shared(contacts: &mut [Moving<'_>], again: bool) -> Option<Slope> {
    if contacts.len() == 1 || !contacts[0].contact.found.shares {
        return Some(squared_depth(&contacts[0]));
    }
    weigh_together(contacts, again)
}

fn weigh_together(contacts: &mut [Moving<'_>], again: bool) -> Option<Slope> {
    let normals = Matrix3xX::from_iterator(
        contacts.len(),
        contacts.iter().flat_map(|c| c.contact.found.normal_b.iter().copied()),
    );
    let coupled = normals.tr_mul(&normals).iter().all(|cosine| *cosine >= -1e-14);
    let loads = match (coupled, again) {
        (true, _) => None,
        (false, false) => Some(()),
        (false, true) => return None,
    };
    let slopes = match loads {
        None => of_coupled(contacts, &normals)?,
        Some(()) => of_uncoupled(contacts, &normals)?,
    };
    let mut sum = (Vec3::zeros(), nalgebra::Matrix3x6::zeros());
    for (moving, load) in contacts.iter_mut().zip(&slopes) {
        let depth = Slope { value: moving.contact.found.depth, by: moving.moves.depth };
        moving.weight = load.over(&depth).by;
        sum.0 += moving.contact.found.normal_b * load.value;
        sum.1 += moving.contact.found.normal_b * load.by + moving.moves.normal * load.value;
    }
    Some(Slope { value: sum.0.norm_squared(), by: sum.0.transpose() * sum.1 * 2.0 })
}

/// Loads λ of contacts of which no two normals are more than 90° apart: t = Σ λ·n with n·t = δ, and the λ of
/// least norm. With N the normals as columns and M = N·Nᵀ: t = M⁺·N·δ, s = M⁺·t, λ = Nᵀ·s.
fn of_coupled(contacts: &[Moving<'_>], normals: &Matrix3xX<f64>) -> Option<Vec<Slope>> {
    let matrix: Mat3 = normals * normals.transpose();
    let inverse = pseudo_inverse(&matrix);
    let depths =
        nalgebra::DVector::from_iterator(contacts.len(), contacts.iter().map(|c| c.contact.found.depth));
    let t: Vec3 = inverse * (normals * depths);
    let s: Vec3 = inverse * t;
    let loads = normals.tr_mul(&s);
    let mut slopes: Vec<Slope> =
        loads.iter().map(|&value| Slope { value, by: RowVector6::zeros() }).collect();
    for column in 0..6 {
        let turned: Vec<Vec3> = contacts.iter().map(|c| c.moves.normal.column(column).into_owned()).collect();
        let weighted = |numbers: &dyn Fn(usize) -> f64, vectors: &dyn Fn(usize) -> Vec3| {
            (0..contacts.len()).map(|i| vectors(i) * numbers(i)).sum::<Vec3>()
        };
        let normal = |i: usize| normals.column(i).into_owned();
        let of_t: Vec3 =
            inverse * weighted(&|i| contacts[i].moves.depth[column] - turned[i].dot(&t), &normal);
        let of_t = of_t + (Mat3::identity() - inverse * matrix) * weighted(&|i| loads[i], &|i| turned[i]);
        let of_matrix = weighted(&|i| loads[i], &|i| turned[i]) + weighted(&|i| turned[i].dot(&s), &normal);
        let of_s = inverse * (of_t - of_matrix);
        for (i, slope) in slopes.iter_mut().enumerate() {
            slope.by[column] = turned[i].dot(&s) + normal(i).dot(&of_s);
        }
    }
    Some(slopes)
}

/// Inverse of a symmetric positive matrix on its range.
fn pseudo_inverse(matrix: &Mat3) -> Mat3 {
    /// Eigenvalue, relative to the largest, below which the normals count as in a plane or on a line.
    const LEAST: f64 = 1e-12;
    let eigen = matrix.symmetric_eigen();
    let largest = eigen.eigenvalues.max();
    (0..3)
        .filter(|&k| eigen.eigenvalues[k] > LEAST * largest)
        .map(|k| {
            let axis = eigen.eigenvectors.column(k);
            axis * axis.transpose() / eigen.eigenvalues[k]
        })
        .sum()
}

/// Loads λ of contacts of which some normals are more than 90° apart: Σ max(0, nᵢ·nⱼ)·λⱼ = δᵢ.
fn of_uncoupled(contacts: &[Moving<'_>], normals: &Matrix3xX<f64>) -> Option<Vec<Slope>> {
    let count = contacts.len();
    let loads: Vec<f64> = contacts.iter().map(|c| c.contact.found.weight * c.contact.found.depth).collect();
    let cosines = normals.tr_mul(normals);
    let factors = DMatrix::from_fn(count, count, |i, j| cosines[(i, j)].max(0.0)).lu();
    let mut slopes: Vec<Slope> =
        loads.iter().map(|&value| Slope { value, by: RowVector6::zeros() }).collect();
    for column in 0..6 {
        let turned = |i: usize| contacts[i].moves.normal.column(column).into_owned();
        let of_cosine = |i: usize, j: usize| {
            let couples = i != j && cosines[(i, j)] > 0.0;
            if couples { turned(i).dot(&normals.column(j)) + normals.column(i).dot(&turned(j)) } else { 0.0 }
        };
        let right = nalgebra::DVector::from_fn(count, |i, _| {
            contacts[i].moves.depth[column] - (0..count).map(|j| of_cosine(i, j) * loads[j]).sum::<f64>()
        });
        let solved = factors.solve(&right)?;
        slopes.iter_mut().zip(solved.iter()).for_each(|(slope, by)| slope.by[column] = *by);
    }
    Some(slopes)
}

/// Weights of the end spheres of a capsule and of the edge that its axis crosses: with the squares A and B of the
/// translations of the ends and E of the depth at the edge, B/E and A/E times those of the ends alone, and
/// 1 − A·B/E².
fn couple(ends: &mut [Moving<'_>], crossing: &mut Moving<'_>, moved: &[Slope; 2]) {
    let square = squared_depth(crossing);
    let parts = moved.map(|other| other.over(&square));
    crossing.weight = -parts[0].times(&parts[1]).by;
    for moving in ends {
        let factor = parts[1 - moving.contact.found.key.end as usize];
        let alone = moving.contact.found.weight / factor.value.max(f64::MIN_POSITIVE);
        moving.weight = moving.weight * factor.value + factor.by * alone;
    }
}

/// Sets the share h·w/Σw of the tangential spring of each contact, and its derivative.
pub(super) fn share_bristles(contacts: &mut [Moving<'_>]) {
    for group in contacts.chunk_by_mut(|a, b| a.contact.found.key == b.contact.found.key) {
        let found: Vec<(&ContactCandidate, Slope)> = group
            .iter()
            .map(|moving| {
                (&moving.contact.found, Slope { value: moving.contact.found.weight, by: moving.weight })
            })
            .collect();
        for (moving, (own, weight)) in group.iter_mut().zip(&found) {
            moving.share = bristle_share(own, found.iter().map(|(other, _)| *other));
            let sharing = found.iter().filter(|(other, _)| share_a_bristle(other, own));
            let whole = sharing.fold(Slope::ZERO, |sum, (_, other)| sum.plus(other));
            if whole.value > weight.value {
                moving.share_slope = weight.over(&whole).by * own.half_or_whole();
            }
        }
    }
}
