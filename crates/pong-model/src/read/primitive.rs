//! Primitives, one function each.

use super::fields::Fields;
use super::opened_primitive::Primitive;
use super::place::{GroupReader, Place, authored_name, read_name, surface_index};
use super::reader::Reader;
use super::{custom, mesh_primitive, round, size};
use crate::draft::BodyDraft;
use crate::model::{Item, PrimitiveInfo};
use crate::ron_tree::Node;
use crate::schema::{self, Shape};
use pong_geometry::Quat;
use pong_geometry::primitive::{
    Ellipsoid, LineSegment, Plane, Point, PrimitiveKind, Ray, RayResponse, Sphere,
};
use std::collections::HashSet;

pub(super) fn read_primitive(
    groups: &mut GroupReader<'_, '_>,
    node: &Node,
    place: &Place,
    index: usize,
    siblings: &mut HashSet<String>,
) {
    let path = match authored_name(node) {
        Some(name) => format!("{}/{name}", place.path),
        None => format!("{}/primitives[{index}]", place.path),
    };
    let Some(kind) = groups.reader.kind(node, &path, schema::PRIMITIVES) else { return };
    let tables = [schema::PRIMITIVE, kind.fields];
    let Some(fields) = Fields::open(groups.reader, node, &path, &tables) else { return };
    let name = read_name(groups.reader, &fields, &path, siblings);
    let surface = match fields.optional("surface") {
        Some(node) => surface_index(groups.reader, groups.surfaces, node, &path),
        None => place.surface,
    };
    if surface.is_none() {
        let cure = "name one here (`surface: \"…\"`) or in a group above";
        groups.reader.fault(node.at, &path, "no-surface", "this primitive has no surface", cure);
    }
    let draft = &mut groups.bodies[place.body];
    let info = PrimitiveInfo {
        name: name.unwrap_or_default(),
        path: path.clone(),
        kind: primitive_kind(kind.tag),
        surface: surface.unwrap_or(0),
        elements: 0..0,
        shell: 0,
        thickness: None,
        first_mirror: 0,
    };
    let mut primitive = Primitive { fields, at: node.at, path, x: place.x_bg.transform(), draft };
    if let Some(info) = read_shape(groups.reader, &mut primitive, kind.tag, info)
        && size::check(groups.reader, draft, &info, node.at)
    {
        place_items(draft, place.group, &info);
        draft.body.surfaces.push(info.surface);
        draft.body.primitives.push(info);
        draft.primitive_at.push(node.at);
        draft.is_solid.push(place.solid);
        draft.one_surface.push(place.one_surface);
        draft.lone_triangle.push(kind.tag == Shape::Triangle);
    }
}

fn place_items(draft: &mut BodyDraft, group: usize, info: &PrimitiveInfo) {
    let primitive = draft.body.primitives.len() as u32;
    let items = info.elements.clone().map(|element| Item { primitive, element });
    draft.groups[group].items.extend(items);
}

fn primitive_kind(shape: Shape) -> PrimitiveKind {
    match shape {
        Shape::Point => PrimitiveKind::Point,
        Shape::LineSegment => PrimitiveKind::LineSegment,
        Shape::Ray => PrimitiveKind::Ray,
        Shape::Sphere => PrimitiveKind::Sphere,
        Shape::Ellipsoid => PrimitiveKind::Ellipsoid,
        Shape::Plane => PrimitiveKind::Plane,
        Shape::Triangle | Shape::TriangleMesh => PrimitiveKind::Triangle,
        Shape::Polyhedron => PrimitiveKind::Polyhedron,
        Shape::Capsule => PrimitiveKind::Capsule,
        Shape::Cylinder => PrimitiveKind::Cylinder,
        Shape::Cone => PrimitiveKind::Cone,
        Shape::Bore => PrimitiveKind::Bore,
        Shape::Custom => PrimitiveKind::Custom,
    }
}

