//! The longest stable step of a spring and a damper on a mass (linear stability).
//!
//! With m the effective mass, κ = k·dt²/m and γ = c·dt/m:
//!
//! | how the force is used | stable if and only if |
//! |---|---|
//! | at every stage of Runge-Kutta 4 | both roots z of z² + γz + κ have \|1 + z + z²/2 + z³/6 + z⁴/24\| ≤ 1: ω·dt ≤ 2.828 undamped, γ ≤ 2.785 without spring, ω·dt ≤ 2.62 at worst between |
//! | once a step, semi-implicit Euler | κ + 2γ < 4 |
//! | held over a frame | κ/2 < γ < 2 |
//! | held, n whole frames late | all roots of (z − 1)²·zⁿ + ½κ(z + 1) + γ(z − 1) lie in the unit circle; needs γ > κ(½ + n) |
//!
//! The last polynomial is that of the exact motion of a mass under a force that changes once a frame.

use crate::mass::SpringRates;
use pong_engine::WrenchCoupling;

/// The longest step (s) at which a contact of stiffness `k` (N/m) and damping `c` (N·s/m) on an effective mass `m`
/// (kg) is stable; 0 if no step is.
pub fn longest_stable_step(coupling: WrenchCoupling, k: f64, c: f64, m: f64) -> f64 {
    match coupling {
        WrenchCoupling::Stages | WrenchCoupling::SemiImplicit if k <= 0.0 && c <= 0.0 => f64::INFINITY,
        // `surely` lies inside the stability region: 2.6 is below its least radius |z| = dt·√(k/m) over
        // underdamped roots, 2.62, and 2.78 below the limit of the faster real root. Each rate is raised to
        // half the other if smaller, which does not change the result but avoids dividing by zero.
        WrenchCoupling::Stages => {
            let frequency = (k / m).sqrt();
            let surely = (2.6 / frequency.max(0.5 * c / m)).min(2.78 * m / c.max(0.5 * m * frequency));
            last_within(surely, 2.0, |step| stage_wise_holds(k * step * step / m, c * step / m))
        }
        // The positive root dt of k·dt² + 2c·dt = 4m.
        WrenchCoupling::SemiImplicit => 4.0 * m / ((c * c + 4.0 * k * m).sqrt() + c),
        WrenchCoupling::ZeroOrderHold { .. } if c <= 0.0 => 0.0,
        WrenchCoupling::ZeroOrderHold { delay_frames: late } => {
            // If the second limit is the smaller, the first may be any larger value; the maximum avoids a
            // division by k = 0.
            let at_most = (c / (k * coupling.lag()).max(0.25 * c * c / m)).min(2.0 * m / c);
            if late == 0 {
                return at_most;
            }
            last_below(at_most, |frame| late_hold_is_stable(k * frame * frame / m, c * frame / m, late))
        }
    }
}

/// A step (s) at which every mode is stable, if each mode has at most the stiffness `k` and the damping `c`
/// over its mass (1/s², 1/s), and at least the damping `ratio` times its stiffness (`ratio` in s); 0 if there
/// is none.
///
/// A mode x of M·q'' + C·q' + K·q = 0 obeys the scalar equation with its own x*Kx and x*Cx, so a bound of
/// both suffices.
pub(crate) fn surely_stable_step(coupling: WrenchCoupling, k: f64, c: f64, ratio: f64) -> f64 {
    let most = longest_stable_step(coupling, k, c, 1.0);
    let least = || longest_stable_step(coupling, k, (k * ratio).min(c), 1.0);
    match coupling {
        // As the damping ratio ½c/√k rises to 0.54 the radius of the region grows a little, then falls to its
        // minimum: over any interval the ends are the minimum. Beyond it the limit of a mode with damping
        // alone is smaller still.
        WrenchCoupling::Stages => most.min(least()).min(2.785 / c.max(0.5 * k.sqrt())),
        WrenchCoupling::SemiImplicit => most,
        WrenchCoupling::ZeroOrderHold { .. } => most.min(least()).min(ratio / coupling.lag()),
    }
}

