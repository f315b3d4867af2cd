//! Paths through spheres (of two spheres, through the larger) and ellipsoids, and out of bores.

use super::line::{Line, Met};
use crate::frame::input::PairContext;
use pong_geometry::interference::ray_bore::ray_bore;
use pong_geometry::primitive::{Bore, PrimitiveKind, Ray};
use pong_geometry::{Mat3, Vec3};
use pong_model::Item;

/// Outcome of a path against a sphere, ellipsoid or bore of B. Planes are half-spaces and cannot be passed;
/// custom kinds are not checked.
pub(super) fn meet(context: &PairContext<'_>, item_a: Item, item_b: Item, line: &Line) -> Option<Met> {
    let (body_a, body_b) = (context.body_a, context.body_b);
    let element = item_b.element as usize;
    match body_b.primitives[item_b.primitive as usize].kind {
        PrimitiveKind::Sphere => {
            let own = match body_a.primitives[item_a.primitive as usize].kind {
                PrimitiveKind::Sphere => body_a.spheres[item_a.element as usize].radius,
                _ => 0.0,
            };
            let sphere = &body_b.spheres[element];
            let radius = sphere.radius.max(own);
            let unit = |p: &Vec3| (p - sphere.center) / radius;
            through_unit_ball(&unit(&line.from_b), &unit(&line.to_b)).map(Met::Through)
        }
        PrimitiveKind::Ellipsoid => {
            let ellipsoid = &body_b.ellipsoids[element];
            let scale = Mat3::from_diagonal(&ellipsoid.semi_axes.map(|a| 1.0 / a));
            let to_axes = scale * ellipsoid.axes.transpose();
            let unit = |p: &Vec3| to_axes * (p - ellipsoid.center);
            let at = through_unit_ball(&unit(&line.from_b), &unit(&line.to_b))?;
            Some(Met::Through((to_axes.transpose() * at).normalize()))
        }
        PrimitiveKind::Bore => out_of_bore(&body_b.bores[element], line),
        _ => None,
    }
}

/// Outcome of a path from the inside of a bore through its wall.
fn out_of_bore(bore: &Bore, line: &Line) -> Option<Met> {
    let ray = Ray { reach: Some(0.0), ..Ray::between(&line.from_b, &line.to_b)? };
    ray_bore(&ray, bore).map(|hit| Met::Through(hit.normal_b))
}

/// Entry point into the unit ball of a path with both ends outside it, if any.
fn through_unit_ball(from: &Vec3, to: &Vec3) -> Option<Vec3> {
    let path = to - from;
    let (square, along, room) = (path.norm_squared(), from.dot(&path), from.norm_squared() - 1.0);
    let root = along * along - square * room;
    let outside = room >= 0.0 && to.norm_squared() >= 1.0;
    // Also rejects a path of length zero, and NaN.
    let enters = root > 0.0 && along < 0.0;
    if !outside || !enters {
        return None;
    }
    let at = (-along - root.max(0.0).sqrt()) / square.max(f64::MIN_POSITIVE);
    (at < 1.0).then(|| from + path * at)
}