/// Reads the shape into the arrays of its kind; `None` if it is faulty.
fn read_shape(
    reader: &mut Reader<'_>,
    p: &mut Primitive<'_, '_>,
    shape: Shape,
    mut info: PrimitiveInfo,
) -> Option<PrimitiveInfo> {
    let count = match shape {
        Shape::Triangle => return mesh_primitive::triangle(reader, p, info),
        Shape::TriangleMesh => return mesh_primitive::triangle_mesh(reader, p, info),
        Shape::Point => {
            let point = point(reader, p)?;
            push(&mut p.draft.body.points, point)
        }
        Shape::Plane => {
            let plane = plane(reader, p)?;
            push(&mut p.draft.body.planes, plane)
        }
        Shape::LineSegment => {
            let segment = segment(reader, p)?;
            push(&mut p.draft.body.segments, segment)
        }
        Shape::Ray => {
            let ray = ray(reader, p)?;
            push(&mut p.draft.body.rays, ray)
        }
        Shape::Sphere => {
            let sphere = sphere(reader, p)?;
            push(&mut p.draft.body.spheres, sphere)
        }
        Shape::Ellipsoid => {
            let ellipsoid = ellipsoid(reader, p)?;
            push(&mut p.draft.body.ellipsoids, ellipsoid)
        }
        Shape::Polyhedron => {
            let hull = mesh_primitive::polyhedron(reader, p)?;
            push(&mut p.draft.hulls, hull)
        }
        Shape::Capsule => {
            let capsule = round::capsule(reader, p)?;
            push(&mut p.draft.body.capsules, capsule)
        }
        Shape::Cylinder => {
            let cylinder = round::cylinder(reader, p)?;
            push(&mut p.draft.body.frusta, cylinder)
        }
        Shape::Cone => {
            let cone = round::cone(reader, p)?;
            push(&mut p.draft.body.frusta, cone)
        }
        Shape::Bore => {
            let bore = round::bore(reader, p)?;
            push(&mut p.draft.body.bores, bore)
        }
        Shape::Custom => {
            let primitive = custom::custom(reader, p)?;
            push(&mut p.draft.body.customs, primitive)
        }
    };
    info.elements = count - 1..count;
    info.first_mirror = count;
    Some(info)
}

fn push<T>(array: &mut Vec<T>, element: T) -> u32 {
    array.push(element);
    array.len() as u32
}

fn point(reader: &mut Reader<'_>, p: &Primitive<'_, '_>) -> Option<Point> {
    let position = p.fields.required(reader, "position").and_then(|node| reader.vector(node, &p.path))?;
    Some(Point { position: p.x.point(&position) })
}

fn plane(reader: &mut Reader<'_>, p: &Primitive<'_, '_>) -> Option<Plane> {
    let normal = p
        .fields
        .required(reader, "normal")
        .and_then(|node| reader.direction(node, &p.path, "the plane's normal"));
    let offset = p.fields.required(reader, "offset").and_then(|node| reader.number(node, &p.path));
    let normal = p.x.vector(&normal?).normalize();
    Some(Plane { normal, offset: offset? + normal.dot(&p.x.translation) })
}

fn segment(reader: &mut Reader<'_>, p: &Primitive<'_, '_>) -> Option<LineSegment> {
    let node = p.fields.required(reader, "ends")?;
    let ends = reader.vectors::<2>(node, &p.path)?.map(|end| p.x.point(&end));
    if reader.judges_shapes && ends[0] == ends[1] {
        let cause = "both ends of the segment are the same place";
        return reader.refuse(node.at, &p.path, "zero-length", cause, "move one end, or use a Point");
    }
    Some(LineSegment { ends })
}

fn ray(reader: &mut Reader<'_>, p: &Primitive<'_, '_>) -> Option<Ray> {
    let origin = p.fields.required(reader, "origin").and_then(|node| reader.vector(node, &p.path));
    let direction = p
        .fields
        .required(reader, "direction")
        .and_then(|node| reader.direction(node, &p.path, "the direction"));
    let length =
        p.fields.required(reader, "length").and_then(|node| reader.positive(node, &p.path, "the length"));
    let reach = match p.fields.optional("reach") {
        Some(node) => reader.not_negative(node, &p.path, "the reach").map(Some),
        None => Some(None),
    };
    let response = match p.fields.optional("response") {
        Some(node) => reader.variant(node, &p.path, &["Normal", "Axial"]),
        None => Some("Normal"),
    };
    let (reach, response) = (reach?, response?);
    let response = if response == "Axial" { RayResponse::Axial } else { RayResponse::Normal };
    let direction = p.x.vector(&direction?).normalize();
    Some(Ray { origin: p.x.point(&origin?), direction, length: length?, reach, response })
}

fn sphere(reader: &mut Reader<'_>, p: &Primitive<'_, '_>) -> Option<Sphere> {
    let center = p.fields.required(reader, "center").and_then(|node| reader.vector(node, &p.path));
    let radius =
        p.fields.required(reader, "radius").and_then(|node| reader.positive(node, &p.path, "the radius"));
    Some(Sphere { center: p.x.point(&center?), radius: radius? })
}

fn ellipsoid(reader: &mut Reader<'_>, p: &Primitive<'_, '_>) -> Option<Ellipsoid> {
    let center = p.fields.required(reader, "center").and_then(|node| reader.vector(node, &p.path));
    let semi_axes = p.fields.required(reader, "semi_axes").and_then(|node| {
        let axes = reader.vector(node, &p.path)?;
        if axes.min() > 0.0 {
            return Some(axes);
        }
        let cause = format!("a semi-axis is {}", axes.min());
        reader.refuse(node.at, &p.path, "not-positive", cause, "all three must be above zero")
    });
    let orientation = match p.fields.optional("orientation") {
        Some(node) => reader.rotation(node, &p.path)?,
        None => Quat::identity(),
    };
    let axes = p.x.rotation * orientation.to_rotation_matrix().into_inner();
    Some(Ellipsoid { center: p.x.point(&center?), axes, semi_axes: semi_axes? })
}
