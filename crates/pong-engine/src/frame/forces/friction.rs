//! The friction of up to eight contacts: what has moved since the last commit, and the laws.

use super::contact_buffer::ContactBuffer;
use super::eight::{Eight, Lanes, Pressed, Touch, get, put};
use super::reference_point::reference_point;
use crate::frame::input::PairContext;
use crate::frame::input::motion::SinceCommit;
use crate::law::FrictionProps;
use crate::law::friction::{Bristles, FrictionInput, FrictionOutput, friction_alone, shortened_each};
use pong_geometry::Vec3;
use pong_geometry::simd::{LANES, LaneBits, Numbers, Simd, Vectors};
use pong_model::box_tree::lanes;

/// What friction does to eight contacts. Vectors are in B's frame.
pub(super) struct Friction {
    /// On A, N.
    pub force: Lanes<3>,
    /// p, m.
    pub bristle: Lanes<3>,
    /// J.
    pub stored: [f64; LANES],
    pub sticks: LaneBits,
}

/// The values of the bristles, one for each lane; zero where there is none.
#[derive(Default)]
struct BristleValues {
    stiffness: [f64; LANES],
    damping: [f64; LANES],
    kinetic_limit: [f64; LANES],
    static_limit: [f64; LANES],
    /// Lanes that have friction.
    asked: LaneBits,
    /// Those whose laws ask for the displacement.
    slides: LaneBits,
    /// Those whose laws are worked out one by one.
    alone: LaneBits,
}

/// What laws that are worked out one by one are told of the time before.
struct Past {
    carried: Lanes<3>,
    slip: Lanes<3>,
}

impl Past {
    const NONE: Self = Self { carried: [[0.0; LANES]; 3], slip: [[0.0; LANES]; 3] };
}

/// What was committed, one for each lane: of a contact that is born, an unstrained bristle.
struct Earlier {
    normal: Lanes<3>,
    bristle: Lanes<3>,
    point: Lanes<3>,
    lasts: LaneBits,
    stuck: LaneBits,
}

impl Friction {
    /// No friction of contacts that stick, as those do that nothing presses.
    const NONE: Self =
        Self { force: [[0.0; LANES]; 3], bristle: [[0.0; LANES]; 3], stored: [0.0; LANES], sticks: LaneBits::MAX };

    #[inline(always)]
    pub fn of<S: Simd>(
        simd: S,
        context: &PairContext<'_>,
        eight: &Eight<'_>,
        touch: &Touch<S>,
        pressed: &Pressed,
        out: &mut ContactBuffer,
    ) -> Self {
        let values = BristleValues::new(eight, pressed, out);
        let mut friction = Self::NONE;
        if values.asked != 0 {
            continue_law_states(context, eight, values.asked, out);
        }
        let mut past = Past::NONE;
        if values.slides != 0 {
            let bristles = values.bristles(simd, context, eight, touch, out);
            let forces = bristles.evaluate(simd);
            friction = Self {
                force: forces.force.store(),
                bristle: forces.bristle.store(),
                stored: forces.stored.store(),
                sticks: forces.sticks,
            };
            if values.alone != 0 {
                past = Past { carried: bristles.carried.store(), slip: bristles.slip.store() };
            }
        }
        if values.alone != 0 {
            friction.ask_each(values.alone, context, eight, (&touch.slip_velocity.store(), pressed, &past), out);
        }
        friction
    }

    /// The laws that are worked out one by one.
    fn ask_each(
        &mut self,
        which: LaneBits,
        context: &PairContext<'_>,
        eight: &Eight<'_>,
        (velocity, pressed, past): (&Lanes<3>, &Pressed, &Past),
        out: &mut ContactBuffer,
    ) {
        for lane in lanes(which) {
            let input = FrictionInput {
                normal_force: pressed.force[lane],
                normal_b: get(&eight.normal, lane),
                slip_b: get(&past.slip, lane),
                slip_velocity_b: get(velocity, lane),
                share: out.contacts[eight.places[lane]].bristle_share,
                stiffness: 0.0,
                carried_b: get(&past.carried, lane),
                stuck: eight.continues[lane].is_none_or(|record| context.memory.records[record].sticks),
                parameters: &[],
            };
            let state = out.law_state_mut(eight.places[lane]);
            if let Some(output) = friction_alone(&eight.props[lane].friction, &input, state) {
                self.set(lane, &output);
            }
        }
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, output: &FrictionOutput) {
        put(&mut self.force, lane, &output.force_b);
        put(&mut self.bristle, lane, &output.bristle_b);
        self.stored[lane] = output.stored;
        self.sticks = self.sticks & !(1 << lane) | LaneBits::from(output.sticks) << lane;
    }
}

impl BristleValues {
    #[inline(always)]
    fn new(eight: &Eight<'_>, pressed: &Pressed, out: &ContactBuffer) -> Self {
        let mut values = Self::default();
        for lane in 0..eight.used {
            let normal_force = pressed.force[lane];
            if normal_force <= 0.0 {
                continue;
            }
            let bit = 1 << lane;
            values.asked |= bit;
            match &eight.props[lane].friction {
                FrictionProps::Bristle { stiffness, damping, mu_kinetic, mu_static } => {
                    let share = out.contacts[eight.places[lane]].bristle_share;
                    values.stiffness[lane] = share * stiffness;
                    values.damping[lane] = share * damping;
                    values.kinetic_limit[lane] = mu_kinetic * normal_force;
                    values.static_limit[lane] = mu_static * normal_force;
                    values.slides |= bit;
                }
                FrictionProps::Custom { .. } => {
                    values.slides |= bit;
                    values.alone |= bit;
                }
                // Coulomb's law asks for the velocity alone.
                FrictionProps::Coulomb { .. } => values.alone |= bit,
                FrictionProps::None => {
                    values.alone |= bit;
                    values.asked &= !bit;
                }
            }
        }
        values
    }

