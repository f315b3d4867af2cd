//! Segments and capsules whose two ends yield: what their contacts store, push and gain. The stiffness is 1 N/m.

use super::fibonacci_sphere;
use super::paths::gained;
use pong_geometry::interference::two_capsules::OverlapContacts;
use pong_geometry::primitive::{Capsule, Polyhedron};
use pong_geometry::{Quat, Vec3, Wrench};
use std::f64::consts::TAU;

/// A capsule, or with the radius 0 a segment.
pub fn bar(ends: [[f64; 3]; 2], radius: f64) -> Capsule {
    Capsule { ends: ends.map(Vec3::from), radius }
}

/// Stored energy, J.
pub fn stored(contacts: &OverlapContacts) -> f64 {
    let one = |share: f64, depth: f64| 0.25 * share * depth * depth;
    contacts.iter().flatten().map(|c| one(c.share, c.interference.depth)).sum()
}

/// Force on A and its moment about the origin.
pub fn pushed(contacts: &OverlapContacts) -> Wrench {
    let mut sum = Wrench::zero();
    for contact in contacts.iter().flatten() {
        let found = contact.interference;
        sum += Wrench::of_force_at(found.normal_b * (0.5 * contact.share * found.depth), &found.deepest_b);
    }
    sum
}

/// Bar moved by a screw: translation and rotation vector.
pub fn moved(a: &Capsule, shift: &Vec3, turn: &Vec3) -> Capsule {
    let turn = Quat::from_scaled_axis(*turn);
    Capsule { ends: a.ends.map(|end| turn * end + shift), radius: a.radius }
}

/// Bar moved along axis `k`, m, or for `k` from 3 on turned about axis `k` − 3, rad.
pub fn moved_by(a: &Capsule, k: usize, by: f64) -> Capsule {
    let (along, none) = (Vec3::ith(k % 3, by), Vec3::zeros());
    if k < 3 { moved(a, &along, &none) } else { moved(a, &none, &along) }
}

/// Component `k` of a wrench: the force, then the moment.
pub fn component(wrench: &Wrench, k: usize) -> f64 {
    if k < 3 { wrench.force[k] } else { wrench.moment[k - 3] }
}

/// Derivative at 0 by central differences of fourth order.
pub fn slope(at: impl Fn(f64) -> f64, step: f64) -> f64 {
    (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step)
}

/// Derivative at 0 by differences; `None` where the slope or the curvature steps, by the force there, N.
pub fn smooth_slope(at: impl Fn(f64) -> f64, step: f64, force: f64) -> Option<f64> {
    let [less, here, more] = [-2.0 * step, 0.0, 2.0 * step].map(&at);
    let [found, twice] = [step, 2.0 * step].map(|step| slope(&at, step));
    let steps =
        (more - 2.0 * here + less).abs() > 1e-3 * force * step || (found - twice).abs() > 3e-7 * force;
    (!steps).then_some(found)
}

/// Unit normals all around, and those of the faces of a polyhedron and between them at its edges.
pub fn normals_around(b: &Polyhedron) -> impl Iterator<Item = Vec3> {
    let faces = b.faces.iter().map(|face| face.normal);
    let edges = b.edges.iter().flat_map(|edge| {
        let [one, other] = edge.faces.map(|face| b.faces[face as usize].normal);
        (1..8).map(move |k| one.lerp(&other, f64::from(k) / 8.0).normalize())
    });
    fibonacci_sphere(300).into_iter().chain(faces).chain(edges)
}

/// Energy gained or lost along a screw, relative to the largest stored; `None` if hardly anything is stored.
pub fn gained_along(
    a: &Capsule,
    shift: &Vec3,
    turn: &Vec3,
    contacts: impl Fn(&Capsule) -> OverlapContacts,
) -> Option<f64> {
    let at = |s: f64| contacts(&moved(a, &(shift * s), &(turn * s)));
    let power = |s: f64| {
        let Wrench { force, moment } = pushed(&at(s));
        // The screw turns about the origin of A's frame, which is at shift·s.
        force.dot(shift) + (moment - (shift * s).cross(&force)).dot(turn)
    };
    gained(|s| stored(&at(s)), power, 1e-4)
}

/// Least value of a function of a normal, by descent from the best `few` of some normals: steps in so many directions, halved
/// down to `last`, rad.
pub fn least_from(
    normals: impl Iterator<Item = Vec3>,
    few: usize,
    (directions, last): (i32, f64),
    value: impl Fn(&Vec3) -> f64,
) -> f64 {
    let mut starts: Vec<(f64, Vec3)> = normals.map(|n| (value(&n), n)).collect();
    starts.sort_by(|x, y| x.0.total_cmp(&y.0));
    let mut least = f64::INFINITY;
    for (mut best, mut n) in starts.into_iter().take(few) {
        let mut step = 0.1;
        while step > last {
            let u = n.cross(&Vec3::ith(n.iamin(), 1.0)).normalize();
            let v = n.cross(&u);
            let tried = (0..directions).map(|k| {
                let (sin, cos) = (TAU * f64::from(k) / f64::from(directions)).sin_cos();
                let n = (n + (u * cos + v * sin) * step).normalize();
                (value(&n), n)
            });
            match tried.min_by(|x, y| x.0.total_cmp(&y.0)) {
                Some((lower, better)) if lower < best => (best, n) = (lower, better),
                _ => step *= 0.5,
            }
        }
        least = least.min(best);
    }
    least
}
