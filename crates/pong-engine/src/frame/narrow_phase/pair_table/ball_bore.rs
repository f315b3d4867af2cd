//! A point or a sphere in a bore: a contact at the nearest wall and, if it is too large for the hole, one
//! opposite. The two share one spring.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use crate::frame::narrow_phase::side_of_bore::role_in_bore;
use pong_geometry::interference::ball_bore::ball_bore;
use pong_geometry::primitive::Sphere;

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let (body_a, element) = (pair.body_a(), pair.item_a.element as usize);
    // A point is a sphere of zero radius.
    let (ball, local) = match a {
        TransformedPrimitive::Sphere(sphere) => (*sphere, body_a.spheres[element].center),
        TransformedPrimitive::Point(point) => {
            (Sphere { center: point.position, radius: 0.0 }, body_a.points[element].position)
        }
        _ => wrong_kind(a),
    };
    let bore = &pair.body_b().bores[pair.item_b.element as usize];
    for contact in ball_bore(&ball, bore).iter().flatten() {
        let key = pair.key();
        let remembered = pair.context.memory.under(&key);
        let role = role_in_bore(pair, &remembered, &local, contact);
        pair.emit_under(key, contact, found, |out| {
            out.share(false);
            (out.role, out.remembered) = (role, Some(remembered.range));
        });
    }
}
