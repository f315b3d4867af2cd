//! Derivatives of the wrenches of the last frame.

use crate::failure::Outcome;
use crate::guard::with_world;
use crate::handle::{Inner, pong_world};
use crate::ids::pong_interface_id;
use crate::interfaces::too_small;
use crate::pointers::{Out, OutArray, apart};
use crate::status::pong_status;
use pong_engine::{ContactTangent, EngineError, PairTangent, TangentMatrix, World};

/// Derivatives of the wrenches that two movable groups put on each other.
///
/// x is a pose: translation of the group's origin, m, and rotation vector, rad. v is a twist: velocity of the
/// origin, m/s, and angular velocity, rad/s. W is a wrench: force, N, and moment about the group's origin, N m. All of
/// them are along common axes. A matrix has 6 rows, one for each number of W, and 6 columns, one for each number of x
/// or v; row r and column c are number 6 r + c.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_tangent {
    /// The two movable groups, in the order of pong_contact_change.
    pub interfaces: [pong_interface_id; 2],
    /// `stiffness[i][j]` is minus the derivative of W of group i by x of group j, N/m, N/rad, N and N m/rad. A spring
    /// that pushes back has a positive diagonal.
    pub stiffness: [[[f64; 36]; 2]; 2],
    /// `damping[i][j]` is minus the derivative of W of group i by v of group j, N s/m, N s/rad, N s and N m s/rad.
    pub damping: [[[f64; 36]; 2]; 2],
}

/// Stiffness and damping of one contact, its weight included.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_contact_tangent {
    /// Derivative of the normal force by the depth, N/m; zero where the force is cut off at zero.
    pub normal_stiffness: f64,
    /// Derivative of the normal force by the depth rate, N s/m; zero where the force is cut off at zero.
    pub normal_damping: f64,
    /// Stiffness of the bristle while it sticks, N/m; zero while it slips and for laws without a bristle.
    pub tangential_stiffness: f64,
    /// Damping of the bristle while it sticks, N s/m; zero while it slips and for laws without a bristle.
    pub tangential_damping: f64,
}

/// Copies the derivatives of the wrenches of the last frame for every two movable groups that touch, in closed form and
/// always in the same order: the first `capacity`; `count` gets their number. They are those of what pong_evaluate()
/// computes from the committed contact state, with the contacts of the frame: turning normals, moving places, weights,
/// sticking and slipping friction included. The matrices are not symmetric where friction or damping acts. See
/// docs/theory.md, 7. A frame pays nothing. Allocates.
///
/// PONG_STATUS_WRONG_PHASE: call it between pong_evaluate() and the commit. PONG_STATUS_BAD_VALUE: a contact has
/// derivatives that are not known in closed form, such as that of two solids or of a law of the host's; the message
/// names it, and pong_get_complete_tangents() has them. PONG_STATUS_BUFFER_TOO_SMALL if not all fit;
/// `group_pairs` of the seal report is always enough. With capacity 0 `tangents` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_tangents(
    world: *const pong_world,
    tangents: *mut pong_tangent,
    capacity: usize,
    count: *mut usize,
) -> pong_status {
    with_world(world, |inner| {
        let out = Destination::new((tangents, "tangents"), capacity, count)?;
        inner.law_faults.check()?;
        let found = inner.phase.frames("get tangents")?.tangents()?;
        out.fill(&found)
    })
}

/// As pong_get_tangents(), by central differences, for every law and every kind of contact: two evaluations for each of
/// the 12 numbers of pose and twist of each group that touches. The width of a difference is 1e-4 of the least depth of
/// the group's contacts. Contacts that begin or end within that width, and friction that begins to slip, spoil the
/// result. The states and the frame are those of before. Allocates.
///
/// PONG_STATUS_WRONG_PHASE: call it between pong_evaluate() and the commit. Otherwise errors as for pong_evaluate() at
/// the states in between; after PONG_STATUS_LAW_FAILED the frame does not count. PONG_STATUS_BUFFER_TOO_SMALL if not all
/// fit. With capacity 0 `tangents` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_tangents_by_differences(
    world: *mut pong_world,
    tangents: *mut pong_tangent,
    capacity: usize,
    count: *mut usize,
) -> pong_status {
    with_world(world, |inner| {
        let out = Destination::new((tangents, "tangents"), capacity, count)?;
        out.fill(&inner.tangents_with(World::tangents_by_differences)?)
    })
}

