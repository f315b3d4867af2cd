//! Drawings of round parts: outlines revolved about their axes.

use pong_geometry::Vec3;
use pong_geometry::primitive::{Bore, Capsule, Frustum};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Vertices of every circle.
const AROUND: u32 = 32;
/// Number of steps along the outline of half a ball.
const ROUNDING: u32 = 8;

/// Vertices and triangles, counter-clockwise seen from the side on which the surface pushes.
pub(crate) type Mesh = (Vec<Vec3>, Vec<[u32; 3]>);

pub(crate) fn of_capsule(capsule: &Capsule) -> Mesh {
    let [one, other] = capsule.ends;
    let length = (other - one).norm();
    let on_ball =
        |middle: f64, angle: f64| (middle + capsule.radius * angle.sin(), capsule.radius * angle.cos());
    let step = |k: u32| FRAC_PI_2 * f64::from(k) / f64::from(ROUNDING);
    let first = (0..=ROUNDING).map(|k| on_ball(0.0, step(k) - FRAC_PI_2));
    let second = (0..=ROUNDING).map(|k| on_ball(length, step(k)));
    turned(&one, &((other - one) / length), &first.chain(second).collect::<Vec<_>>())
}

pub(crate) fn of_frustum(frustum: &Frustum) -> Mesh {
    let [one, other] = frustum.radii;
    let outline = [(0.0, 0.0), (0.0, one), (frustum.length, other), (frustum.length, 0.0)];
    turned(&frustum.ends[0], &frustum.axis, &outline)
}

/// The wall alone, seen from inside.
pub(crate) fn of_bore(bore: &Bore) -> Mesh {
    let hole = &bore.hole;
    turned(&hole.ends[0], &hole.axis, &[(hole.length, hole.radii[1]), (0.0, hole.radii[0])])
}

/// Revolves an outline, given as positions along and away from the axis, m.
fn turned(origin: &Vec3, axis: &Vec3, outline: &[(f64, f64)]) -> Mesh {
    let across = axis.cross(&Vec3::ith(axis.iamin(), 1.0)).normalize();
    let other = axis.cross(&across);
    let circle = |&(along, aside): &(f64, f64)| {
        let middle = origin + axis * along;
        (0..AROUND).map(move |k| {
            let angle = TAU * f64::from(k) / f64::from(AROUND);
            middle + (across * angle.cos() + other * angle.sin()) * aside
        })
    };
    let corners = outline.iter().flat_map(circle).collect();
    let strips = 0..outline.len() as u32 - 1;
    let triangles = strips.flat_map(|strip| (0..AROUND).flat_map(move |k| quad(strip * AROUND, k))).collect();
    (corners, triangles)
}

/// The two triangles between vertex `k` of a circle, the next vertex, and the following circle.
fn quad(circle: u32, k: u32) -> [[u32; 3]; 2] {
    let next = (k + 1) % AROUND;
    let (a, b, c, d) = (circle + k, circle + next, circle + AROUND + next, circle + AROUND + k);
    [[a, b, c], [a, c, d]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six times the volume enclosed by triangles.
    fn volume((corners, triangles): &Mesh) -> f64 {
        let of = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| corners[v as usize]);
            a.dot(&b.cross(&c)) / 6.0
        };
        triangles.iter().map(of).sum()
    }

    /// Enclosed volumes agree with the formulas, except for the polygons in place of circles: front faces are
    /// outside.
    #[test]
    fn pictures_enclose_the_volumes_of_the_parts() {
        let polygon = f64::from(AROUND) / TAU * (TAU / f64::from(AROUND)).sin();
        let ends = [Vec3::new(0.3, -0.2, 0.5), Vec3::new(1.1, 0.4, -0.3)];
        let length = (ends[1] - ends[0]).norm();
        let pi = std::f64::consts::PI;
        let cone = Frustum::new(ends, [0.3, 0.1]);
        let exact = pi * length / 3.0 * (0.09 + 0.03 + 0.01) * polygon;
        assert!((volume(&of_frustum(&cone)) / exact - 1.0).abs() < 1e-12);
        let capsule = Capsule { ends, radius: 0.2 };
        let exact = (pi * 0.04 * length + 4.0 / 3.0 * pi * 0.008) * polygon;
        assert!((volume(&of_capsule(&capsule)) / exact - 1.0).abs() < 0.01);
        let bore = Bore { hole: cone, thickness: 0.1, mouths: [true; 2] };
        let toward_axis = |t: &[u32; 3], corners: &[Vec3]| {
            let [a, b, c] = t.map(|v| corners[v as usize]);
            let middle = (a + b + c) / 3.0;
            let on_axis = ends[0] + cone.axis * cone.axis.dot(&(middle - ends[0]));
            (b - a).cross(&(c - a)).dot(&(on_axis - middle)) > 0.0
        };
        let (corners, triangles) = of_bore(&bore);
        assert!(triangles.iter().all(|t| toward_axis(t, &corners)));
    }
}
