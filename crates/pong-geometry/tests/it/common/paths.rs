//! Energy that appears or vanishes along a path of two bodies.

/// Energy gained or lost along a way from 0 to 1, relative to the largest that is stored at five places of it: the work of
/// the wrench, with `power` its derivative, and what is stored at the end. `None` if less than `least` is stored.
pub fn gained(energy: impl Fn(f64) -> f64, power: impl Fn(f64) -> f64, least: f64) -> Option<f64> {
    let samples = [0.0, 0.25, 0.5, 0.75, 1.0].map(&energy);
    let largest = samples.into_iter().fold(0.0, f64::max);
    if largest < least {
        return None;
    }
    let gained_in = |parts: i32, limit: f64| {
        let of_part = |k: i32| {
            let [from, to] = [k, k + 1].map(|k| f64::from(k) / f64::from(parts));
            let at_three = [from, 0.5 * (from + to), to].map(&power);
            work(&power, [from, to], at_three, 36, limit * largest)
        };
        ((0..parts).map(of_part).sum::<f64>() + samples[4] - samples[0]).abs() / largest
    };
    // Halves may agree by chance beside a kink: where that shows, smaller ones tell.
    let first = Some(gained_in(16, 3e-10)).filter(|gained| *gained < 1e-9);
    first.or_else(|| Some(gained_in(256, 1e-11)))
}

/// Work from `from` to `to` of the way, by Simpson's rule, halved until two
/// halves agree with the whole.
fn work(at: &impl Fn(f64) -> f64, [from, to]: [f64; 2], power: [f64; 3], depth: u32, limit: f64) -> f64 {
    let middle = 0.5 * (from + to);
    let rule = |length: f64, p: [f64; 3]| length * (p[0] + 4.0 * p[1] + p[2]) / 6.0;
    let halves =
        [[power[0], at(0.5 * (from + middle)), power[1]], [power[1], at(0.5 * (middle + to)), power[2]]];
    let [one, other] = halves.map(|p| rule(middle - from, p));
    let off = one + other - rule(to - from, power);
    if depth == 0 || off.abs() <= 15.0 * limit * (to - from) {
        return one + other + off / 15.0;
    }
    work(at, [from, middle], halves[0], depth - 1, limit)
        + work(at, [middle, to], halves[1], depth - 1, limit)
}
