//! The forces of up to eight contacts of one direction at a time.

use super::contact::FrameContact;
use super::contact_buffer::ContactBuffer;
use super::friction::Friction;
use crate::frame::input::PairContext;
use crate::frame::input::motion::Motion;
use crate::law::{PairProps, normal_force, stored_energy};
use crate::state::ContactRole;
use pong_geometry::simd::{Kernel, LANES, Numbers, Simd, Vectors};
use pong_geometry::{Vec3, Wrench};

/// So many numbers, one for each lane.
pub(super) type Lanes<const N: usize> = [[f64; LANES]; N];

/// Works out the forces of `count` contacts of a buffer, which are all of one direction.
pub(super) struct Forces<'a, I> {
    pub context: &'a PairContext<'a>,
    pub out: &'a mut ContactBuffer,
    pub count: usize,
    /// Where in the buffer each stands.
    pub index: I,
}

impl<I: Fn(usize) -> usize> Kernel for Forces<'_, I> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self { context, out, count, index } = self;
        for first in (0..count).step_by(LANES) {
            let mut places = [0; LANES];
            let used = LANES.min(count - first);
            for (lane, place) in places.iter_mut().enumerate() {
                // Lanes to spare do what the last one does.
                *place = index(first + lane.min(used - 1));
            }
            Eight::new(context, out, &places, used).settle(simd, context, out);
        }
    }
}

/// Up to eight contacts.
pub(super) struct Eight<'a> {
    /// Where in the buffer they stand; in spare lanes the last one once more.
    pub places: &'a [usize; LANES],
    pub used: usize,
    pub props: [&'a PairProps; LANES],
    /// The committed record that each continues.
    pub continues: [Option<usize>; LANES],
    pub normal: Lanes<3>,
    deepest: Lanes<3>,
    /// From the deepest place of A to the contact point, m.
    lead: [f64; LANES],
}

/// What moves how where they touch, in B's frame.
#[derive(Clone, Copy)]
pub(super) struct Touch<S: Simd> {
    pub normal: Vectors<S>,
    /// c, m.
    pub point: Vectors<S>,
    /// δ', m/s.
    pub closing: Numbers<S>,
    /// v_t, m/s.
    pub slip_velocity: Vectors<S>,
}

/// What the normal laws say.
pub(super) struct Pressed {
    /// N.
    pub force: [f64; LANES],
    /// In the springs, J.
    pub stored: [f64; LANES],
}

impl<'a> Eight<'a> {
    #[inline(always)]
    fn new(
        context: &'a PairContext<'a>,
        out: &ContactBuffer,
        places: &'a [usize; LANES],
        used: usize,
    ) -> Self {
        let mut eight = Self {
            places,
            used,
            props: [context.props(&out.contacts[places[0]].found); LANES],
            continues: [None; LANES],
            normal: [[0.0; LANES]; 3],
            deepest: [[0.0; LANES]; 3],
            lead: [0.0; LANES],
        };
        for lane in 0..LANES {
            let found = &out.contacts[places[lane]].found;
            let props = context.props(found);
            eight.props[lane] = props;
            put(&mut eight.normal, lane, &found.normal_b);
            put(&mut eight.deepest, lane, &found.deepest_b);
            eight.lead[lane] = props.share_a * found.depth;
            if lane < used {
                eight.continues[lane] =
                    context.memory.matching(&found.key, &found.normal_b, ContactRole::Active);
            }
        }
        eight
    }

