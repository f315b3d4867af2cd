//! Positions of slipping bristles on the circles of their limits after a displacement, eight at a time.
//!
//! The motion of A drags a slipping bristle of constant length p_k, and the direction of its deflection p
//! turns towards the direction of the motion. With ψ the angle between p and a straight displacement u, and s
//! the distance along it,
//!
//! ```text
//! dψ/ds = −sin ψ/p_k      hence      tan(ψ/2) = tan(ψ₀/2)·exp(−z),      z = |u|/p_k
//! ```
//!
//! For a curved path, u is the chord, and the direction of motion turns from −γ to γ relative to u, with γ
//! the angle from u to v_t. To first order in γ, p lags behind that turn by
//!
//! ```text
//! 2γz·∫₀¹ (s − ½)·exp(−z(1 − s)) ds = γ·(1 − 2(1 − exp(−z))/z + exp(−z))
//! ```
//!
//! (own derivation; theory manual, section 4). A radial return p_k·p*/|p*| is one order less accurate in the
//! step.

use pong_geometry::simd::{Numbers, Simd, Vectors};

/// Value of z below which the lag is summed as a series: the closed form loses 2·10⁻¹⁶/z rad by cancellation.
const SERIES_MAX: f64 = 0.25;

/// Displacements that took eight bristles out of their circles. Vectors are in one frame, in the contact
/// planes.
pub(super) struct SlipPath<S: Simd> {
    /// Unit normals of the contacts.
    pub normal: Vectors<S>,
    /// Deflections before the step, m.
    pub carried: Vectors<S>,
    /// Displacement u, m.
    pub slip: Vectors<S>,
    /// Slip velocity v_t, m/s.
    pub slip_velocity: Vectors<S>,
    /// Radius of the circle that the bristle left, m; larger than `radius` for a bristle that stuck until
    /// then.
    pub left_at: Numbers<S>,
    /// Radius p_k of the circle on which the bristle moves then, m.
    pub radius: Numbers<S>,
}

/// Points where straight paths leave the circles.
struct Traversal<S: Simd> {
    /// Unit directions of the bristles at these points. If any of the path is left, they point along the path
    /// or across it, never backwards.
    direction: Vectors<S>,
    /// Remaining length of the path, m.
    left: Numbers<S>,
}

impl<S: Simd> SlipPath<S> {
    /// Deflections at the end, on the circles of `radius`, m. A bristle with no path left keeps its
    /// direction.
    #[inline(always)]
    pub fn end(&self, simd: S) -> Vectors<S> {
        let zero = Numbers::splat(simd, 0.0);
        let length = self.slip.norm();
        let along = self.slip.along(length);
        let way = Traversal::after_leaving(self.carried, along, length, self.left_at);
        let moves = zero.below(way.left);
        // Limit of the ratio for a radius that vanishes with the load; far smaller ratios already make
        // `decay` zero.
        const LARGEST_RATIO: f64 = 1e300;
        let ratio = way.left.over(self.radius.larger(way.left * zero.all(1.0 / LARGEST_RATIO)));
        let decay = ratio.exp_of_minus();
        let turned = turned_towards(way.direction, along, decay);
        // A smooth path does not end with a velocity that points backwards. Such a velocity is mirrored, so
        // that the angle stays continuous.
        let velocity = self.slip_velocity;
        let angle = self.normal.dot(along.cross(velocity)).angle_above(along.dot(velocity).abs());
        let turned = turned_by(turned, self.normal, angle * lag_of_turn(ratio, decay));
        Vectors::select(moves, turned, way.direction) * self.radius
    }
}

impl<S: Simd> Traversal<S> {
    /// Follows a straight path from `start` along the unit vector `along` to an end outside the circle of
    /// radius `circle`. Returns where the path leaves the circle for the last time. If the load has fallen,
    /// the whole path may lie outside; then it returns where the path is nearest to the circle.
    ///
    /// The result is computed from the point of the line nearest to the centre. Under a nearly vanished load
    /// the circle may be far smaller than the deflection, and a result computed from `start` would be pure
    /// rounding.
    #[inline(always)]
    fn after_leaving(start: Vectors<S>, along: Vectors<S>, length: Numbers<S>, circle: Numbers<S>) -> Self {
        let zero = length.all(0.0);
        let advance = start.dot(along);
        let nearest = start - along * advance;
        let half_chord = (circle * circle - nearest.norm_squared()).larger(zero).sqrt();
        let passed = half_chord - advance;
        let is_at_end = passed.at_least(length);
        let is_passed = zero.below(passed);
        let place = Vectors::select(is_passed, nearest + along * half_chord, start);
        let place = Vectors::select(is_at_end, start + along * length, place);
        let left = Numbers::select(is_at_end, zero, length - passed.larger(zero));
        Self { direction: place.unit_or(along), left }
    }
}

