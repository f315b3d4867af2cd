//! Sums the wrenches of all contacts in key order, for each movable group in its own frame and about its own
//! origin.
//!
//! The rounding error of one addition grows with the sum; after thousands of contacts it would exceed 1e-12
//! of the largest force. Therefore blocks of [`PART`] contacts are summed first, and then the block sums
//! (docs/theory.md, 5).

use crate::energy::LedgerEntry;
use crate::frame::forces::contact_ref::ContactRef;
use crate::frame::forces::found::FoundContacts;
use crate::frame::input::WorkerInput;
use crate::frame::input::relative::Motions;
use crate::frame::output::order::OrderedContacts;
use crate::seal::{Direction, Sealed};
use pong_geometry::{Transform, Vec3, Wrench};

/// Adds every contact to the wrenches of both of its movable groups. Contacts of one direction are summed
/// together in B's axes first. Returns the first direction with a contact whose values are beyond the range
/// of f64 or close to it, if any.
#[inline]
pub(crate) fn sum(
    motions: &Motions<'_>,
    input: &WorkerInput,
    contacts: OrderedContacts<'_>,
    wrenches: &mut [Wrench],
) -> Option<Direction> {
    let mut beyond_range = None;
    for refs in contacts.order.chunk_by(|a, b| a.direction() == b.direction()) {
        let direction = refs[0].direction();
        let x_ba = motions.known(input, direction).x_ba;
        let sums = Sums::of_direction(&contacts.found, refs, &x_ba.translation);
        if !sums.in_range {
            beyond_range.get_or_insert(direction);
        }
        let (body_a, body_b) = motions.sealed.bodies_of(direction);
        wrenches[body_a] += sums.on_a(&x_ba);
        wrenches[body_b] += sums.on_b();
    }
    beyond_range
}

/// References per block sum, including contacts that do not push.
const PART: usize = 64;

/// Sums over the contacts of one direction, in B's axes.
pub(super) struct Sums {
    /// Force on A, N.
    force: Vec3,
    /// Moment on A about A's origin, N·m.
    about_a: Vec3,
    /// Moment on A about B's origin, N·m.
    about_b: Vec3,
    /// True if all values are far from overflow.
    in_range: bool,
}

impl Sums {
    fn of_nothing() -> Self {
        Self { force: Vec3::zeros(), about_a: Vec3::zeros(), about_b: Vec3::zeros(), in_range: true }
    }

    /// Sums over all contacts of a direction, part by part; `origin_a` is A's origin in B's frame, m.
    #[inline]
    pub fn of_direction(found: &FoundContacts<'_>, refs: &[ContactRef], origin_a: &Vec3) -> Self {
        let mut sums = Self::of_nothing();
        for part in refs.chunks(PART) {
            sums.add(&Self::of(found, part, origin_a));
        }
        sums
    }

    /// Sums over some contacts; `origin_a` is A's origin in B's frame, m.
    #[inline]
    fn of(found: &FoundContacts<'_>, refs: &[ContactRef], origin_a: &Vec3) -> Self {
        let mut sums = Self::of_nothing();
        for reference in refs.iter().filter(|reference| reference.pushes()) {
            let contact = found.contact(reference);
            let (force_b, point_b) = (&contact.force(), &contact.point_b);
            sums.force += force_b;
            sums.about_a += (point_b - origin_a).cross(force_b);
            sums.about_b += point_b.cross(force_b);
            sums.in_range &= holds(contact.size());
        }
        sums
    }

    /// Adds the sums of further contacts.
    #[inline]
    fn add(&mut self, more: &Self) {
        self.force += more.force;
        self.about_a += more.about_a;
        self.about_b += more.about_b;
        self.in_range &= more.in_range;
    }

    /// Wrench on A, about A's origin in A's axes.
    pub fn on_a(&self, x_ba: &Transform) -> Wrench {
        Wrench { force: x_ba.rotation.tr_mul(&self.force), moment: x_ba.rotation.tr_mul(&self.about_a) }
    }

    /// Wrench on B, about B's origin in B's axes.
    pub fn on_b(&self) -> Wrench {
        Wrench { force: -self.force, moment: -self.about_b }
    }
}

/// Bound that leaves room for a rotation into other axes without overflow.
const LARGEST: f64 = f64::MAX / 16.0;

/// Returns true if a sum is within the bound; false for NaN.
fn holds(sum: f64) -> bool {
    sum <= LARGEST
}

/// Returns a movable group to name in an error, if its wrench, a contact of its (`beyond_range`, from
/// [`sum`]) or the ledger is beyond the range of f64 or close to it. Sums and products of finite values can
/// be.
#[inline]
pub(crate) fn overflow(
    sealed: &Sealed,
    wrenches: &[Wrench],
    beyond_range: Option<Direction>,
    ledger: &LedgerEntry,
) -> Option<usize> {
    let of_wrench = |wrench: &Wrench| wrench.force.abs().sum() + wrench.moment.abs().sum();
    // Groups without pairs have no wrench.
    let mut bodies = sealed.paired_bodies.iter().copied();
    let body = bodies.find(|&body| !holds(of_wrench(&wrenches[body])));
    body.or_else(|| {
        let beyond_ledger = !holds(ledger.work.abs() + ledger.dissipated.abs());
        // The ledger belongs to no group, so the first is named.
        beyond_range.map(|direction| sealed.bodies_of(direction).0).or(beyond_ledger.then_some(0))
    })
}
