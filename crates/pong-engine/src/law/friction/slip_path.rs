//! Where a bristle stands on the circle of its limit after a displacement.
//!
//! A slipping bristle is dragged by its tip at a constant length p_k: its direction turns towards that of the motion.
//! With ψ the angle between p and a straight displacement u,
//!
//! ```text
//! dψ/ds = −sin ψ/p_k      hence      tan(ψ/2) = tan(ψ₀/2)·exp(−z),      z = |u|/p_k
//! ```
//!
//! Where the path is curved, u is its chord, and the direction of motion turns from −γ to γ of it, γ the angle from u to
//! v_t. The linear part of the lag against that turn is
//!
//! ```text
//! 2γz·∫₀¹ (s − ½)·exp(−z(1 − s)) ds = γ·(1 − 2(1 − exp(−z))/z + exp(−z))
//! ```
//!
//! (own; theory manual, section 4). A radial return p_k·p*/|p*| lags behind by one order of the step.

use super::force::FrictionInput;
use pong_geometry::Vec3;

/// Below this z the lag is summed as a series: its closed form cancels, and loses 2·10⁻¹⁶/z of a radian.
const SERIES_MAX: f64 = 0.25;

/// The bristle on the circle of radius `radius`, m, after a displacement that took it over the circle of radius `left_at`,
/// which is larger where it stuck until then.
#[inline(always)]
pub(super) fn on_circle(input: &FrictionInput<'_>, left_at: f64, radius: f64) -> Vec3 {
    if radius <= 0.0 {
        return Vec3::zeros();
    }
    let length = input.slip_b.norm();
    if length <= 0.0 {
        return unit_or(&input.carried_b, Vec3::zeros()) * radius;
    }
    let along = input.slip_b / length.max(f64::MIN_POSITIVE);
    let way = Traversal::after_leaving(&input.carried_b, &along, length, left_at);
    if way.left <= 0.0 {
        return way.direction * radius;
    }
    // Far beyond where anything is left of the first direction: a load that has all but gone leaves all but no radius.
    const LARGEST_RATIO: f64 = 1e300;
    let ratio = way.left.min(radius * LARGEST_RATIO) / radius;
    let decay = libm::exp(-ratio);
    let turned = turned_towards(&way.direction, &along, decay);
    // A velocity that points back along the path is not the end of a smooth one; so mirrored, the angle has no jump there.
    let angle = libm::atan2(
        input.normal_b.dot(&along.cross(&input.slip_velocity_b)),
        along.dot(&input.slip_velocity_b).abs(),
    );
    turned_by(&turned, &input.normal_b, angle * lag_of_turn(ratio, decay)) * radius
}

/// Where the circle was left on a straight way.
struct Traversal {
    /// Unit vector of the bristle there. It points along the way or across it, never back, where any of the way is left.
    direction: Vec3,
    /// The part of the way that was left, m.
    left: f64,
}

impl Traversal {
    /// From `start` along a unit vector to an end outside of the circle of radius `circle`: where it leaves that circle for
    /// the last time, or comes nearest to it. The load may have fallen, so that all of the way lies outside.
    ///
    /// The place is built from the point of the line that is nearest to the middle. Summed up from the start it would be
    /// rounding alone where the circle is far smaller than the bristle was: under a load that has all but gone.
    #[inline(always)]
    fn after_leaving(start: &Vec3, along: &Vec3, length: f64, circle: f64) -> Self {
        let advance = start.dot(along);
        let nearest = start - along * advance;
        let half_chord = (circle * circle - nearest.norm_squared()).max(0.0).sqrt();
        let passed = half_chord - advance;
        if passed >= length {
            let end = start + along * length;
            return Self { direction: unit_or(&end, *along), left: 0.0 };
        }
        let place = if passed > 0.0 { nearest + along * half_chord } else { *start };
        Self { direction: unit_or(&place, *along), left: length - passed.max(0.0) }
    }
}

/// The unit vector along `v`; `other` where `v` is too short to have a direction.
#[inline(always)]
fn unit_or(v: &Vec3, other: Vec3) -> Vec3 {
    let length = v.norm();
    if length > 0.0 { v / length.max(f64::MIN_POSITIVE) } else { other }
}

/// `direction` after ψ has become 2·atan(tan(ψ/2)·decay), ψ its angle to `along`, at most 90°; all unit vectors.
#[inline(always)]
fn turned_towards(direction: &Vec3, along: &Vec3, decay: f64) -> Vec3 {
    let cosine = direction.dot(along);
    let across = direction - along * cosine;
    let factor = decay / (1.0 + cosine);
    let tangent_squared = across.norm_squared() * factor * factor;
    (along * (1.0 - tangent_squared) + across * (2.0 * factor)) / (1.0 + tangent_squared)
}

