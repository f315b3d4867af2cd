//! Contacts of the last frame.

use crate::guard::{get, with_world};
use crate::handle::pong_world;
use crate::ids::{pong_interface_id, pong_object_id, pong_pair_id};
use crate::interfaces::too_small;
use crate::pointers::{Out, OutArray, apart};
use crate::status::pong_status;
use pong_engine::{Contact, ContactSide, World};

/// Kind of a feature of a primitive: PONG_FEATURE_...
pub type pong_feature_kind = u32;

/// `feature_kind` of a face, or of a surface as a whole.
pub const PONG_FEATURE_FACE: pong_feature_kind = 0;
/// `feature_kind` of an edge.
pub const PONG_FEATURE_EDGE: pong_feature_kind = 1;
/// `feature_kind` of a vertex.
pub const PONG_FEATURE_VERTEX: pong_feature_kind = 2;

/// One side of a contact.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_contact_side {
    /// The Object.
    pub object: pong_object_id,
    /// The movable group.
    pub interface: pong_interface_id,
    /// The primitive: an index within the movable group, see pong_primitive_path().
    pub primitive: u32,
    /// The triangle of a mesh, counted from its first; 0 otherwise.
    pub element: u32,
    /// Lever arm from the group's origin to the point of the contact, m, along common axes.
    pub arm: [f64; 3],
}

/// One contact. Vectors are expressed in the common frame; forces are those on A, B receives the opposite at the
/// same place.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_contact {
    /// The pair of Objects.
    pub pair: pong_pair_id,
    /// Side A: the primitive whose kind the tester names first.
    pub a: pong_contact_side,
    /// Side B.
    pub b: pong_contact_side,
    /// Feature of B that pushes: PONG_FEATURE_FACE, PONG_FEATURE_EDGE or PONG_FEATURE_VERTEX.
    pub feature_kind: pong_feature_kind,
    /// Index of that feature among those of its kind.
    pub feature_index: u32,
    /// End of an elongated body: 0 and 1 at its ends, 2 and above between them; 0 for other bodies.
    /// Contacts of solids have bit 31 set, forces against rolling and spinning bit 30: see docs/c_api.md.
    pub end: u32,
    /// 1: friction sticks. 0: it slips, or there is none.
    pub sticks: i32,
    /// Point at which the force acts, m.
    pub point: [f64; 3],
    /// Unit normal from B to A.
    pub normal: [f64; 3],
    /// Depth of penetration, m, positive.
    pub depth: f64,
    /// Rate of the depth, m/s, positive while closing.
    pub depth_rate: f64,
    /// Weight, 0 to 1: the share of the pair's spring that this contact carries.
    /// For a cell of two solids, its area, m2; 0 for the contacts that carry their friction.
    pub weight: f64,
    /// Normal force, N, never negative.
    pub normal_force: f64,
    /// Friction force on A, N, tangential.
    pub friction_force: [f64; 3],
    /// Total force on A, N.
    pub force: [f64; 3],
    /// Tangential velocity of A against B, m/s.
    pub slip_velocity: [f64; 3],
    /// Energy stored in the normal spring and in friction, J.
    pub stored: f64,
}

/// Copies the number of contacts of the last frame; 0 before the first.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_contact_count(world: *const pong_world, count: *mut usize) -> pong_status {
    get(world, (count, "count"), |inner| Ok(inner.phase.report().contacts as usize))
}

/// Copies the contacts of the last frame, always in the same order for the same frame: the first `capacity`;
/// `count` gets their number. None before the first frame. PONG_STATUS_BUFFER_TOO_SMALL if not all fit; the
/// contact capacity of the seal report is always enough. With capacity 0 `contacts` may be NULL.
/// PONG_STATUS_LAW_FAILED after a frame that a law spoilt.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_contacts(
    world: *const pong_world,
    contacts: *mut pong_contact,
    capacity: usize,
    count: *mut usize,
) -> pong_status {
    with_world(world, |inner| {
        apart(("contacts", contacts, capacity), ("count", count, 1))?;
        let (mut out, count) = (OutArray::new(contacts, capacity, "contacts")?, Out::new(count, "count")?);
        inner.law_faults.check()?;
        let listed = inner.phase.sealed().into_iter().flat_map(World::contacts_iter).enumerate();
        listed.take(capacity).for_each(|(index, contact)| out.set(index, (&contact).into()));
        let total = inner.phase.report().contacts as usize;
        count.set(total);
        too_small("contacts", capacity, total)
    })
}

