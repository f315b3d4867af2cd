//! Contact points on round parts, and orientations of what touches them.

use crate::random::{Random, rotation_about, rotation_between};
use crate::round_part::{RoundKind, RoundPart};
use crate::scene::Shape;
use pong_geometry::{Quat, Vec3};

/// A contact point on the surface of B, with the outward normal.
#[derive(Clone, Copy, Debug)]
pub struct Foot {
    /// Position in B's group, m.
    pub place: Vec3,
    /// Outward unit normal, in B's group.
    pub normal: Vec3,
}

/// A point of a round part: on its wall, its ends, an edge circle or a bore's opening.
pub fn foot_on_round(random: &mut Random, part: &RoundPart, is_round: bool) -> Foot {
    let axis = part.axis();
    let [p, q] = part.ends;
    let aside = random.across(&axis);
    let length = (q - p).norm();
    let end = random.below(2);
    let outward = if end == 0 { -axis } else { axis };
    let on_wall = |t: f64| {
        let radius = part.radii[0] + (part.radii[1] - part.radii[0]) * t;
        let normal = (aside * length - axis * (part.radii[1] - part.radii[0])).normalize();
        Foot { place: p + (q - p) * t + aside * radius, normal }
    };
    let t = if is_round { random.pick(&[0.0, 0.25, 0.5]) } else { random.unit() };
    let rim = part.ends[end] + aside * part.radii[end];
    let (turn, share) = (random.unit(), random.unit());
    let mixed = aside * turn + outward * (1.0 - turn);
    match (part.kind, random.below(4)) {
        (RoundKind::Bore, 0) => Foot { place: rim, normal: (outward * turn - aside).normalize() },
        (RoundKind::Bore, _) => {
            let Foot { place, normal } = on_wall(t);
            Foot { place, normal: -normal }
        }
        (RoundKind::Capsule, 0) => {
            let normal = mixed.normalize();
            Foot { place: part.ends[end] + normal * part.radii[end], normal }
        }
        (_, 0) => Foot { place: rim, normal: mixed.normalize() },
        (RoundKind::Cylinder | RoundKind::Cone, 1) => {
            Foot { place: part.ends[end] + aside * (part.radii[end] * share), normal: outward }
        }
        _ => on_wall(t),
    }
}

/// First orientation of a long body at a round part, or of a round part at anything: along, across, upright
/// or slanted.
pub fn first_orientation_of_round(
    random: &mut Random,
    [shape, touched]: [&Shape; 2],
    foot: &Foot,
    is_round: bool,
) -> Option<Quat> {
    let along = match (shape, touched) {
        (Shape::Round(part), _) => part.axis(),
        (Shape::Segment { ends }, Shape::Round(_)) => (ends[1] - ends[0]).normalize(),
        _ => return None,
    };
    let axis = match touched {
        Shape::Round(part) => part.axis(),
        _ => random.across(&foot.normal),
    };
    let toward = match random.below(8) {
        0 => random.direction(),
        1 => foot.normal,
        2 => axis.cross(&foot.normal).try_normalize(1e-6).unwrap_or(axis),
        _ => axis,
    };
    let tilt = match random.below(3) {
        0 => Vec3::zeros(),
        1 if !is_round => random.vector(0.3),
        _ if is_round => Vec3::zeros(),
        _ => random.direction() * random.log_between(1e-9, 0.1),
    };
    let toward = (toward + tilt).normalize() * random.pick(&[1.0, -1.0]);
    let spin = if is_round { Quat::identity() } else { rotation_about(&along, random.between(-3.0, 3.0)) };
    Some(rotation_between(&along, &toward) * spin)
}
