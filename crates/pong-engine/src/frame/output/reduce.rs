//! Sums the wrenches of all contacts, in key order, about and along each movable group's own frame.
//!
//! What one addition rounds off grows with the sum: after thousands of contacts it would be more than 1e-12 of the largest of
//! them. So [`PART`] contacts are added to each other, and then the sums over so many (docs/theory.md, 5).

use crate::frame::buffers::EvaluationBuffers;
use crate::frame::forces::found::FoundContacts;
use crate::frame::forces::place::Place;
use crate::frame::forces::term::Term;
use crate::frame::input::EvaluationInput;
use crate::frame::input::relative::Motions;
use crate::sealed::Sealed;
use pong_geometry::{Transform, Vec3, Wrench};

/// Adds every contact to both of its movable groups: first those of one direction of a pair together, in B's axes.
#[inline]
pub(crate) fn sum(given: &EvaluationInput<'_>, frame: &mut EvaluationBuffers) {
    let EvaluationInput { sealed, memory, .. } = *given;
    let EvaluationBuffers {
        input, caller, workers, order, near, poses, twists, wrenches, beyond_range, ..
    } = frame;
    let motions = Motions { sealed, poses, twists, committed: &memory.poses };
    let found = FoundContacts { caller: &caller.out, workers };
    for places in order.chunk_by(|a, b| a.direction() == b.direction()) {
        let direction = places[0].direction();
        let x_ba = motions.known(near, input, direction).x_ba;
        let mut sums = Sums::of_nothing();
        for part in places.chunks(PART) {
            sums.add(&Sums::of(&found, part, &x_ba.translation));
        }
        if !sums.in_range {
            beyond_range.get_or_insert(direction);
        }
        let (body_a, body_b) = sealed.bodies_of(direction);
        wrenches[body_a] += sums.on_a(&x_ba);
        wrenches[body_b] += sums.on_b();
    }
}

/// The contacts of so many places, some of which may only be remembered, are added before their sum is.
const PART: usize = 64;

/// Sums over contacts of one direction, along B's axes.
struct Sums {
    /// On A, N.
    force: Vec3,
    /// On A about A's origin, N·m.
    about_a: Vec3,
    /// On A about B's origin, N·m.
    about_b: Vec3,
    /// Whether the numbers of each contact are well within the range of numbers.
    in_range: bool,
}

impl Sums {
    fn of_nothing() -> Self {
        Self { force: Vec3::zeros(), about_a: Vec3::zeros(), about_b: Vec3::zeros(), in_range: true }
    }

    /// Over some contacts, with A's origin in B's frame, m.
    #[inline]
    fn of(found: &FoundContacts<'_>, places: &[Place], origin_a: &Vec3) -> Self {
        let mut sums = Self::of_nothing();
        for place in places.iter().filter(|place| place.pushes()) {
            let Term { force_b, point_b, size } = &found.term(place);
            sums.force += force_b;
            sums.about_a += (point_b - origin_a).cross(force_b);
            sums.about_b += point_b.cross(force_b);
            sums.in_range &= holds(*size);
        }
        sums
    }

    /// The sums over more contacts.
    #[inline]
    fn add(&mut self, more: &Self) {
        self.force += more.force;
        self.about_a += more.about_a;
        self.about_b += more.about_b;
        self.in_range &= more.in_range;
    }

    /// The wrench on A, about and along A's frame.
    fn on_a(&self, x_ba: &Transform) -> Wrench {
        Wrench { force: x_ba.rotation.tr_mul(&self.force), moment: x_ba.rotation.tr_mul(&self.about_a) }
    }

    /// The wrench on B, about and along B's frame.
    fn on_b(&self) -> Wrench {
        Wrench { force: -self.force, moment: -self.about_b }
    }
}

/// What the turn to the axes of another frame must not carry out of the range of numbers.
const LARGEST: f64 = f64::MAX / 16.0;

/// False for what is not a number, too.
fn holds(sum: f64) -> bool {
    sum <= LARGEST
}

impl EvaluationBuffers {
    /// A movable group whose numbers have left the range of numbers, if any: a product or sum of finite ones can.
    #[inline]
    pub fn overflows(&self, sealed: &Sealed) -> Option<usize> {
        let of_wrench = |wrench: &Wrench| wrench.force.abs().sum() + wrench.moment.abs().sum();
        // Those that meet nobody have no wrench.
        let mut bodies = sealed.paired_bodies.iter().copied();
        let body = bodies.find(|&body| !holds(of_wrench(&self.wrenches[body])));
        body.or_else(|| {
            let ledger = !holds(self.energy.work.abs() + self.energy.dissipated.abs());
            // Energies are nobody's: the first group stands for all.
            self.beyond_range.map(|direction| sealed.bodies_of(direction).0).or(ledger.then_some(0))
        })
    }
}
