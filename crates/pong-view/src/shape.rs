//! Drawing of a body: its primitives as numbers for the page. Bodies with the same model share it.

use crate::blob::{Blob, Column};
use crate::hull::hull;
use crate::round;
use crate::surface::Surface;
use pong_geometry::extension::PrimitiveRef;
use pong_geometry::primitive::Drawing;
use pong_geometry::{Mat3, Quat, Vec3};
use pong_model::{MovableGroup, PrimitiveInfo};
use serde::Serialize;
use std::collections::BTreeMap;

/// One primitive of a shape.
#[derive(Debug, Serialize)]
pub(crate) struct Part {
    path: String,
    kind: &'static str,
    surface: String,
    /// First triangle, or first entry of its kind's column.
    first: u32,
    /// Number of triangles; 1 for kinds without any.
    count: u32,
}

/// A body's primitives. Lengths in m, in the frame of the body.
#[derive(Debug, Serialize)]
pub(crate) struct Shape {
    parts: Vec<Part>,
    #[serde(skip)]
    by_path: BTreeMap<String, usize>,
    /// Largest distance of anything bounded from the body's origin, m.
    radius: f64,
    /// Vertices of all triangles, (x, y, z).
    vertices: Column,
    /// Three vertices each: faces of polyhedra, triangles, hulls of custom primitives.
    triangles: Column,
    /// Two vertices each: the free edges and creases to draw.
    edges: Column,
    /// Positions (x, y, z).
    points: Column,
    /// Both end points.
    segments: Column,
    /// Origin and tip.
    rays: Column,
    /// Centre, semi-axes, quaternion (w, x, y, z): spheres and ellipsoids.
    balls: Column,
    /// Normal and offset.
    planes: Column,
}

/// A shape being built.
#[derive(Default)]
struct Draft {
    surface: Surface,
    points: Vec<f64>,
    segments: Vec<f64>,
    rays: Vec<f64>,
    balls: Vec<f64>,
    planes: Vec<f64>,
    radius: f64,
}

impl Shape {
    pub fn new(body: &MovableGroup, surfaces: &[pong_model::Surface], blob: &mut Blob) -> Self {
        let mut draft = Draft::default();
        draft.surface.take_vertices(&body.triangles);
        let name = |info: &PrimitiveInfo| surfaces[info.surface as usize].name.clone();
        let parts = body.primitives.iter().map(|info| draft.part(body, info, name(info))).collect();
        let by_path = body.primitives.iter().map(|info| info.path.clone()).zip(0..).collect();
        draft.surface.add_creases(body);
        let radius = draft.radius.max(draft.surface.radius());
        Self {
            parts,
            by_path,
            radius,
            vertices: blob.f32s(draft.surface.vertices.iter().flat_map(|v| [v.x, v.y, v.z])),
            triangles: blob.u32s(draft.surface.triangles.into_iter().flatten()),
            edges: blob.u32s(draft.surface.edges.into_iter().flatten()),
            points: blob.f32s(draft.points),
            segments: blob.f32s(draft.segments),
            rays: blob.f32s(draft.rays),
            balls: blob.f32s(draft.balls),
            planes: blob.f32s(draft.planes),
        }
    }

    /// Largest distance of anything bounded from the body's origin, m.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The primitive with that path.
    pub fn part(&self, path: &str) -> Option<usize> {
        self.by_path.get(path).copied()
    }

    /// Number of triangles.
    pub fn triangle_count(&self) -> usize {
        self.triangles.length() / 3
    }
}

impl Draft {
    fn part(&mut self, body: &MovableGroup, info: &PrimitiveInfo, surface: String) -> Part {
        let (first, count) = self.place(body, info);
        Part { path: info.path.clone(), kind: info.kind.name(), surface, first, count }
    }

    /// Adds a primitive; returns its range (first and count).
    fn place(&mut self, body: &MovableGroup, info: &PrimitiveInfo) -> (u32, u32) {
        match body.element(info.kind, info.elements.start) {
            PrimitiveRef::Triangle(set, _) => self.surface.add_mesh(set, info),
            PrimitiveRef::Polyhedron(polyhedron) => self.surface.add_polyhedron(polyhedron),
            PrimitiveRef::Custom(custom) => self.surface.add_hull(&hull(custom)),
            other => {
                let drawing = other.facts().and_then(|facts| facts.drawing());
                self.draw(&drawing.expect("only meshes, polyhedra and custom primitives have no drawing"))
            }
        }
    }

    fn draw(&mut self, drawing: &Drawing) -> (u32, u32) {
        let numbers = |ends: &[Vec3; 2]| ends.map(|end| [end.x, end.y, end.z]).into_iter().flatten();
        match drawing {
            Drawing::Point(place) => {
                self.reach(place, 0.0);
                one(&mut self.points, 3, place.iter().copied())
            }
            Drawing::Segment(ends) => {
                ends.iter().for_each(|end| self.reach(end, 0.0));
                one(&mut self.segments, 6, numbers(ends))
            }
            Drawing::Ray(ends) => {
                ends.iter().for_each(|end| self.reach(end, 0.0));
                one(&mut self.rays, 6, numbers(ends))
            }
            Drawing::Ball { center, axes, semi_axes } => self.ball(center, semi_axes, axes),
            Drawing::Plane { normal, offset } => {
                one(&mut self.planes, 4, normal.iter().copied().chain([*offset]))
            }
            Drawing::Revolved { origin, axis, outline } => {
                self.surface.add_hull(&round::revolved(origin, axis, outline))
            }
        }
    }

    fn ball(&mut self, center: &Vec3, semi_axes: &Vec3, axes: &Mat3) -> (u32, u32) {
        self.reach(center, semi_axes.max());
        // A left-handed set of axes describes the same ellipsoid as the right-handed one.
        let mut axes = *axes;
        if axes.determinant() < 0.0 {
            axes.neg_mut();
        }
        let q = Quat::from_matrix(&axes);
        let numbers = center.iter().chain(semi_axes).copied().chain([q.w, q.i, q.j, q.k]);
        one(&mut self.balls, 10, numbers)
    }

    fn reach(&mut self, place: &Vec3, radius: f64) {
        self.radius = self.radius.max(place.norm() + radius);
    }
}

/// Appends the numbers of one primitive, `width` each; returns its range.
fn one(column: &mut Vec<f64>, width: usize, numbers: impl Iterator<Item = f64>) -> (u32, u32) {
    let first = column.len() / width;
    column.extend(numbers);
    (first as u32, 1)
}