/// [`surely_stable_step`] of contacts with these rates, whose damping is at least `ratio` times the
/// stiffness, together with springs of the host. Springs are integrated with the contacts, and the rates of
/// both add; under a held wrench the host integrates them between frames, and each is judged by itself.
pub(crate) fn surely_stable_with(
    coupling: WrenchCoupling,
    contacts: SpringRates,
    ratio: f64,
    springs: SpringRates,
) -> f64 {
    let of = |coupling, rates: SpringRates, ratio| {
        surely_stable_step(coupling, rates.stiffness, rates.damping, ratio)
    };
    if springs.is_zero() {
        return of(coupling, contacts, ratio);
    }
    // Springs may be undamped, so their ratio is 0.
    match coupling {
        WrenchCoupling::ZeroOrderHold { .. } => {
            let alone = of(WrenchCoupling::Stages, springs, 0.0);
            if contacts.is_zero() { alone } else { alone.min(of(coupling, contacts, ratio)) }
        }
        _ => {
            let stiffness = contacts.stiffness + springs.stiffness;
            of(coupling, SpringRates { stiffness, damping: contacts.damping + springs.damping }, 0.0)
        }
    }
}

/// True if the classic Runge-Kutta method amplifies neither root of z² + γz + κ.
fn stage_wise_holds(kappa: f64, gamma: f64) -> bool {
    let under = kappa - 0.25 * gamma * gamma;
    if under >= 0.0 {
        return grown((-0.5 * gamma, under.sqrt())) <= 1.0 + 1e-12;
    }
    let fast = 0.5 * gamma + (-under).sqrt();
    grown((-fast, 0.0)).max(grown((-kappa / fast, 0.0))) <= 1.0 + 1e-12
}

/// Amplification factor |1 + z + z²/2 + z³/6 + z⁴/24|.
fn grown((x, y): (f64, f64)) -> f64 {
    let (mut re, mut im) = (1.0, 0.0);
    for divisor in [4.0, 3.0, 2.0, 1.0] {
        (re, im) = (1.0 + (re * x - im * y) / divisor, (re * y + im * x) / divisor);
    }
    (re * re + im * im).sqrt()
}

/// True if a held force, `late` frames late, leaves all roots within the unit circle (Schur and Cohn's
/// recursion).
fn late_hold_is_stable(kappa: f64, gamma: f64, late: u32) -> bool {
    let n = late as usize;
    let mut p = vec![0.0; n + 3];
    for (power, coefficient) in
        [(0, 0.5 * kappa - gamma), (1, 0.5 * kappa + gamma), (n, 1.0), (n + 1, -2.0), (n + 2, 1.0)]
    {
        p[power] += coefficient;
    }
    while p.len() > 1 {
        let last = p.len() - 1;
        let shrinks = p[0].abs() < p[last].abs();
        if !shrinks {
            return false;
        }
        let reflection = p[0] / p[last];
        p = (0..last).map(|i| p[i + 1] - reflection * p[last - 1 - i]).collect();
    }
    true
}

/// Number of halvings until an interval of doubles cannot shrink any more.
const HALVINGS: usize = 100;

/// The last step that holds, between `surely`, which holds, and `factor` times as much.
fn last_within(surely: f64, factor: f64, holds: impl Fn(f64) -> bool) -> f64 {
    // Near the real axis the region is not convex: walk to its border before bisecting.
    let (walk, mut inside) = (1.005, surely);
    while inside * walk < surely * factor && holds(inside * walk) {
        inside *= walk;
    }
    bisect(inside, inside * walk, holds)
}

/// The last step that holds below `at_most`, which may not hold; 0 if none down to a millionth of it does.
fn last_below(at_most: f64, holds: impl Fn(f64) -> bool) -> f64 {
    // NaN, or too short to be multiplied by a tenth.
    if at_most.is_nan() || at_most < 1e-290 {
        return 0.0;
    }
    if holds(at_most) {
        return at_most;
    }
    let mut inside = at_most;
    while !holds(inside) {
        inside *= 0.9;
        if inside < 1e-6 * at_most {
            return 0.0;
        }
    }
    bisect(inside, inside / 0.9, holds)
}