/// Lists movable groups in contact whose pose stayed the same, bit for bit, from one commit to the next, though
/// their velocity would have moved them within `step`, the time between the two, s: copies the first
/// `capacity`; `count` gets their number.
///
/// Friction by bristles follows poses, so a belt that is to carry needs a pose that moves, or Coulomb friction,
/// which uses velocities alone. Call it right after pong_step() or pong_commit(); at other times the list is
/// empty. A frame that is committed twice, as in a pause, is listed too. PONG_STATUS_BUFFER_TOO_SMALL if not
/// all fit. With capacity 0 `groups` may be NULL. Allocates.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_find_standing_groups(
    world: *const pong_world,
    step: f64,
    groups: *mut pong_interface_id,
    capacity: usize,
    count: *mut usize,
) -> pong_status {
    with_world(world, |inner| {
        apart(("groups", groups, capacity), ("count", count, 1))?;
        let (mut out, count) = (OutArray::new(groups, capacity, "groups")?, Out::new(count, "count")?);
        let found = inner.phase.frames("look for groups that stand still")?.standing_groups(step)?;
        count.set(found.len());
        for (index, group) in found.iter().take(capacity).enumerate() {
            out.set(index, (*group).into());
        }
        too_small("groups", capacity, found.len())
    })
}

/// Derivatives of the normal force of each contact of the last frame by its depth (`stiffness`, N/m) and by
/// its depth rate (`damping`, N s/m), with the weight of the contact, in the order of pong_get_contacts():
/// the first `capacity` of both are written, `count` gets their number. Zero where the force is cut off at
/// zero; not a number (NaN) for a normal law of the host's. After pong_set_surface() they follow the new
/// values, but the contacts are still those of the frame: evaluate first. PONG_STATUS_BUFFER_TOO_SMALL if not
/// all fit. With capacity 0 both arrays may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_contact_stiffness(
    world: *const pong_world,
    stiffness: *mut f64,
    damping: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> pong_status {
    with_world(world, |inner| {
        apart(("stiffness", stiffness, capacity), ("damping", damping, capacity))?;
        apart(("stiffness", stiffness, capacity), ("count", count, 1))?;
        apart(("damping", damping, capacity), ("count", count, 1))?;
        let mut stiffness = OutArray::new(stiffness, capacity, "stiffness")?;
        let mut damping = OutArray::new(damping, capacity, "damping")?;
        let count = Out::new(count, "count")?;
        inner.law_faults.check()?;
        let listed = inner.phase.sealed().into_iter().flat_map(World::normal_tangents).enumerate();
        for (index, tangent) in listed.take(capacity) {
            stiffness.set(index, tangent.map_or(f64::NAN, |tangent| tangent.stiffness));
            damping.set(index, tangent.map_or(f64::NAN, |tangent| tangent.damping));
        }
        let total = inner.phase.report().contacts as usize;
        count.set(total);
        too_small("stiffness and damping", capacity, total)
    })
}

impl From<&Contact> for pong_contact {
    fn from(contact: &Contact) -> Self {
        Self {
            pair: contact.pair.into(),
            a: (&contact.a).into(),
            b: (&contact.b).into(),
            feature_kind: contact.feature.kind() as u32,
            feature_index: contact.feature.index() as u32,
            end: contact.end,
            sticks: contact.sticks.into(),
            point: contact.point.into(),
            normal: contact.normal.into(),
            depth: contact.depth,
            depth_rate: contact.depth_rate,
            weight: contact.weight,
            normal_force: contact.normal_force,
            friction_force: contact.friction_force.into(),
            force: contact.force.into(),
            slip_velocity: contact.slip_velocity.into(),
            stored: contact.stored,
        }
    }
}

impl From<&ContactSide> for pong_contact_side {
    fn from(side: &ContactSide) -> Self {
        Self {
            object: side.object.into(),
            interface: side.interface.into(),
            primitive: side.primitive,
            element: side.element,
            arm: side.arm.into(),
        }
    }
}