/// A vector across `normal`, turned about it by an angle, rad.
#[inline(always)]
fn turned_by(vector: &Vec3, normal: &Vec3, angle: f64) -> Vec3 {
    let (sine, cosine) = libm::sincos(angle);
    vector * cosine + normal.cross(vector) * sine
}

/// 1 − 2(1 − e⁻ᶻ)/z + e⁻ᶻ, which is Σ (k − 1)·(−z)ᵏ/(k + 1)! over k from 2.
#[inline(always)]
fn lag_of_turn(z: f64, decay: f64) -> f64 {
    if z >= SERIES_MAX {
        return 1.0 - 2.0 * (1.0 - decay) / z + decay;
    }
    const TERMS: i32 = 10;
    let (mut power, mut factorial, mut sum) = (-z, 2.0, 0.0);
    for k in 2..2 + TERMS {
        power *= -z;
        factorial *= f64::from(k + 1);
        sum += power * f64::from(k - 1) / factorial;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    const RADIUS: f64 = 3e-5;

    fn input(carried: Vec3, slip: Vec3, slip_velocity: Vec3) -> FrictionInput<'static> {
        FrictionInput {
            normal_force: 1.0,
            normal_b: Vec3::z(),
            slip_b: slip,
            slip_velocity_b: slip_velocity,
            share: 1.0,
            stiffness: 1.0,
            carried_b: carried,
            stuck: false,
            parameters: &[],
        }
    }

    fn at_angle(angle: f64) -> Vec3 {
        Vec3::new(libm::cos(angle), libm::sin(angle), 0.0)
    }

    /// The tip is moved in many small steps, and the bristle pulled back to its length after each: first order in their
    /// length, so two lengths are extrapolated.
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
            let got = on_circle(&input(start, way, Vec3::x()), RADIUS, RADIUS);
            let slow = dragged(start, |s| way * s);
            assert!((got - slow).norm() < 1e-9 * RADIUS, "{angle} {length}: {got:?}, slowly {slow:?}");
        }
    }

    /// From inside its circle, over it, and on; and straight through it from the other side.
    #[test]
    fn a_bristle_first_fills_its_circle() {
        for start in [Vec3::new(0.2, 0.7, 0.0), Vec3::zeros(), Vec3::new(-0.8, 0.6, 0.0)] {
            let (start, way) = (start * RADIUS, Vec3::x() * 2.5 * RADIUS);
            let got = on_circle(&input(start, way, Vec3::x()), RADIUS, RADIUS);
            let slow = dragged(start, |s| way * s);
            assert!((got - slow).norm() < 1e-9 * RADIUS, "{got:?}, slowly {slow:?}");
        }
    }

    /// Along an arc that turns by 2γ, from a bristle that lags by as much, the error falls with the cube of γ; without the
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
            let got = on_circle(&input(start, place(1.0), at_angle(turn)), RADIUS, RADIUS);
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
            assert!((lag_of_turn(z, libm::exp(-z)) - closed).abs() < 1e-14, "{z}");
        }
        assert!((lag_of_turn(1e-6, libm::exp(-1e-6)) / (1e-12 / 6.0) - 1.0).abs() < 1e-6);
    }

    /// A load that has all but gone leaves a circle far smaller than the bristle, which the way crosses through its middle.
    #[test]
    fn a_way_through_the_middle_of_a_tiny_circle_ends_along_it() {
        for exponent in 0..60 {
            let circle = RADIUS * 10.0_f64.powi(-5 * exponent);
            for part in [1.0 / 3.0, 0.5, 0.7] {
                let heading = Vec3::new(0.6, -0.8, 0.0);
                let (start, way) = (heading * (-part * RADIUS), heading * RADIUS);
                let got = on_circle(&input(start, way, heading), circle, circle);
                assert!((got - heading * circle).norm() <= 1e-9 * circle, "{circle:e}: {got:?}");
            }
        }
    }

    /// What ends outside under a fallen load, whether its way meets the circle or passes beside it, changes little with its
    /// way: no step where the way begins to meet the circle.
    #[test]
    fn the_place_on_the_circle_has_no_step() {
        let mut last: Option<Vec3> = None;
        for step in 0..=200_000 {
            let height = 0.9 + 0.2 * f64::from(step) / 200_000.0;
            let start = Vec3::new(-1.2, height, 0.0) * RADIUS;
            let got = on_circle(&input(start, Vec3::x() * 2.0 * RADIUS, Vec3::y()), RADIUS, RADIUS);
            if let Some(last) = last {
                // Where the way touches the circle the chord grows as a root: 2·√(2·1e-6).
                assert!((got - last).norm() < 4e-3 * RADIUS, "{height}");
            }
            last = Some(got);
        }
    }
}
