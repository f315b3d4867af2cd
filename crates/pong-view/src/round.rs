//! Drawings of round parts: outlines revolved about their axes.

use pong_geometry::Vec3;
use pong_geometry::primitive::Stroke;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Vertices of every circle.
const AROUND: u32 = 32;
/// Number of steps along a quarter of a circle in an outline.
const ROUNDING: u32 = 8;

/// Vertices and triangles, counter-clockwise seen from the side on which the surface pushes.
pub(crate) type Mesh = (Vec<Vec3>, Vec<[u32; 3]>);

/// Drawing of a surface of revolution.
pub(crate) fn revolved(origin: &Vec3, axis: &Vec3, outline: &[Stroke]) -> Mesh {
    turned(origin, axis, &outline.iter().flat_map(corners).collect::<Vec<_>>())
}

/// Corners of a stroke, as positions along and away from the axis, m.
fn corners(stroke: &Stroke) -> Vec<(f64, f64)> {
    match *stroke {
        Stroke::Corner { along, aside } => vec![(along, aside)],
        Stroke::Arc { along, aside, radius, quarters: [from, to] } => {
            let steps = ROUNDING * from.abs_diff(to);
            let angle = |k: u32| {
                let share = f64::from(k) / f64::from(steps);
                FRAC_PI_2 * (f64::from(from) + f64::from(to - from) * share)
            };
            let corner = |angle: f64| (along + radius * angle.sin(), aside + radius * angle.cos());
            (0..=steps).map(|k| corner(angle(k))).collect()
        }
    }
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
    use pong_geometry::primitive::{Bore, Capsule, Drawing, Frustum, Primitive};

    fn mesh(part: &dyn Primitive) -> Mesh {
        let Some(Drawing::Revolved { origin, axis, outline }) = part.drawing() else {
            panic!("not revolved")
        };
        revolved(&origin, &axis, &outline)
    }

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
        assert!((volume(&mesh(&cone)) / exact - 1.0).abs() < 1e-12);
        let capsule = Capsule { ends, radius: 0.2 };
        let exact = (pi * 0.04 * length + 4.0 / 3.0 * pi * 0.008) * polygon;
        assert!((volume(&mesh(&capsule)) / exact - 1.0).abs() < 0.01);
        let bore = Bore { hole: cone, thickness: 0.1, mouths: [true; 2] };
        let toward_axis = |t: &[u32; 3], corners: &[Vec3]| {
            let [a, b, c] = t.map(|v| corners[v as usize]);
            let middle = (a + b + c) / 3.0;
            let on_axis = ends[0] + cone.axis * cone.axis.dot(&(middle - ends[0]));
            (b - a).cross(&(c - a)).dot(&(on_axis - middle)) > 0.0
        };
        let (corners, triangles) = mesh(&bore);
        assert!(triangles.iter().all(|t| toward_axis(t, &corners)));
    }
}
