//! Bristle friction of up to eight contacts at once, from any pairs of movable groups.

use super::contact::FrameContact;
use crate::law::friction::{BristleForces, Bristles};
use pong_geometry::Vec3;
use pong_geometry::simd::{self, Kernel, LANES, LaneBits, Numbers, Simd, Vectors};

/// Vectors, one per lane, stored by coordinate.
type Lanes = [[f64; LANES]; 3];

/// Friction input of one contact. Vectors are in B's frame.
pub(super) struct Bristle {
    /// Unit normal.
    pub normal_b: Vec3,
    /// Deflection p, rotated into the current contact plane, m.
    pub carried_b: Vec3,
    /// Slip u since the last commit, m.
    pub slip_b: Vec3,
    /// Slip velocity v_t, m/s.
    pub slip_velocity_b: Vec3,
    /// Tangential stiffness K, N/m.
    pub stiffness: f64,
    /// Tangential damping c, N·s/m.
    pub damping: f64,
    /// μ_k·F_n, N.
    pub kinetic_limit: f64,
    /// μ_s·F_n, N.
    pub static_limit: f64,
    /// True if the bristle stuck at the last commit.
    pub stuck: bool,
}

/// Up to eight contacts whose friction is pending.
// Aligned, because eight f64 fill one cache line: a load from an unaligned array would touch two lines.
#[derive(Debug)]
#[repr(C, align(64))]
pub(super) struct PendingBristles {
    normal: Lanes,
    carried: Lanes,
    slip: Lanes,
    slip_velocity: Lanes,
    stiffness: [f64; LANES],
    damping: [f64; LANES],
    kinetic_limit: [f64; LANES],
    static_limit: [f64; LANES],
    count: usize,
    /// Indices of the contacts in their buffer.
    indices: [u32; LANES],
    stuck: LaneBits,
}

impl PendingBristles {
    pub fn new() -> Self {
        const NOTHING: Lanes = [[0.0; LANES]; 3];
        Self {
            count: 0,
            indices: [0; LANES],
            normal: NOTHING,
            carried: NOTHING,
            slip: NOTHING,
            slip_velocity: NOTHING,
            stiffness: [0.0; LANES],
            damping: [0.0; LANES],
            kinetic_limit: [0.0; LANES],
            static_limit: [0.0; LANES],
            stuck: 0,
        }
    }

    pub fn clear(&mut self) {
        self.count = 0;
    }

    pub fn is_full(&self) -> bool {
        self.count == LANES
    }

    /// Adds a contact; fewer than eight must be pending.
    #[inline(always)]
    pub fn add(&mut self, index: usize, one: &Bristle) {
        let lane = self.count;
        self.count += 1;
        self.indices[lane] = index as u32;
        put(&mut self.normal, lane, &one.normal_b);
        put(&mut self.carried, lane, &one.carried_b);
        put(&mut self.slip, lane, &one.slip_b);
        put(&mut self.slip_velocity, lane, &one.slip_velocity_b);
        self.stiffness[lane] = one.stiffness;
        self.damping[lane] = one.damping;
        self.kinetic_limit[lane] = one.kinetic_limit;
        self.static_limit[lane] = one.static_limit;
        self.stuck = self.stuck & !(1 << lane) | LaneBits::from(one.stuck) << lane;
    }

    /// Computes the friction of all pending contacts, which are then complete.
    #[inline]
    pub fn flush(&mut self, contacts: &mut [FrameContact]) {
        let count = std::mem::take(&mut self.count);
        if count > 0 {
            simd::run(ComputeFriction { bristles: self, count, contacts });
        }
    }
}

struct ComputeFriction<'a> {
    bristles: &'a PendingBristles,
    count: usize,
    contacts: &'a mut [FrameContact],
}

impl Kernel for ComputeFriction<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self { bristles: pending, count, contacts } = self;
        // Unused lanes hold earlier values or zeros; their results are not used.
        let forces = Bristles {
            stiffness: Numbers::load(simd, &pending.stiffness),
            damping: Numbers::load(simd, &pending.damping),
            kinetic_limit: Numbers::load(simd, &pending.kinetic_limit),
            static_limit: Numbers::load(simd, &pending.static_limit),
            normal: Vectors::load(simd, &pending.normal),
            carried: Vectors::load(simd, &pending.carried),
            slip: Vectors::load(simd, &pending.slip),
            slip_velocity: Vectors::load(simd, &pending.slip_velocity),
            stuck: pending.stuck | !(LaneBits::MAX >> (LANES - count)),
        }
        .evaluate(simd);
        let BristleForces { force, bristle, stored, sticks } = forces;
        let (force, bristle, stored) = (force.store(), bristle.store(), stored.store());
        for lane in 0..count {
            let contact = &mut contacts[pending.indices[lane] as usize];
            contact.friction_force_b = get(&force, lane);
            contact.bristle_b = get(&bristle, lane);
            contact.stored += stored[lane];
            contact.sticks = sticks >> lane & 1 == 1;
        }
    }
}

#[inline(always)]
fn get(lanes: &Lanes, lane: usize) -> Vec3 {
    Vec3::new(lanes[0][lane], lanes[1][lane], lanes[2][lane])
}

#[inline(always)]
fn put(lanes: &mut Lanes, lane: usize, v: &Vec3) {
    (lanes[0][lane], lanes[1][lane], lanes[2][lane]) = (v.x, v.y, v.z);
}
