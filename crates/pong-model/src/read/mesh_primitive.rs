//! Triangles, triangle meshes and polyhedra, inline or from a file.

use super::inward::inward_volume_m3;
use super::mesh_file::{self, Mesh};
use super::opened_primitive::Primitive;
use super::reader::{LISTED_PER_MESH, Reader};
use crate::hull::{self, Hull};
use crate::limits::out_of_range;
use crate::model::PrimitiveInfo;
use crate::ron_tree::{Node, Value};
use pong_geometry::Vec3;
use pong_geometry::primitive::{Lean, MayPush, NO_NEIGHBOR, TriangleRecord};

/// Ratio of smallest height to longest edge below which a triangle is refused.
pub(crate) const SLIVER: f64 = 1e-9;

pub(super) fn triangle(
    reader: &mut Reader<'_>,
    p: &mut Primitive<'_, '_>,
    info: PrimitiveInfo,
) -> Option<PrimitiveInfo> {
    let vertices = p.fields.required(reader, "vertices").and_then(|node| reader.vectors::<3>(node, &p.path));
    let Some(vertices) = vertices else {
        options(reader, p);
        return None;
    };
    let mesh = Mesh { vertices: vertices.to_vec(), corners: vec![0, 1, 2], ends: vec![3], ..Mesh::default() };
    add_triangles(reader, p, info, &mesh, |_| None)
}

pub(super) fn triangle_mesh(
    reader: &mut Reader<'_>,
    p: &mut Primitive<'_, '_>,
    info: PrimitiveInfo,
) -> Option<PrimitiveInfo> {
    let Some(mesh) = mesh(reader, p, "triangles") else {
        options(reader, p);
        return None;
    };
    if !reader.judges_shapes {
        options(reader, p);
        indices_of_vertices(reader, p, &mesh, "triangles");
        return None;
    }
    if mesh.face_count() == 0 {
        return reader.refuse(
            p.at,
            &p.path,
            "empty-mesh",
            "the mesh has no triangles",
            "give it some, or remove it",
        );
    }
    let info = add_triangles(reader, p, info, &mesh, Some)?;
    tell_inward(reader, p, &info, &mesh);
    Some(info)
}

/// Warns of a closed mesh from a file that faces inwards, because nothing in the model shows it.
fn tell_inward(reader: &mut Reader<'_>, p: &Primitive<'_, '_>, info: &PrimitiveInfo, mesh: &Mesh) {
    let (from_file, one_sided) = (mesh.at.is_empty(), info.first_mirror == info.elements.end);
    if !from_file || !one_sided {
        return;
    }
    let set = &p.draft.body.triangles;
    let own = &set.triangles[info.elements.start as usize..info.elements.end as usize];
    if let Some(volume_m3) = inward_volume_m3(set, own) {
        let what = format!(
            "the mesh is closed and faces inwards: it holds bodies within its {volume_m3:.3e} m³, and lets them in from \
             outside; turn its normals unless it is a room"
        );
        reader.warn(p.at, &p.path, &what);
    }
}

/// Reads thickness and sidedness.
fn options(reader: &mut Reader<'_>, p: &Primitive<'_, '_>) -> Option<(Option<f64>, bool)> {
    let thickness = match p.fields.optional("thickness") {
        Some(node) => reader.positive(node, &p.path, "the thickness").map(Some),
        None => Some(None),
    };
    let two_sided = match p.fields.optional("two_sided") {
        Some(node) => reader.boolean(node, &p.path),
        None => Some(false),
    };
    Some((thickness?, two_sided?))
}

/// Reports the faults of single faces, but only a limited number of them.
struct FaceFaults<'p> {
    path: &'p str,
    list: &'static str,
    count: usize,
}

