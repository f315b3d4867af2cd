//! Contacts as forces on the movable groups that yield: rows of a matrix in coordinates in which every mass is one.

use crate::mobility::{Vec6, largest_eigenvalue};
use crate::setting::Setting;
use crate::spring::ContactSprings;
use nalgebra::DMatrix;
use pong_engine::inspect::PushingContact;
use pong_geometry::Vec3;

/// A contact with at least one body that yields, or a spring that counts beside it.
#[derive(Clone)]
pub(crate) struct Acting {
    pub springs: ContactSprings,
    /// Active share of the contact's spring, 0…1.
    pub weight: f64,
    /// Part of the normal spring that the stiffness has: the weight, but 0 for a contact whose springs count at the ends of
    /// an axis.
    pub stiffens: f64,
    /// Unit normal from B to A, in B's frame.
    pub normal: Vec3,
    /// The axes of B's frame as forces on the movable groups that yield.
    pub rows: Vec<(usize, [Vec6; 3])>,
}

impl Acting {
    /// Makes it; `None` if the contact cannot be judged.
    pub fn new(setting: &Setting<'_>, contact: &PushingContact<'_>) -> Option<Self> {
        let (a, b) = (contact.group_a, contact.group_b);
        if setting.masses[a].is_none() || setting.masses[b].is_none() {
            return None;
        }
        let springs = setting.pressed_springs(contact)?;
        let rows = rows_of(setting, contact);
        let weight = contact.weight;
        Some(Self { springs, weight, stiffens: weight, normal: contact.normal_b, rows })
    }
}

/// The axes of B's frame.
pub(crate) const AXES: [Vec3; 3] =
    [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0)];

/// Movable group and primitive of A and of B.
pub(crate) fn primitives_of(contact: &PushingContact<'_>) -> [(usize, u32); 2] {
    [(contact.group_a, contact.primitive_a), (contact.group_b, contact.primitive_b)]
}

/// The axes of B's frame, at a contact, as forces on the movable groups that yield.
pub(crate) fn rows_of(setting: &Setting<'_>, contact: &PushingContact<'_>) -> Vec<(usize, [Vec6; 3])> {
    let x_ba = contact.x_ba;
    let at_a = x_ba.rotation.tr_mul(&(contact.point_b - x_ba.translation));
    let on_a = setting.mobilities[contact.group_a]
        .as_ref()
        .map(|body| (contact.group_a, AXES.map(|axis| body.row(&x_ba.rotation.tr_mul(&axis), &at_a))));
    let on_b = setting.mobilities[contact.group_b]
        .as_ref()
        .map(|body| (contact.group_b, AXES.map(|axis| body.row(&-axis, &contact.point_b))));
    on_a.into_iter().chain(on_b).collect()
}

/// Inverse of the effective mass at a contact along the normal, 1/kg, and its largest value along the surface.
pub(crate) fn compliances_at(setting: &Setting<'_>, contact: &PushingContact<'_>) -> [f64; 2] {
    let mut sum = pong_geometry::Mat3::zeros();
    for (_, rows) in rows_of(setting, contact) {
        sum += pong_geometry::Mat3::from_fn(|i, j| rows[i].dot(&rows[j]));
    }
    if setting.share_joints(contact.group_a, contact.group_b) {
        sum *= 2.0;
    }
    let n = &contact.normal_b;
    let flat = pong_geometry::Mat3::identity() - n * n.transpose();
    let along = flat * sum * flat;
    [n.dot(&(sum * n)), largest_eigenvalue(DMatrix::from_column_slice(3, 3, along.as_slice()))]
}
