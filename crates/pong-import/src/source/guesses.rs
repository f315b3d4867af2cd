//! Notes on doubtful assumptions: OBJ and STL files give neither unit nor upward axis.

use super::reading::Reading;
use super::tree::{Shape, Source};
use crate::findings::Findings;
use nalgebra::Vector3;

/// Models longer than this, read in metres, are probably in millimetres, m.
const LONG_M: f64 = 10.0;
/// Corners this near the lowest point, in lengths of the whole, lie on the ground.
const GROUND_SHARE: f64 = 1e-3;
/// Least area on the ground that a model stands on, as a share of its squared length. An area below a tenth of
/// that on another axis does not count.
const FOOT_SHARE: f64 = 1e-2;

/// Notes for a file of a format without a unit and an upward axis.
pub(super) fn tell(source: &Source, reading: &Reading, file: &str, findings: &mut Findings) {
    let places =
        || source.nodes.iter().filter_map(|node| node.mesh.as_ref()).flat_map(|shape| &shape.vertices);
    let none = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    let (low, high) = places().fold(none, |(low, high), place| (low.inf(place), high.sup(place)));
    let length = (high - low).max();
    if reading.unit_m == 1.0 && length > LONG_M {
        let cause = format!(
            "it is {length:.4} m long if one unit is a metre, which was assumed: the format tells no unit"
        );
        let cure = format!("if it is in millimetres, {:.4} m, say --unit 1mm", 1e-3 * length);
        findings.note(file, "unit-assumed", cause, cure);
    }
    // With an axis given by the caller nothing was assumed.
    if reading.up.is_some() || length.is_nan() || length <= 0.0 {
        return;
    }
    let [_, on_y, on_z] = [0, 1, 2].map(|axis| foot(source, axis, low[axis] + GROUND_SHARE * length));
    if on_y > FOOT_SHARE * length * length && on_z < 0.1 * on_y {
        let cause = format!(
            "it stands on {on_y:.2e} m² at its lowest y and on {on_z:.2e} m² at its lowest z: y may point up, and z was assumed"
        );
        findings.note(file, "up-assumed", cause, "if y points up, say --up y; else say --up z");
    }
}

/// Area of the triangles that lie below a height on one axis, m².
fn foot(source: &Source, axis: usize, height: f64) -> f64 {
    let shapes = source.nodes.iter().filter_map(|node| node.mesh.as_ref());
    let area = |shape: &Shape| -> f64 {
        let corners = shape.triangles.iter().map(|triangle| triangle.map(|v| shape.vertices[v as usize]));
        let low = corners.filter(|corners| corners.iter().all(|corner| corner[axis] <= height));
        low.map(|[a, b, c]| 0.5 * (b - a).cross(&(c - a)).norm()).sum()
    };
    shapes.map(area).sum()
}