impl FaceFaults<'_> {
    fn note(
        &mut self,
        reader: &mut Reader<'_>,
        at: u32,
        face: Option<usize>,
        rule: &'static str,
        what: (String, &str),
    ) {
        self.count += 1;
        if self.count <= LISTED_PER_MESH {
            let path =
                face.map_or(self.path.to_owned(), |face| format!("{}/{}[{face}]", self.path, self.list));
            reader.fault(at, &path, rule, what.0, what.1);
        }
    }

    fn close(&self, reader: &mut Reader<'_>, at: u32) {
        if self.count > LISTED_PER_MESH {
            let cause = format!("{} more faults in this mesh are not listed", self.count - LISTED_PER_MESH);
            reader.fault(at, self.path, "more-faults", cause, "correct those listed first");
        }
    }
}

fn add_triangles(
    reader: &mut Reader<'_>,
    p: &mut Primitive<'_, '_>,
    mut info: PrimitiveInfo,
    mesh: &Mesh,
    name: impl Fn(usize) -> Option<usize>,
) -> Option<PrimitiveInfo> {
    let (thickness, two_sided) = options(reader, p)?;
    let path = p.path.clone();
    let mut faults = FaceFaults { path: &path, list: "triangles", count: 0 };
    let set = &mut p.draft.body.triangles;
    let first = set.triangles.len() as u32;
    for face in 0..mesh.face_count() {
        match triangle_corners(mesh, face, &p.x) {
            Ok(corners) => {
                let vertices = corners.map(|corner| p.draft.welder.weld(corner, &mut set.vertices));
                set.triangles.push(TriangleRecord {
                    vertices,
                    neighbors: [NO_NEIGHBOR; 3],
                    shell: 0,
                    may_push: MayPush::ALL,
                    edge_lean: Lean::ANY,
                    vertex_lean: Lean::ANY,
                });
            }
            Err((rule, cause, cure)) => {
                let at = mesh.face_at(face).unwrap_or(p.at);
                faults.note(reader, at, name(face), rule, (cause, cure));
            }
        }
    }
    faults.close(reader, p.at);
    if faults.count > 0 {
        // Later faults name triangles by their index in the array, so no gap may remain.
        set.triangles.truncate(first as usize);
        return None;
    }
    let end = set.triangles.len() as u32;
    if two_sided {
        set.triangles.extend_from_within(first as usize..);
        for mirror in &mut set.triangles[end as usize..] {
            mirror.vertices.swap(1, 2);
        }
    }
    info.elements = first..set.triangles.len() as u32;
    info.first_mirror = end;
    info.thickness = thickness;
    Some(info)
}

type FaceFault = (&'static str, String, &'static str);

fn triangle_corners(mesh: &Mesh, face: usize, x: &pong_geometry::Transform) -> Result<[Vec3; 3], FaceFault> {
    let indices: [u32; 3] = mesh.face(face).try_into().map_err(|_| {
        let cause = format!("this face has {} corners", mesh.face(face).len());
        ("not-a-triangle", cause, "triangulate the mesh before it is exported")
    })?;
    let mut corners = [Vec3::zeros(); 3];
    for (corner, &index) in corners.iter_mut().zip(&indices) {
        let Some(vertex) = mesh.vertices.get(index as usize) else {
            let cause = format!("there is no vertex {index} among {}", mesh.vertices.len());
            return Err(("index-out-of-range", cause, "indices count from 0"));
        };
        *corner = x.point(vertex);
        if let Some((rule, cause, cure)) = vertex.iter().chain(corner.iter()).find_map(|&x| out_of_range(x)) {
            return Err((rule, format!("vertex {index}: {cause}"), cure));
        }
    }
    if indices[0] == indices[1] || indices[1] == indices[2] || indices[2] == indices[0] {
        return Err((
            "repeated-index",
            format!("{indices:?} names a vertex twice"),
            "a triangle has three vertices",
        ));
    }
    let share = smallest_height_share(&corners);
    if share.is_nan() || share < SLIVER {
        let cause = format!("a sliver: its height is {share:.1e} of its longest edge");
        return Err(("sliver-triangle", cause, "remove it or move a vertex; 1e-9 is the least"));
    }
    Ok(corners)
}

/// Ratio of smallest height to longest edge; scaled first so that no size overflows.
pub(crate) fn smallest_height_share(corners: &[Vec3; 3]) -> f64 {
    let edges = [corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]];
    let longest = edges.iter().map(Vec3::norm).fold(0.0, f64::max);
    if longest == 0.0 {
        return 0.0;
    }
    (edges[0] / longest).cross(&(edges[1] / longest)).norm()
}

