//! The reset-integrator bristle in two dimensions, under a varying load: of eight contacts at a time.
//!
//! ```text
//! p_s = μ_s·F_n/K      p_k = μ_k·F_n/K      p* = carried p + u
//! sticking:  |p*| ≤ p_s keeps sticking, p = p*;              else breaks away, p on the circle p_k
//! slipping:  |p*| ≤ p_k, p = p*;                             else p on the circle p_k
//!            sticks again where p*·v_t < 0 or |p*| < p_k, as soon as |K·p + c·v_t| ≤ μ_k·F_n
//! F_t = −cut(K·p + c·v_t), its length cut to μ_s·F_n while sticking, to μ_k·F_n in every other step
//! ```
//!
//! D. A. Haessig and B. Friedland, "On the modeling and simulation of friction", J. Dyn. Sys. Meas. Control 113
//! (1991), extended to the plane. Where the bristle stands on the circle p_k is told by `slip_path.rs`.
//!
//! Only the limits follow the load, never K: a bristle whose stiffness followed it would make energy. One force law
//! serves sticking and slipping, and what sticks again is held by the kinetic limit until its force has come inside it.
//! So the force is a continuous function of p, v_t and F_n, and steps at break-away alone: a contact that stands on its
//! limit has the same force whichever side of it rounding takes (theory manual, section 4).
//!
//! Products with K stand for the lengths p_s and p_k, so that K = 0 needs no case of its own.

use super::slip_path::SlipPath;
use pong_geometry::Vec3;
use pong_geometry::simd::{LaneBits, Numbers, Simd, Vectors};

/// What rounding may do to a force that stands on its limit, as a part of the limit: a carried bristle and the product
/// with K are off by a few times 1e-16. Friction may exceed its limit by no more than this.
const LIMIT_ROUNDING: f64 = 1e-13;

/// The bristles of eight contacts, and what has happened to them. A lane of zeros that sticks is one without friction.
pub(crate) struct Bristles<S: Simd> {
    /// K, N/m.
    pub stiffness: Numbers<S>,
    /// c, N·s/m.
    pub damping: Numbers<S>,
    /// μ_k·F_n, N.
    pub kinetic_limit: Numbers<S>,
    /// μ_s·F_n, N.
    pub static_limit: Numbers<S>,
    /// Unit normals; these and the vectors below are in the frame of B's movable group.
    pub normal: Vectors<S>,
    /// Deflections carried into the present contact planes, m.
    pub carried: Vectors<S>,
    /// u, m.
    pub slip: Vectors<S>,
    /// v_t, m/s.
    pub slip_velocity: Vectors<S>,
    /// Which of them stuck at the last commit.
    pub stuck: LaneBits,
}

/// What they do.
pub(crate) struct BristleForces<S: Simd> {
    /// On A, N.
    pub force: Vectors<S>,
    /// p, m.
    pub bristle: Vectors<S>,
    /// In the bristles, J.
    pub stored: Numbers<S>,
    /// Which of them stick.
    pub sticks: LaneBits,
}

impl<S: Simd> Bristles<S> {
    #[inline(always)]
    pub fn evaluate(&self, simd: S) -> BristleForces<S> {
        let Self { stiffness, static_limit, kinetic_limit, slip_velocity, stuck, .. } = *self;
        let trial = self.carried + self.slip;
        let pull = stiffness * trial.norm();
        let slack = Numbers::splat(simd, 1.0 + LIMIT_ROUNDING);
        let holds = stuck & simd.bits((static_limit * slack).at_least(pull));
        let over = !holds & (stuck | !simd.bits(kinetic_limit.at_least(pull)));
        let is_held = simd.mask(holds);
        let mut bristle = Vectors::select(is_held, shortened_each(trial, pull, static_limit), trial);
        if over != 0 {
            let is_over = simd.mask(over);
            bristle = Vectors::select(is_over, self.path(simd).end(simd), bristle);
        }
        let limit = Numbers::select(is_held, static_limit, kinetic_limit);
        let pushed = bristle * stiffness + slip_velocity * self.damping;
        let length = pushed.norm();
        // What slipped sticks again: its motion has turned back or no longer fills the circle, and the static limit would
        // leave its force as it is.
        let turned_back = simd.bits(trial.dot(slip_velocity).below(Numbers::splat(simd, 0.0)));
        let within = simd.bits(pull.below(kinetic_limit * Numbers::splat(simd, 1.0 - LIMIT_ROUNDING)));
        let again = (turned_back | within) & simd.bits((kinetic_limit * slack).at_least(length));
        BristleForces {
            force: -shortened_each(pushed, length, limit),
            bristle,
            stored: Numbers::splat(simd, 0.5) * stiffness * bristle.norm_squared(),
            sticks: holds | (!stuck & again),
        }
    }