fn bisect(mut inside: f64, mut outside: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (inside + outside);
        if holds(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    const HELD: WrenchCoupling = WrenchCoupling::ZeroOrderHold { delay_frames: 0 };

    /// Known answers: dt = 2√(m/k) undamped; κ + 2γ = 4 with damping; kT/2 = c and c = 2m/T for a held wrench; 2√2 and
    /// 2.785293563 for Runge-Kutta.
    #[test]
    fn limits_are_those_of_the_stability_table() {
        let euler = WrenchCoupling::SemiImplicit;
        assert!((longest_stable_step(euler, 1e4, 0.0, 1.0) - 0.02).abs() < 1e-15);
        let step = longest_stable_step(euler, 3e4, 70.0, 2.0);
        assert!((3e4 * step * step / 2.0 + 2.0 * 70.0 * step / 2.0 - 4.0).abs() < 1e-12);
        assert_eq!(longest_stable_step(HELD, 1e4, 5.0, 1.0), 1e-3);
        assert_eq!(longest_stable_step(HELD, 1e-9, 5.0, 1.0), 0.4);
        assert_eq!(longest_stable_step(HELD, 1e4, 0.0, 1.0), 0.0);
        let stages = |k, c| longest_stable_step(WrenchCoupling::Stages, k, c, 1.0);
        assert!((stages(1e4, 0.0) * 100.0 - 8_f64.sqrt()).abs() < 1e-5);
        assert!((stages(1e-9, 10.0) * 10.0 - 2.785293563).abs() < 1e-6);
        // Half of critical damping: the region is narrower there than on either axis.
        assert!((stages(1.0, 1.0) - 2.623).abs() < 1e-3, "{}", stages(1.0, 1.0));
    }

    /// A contact without stiffness, or without damping, is limited by the other alone; one without both at no
    /// step. No infinity takes part: `ci/traps` checks it.
    #[test]
    fn nothing_to_hold_limits_no_step() {
        for m in [1e-6, 1.0, 1e9] {
            let stages = |k, c| longest_stable_step(WrenchCoupling::Stages, k, c, m);
            assert!((stages(0.0, 10.0 * m) * 10.0 - 2.785293563).abs() < 1e-6);
            assert_eq!(stages(1e4 * m, 0.0), stages(1e4 * m, 1e-300));
            assert!((longest_stable_step(HELD, 0.0, 5.0 * m, m) - 0.4).abs() < 1e-15);
            for coupling in [WrenchCoupling::Stages, WrenchCoupling::SemiImplicit] {
                assert_eq!(longest_stable_step(coupling, 0.0, 0.0, m), f64::INFINITY);
            }
        }
    }

    /// The least damping of a delayed wrench, found independently by iterating the map: 1.515·kT one frame
    /// late at κ = 0.01, and no damping at all one frame late at κ = 0.5, two frames late at κ = 0.1.
    #[test]
    fn a_late_wrench_needs_more_damping_until_none_helps() {
        let stable = |kappa: f64, gamma: f64, late| late_hold_is_stable(kappa, gamma, late);
        assert!(stable(0.01, 0.01 * 1.52, 1) && !stable(0.01, 0.01 * 1.51, 1));
        let any = |kappa, late| (1..2000).any(|i| stable(kappa, 1e-3 * f64::from(i), late));
        assert!(!any(0.5, 1) && any(0.05, 1));
        assert!(!any(0.1, 2) && any(0.02, 2));
        let step = longest_stable_step(WrenchCoupling::ZeroOrderHold { delay_frames: 1 }, 1e4, 15.0, 1.0);
        assert!(step < 1e-3 && step > 0.97e-3, "{step}");
        // Damping alone, one frame late: z² − z + γ has its roots on the circle at γ = 1.
        let step = longest_stable_step(WrenchCoupling::ZeroOrderHold { delay_frames: 1 }, 1e-9, 10.0, 1.0);
        assert!((step * 10.0 - 1.0).abs() < 1e-6, "{step}");
    }

    /// Without delay the polynomial has Jury's condition κ/2 < γ < 2.
    #[test]
    fn the_recursion_agrees_with_the_closed_form_without_delay() {
        for i in 1..60 {
            for j in 1..60 {
                let (kappa, gamma) = (0.083 * f64::from(i), 0.041 * f64::from(j));
                assert_eq!(late_hold_is_stable(kappa, gamma, 0), 0.5 * kappa < gamma && gamma < 2.0);
            }
        }
    }

    fn holds(coupling: WrenchCoupling, kappa: f64, gamma: f64) -> bool {
        match coupling {
            WrenchCoupling::Stages => stage_wise_holds(kappa, gamma),
            WrenchCoupling::SemiImplicit => kappa + 2.0 * gamma <= 4.0,
            // The recursion cannot resolve 1e-16 relative to one.
            WrenchCoupling::ZeroOrderHold { delay_frames: 0 } => 0.5 * kappa < gamma && gamma < 2.0,
            WrenchCoupling::ZeroOrderHold { delay_frames: late } => late_hold_is_stable(kappa, gamma, late),
        }
    }

    /// No mode within the bounds gains energy at a step called sure, and the step is not far too cautious:
    /// some mode gains at little more than twice it.
    #[test]
    fn a_sure_step_holds_every_mode_within_the_bounds() {
        let couplings = [0, 1, 2].map(|late| WrenchCoupling::ZeroOrderHold { delay_frames: late });
        for coupling in [WrenchCoupling::Stages, WrenchCoupling::SemiImplicit].into_iter().chain(couplings) {
            for zeta in [0.05, 0.2, 0.4, 0.539, 0.541, 0.7, 1.0, 3.0, 20.0] {
                let (k, c) = (4.0, 4.0 * zeta);
                for ratio in [c / k, 0.3 * c / k] {
                    let step = surely_stable_step(coupling, k, c, ratio);
                    if step == 0.0 {
                        assert!(coupling.lag() > 1.0, "{coupling:?} {zeta}");
                        continue;
                    }
                    let gains = |step: f64| {
                        (1..=200).any(|i| {
                            let of_k = f64::from(i) / 200.0 * k;
                            let (least, most) = (ratio * of_k, c);
                            (0..=50).any(|j| {
                                let of_c = least + (most - least) * f64::from(j) / 50.0;
                                !holds(coupling, of_k * step * step, of_c * step)
                            })
                        })
                    };
                    assert!(!gains(step * (1.0 - 1e-5)), "{coupling:?} {zeta} {ratio}: {step}");
                    assert!(gains(step * 2.1), "{coupling:?} {zeta} {ratio}: {step}");
                }
            }
        }
    }

    /// The least radius of the stability region of Runge-Kutta: |z| = 2.6156 at a damping ratio of 0.54.
    #[test]
    fn the_narrowest_place_is_where_it_is_said() {
        let reach = |zeta: f64| longest_stable_step(WrenchCoupling::Stages, 1.0, 2.0 * zeta, 1.0);
        let all = (0..1000).map(|i| reach(1e-3 * f64::from(i)));
        let least = all.fold(f64::INFINITY, f64::min);
        assert!(
            (2.6155..2.6156).contains(&least) && (reach(0.54) - least).abs() < 1e-3,
            "{least} {}",
            reach(0.54)
        );
        // Up to there it grows and then falls, so that over any interval the ends are the minimum.
        let reaches = (0..540).map(|i| reach(1e-3 * f64::from(i))).collect::<Vec<_>>();
        let top = reaches.iter().enumerate().max_by(|x, y| x.1.total_cmp(y.1)).unwrap().0;
        assert!(reaches[..top].windows(2).all(|two| two[0] <= two[1] + 1e-9), "{top}");
        assert!(reaches[top..].windows(2).all(|two| two[1] <= two[0] + 1e-9), "{top}");
    }
}