/// Reads and checks the shape of a polyhedron, in the frame of its body.
pub(super) fn polyhedron(reader: &mut Reader<'_>, p: &mut Primitive<'_, '_>) -> Option<Hull> {
    let mesh = mesh(reader, p, "faces");
    let inactive = match p.fields.optional("inactive_faces") {
        Some(node) => inactive_faces(reader, node, &p.path, mesh.as_ref().map(Mesh::face_count)),
        None => Some(Vec::new()),
    };
    let mesh = mesh?;
    if !reader.judges_shapes {
        indices_of_vertices(reader, p, &mesh, "faces");
        return None;
    }
    let vertices: Vec<Vec3> = mesh.vertices.iter().map(|v| p.x.point(v)).collect();
    let faces: Vec<&[u32]> = (0..mesh.face_count()).map(|face| mesh.face(face)).collect();
    let mut active = vec![true; faces.len()];
    for face in inactive? {
        active[face] = false;
    }
    match hull::check(&vertices, &faces, &active) {
        Ok(hull) => {
            for what in &hull.remarks {
                reader.warn(p.at, &p.path, what);
            }
            Some(hull)
        }
        Err(problems) => {
            let mut faults = FaceFaults { path: &p.path, list: "faces", count: 0 };
            for problem in problems {
                let at = problem.face.and_then(|face| mesh.face_at(face)).unwrap_or(p.at);
                faults.note(reader, at, problem.face, problem.rule, (problem.cause, problem.cure));
            }
            faults.close(reader, p.at);
            None
        }
    }
}

/// Reports the faces that refer to a missing vertex. This is the only check of a mesh whose shape is not
/// judged.
fn indices_of_vertices(reader: &mut Reader<'_>, p: &Primitive<'_, '_>, mesh: &Mesh, list: &'static str) {
    let mut faults = FaceFaults { path: &p.path, list, count: 0 };
    for face in 0..mesh.face_count() {
        let beyond = mesh.face(face).iter().find(|&&vertex| vertex as usize >= mesh.vertices.len());
        if let Some(vertex) = beyond {
            let cause = format!("there is no vertex {vertex} among {}", mesh.vertices.len());
            let at = mesh.face_at(face).unwrap_or(p.at);
            faults.note(reader, at, Some(face), "index-out-of-range", (cause, "indices count from 0"));
        }
    }
    faults.close(reader, p.at);
}

fn inactive_faces(
    reader: &mut Reader<'_>,
    node: &Node,
    path: &str,
    face_count: Option<usize>,
) -> Option<Vec<usize>> {
    let numbers = reader.numbers(node, path)?;
    let face_count = face_count?;
    let mut faces = Vec::new();
    let mut all_there = true;
    for number in numbers {
        if number >= 0.0 && number.fract() == 0.0 && number < face_count as f64 {
            faces.push(number as usize);
        } else {
            let cause = format!("there is no face {number} among {face_count}");
            reader.fault(
                node.at,
                path,
                "index-out-of-range",
                cause,
                "faces count from 0 in the order of the file",
            );
            all_there = false;
        }
    }
    all_there.then_some(faces)
}

/// Mesh of a primitive, from its fields or from the file it names; indices are not checked yet.
fn mesh(reader: &mut Reader<'_>, p: &Primitive<'_, '_>, faces: &'static str) -> Option<Mesh> {
    let file = p.fields.optional("file");
    let inline = [p.fields.optional("vertices"), p.fields.optional(faces)];
    if let Some(node) = file {
        if inline.iter().any(Option::is_some) {
            let cause = format!("`file` and `vertices`/`{faces}` both give the shape");
            return reader.refuse(node.at, &p.path, "either-or", cause, "keep one of them");
        }
        return mesh_file::from_file(reader, node, p.fields.optional("scale"), &p.path);
    }
    if inline.iter().all(Option::is_none) {
        let cause = "the shape is missing";
        return reader.refuse(
            p.at,
            &p.path,
            "missing-field",
            cause,
            format!("add `file: \"…\"`, or `vertices` and `{faces}`"),
        );
    }
    let scale = match p.fields.optional("scale") {
        Some(node) => reader.positive(node, &p.path, "the scale"),
        None => Some(1.0),
    };
    let vertices = p.fields.required(reader, "vertices").and_then(|node| vertices(reader, node, &p.path));
    let indices = p.fields.required(reader, faces).and_then(|node| indices(reader, node, &p.path, faces));
    let (scale, vertices, mut mesh) = (scale?, vertices?, indices?);
    mesh.vertices = if scale == 1.0 { vertices } else { vertices.into_iter().map(|v| v * scale).collect() };
    Some(mesh)
}