    /// Fills in all of the contacts but what was found.
    #[inline(always)]
    fn settle<S: Simd>(&self, simd: S, context: &PairContext<'_>, out: &mut ContactBuffer) {
        let touch = self.touch(simd, context.motion);
        let pressed = self.pressed(out, &touch.closing.store());
        let friction = Friction::of(simd, context, self, &touch, &pressed, out);
        let normal_force = touch.normal * Numbers::load(simd, &pressed.force);
        let force = normal_force + Vectors::load(simd, &friction.force);
        let wrenches = Wrenches::new(simd, context.motion, force, touch.point);
        let (point, closing, velocity) =
            (touch.point.store(), touch.closing.store(), touch.slip_velocity.store());
        for lane in 0..self.used {
            // Whoever gives a contact one more field is told here.
            let FrameContact {
                found,
                bristle_share: _,
                point_b,
                rate,
                normal_force,
                friction_force_b,
                slip_velocity_b,
                bristle_b,
                wrenches: of_force,
                stored,
                sticks,
                continues,
                work,
                dissipated,
            } = &mut out.contacts[self.places[lane]];
            (*point_b, *rate, *normal_force) = (get(&point, lane), closing[lane], pressed.force[lane]);
            (*friction_force_b, *slip_velocity_b) = (get(&friction.force, lane), get(&velocity, lane));
            (*bristle_b, *sticks) = (get(&friction.bristle, lane), friction.sticks >> lane & 1 == 1);
            *of_force = match found.role {
                ContactRole::Active => wrenches.of(lane),
                _ => [Wrench::zero(); 2],
            };
            *stored = pressed.stored[lane] + friction.stored[lane];
            *continues = self.continues[lane].map(|record| record as u32);
            (*work, *dissipated) = (0.0, 0.0);
        }
    }

    #[inline(always)]
    fn touch<S: Simd>(&self, simd: S, motion: &Motion) -> Touch<S> {
        let normal = Vectors::load(simd, &self.normal);
        let point = Vectors::load(simd, &self.deepest) + normal * Numbers::load(simd, &self.lead);
        let arm_a = point - Vectors::splat(simd, &motion.x_ba.translation);
        let of_turn_a = Vectors::splat(simd, &motion.omega_a_b).cross(arm_a);
        let of_turn_b = Vectors::splat(simd, &motion.omega_b_b).cross(point);
        let velocity = Vectors::splat(simd, &motion.linear_b) + of_turn_a - of_turn_b;
        let closing = -normal.dot(velocity);
        Touch { normal, point, closing, slip_velocity: velocity + normal * closing }
    }

    /// The normal laws one by one: they are short, and some are the host's.
    #[inline(always)]
    fn pressed(&self, out: &ContactBuffer, closing: &[f64; LANES]) -> Pressed {
        let mut pressed = Pressed { force: [0.0; LANES], stored: [0.0; LANES] };
        for lane in 0..self.used {
            let found = &out.contacts[self.places[lane]].found;
            if found.role == ContactRole::Active {
                let (props, weight) = (self.props[lane], found.full_weight());
                pressed.force[lane] = normal_force(props, weight, found.depth, closing[lane]);
                pressed.stored[lane] = stored_energy(props, weight, found.depth);
            }
        }
        pressed
    }
}

/// What forces at points are to the movable groups.
struct Wrenches {
    /// On A, about and along A's frame.
    force_a: Lanes<3>,
    moment_a: Lanes<3>,
    /// On B, about and along B's frame.
    force_b: Lanes<3>,
    moment_b: Lanes<3>,
}

impl Wrenches {
    /// Of forces on A; all in B's frame.
    #[inline(always)]
    fn new<S: Simd>(simd: S, motion: &Motion, force_b: Vectors<S>, point_b: Vectors<S>) -> Self {
        let into_a = motion.x_ba.rotation.transpose();
        let force_a = force_b.turned(&into_a);
        let arm_a = (point_b - Vectors::splat(simd, &motion.x_ba.translation)).turned(&into_a);
        Self {
            force_a: force_a.store(),
            moment_a: arm_a.cross(force_a).store(),
            force_b: (-force_b).store(),
            moment_b: force_b.cross(point_b).store(),
        }
    }

    #[inline(always)]
    fn of(&self, lane: usize) -> [Wrench; 2] {
        [
            Wrench { force: get(&self.force_a, lane), moment: get(&self.moment_a, lane) },
            Wrench { force: get(&self.force_b, lane), moment: get(&self.moment_b, lane) },
        ]
    }
}

/// The vector of one lane.
#[inline(always)]
pub(super) fn get(lanes: &Lanes<3>, lane: usize) -> Vec3 {
    Vec3::new(lanes[0][lane], lanes[1][lane], lanes[2][lane])
}

/// Sets it.
#[inline(always)]
pub(super) fn put(lanes: &mut Lanes<3>, lane: usize, v: &Vec3) {
    (lanes[0][lane], lanes[1][lane], lanes[2][lane]) = (v.x, v.y, v.z);
}