/// Turns `direction` towards `along`: the angle ψ between them, at most 90°, becomes 2·atan(tan(ψ/2)·decay).
/// All are unit vectors.
#[inline(always)]
fn turned_towards<S: Simd>(direction: Vectors<S>, along: Vectors<S>, decay: Numbers<S>) -> Vectors<S> {
    let (one, two) = (decay.all(1.0), decay.all(2.0));
    let cosine = direction.dot(along);
    let across = direction - along * cosine;
    // The angle may exceed 90° if no path is left; that result is not used.
    let factor = decay.over((one + cosine).larger(decay.all(0.5)));
    let tangent_squared = across.norm_squared() * factor * factor;
    (along * (one - tangent_squared) + across * (two * factor)) * one.over(one + tangent_squared)
}

/// Rotates vectors, which lie in the plane normal to `normal`, about it by angles, rad.
#[inline(always)]
fn turned_by<S: Simd>(vectors: Vectors<S>, normal: Vectors<S>, angle: Numbers<S>) -> Vectors<S> {
    let (sine, cosine) = angle.sin_cos();
    vectors * cosine + normal.cross(vectors) * sine
}

/// Lag of a bristle behind a turn of its path, relative to γ: 1 − 2(1 − e⁻ᶻ)/z + e⁻ᶻ, equal to Σ (k −
/// 1)·(−z)ᵏ/(k + 1)! over k from 2.
#[inline(always)]
fn lag_of_turn<S: Simd>(z: Numbers<S>, decay: Numbers<S>) -> Numbers<S> {
    let (one, two) = (z.all(1.0), z.all(2.0));
    let closed = one - (two * (one - decay)).over(z.larger(z.all(SERIES_MAX))) + decay;
    let small = z.smaller(z.all(SERIES_MAX));
    let series = small * small * small.series(&LAG);
    Numbers::select(z.at_least(z.all(SERIES_MAX)), closed, series)
}

/// Coefficients (k − 1)·(−1)ᵏ/(k + 1)!, for k from 2.
const LAG: [f64; 10] = {
    let mut coefficients = [0.0; 10];
    let mut factorial = 2.0;
    let mut index = 0;
    while index < 10 {
        let k = (index + 2) as f64;
        factorial *= k + 1.0;
        let sign = if index % 2 == 0 { 1.0 } else { -1.0 };
        coefficients[index] = sign * (k - 1.0) / factorial;
        index += 1;
    }
    coefficients
};

#[cfg(test)]
mod tests {
    use super::*;
    use pong_geometry::Vec3;
    use pong_geometry::simd::{LANES, Portable};

    const RADIUS: f64 = 3e-5;

    /// Final position of one bristle, computed in every lane.
    fn on_circle([carried, slip, slip_velocity]: [Vec3; 3], left_at: f64, radius: f64) -> Vec3 {
        let all = |v: Vec3| Vectors::splat(Portable, &v);
        let path = SlipPath {
            normal: all(Vec3::z()),
            carried: all(carried),
            slip: all(slip),
            slip_velocity: all(slip_velocity),
            left_at: Numbers::splat(Portable, left_at),
            radius: Numbers::splat(Portable, radius),
        };
        let [x, y, z] = path.end(Portable).store();
        let of = |lane: usize| Vec3::new(x[lane], y[lane], z[lane]);
        (1..LANES).for_each(|lane| assert_eq!(of(lane), of(0)));
        of(0)
    }

    fn lag(z: f64) -> f64 {
        let z = Numbers::splat(Portable, z);
        lag_of_turn(z, z.exp_of_minus()).store()[0]
    }

    fn at_angle(angle: f64) -> Vec3 {
        Vec3::new(libm::cos(angle), libm::sin(angle), 0.0)
    }

    /// Reference: moves the tip in many small steps and pulls the bristle back to its length after each.
    /// First order in the step, so two step sizes are extrapolated.
    fn dragged(start: Vec3, path: impl Fn(f64) -> Vec3) -> Vec3 {
        let run = |steps: i32| {
            let mut bristle = start;
            for step in 0..steps {
                let at = |step: i32| path(f64::from(step) / f64::from(steps));
                bristle += at(step + 1) - at(step);
                bristle *= (RADIUS / bristle.norm()).min(1.0);
            }
            bristle
        };
        run(400_000) * 2.0 - run(200_000)
    }

