//! Checks of single shapes, and bounding volumes of valid models.

use crate::arrays::{refused, rows};
use crate::errors::bad_value;
use numpy::{AllowTypeChange, IntoPyArray, PyArray1, PyArray2, PyArrayLike3, PyUntypedArrayMethods};
use pong_geometry::bounding::Volume;
use pong_geometry::{Mat3, Vec3};
use pong_model::shapes;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::HashSet;

/// Lists the faults of a polyhedron found by the first check that fails.
///
/// Parameters
/// ----------
/// vertices : array_like, shape (n, 3)
///     Vertices, m.
/// faces : sequence of sequence of int
///     Indices of the vertices of each face.
/// inactive : sequence of int, optional
///     Faces that take no contact.
///
/// Returns
/// -------
/// list[dict[str, Any]]
///     Faults; empty if it is valid.
#[pyfunction]
#[pyo3(signature = (vertices, faces, inactive = Vec::new()))]
pub(crate) fn check_polyhedron<'py>(
    py: Python<'py>,
    vertices: Bound<'py, PyAny>,
    faces: Vec<Vec<u32>>,
    inactive: Vec<usize>,
) -> PyResult<Vec<Bound<'py, PyDict>>> {
    let array = rows("vertices", &vertices, vertices.len()?, 3)?;
    let places = array.as_array();
    if let Some(face) = inactive.iter().find(|&&face| face >= faces.len()) {
        let cause = format!("there is no face {face} among {}", faces.len());
        return Err(bad_value("inactive", cause, "faces count from 0"));
    }
    let places: Vec<Vec3> = places.rows().into_iter().map(|p| Vec3::new(p[0], p[1], p[2])).collect();
    let faults = py.detach(|| {
        let faces: Vec<&[u32]> = faces.iter().map(Vec::as_slice).collect();
        shapes::check_polyhedron(&places, &faces, &inactive)
    });
    let told = |fault: shapes::PolyhedronFault| {
        let entry = PyDict::new(py);
        entry.set_item("rule", fault.rule)?;
        entry.set_item("cause", fault.cause)?;
        entry.set_item("cure", fault.cure)?;
        entry.set_item("face", fault.face)?;
        let places = fault.places.iter().map(|place| (place.x, place.y, place.z));
        entry.set_item("places", places.collect::<Vec<_>>())?;
        entry.set_item("off", fault.off)?;
        Ok(entry)
    };
    faults.into_iter().map(told).collect()
}

/// Lists faults and oddities of the triangles of one body.
///
/// Parameters
/// ----------
/// corners : array_like, shape (n, 3, 3)
///     Corners of the triangles, m.
///
/// Returns
/// -------
/// list[dict[str, Any]]
///     An entry for each rule.
#[pyfunction]
#[pyo3(signature = (corners))]
pub(crate) fn check_triangles<'py>(
    py: Python<'py>,
    corners: Bound<'py, PyAny>,
) -> PyResult<Vec<Bound<'py, PyDict>>> {
    let given = corners;
    let cure = "give three corners (x, y, z) for each triangle: shape (n, 3, 3)";
    let corners = given.extract::<PyArrayLike3<'py, f64, AllowTypeChange>>();
    let corners = corners.ok().filter(|corners| corners.shape()[1..] == [3, 3]);
    let corners = corners.ok_or_else(|| refused("corners", &given, cure))?;
    let shape = corners.shape();
    let view = corners.as_array();
    let place = |t: usize, k: usize| Vec3::new(view[[t, k, 0]], view[[t, k, 1]], view[[t, k, 2]]);
    let triangles: Vec<[Vec3; 3]> = (0..shape[0]).map(|t| [0, 1, 2].map(|k| place(t, k))).collect();
    if let Some(index) = triangles.iter().position(|corners| corners.iter().flatten().any(|x| !x.is_finite()))
    {
        let cause = format!("triangle {index} has a coordinate that is no finite number");
        return Err(bad_value("corners", cause, "give finite numbers"));
    }
    let told = |fault: shapes::TriangleFault| {
        let entry = PyDict::new(py);
        entry.set_item("severity", if fault.is_error { "error" } else { "warning" })?;
        entry.set_item("rule", fault.rule)?;
        entry.set_item("cause", fault.cause)?;
        entry.set_item("cure", fault.cure)?;
        let triangles: Vec<i64> = fault.triangles.into_iter().map(i64::from).collect();
        entry.set_item("triangles", triangles.into_pyarray(py))?;
        Ok(entry)
    };
    let faults = py.detach(|| shapes::check_triangles(&triangles));
    faults.into_iter().map(told).collect()
}

/// Bounding volume of every group that has one, with the groups of each movable group together, outer ones
/// first.
pub(crate) fn bounds<'py>(py: Python<'py>, model: &pong_model::Model) -> PyResult<Vec<Bound<'py, PyDict>>> {
    let mut found = Vec::new();
    for body in model.bodies.iter().filter(|body| !body.primitives.is_empty()) {
        // Leaves split off a group have its path and come after it.
        let mut told = HashSet::new();
        for node in body.tree.nodes.iter().filter(|node| told.insert(&*node.group)) {
            let entry = PyDict::new(py);
            entry.set_item("path", &*node.group)?;
            entry.set_item("movable_group", &body.path)?;
            entry.set_item("kind", node.volume.kind_name())?;
            if let Some((center, half, axes)) = box_of(&node.volume) {
                entry.set_item("center", numbers(py, &center))?;
                entry.set_item("half", numbers(py, &half))?;
                let columns: Vec<Vec<f64>> =
                    axes.row_iter().map(|row| row.iter().copied().collect()).collect();
                entry.set_item("axes", PyArray2::from_vec2(py, &columns)?)?;
            }
            found.push(entry);
        }
    }
    Ok(found)
}

fn numbers<'py>(py: Python<'py>, v: &Vec3) -> Bound<'py, PyArray1<f64>> {
    PyArray1::from_slice(py, v.as_slice())
}

/// Centre, half extents and axes; a sphere's half extents are its radius. `None` for unbounded or
/// host-defined volumes.
fn box_of(volume: &Volume) -> Option<(Vec3, Vec3, Mat3)> {
    match volume {
        Volume::Aabb { center, half } => Some((*center, *half, Mat3::identity())),
        Volume::Sphere { center, radius } => Some((*center, Vec3::repeat(*radius), Mat3::identity())),
        Volume::Obb { center, axes, half } => Some((*center, *half, *axes)),
        _ => None,
    }
}
