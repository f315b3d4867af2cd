//! Reset-integrator bristle in two dimensions, under a varying load, for eight contacts at a time.
//!
//! ```text
//! p_s = μ_s·F_n/K      p_k = μ_k·F_n/K      p* = carried p + u
//! sticking:  |p*| ≤ p_s keeps sticking, p = p*;              else breaks away, p on the circle p_k
//! slipping:  |p*| ≤ p_k, p = p*;                             else p on the circle p_k
//!            sticks again where p*·v_t < 0 or |p*| < p_k, as soon as |K·p + c·v_t| ≤ μ_k·F_n
//! F_t = −cut(K·p + c·v_t), its length cut to μ_s·F_n while sticking, to μ_k·F_n in every other step
//! ```
//!
//! Here p is the deflection (carried p: rotated into the current contact plane), u the slip since the last
//! commit, v_t the slip velocity, F_n the normal force, K the tangential stiffness and c the tangential
//! damping.
//!
//! D. A. Haessig and B. Friedland, "On the modeling and simulation of friction", J. Dyn. Sys. Meas. Control
//! 113 (1991), extended to the plane. `slip_path.rs` computes the point on the circle p_k.
//!
//! Only the limits follow the load, never K: a bristle whose stiffness followed the load would create energy.
//! Sticking and slipping use the same force law, and a contact that sticks again keeps the kinetic limit
//! until its force is below it. The force is therefore a continuous function of p, v_t and F_n, and steps
//! only at break-away: at its limit, a contact has the same force on whichever side rounding puts it (theory
//! manual, section 4).
//!
//! Products with K replace the lengths p_s and p_k, so that K = 0 needs no special case.

use super::slip_path::SlipPath;
use pong_geometry::Vec3;
use pong_geometry::simd::{LaneBits, Numbers, Simd, Vectors};

/// Allowance for rounding of a force at its limit, relative to the limit: the carried bristle and its product
/// with K have errors of a few times 1e-16. Friction exceeds its limit by no more than this.
const LIMIT_ROUNDING: f64 = 1e-13;

/// Bristles of eight contacts, and their motion since the last commit. A sticking lane of zeros has no
/// friction.
pub(crate) struct Bristles<S: Simd> {
    /// Tangential stiffness K, N/m.
    pub stiffness: Numbers<S>,
    /// Tangential damping c, N·s/m.
    pub damping: Numbers<S>,
    /// Kinetic limit μ_k·F_n, N.
    pub kinetic_limit: Numbers<S>,
    /// Static limit μ_s·F_n, N.
    pub static_limit: Numbers<S>,
    /// Unit normals. All vectors are in the frame of B's movable group.
    pub normal: Vectors<S>,
    /// Deflections p, rotated into the current contact planes, m.
    pub carried: Vectors<S>,
    /// Slip u since the last commit, m.
    pub slip: Vectors<S>,
    /// Slip velocities v_t, m/s.
    pub slip_velocity: Vectors<S>,
    /// Lanes that stuck at the last commit.
    pub stuck: LaneBits,
}

/// Forces and new state of eight bristles.
pub(crate) struct BristleForces<S: Simd> {
    /// Friction forces on A, N.
    pub force: Vectors<S>,
    /// New deflections p, m.
    pub bristle: Vectors<S>,
    /// Energies stored in the bristles, J.
    pub stored: Numbers<S>,
    /// Lanes that stick.
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
        // A slipping contact sticks again if its motion has reversed or its deflection is inside the circle,
        // and if its force is also within the kinetic limit, so that the static limit would not change it.
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

    /// Paths of the bristles that exceeded their limits; the values of the other lanes are not used.
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

    /// Deflection at which the bristle has this force, m.
    #[inline(always)]
    fn deflection_at(&self, pull: Numbers<S>) -> Numbers<S> {
        /// Largest result: larger than any deflection at a limit, with a finite square.
        const FARTHEST_M: f64 = 1e120;
        pull.over(self.stiffness.larger(pull * pull.all(1.0 / FARTHEST_M)))
    }
}

/// Shortens a vector, whose length is `length`, to at most `limit`.
///
/// If nothing is cut, the factor is exactly 1. There is no branch, because a compiler may move a division in
/// front of it, and 0/0 is an invalid operation.
#[inline(always)]
pub(crate) fn shortened(vector: Vec3, length: f64, limit: f64) -> Vec3 {
    let longer = if length > limit { length } else { limit };
    vector * (limit / longer.max(f64::MIN_POSITIVE))
}

/// Shortens eight vectors, whose lengths are `length`, to at most `limit`.
#[inline(always)]
fn shortened_each<S: Simd>(vectors: Vectors<S>, length: Numbers<S>, limit: Numbers<S>) -> Vectors<S> {
    vectors * limit.over(length.larger(limit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pong_geometry::simd::{LANES, Portable};
    use pong_testkit::Random;

    /// Eight vectors in the plane normal to z, of lengths up to `size`.
    fn in_plane(random: &mut Random, size: f64) -> Vectors<Portable> {
        let mut coordinates = [[0.0; LANES]; 3];
        for axis in &mut coordinates[..2] {
            axis.iter_mut().for_each(|x| *x = random.between(-size, size));
        }
        Vectors::load(Portable, &coordinates)
    }

    /// Bristles that stick again are evaluated once more without motion: they are then held by the static
    /// limit, which must not change their force.
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