    #[test]
    fn a_straight_way_turns_the_bristle_as_a_dragged_one() {
        for (angle, length) in [(0.3, 1e-6), (1.2, 2e-5), (1.57, 1e-4), (-0.8, 5e-5)] {
            let start = at_angle(angle) * RADIUS;
            let way = Vec3::x() * length;
            let got = on_circle([start, way, Vec3::x()], RADIUS, RADIUS);
            let slow = dragged(start, |s| way * s);
            assert!((got - slow).norm() < 1e-9 * RADIUS, "{angle} {length}: {got:?}, slowly {slow:?}");
        }
    }

    /// Paths from inside the circle to its outside, and straight through it from the other side.
    #[test]
    fn a_bristle_first_fills_its_circle() {
        for start in [Vec3::new(0.2, 0.7, 0.0), Vec3::zeros(), Vec3::new(-0.8, 0.6, 0.0)] {
            let (start, way) = (start * RADIUS, Vec3::x() * 2.5 * RADIUS);
            let got = on_circle([start, way, Vec3::x()], RADIUS, RADIUS);
            let slow = dragged(start, |s| way * s);
            assert!((got - slow).norm() < 1e-9 * RADIUS, "{got:?}, slowly {slow:?}");
        }
    }

    /// On an arc that turns by 2γ, for a bristle that lags by as much, the error falls with γ³; without the
    /// lag of the turn it falls with γ.
    #[test]
    fn a_curved_way_is_followed_to_third_order() {
        let error = |turn: f64| {
            let length = 0.8 * RADIUS;
            let heading = |s: f64| turn * (2.0 * s - 1.0);
            let place = |s: f64| {
                let radius = length / (2.0 * turn);
                let (sine, cosine) = libm::sincos(heading(s));
                Vec3::new(sine + libm::sin(turn), libm::cos(turn) - cosine, 0.0) * radius
            };
            let start = at_angle(-1.5 * turn) * RADIUS;
            let got = on_circle([start, place(1.0), at_angle(turn)], RADIUS, RADIUS);
            (got - dragged(start, place)).norm() / RADIUS
        };
        let errors = [0.2, 0.1, 0.05].map(error);
        assert!(errors[0] < 1e-3, "{errors:?}");
        for pair in errors.windows(2) {
            assert!(pair[1] < 0.15 * pair[0], "{errors:?}");
        }
    }

    #[test]
    fn the_series_of_the_lag_is_its_closed_form() {
        for z in [0.2, 0.2499, 0.25, 0.3] {
            let closed = 1.0 - 2.0 * (1.0 - libm::exp(-z)) / z + libm::exp(-z);
            assert!((lag(z) - closed).abs() < 1e-14, "{z}");
        }
        assert!((lag(1e-6) / (1e-12 / 6.0) - 1.0).abs() < 1e-6);
    }

    /// A nearly vanished load leaves a circle far smaller than the bristle; the path crosses it through its
    /// centre.
    #[test]
    fn a_way_through_the_middle_of_a_tiny_circle_ends_along_it() {
        for exponent in 0..60 {
            let circle = RADIUS * 10.0_f64.powi(-5 * exponent);
            for part in [1.0 / 3.0, 0.5, 0.7] {
                let heading = Vec3::new(0.6, -0.8, 0.0);
                let (start, way) = (heading * (-part * RADIUS), heading * RADIUS);
                let got = on_circle([start, way, heading], circle, circle);
                assert!((got - heading * circle).norm() <= 1e-9 * circle, "{circle:e}: {got:?}");
            }
        }
    }

    /// Ends outside the circle under a fallen load vary continuously with the path, also where the path
    /// begins to meet the circle.
    #[test]
    fn the_place_on_the_circle_has_no_step() {
        let mut last: Option<Vec3> = None;
        for step in 0..=200_000 {
            let height = 0.9 + 0.2 * f64::from(step) / 200_000.0;
            let start = Vec3::new(-1.2, height, 0.0) * RADIUS;
            let got = on_circle([start, Vec3::x() * 2.0 * RADIUS, Vec3::y()], RADIUS, RADIUS);
            if let Some(last) = last {
                // Where the path becomes a chord, its length grows as a square root: 2·√(2·1e-6).
                assert!((got - last).norm() < 4e-3 * RADIUS, "{height}");
            }
            last = Some(got);
        }
    }
}