/// Rows of numbers, each with its byte offset; reports everything else as a fault.
fn rows(
    reader: &mut Reader<'_>,
    node: &Node,
    path: &str,
    form: &str,
    mut each: impl FnMut(&mut Reader<'_>, usize, u32, &[f64]),
) -> Option<()> {
    if let Value::Rows(rows) = &node.value {
        for index in 0..rows.len() {
            each(reader, index, rows.at[index], rows.row(index));
        }
        return Some(());
    }
    let mut good = true;
    for (index, item) in reader.list(node, path)?.iter().enumerate() {
        match row_numbers(reader, item, path, form) {
            Some(numbers) => each(reader, index, item.at, &numbers),
            None => good = false,
        }
    }
    good.then_some(())
}

fn row_numbers(reader: &mut Reader<'_>, item: &Node, path: &str, form: &str) -> Option<Vec<f64>> {
    let numbers = match &item.value {
        Value::Numbers(numbers) => return Some(numbers.to_vec()),
        Value::Tuple(None, numbers) | Value::List(numbers) => numbers,
        other => {
            let cause = format!("expected {form}, found {}", other.describe());
            return reader.refuse(item.at, path, "wrong-type", cause, format!("write {form}"));
        }
    };
    let numbers: Vec<_> = numbers.iter().map(|number| reader.any_number(number, path)).collect();
    numbers.into_iter().collect()
}

fn vertices(reader: &mut Reader<'_>, node: &Node, path: &str) -> Option<Vec<Vec3>> {
    let mut vertices = Vec::new();
    let mut faults = 0;
    let path = format!("{path}/vertices");
    rows(reader, node, &path, "(x, y, z)", |reader, index, at, row| {
        let fault = row.iter().find_map(|&x| out_of_range(x));
        if let (&[x, y, z], None) = (row, &fault) {
            vertices.push(Vec3::new(x, y, z));
            return;
        }
        faults += 1;
        if faults <= LISTED_PER_MESH {
            let path = format!("{path}[{index}]");
            let cure = "write three finite numbers (x, y, z)";
            let found = || ("wrong-type", format!("expected (x, y, z), found {} numbers", row.len()), cure);
            let (rule, cause, cure) = fault.filter(|_| row.len() == 3).unwrap_or_else(found);
            reader.fault(at, &path, rule, cause, cure);
        }
    })?;
    (faults == 0).then_some(vertices)
}

fn indices(reader: &mut Reader<'_>, node: &Node, path: &str, list: &'static str) -> Option<Mesh> {
    let mut mesh = Mesh::default();
    let mut faults = FaceFaults { path, list, count: 0 };
    let list_path = format!("{path}/{list}");
    rows(reader, node, &list_path, "a face of vertex indices", |reader, index, at, row| {
        for &number in row {
            if number < 0.0 || number.fract() != 0.0 || number >= f64::from(u32::MAX) || number.is_nan() {
                let cause = format!("{number} is no index");
                faults.note(
                    reader,
                    at,
                    Some(index),
                    "not-an-index",
                    (cause, "indices are whole numbers from 0"),
                );
            }
            mesh.corners.push(number as u32);
        }
        mesh.ends.push(mesh.corners.len() as u32);
        mesh.at.push(at);
    })?;
    faults.close(reader, node.at);
    (faults.count == 0).then_some(mesh)
}