    #[inline(always)]
    fn bristles<S: Simd>(
        &self,
        simd: S,
        context: &PairContext<'_>,
        eight: &Eight<'_>,
        touch: &Touch<S>,
        out: &ContactBuffer,
    ) -> Bristles<S> {
        let earlier = Earlier::new(context, eight);
        Bristles {
            stiffness: Numbers::load(simd, &self.stiffness),
            damping: Numbers::load(simd, &self.damping),
            kinetic_limit: Numbers::load(simd, &self.kinetic_limit),
            static_limit: Numbers::load(simd, &self.static_limit),
            normal: touch.normal,
            carried: earlier.carried(simd, touch.normal),
            slip: match &context.motion.since_commit {
                Some(since) => displacement(simd, (context, since), eight, touch, &earlier, out),
                None => Vectors::splat(simd, &Vec3::zeros()),
            },
            slip_velocity: touch.slip_velocity,
            // What has no bristle is one without limits and stiffness that sticks, whatever it did.
            stuck: earlier.stuck | !self.slides | self.alone,
        }
    }
}

/// Registered laws go on from what was committed.
#[inline(always)]
fn continue_law_states(
    context: &PairContext<'_>,
    eight: &Eight<'_>,
    asked: LaneBits,
    out: &mut ContactBuffer,
) {
    if out.law_state_len == 0 {
        return;
    }
    for lane in 0..eight.used {
        let state = out.law_state_mut(eight.places[lane]);
        match eight.continues[lane] {
            Some(record) if asked >> lane & 1 == 1 => {
                state.copy_from_slice(context.memory.law_state_of(record));
            }
            _ => state.fill(0.0),
        }
    }
}

impl Earlier {
    #[inline(always)]
    fn new(context: &PairContext<'_>, eight: &Eight<'_>) -> Self {
        let mut earlier = Self {
            normal: eight.normal,
            bristle: [[0.0; LANES]; 3],
            point: [[0.0; LANES]; 3],
            lasts: 0,
            stuck: LaneBits::MAX,
        };
        for lane in 0..eight.used {
            let Some(record) = eight.continues[lane] else { continue };
            let record = &context.memory.records[record];
            put(&mut earlier.normal, lane, &record.normal_b);
            put(&mut earlier.bristle, lane, &record.bristle_b);
            put(&mut earlier.point, lane, &record.point_b);
            earlier.lasts |= 1 << lane;
            if !record.sticks {
                earlier.stuck &= !(1 << lane);
            }
        }
        earlier
    }

    /// The bristles across `to`: carried by the smallest rotations that take the normals there. Opposite normals have none, and
    /// never continue each other.
    #[inline(always)]
    fn carried<S: Simd>(&self, simd: S, to: Vectors<S>) -> Vectors<S> {
        let (from, bristle) = (Vectors::load(simd, &self.normal), Vectors::load(simd, &self.bristle));
        let cosine = from.dot(to);
        let axis = from.cross(to);
        let along = axis.dot(bristle).over(cosine + cosine.all(1.0));
        bristle * cosine + axis.cross(bristle) + axis * along
    }
}

/// u, in the present contact planes: the displacement of A since the last commit where it touches,
///
/// ```text
/// Δo + φ × ½[(c₀ − o₀) + (c₁ − o₁)]
/// ```
///
/// with the mean of the levers then and now: the lever of the start alone lets a ball that rolls and spins slip by the
/// spin times the way that its contact has moved. A contact that is born has only the present lever, and of its
/// displacement the part since the touch, as if the approach Δn had been even.
#[inline(always)]
fn displacement<S: Simd>(
    simd: S,
    (context, since): (&PairContext<'_>, &SinceCommit),
    eight: &Eight<'_>,
    touch: &Touch<S>,
    earlier: &Earlier,
    out: &ContactBuffer,
) -> Vectors<S> {
    let mut reference = [[0.0; LANES]; 3];
    let mut depth = [0.0; LANES];
    for lane in 0..eight.used {
        let found = &out.contacts[eight.places[lane]].found;
        depth[lane] = found.depth;
        put(&mut reference, lane, &reference_point(context.body_a, &found.key, found.element_a));
    }
    let reference = Vectors::load(simd, &reference);
    let before = reference.carried(simd, &since.x_ba);
    let now = reference.carried(simd, &context.motion.x_ba);
    let present = touch.point - now;
    let mean = (Vectors::load(simd, &earlier.point) - before + present) * Numbers::splat(simd, 0.5);
    let lasts = simd.mask(earlier.lasts);
    let lever = Vectors::select(lasts, mean, present);
    let rotation = Vectors::splat(simd, &context.rotation(since));
    let displacement = now - before + rotation.cross(lever);
    let approach = -touch.normal.dot(displacement);
    let across = displacement + touch.normal * approach;
    Vectors::select(lasts, across, shortened_each(across, approach, Numbers::load(simd, &depth)))
}

impl PairContext<'_> {
    /// φ, worked out once for all contacts of the pair.
    fn rotation(&self, since: &SinceCommit) -> Vec3 {
        self.rotation_b.get().unwrap_or_else(|| {
            let rotation = since.rotation();
            self.rotation_b.set(Some(rotation));
            rotation
        })
    }
}