    /// The paths of those that have come over their limits; of the others, something that can be worked out.
    #[inline(always)]
    fn path(&self, simd: S) -> SlipPath<S> {
        let left_at = Numbers::select(simd.mask(self.stuck), self.static_limit, self.kinetic_limit);
        SlipPath {
            normal: self.normal,
            carried: self.carried,
            slip: self.slip,
            slip_velocity: self.slip_velocity,
            left_at: self.deflection_at(left_at),
            radius: self.deflection_at(self.kinetic_limit),
        }
    }

    /// The deflection at which the bristle pulls so much, m.
    #[inline(always)]
    fn deflection_at(&self, pull: Numbers<S>) -> Numbers<S> {
        /// Far more than any that has come over its limit, whose square is still a number.
        const FARTHEST_M: f64 = 1e120;
        pull.over(self.stiffness.larger(pull * pull.all(1.0 / FARTHEST_M)))
    }
}

/// A vector of the given length, shortened to at most `limit`.
///
/// The quotient is 1, exactly, where nothing is cut, and is computed in any case: behind a branch a compiler may compute it
/// before the branch, and then nothing over nothing would be an invalid operation.
#[inline(always)]
pub(crate) fn shortened(vector: Vec3, length: f64, limit: f64) -> Vec3 {
    let longer = if length > limit { length } else { limit };
    vector * (limit / longer.max(f64::MIN_POSITIVE))
}

/// The same of eight.
#[inline(always)]
fn shortened_each<S: Simd>(vectors: Vectors<S>, length: Numbers<S>, limit: Numbers<S>) -> Vectors<S> {
    vectors * limit.over(length.larger(limit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pong_geometry::simd::{LANES, Portable};
    use pong_testkit::Random;

    /// Eight vectors in the plane across z, of lengths up to `size`.
    fn in_plane(random: &mut Random, size: f64) -> Vectors<Portable> {
        let mut coordinates = [[0.0; LANES]; 3];
        for axis in &mut coordinates[..2] {
            axis.iter_mut().for_each(|x| *x = random.between(-size, size));
        }
        Vectors::load(Portable, &coordinates)
    }

    /// It is asked for once more where it then is: what sticks again is held by the static limit from then on, and that may
    /// not change its force.
    #[test]
    fn what_sticks_again_has_the_same_force_as_what_sticks() {
        let mut random = Random::new(3, 0, 0);
        let number = |value| Numbers::splat(Portable, value);
        let mut stick_again = 0;
        for _ in 0..4000 {
            let slipping = Bristles {
                stiffness: number(1e4),
                damping: number(random.between(0.0, 200.0)),
                kinetic_limit: number(4.0),
                static_limit: number(6.0),
                normal: Vectors::splat(Portable, &Vec3::z()),
                carried: in_plane(&mut random, 4e-4),
                slip: in_plane(&mut random, 4e-4),
                slip_velocity: in_plane(&mut random, 0.05),
                stuck: 0,
            };
            let now = slipping.evaluate(Portable);
            let nothing = Vectors::splat(Portable, &Vec3::zeros());
            let stuck = Bristles { carried: now.bristle, slip: nothing, stuck: LaneBits::MAX, ..slipping };
            let change = (stuck.evaluate(Portable).force - now.force).norm().store();
            for lane in (0..LANES).filter(|&lane| now.sticks >> lane & 1 == 1) {
                stick_again += 1;
                assert!(change[lane] <= 1e-12 * 4.0, "{} N", change[lane]);
            }
        }
        assert!(stick_again > 1000, "{stick_again}");
    }
}