/// As pong_get_tangents() for the pairs of groups whose contacts all have derivatives in closed form, and as
/// pong_get_tangents_by_differences() for the others, in the same order. Allocates.
///
/// Errors as for pong_get_tangents_by_differences().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_complete_tangents(
    world: *mut pong_world,
    tangents: *mut pong_tangent,
    capacity: usize,
    count: *mut usize,
) -> pong_status {
    with_world(world, |inner| {
        let out = Destination::new((tangents, "tangents"), capacity, count)?;
        out.fill(&inner.tangents_with(World::complete_tangents)?)
    })
}

/// Copies stiffness and damping of each contact of the last frame, in the order of pong_get_contacts(): the first
/// `capacity`; `count` gets their number. All four are not a number (NaN) for a law of the host's, for contacts of
/// solids and for forces against rolling and spinning. After pong_set_surface() they follow the new values, but the
/// contacts are still those of the frame: evaluate first. PONG_STATUS_BUFFER_TOO_SMALL if not all fit; the contact
/// capacity of the seal report is always enough. With capacity 0 `tangents` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_contact_tangents(
    world: *const pong_world,
    tangents: *mut pong_contact_tangent,
    capacity: usize,
    count: *mut usize,
) -> pong_status {
    with_world(world, |inner| {
        apart(("tangents", tangents, capacity), ("count", count, 1))?;
        let (mut out, count) = (OutArray::new(tangents, capacity, "tangents")?, Out::new(count, "count")?);
        inner.law_faults.check()?;
        let listed = inner.phase.sealed().into_iter().flat_map(World::contact_tangents).enumerate();
        listed.take(capacity).for_each(|(index, tangent)| out.set(index, tangent.into()));
        let total = inner.phase.report().contacts as usize;
        count.set(total);
        too_small("tangents", capacity, total)
    })
}

/// Array and count of a caller who gets a list.
pub(crate) struct Destination<T> {
    items: OutArray<T>,
    name: &'static str,
    count: Out<usize>,
}

impl<T> Destination<T> {
    /// # Safety
    /// That of all entries.
    pub unsafe fn new(
        (items, name): (*mut T, &'static str),
        capacity: usize,
        count: *mut usize,
    ) -> Outcome<Self> {
        apart((name, items, capacity), ("count", count, 1))?;
        Ok(Self { items: OutArray::new(items, capacity, name)?, name, count: Out::new(count, "count")? })
    }

    /// Writes what fits.
    pub fn fill<'s, S: 's>(mut self, found: &'s [S]) -> Outcome
    where
        T: From<&'s S>,
    {
        self.count.set(found.len());
        for (index, item) in found.iter().take(self.items.len()).enumerate() {
            self.items.set(index, item.into());
        }
        too_small(self.name, self.items.len(), found.len())
    }
}

impl Inner {
    /// Tangents that may take differences. If a law fails at a state in between, the frame does not count any more: a law that
    /// is not pure may have failed in the last evaluation, which computes the frame again.
    fn tangents_with(
        &mut self,
        tangents: impl FnOnce(&mut World) -> Result<Vec<PairTangent>, EngineError>,
    ) -> Outcome<Vec<PairTangent>> {
        self.law_faults.check()?;
        let found = tangents(self.phase.frames_mut("get tangents")?);
        self.law_faults.collect();
        self.law_faults.check()?;
        Ok(found?)
    }
}

impl From<&PairTangent> for pong_tangent {
    fn from(tangent: &PairTangent) -> Self {
        Self {
            interfaces: tangent.groups.map(Into::into),
            stiffness: tangent.stiffness.map(|row| row.map(|block| by_rows(&block))),
            damping: tangent.damping.map(|row| row.map(|block| by_rows(&block))),
        }
    }
}

pub(crate) fn by_rows(matrix: &TangentMatrix) -> [f64; 36] {
    std::array::from_fn(|index| matrix[(index / 6, index % 6)])
}

impl From<Option<ContactTangent>> for pong_contact_tangent {
    fn from(tangent: Option<ContactTangent>) -> Self {
        let of = |number: fn(ContactTangent) -> f64| tangent.map_or(f64::NAN, number);
        Self {
            normal_stiffness: of(|tangent| tangent.normal.stiffness),
            normal_damping: of(|tangent| tangent.normal.damping),
            tangential_stiffness: of(|tangent| tangent.tangential.stiffness),
            tangential_damping: of(|tangent| tangent.tangential.damping),
        }
    }
}
