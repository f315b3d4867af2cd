//! Random bores, and operations on them, for the tests of contacts with bores.

use pong_geometry::primitive::{Bore, Frustum};
use pong_geometry::{Transform, Vec3};
use pong_testkit::Random;

/// Random bore, about 1 m in size, straight or tapered, near the origin.
pub fn random_bore(random: &mut Random) -> Bore {
    let one = random.direction() * random.between(0.0, 1.0);
    let other = one + random.direction() * random.between(0.3, 2.0);
    let radius = random.between(0.2, 1.0);
    let last = if random.below(2) == 0 { radius } else { random.between(0.2, 1.0) };
    Bore {
        hole: Frustum::new([one, other], [radius, last]),
        thickness: random.between(0.1, 0.6),
        mouths: [random.below(4) > 0, random.below(4) > 0],
    }
}

pub fn carried(bore: &Bore, x: &Transform) -> Bore {
    Bore { hole: bore.hole.carried(x), ..*bore }
}

pub fn scaled(bore: &Bore, factor: f64) -> Bore {
    let Frustum { ends, radii, .. } = bore.hole;
    let hole = Frustum::new(ends.map(|end| end * factor), radii.map(|radius| radius * factor));
    Bore { hole, thickness: bore.thickness * factor, mouths: bore.mouths }
}

pub fn swapped(bore: &Bore) -> Bore {
    let Frustum { ends: [a, b], radii: [r, s], .. } = bore.hole;
    let [m, n] = bore.mouths;
    Bore { hole: Frustum::new([b, a], [s, r]), thickness: bore.thickness, mouths: [n, m] }
}

/// Bore rounded to single precision, as a model file holds it.
pub fn rounded(bore: &Bore) -> Bore {
    let round = |x: f64| f64::from(x as f32);
    let Frustum { ends, radii, .. } = bore.hole;
    let hole = Frustum::new(ends.map(|end| end.map(round)), radii.map(round));
    Bore { hole, thickness: round(bore.thickness), mouths: bore.mouths }
}

/// Two unit vectors perpendicular to the axis and to each other.
pub fn across(bore: &Bore) -> [Vec3; 2] {
    let one = bore.hole.axis.cross(&Vec3::ith(bore.hole.axis.iamin(), 1.0)).normalize();
    [one, bore.hole.axis.cross(&one)]
}

/// Point of the wall at a fraction of the length and an angle.
pub fn on_wall(bore: &Bore, share: f64, angle: f64) -> Vec3 {
    let [one, other] = across(bore);
    let [first, last] = bore.hole.radii;
    let radius = first + (last - first) * share;
    bore.hole.ends[0]
        + bore.hole.axis * (bore.hole.length * share)
        + (one * angle.cos() + other * angle.sin()) * radius
}

/// Squared length of the shortest vector that clears two depths, given the cosine between their normals.
pub fn shared_square(one: f64, two: f64, cosine: f64) -> f64 {
    let g = cosine.max(0.0);
    let (least, most) = (one.min(two), one.max(two));
    if g * most >= least {
        return most * most;
    }
    (one * one + two * two - 2.0 * g * one * two) / (1.0 - g * g)
}
