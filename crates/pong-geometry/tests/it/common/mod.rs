//! Shapes and numbers shared by the geometry tests.

pub mod bars;
pub mod levels;
pub mod paths;

use pong_geometry::primitive::{
    EdgePush, Ellipsoid, Lean, MayPush, NO_NEIGHBOR, Polyhedron, PolyhedronEdge, PolyhedronFace,
    PolyhedronParts, PolyhedronVertex, RimEdge, TriangleRecord, TriangleSet,
};
use pong_geometry::{Transform, Vec3};

pub use pong_testkit::Random;

/// Random rigid transform, its translation at most `reach` long.
pub fn random_motion(random: &mut Random, reach: f64) -> Transform {
    Transform {
        rotation: random.rotation_matrix(),
        translation: random.direction() * random.between(0.0, reach),
    }
}

/// `count` points spread evenly over the unit sphere.
pub fn fibonacci_sphere(count: usize) -> Vec<Vec3> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..count)
        .map(|i| {
            let z = 1.0 - (2.0 * i as f64 + 1.0) / count as f64;
            let radius = (1.0 - z * z).sqrt();
            let angle = golden * i as f64;
            Vec3::new(radius * angle.cos(), radius * angle.sin(), z)
        })
        .collect()
}

/// A closed hull with `2·vertices − 4` triangular faces: an even sphere stretched along the axes.
pub fn stretched_hull(vertices: usize, stretch: Vec3) -> Polyhedron {
    let points: Vec<Vec3> = fibonacci_sphere(vertices).iter().map(|p| p.component_mul(&stretch)).collect();
    hull(&points)
}

/// An axis-aligned box.
pub fn cuboid(low: Vec3, high: Vec3) -> Polyhedron {
    hull(&cuboid_corners(low, high))
}

/// The corners of an axis-aligned box.
pub fn cuboid_corners(low: Vec3, high: Vec3) -> Vec<Vec3> {
    let mut corners = Vec::new();
    for x in [low.x, high.x] {
        for y in [low.y, high.y] {
            for z in [low.z, high.z] {
                corners.push(Vec3::new(x, y, z));
            }
        }
    }
    corners
}

/// The convex hull of points in convex position, all faces active.
pub fn hull(points: &[Vec3]) -> Polyhedron {
    hull_with_walls(points, &|_, _| false)
}

/// [`hull`] in which `is_wall` (outward normal, offset) makes a face an inactive internal face. Edges and
/// vertices on it do not push; other pieces are not considered.
pub fn hull_with_walls(points: &[Vec3], is_wall: &dyn Fn(&Vec3, f64) -> bool) -> Polyhedron {
    let diameter = largest_distance(points);
    let outlines = hull_outlines(points, 1e-9 * diameter);
    let mut polyhedron = PolyhedronParts {
        faces: Vec::new(),
        rims: Vec::new(),
        edges: Vec::new(),
        vertices: Vec::new(),
        cone_edges: Vec::new(),
        diameter,
    };
    for (normal, outline) in &outlines {
        let offset = outline.iter().map(|&v| normal.dot(&points[v])).sum::<f64>() / outline.len() as f64;
        polyhedron.faces.push(PolyhedronFace {
            normal: *normal,
            offset,
            active: !is_wall(normal, offset),
            closed: false,
            first_rim: polyhedron.rims.len() as u32,
            rim_count: outline.len() as u32,
        });
        for (k, &start) in outline.iter().enumerate() {
            let end = outline[(k + 1) % outline.len()];
            push_rim(&mut polyhedron, points, &outlines, start, end, *normal);
        }
    }
    set_edge_pushes(&mut polyhedron);
    push_vertices(&mut polyhedron, points);
    Polyhedron::new(polyhedron)
}

fn push_rim(
    polyhedron: &mut PolyhedronParts,
    points: &[Vec3],
    outlines: &[(Vec3, Vec<usize>)],
    start: usize,
    end: usize,
    normal: Vec3,
) {
    let face = polyhedron.faces.len() - 1;
    let has = |outline: &[usize]| {
        (0..outline.len()).any(|k| outline[k] == end && outline[(k + 1) % outline.len()] == start)
    };
    let neighbor = outlines.iter().position(|(_, outline)| has(outline)).expect("the hull is closed");
    let key = |v: usize| (points[v].x, points[v].y, points[v].z);
    let [first, second] = if key(start) < key(end) { [start, end] } else { [end, start] };
    let ends = [first as u32, second as u32];
    let edge = polyhedron.edges.iter().position(|e| e.vertices == ends).unwrap_or_else(|| {
        polyhedron.edges.push(PolyhedronEdge {
            vertices: ends,
            faces: [face as u32, neighbor as u32],
            direction: (points[second] - points[first]).normalize(),
            push: None,
            convex: None,
        });
        polyhedron.edges.len() - 1
    });
    polyhedron.rims.push(RimEdge {
        start: start as u32,
        edge: edge as u32,
        neighbor: neighbor as u32,
        anchor: points[first],
        outward: (points[end] - points[start]).normalize().cross(&normal).normalize(),
    });
}

fn set_edge_pushes(polyhedron: &mut PolyhedronParts) {
    for index in 0..polyhedron.edges.len() {
        let faces = polyhedron.edges[index].faces.map(|f| f as usize);
        if faces.iter().all(|&f| polyhedron.faces[f].active) {
            let outward = |f: usize| {
                polyhedron
                    .rim(f)
                    .iter()
                    .find(|rim| rim.edge as usize == index)
                    .expect("rim of the edge")
                    .outward
            };
            let push =
                EdgePush { normals: faces.map(|f| polyhedron.faces[f].normal), outwards: faces.map(outward) };
            (polyhedron.edges[index].push, polyhedron.edges[index].convex) = (Some(push), Some(push));
        }
    }
}

fn push_vertices(polyhedron: &mut PolyhedronParts, points: &[Vec3]) {
    for (index, position) in points.iter().enumerate() {
        let first_cone = polyhedron.cone_edges.len() as u32;
        let mut pushes = true;
        for edge in &polyhedron.edges {
            if let Some(end) = edge.vertices.iter().position(|&v| v as usize == index) {
                polyhedron.cone_edges.push(if end == 0 { edge.direction } else { -edge.direction });
                pushes &= edge.faces.iter().all(|&f| polyhedron.faces[f as usize].active);
            }
        }
        let cone_count = polyhedron.cone_edges.len() as u32 - first_cone;
        polyhedron.vertices.push(PolyhedronVertex { position: *position, pushes, first_cone, cone_count });
    }
}

fn largest_distance(points: &[Vec3]) -> f64 {
    let mut largest = 0.0_f64;
    for a in points {
        for b in points {
            largest = largest.max((a - b).norm());
        }
    }
    largest
}

/// Outward normal and counter-clockwise outline of every face, by trying all triples of points.
fn hull_outlines(points: &[Vec3], tolerance: f64) -> Vec<(Vec3, Vec<usize>)> {
    let mut found: Vec<(Vec3, Vec<usize>)> = Vec::new();
    let count = points.len();
    let triples = (0..count).flat_map(|i| {
        // The lowest index first; both orientations of the other two.
        (i + 1..count).flat_map(move |j| (i + 1..count).filter(move |&k| k != j).map(move |k| [i, j, k]))
    });
    for triple in triples {
        let Some((normal, members)) = face_through(points, triple, tolerance) else { continue };
        if !found.iter().any(|(_, outline)| members.iter().all(|m| outline.contains(m))) {
            found.push((normal, ordered(points, &normal, &members)));
        }
    }
    found
}

fn face_through(points: &[Vec3], [i, j, k]: [usize; 3], tolerance: f64) -> Option<(Vec3, Vec<usize>)> {
    let cross = (points[j] - points[i]).cross(&(points[k] - points[i]));
    let normal = cross.try_normalize(tolerance * tolerance)?;
    let mut members = Vec::new();
    for (index, p) in points.iter().enumerate() {
        let height = normal.dot(&(p - points[i]));
        if height > tolerance {
            return None;
        }
        if height >= -tolerance {
            members.push(index);
        }
    }
    Some((normal, members))
}

fn ordered(points: &[Vec3], normal: &Vec3, members: &[usize]) -> Vec<usize> {
    let middle = members.iter().map(|&m| points[m]).sum::<Vec3>() / members.len() as f64;
    let u = (points[members[0]] - middle).normalize();
    let v = normal.cross(&u);
    let angle = |m: usize| {
        let r = points[m] - middle;
        v.dot(&r).atan2(u.dot(&r))
    };
    let mut outline = members.to_vec();
    outline.sort_by(|&a, &b| angle(a).total_cmp(&angle(b)));
    outline
}

/// A polyhedron moved rigidly.
pub fn moved(polyhedron: &Polyhedron, x: &Transform) -> Polyhedron {
    let mut moved = polyhedron.clone().into_parts();
    for face in &mut moved.faces {
        face.normal = x.vector(&face.normal);
        face.offset += face.normal.dot(&x.translation);
    }
    for rim in &mut moved.rims {
        rim.anchor = x.point(&rim.anchor);
        rim.outward = x.vector(&rim.outward);
    }
    for edge in &mut moved.edges {
        edge.direction = x.vector(&edge.direction);
        if let Some(push) = &mut edge.push {
            push.normals = push.normals.map(|n| x.vector(&n));
            push.outwards = push.outwards.map(|o| x.vector(&o));
        }
    }
    for vertex in &mut moved.vertices {
        vertex.position = x.point(&vertex.position);
    }
    for cone in &mut moved.cone_edges {
        *cone = x.vector(cone);
    }
    Polyhedron::new(moved)
}

/// A polyhedron scaled about the origin.
pub fn scaled(polyhedron: &Polyhedron, factor: f64) -> Polyhedron {
    let mut scaled = polyhedron.clone().into_parts();
    scaled.diameter *= factor;
    for face in &mut scaled.faces {
        face.offset *= factor;
    }
    for rim in &mut scaled.rims {
        rim.anchor *= factor;
    }
    for vertex in &mut scaled.vertices {
        vertex.position *= factor;
    }
    Polyhedron::new(scaled)
}

/// An ellipsoid scaled about the origin.
pub fn scaled_ellipsoid(e: &Ellipsoid, factor: f64) -> Ellipsoid {
    Ellipsoid { center: e.center * factor, axes: e.axes, semi_axes: e.semi_axes * factor }
}

/// A triangle set from corners and triangles, neighbours found by shared edges.
pub fn triangle_set(vertices: Vec<Vec3>, triangles: &[[u32; 3]]) -> TriangleSet {
    let across = |a: u32, b: u32| {
        let has = |t: &[u32; 3]| (0..3).any(|k| t[k] == b && t[(k + 1) % 3] == a);
        triangles.iter().position(has).map_or(NO_NEIGHBOR, |t| t as u32)
    };
    let triangles = triangles
        .iter()
        .map(|t| TriangleRecord {
            vertices: *t,
            neighbors: [across(t[0], t[1]), across(t[1], t[2]), across(t[2], t[0])],
            shell: 0,
            may_push: MayPush::ALL,
            edge_lean: Lean::ANY,
            vertex_lean: Lean::ANY,
        })
        .collect();
    TriangleSet { vertices, triangles }
}

/// The surface of a polyhedron, each face cut into triangles from its first corner.
pub fn surface_of(polyhedron: &Polyhedron) -> TriangleSet {
    let mut triangles = Vec::new();
    for face in 0..polyhedron.faces.len() {
        let rim = polyhedron.rim(face);
        for k in 1..rim.len() - 1 {
            triangles.push([rim[0].start, rim[k].start, rim[k + 1].start]);
        }
    }
    triangle_set(polyhedron.vertices.iter().map(|v| v.position).collect(), &triangles)
}

/// Level patch of `count`² squares, each cut in two, with corners jittered in the plane and lifted by `lift`.
pub fn patch(count: u32, random: &mut Random, lift: &dyn Fn(f64, f64) -> f64) -> TriangleSet {
    let mut vertices = Vec::new();
    for i in 0..=count {
        for j in 0..=count {
            let x = f64::from(i) / f64::from(count) - 0.5 + random.between(-0.2, 0.2) / f64::from(count);
            let y = f64::from(j) / f64::from(count) - 0.5 + random.between(-0.2, 0.2) / f64::from(count);
            vertices.push(Vec3::new(x, y, lift(x, y)));
        }
    }
    let mut triangles = Vec::new();
    for i in 0..count {
        for j in 0..count {
            let at = |di: u32, dj: u32| (i + di) * (count + 1) + j + dj;
            triangles.push([at(0, 0), at(1, 0), at(1, 1)]);
            triangles.push([at(0, 0), at(1, 1), at(0, 1)]);
        }
    }
    triangle_set(vertices, &triangles)
}

/// Convex pieces, some with internal faces, closed or open, as they are and rotated.
pub fn pieces(random: &mut Random) -> Vec<Polyhedron> {
    let box_corners = cuboid_corners(Vec3::repeat(-1.0), Vec3::repeat(1.0));
    let walled = [
        hull_with_walls(&box_corners, &|normal, _| normal.x > 0.9),
        hull_with_walls(&box_corners, &|normal, _| normal.x > 0.9 || normal.y < -0.9),
        hull_with_walls(&fibonacci_sphere(18), &|normal, _| normal.x > 0.7),
        hull_with_walls(&fibonacci_sphere(66), &|normal, _| normal.z < -0.5),
    ];
    let open = walled.clone().map(|mut piece| {
        piece.change(|parts| parts.faces.iter_mut().for_each(|face| face.closed = false));
        piece
    });
    let mut all = vec![cuboid(Vec3::repeat(-1.0), Vec3::repeat(1.0))];
    all.extend(walled.into_iter().chain(open));
    all.extend([4, 8, 12, 18, 25, 66].map(|vertices| stretched_hull(vertices, Vec3::new(1.0, 0.8, 0.6))));
    let turned: Vec<_> = all.iter().map(|piece| moved(piece, &random_motion(random, 0.5))).collect();
    all.extend(turned);
    all
}

/// Random point near a piece: anywhere, with coordinates of single precision or of few digits, along an edge
/// or in the plane of some vertices, or within rounding of these or within the tolerance of internal faces.
pub fn place_near(random: &mut Random, piece: &Polyhedron) -> Vec3 {
    let [a, b, c] = [(); 3].map(|()| {
        let vertex = (random.unit() * piece.vertices.len() as f64) as usize;
        piece.vertices[vertex].position
    });
    let along_edge = a + (b - a) * random.between(-0.5, 1.5);
    let in_plane = along_edge + (c - a) * random.between(-0.5, 1.5);
    match (random.unit() * 9.0) as u32 {
        0 => Vec3::from_fn(|_, _| random.between(-1.5, 1.5)),
        1 => Vec3::from_fn(|_, _| f64::from(random.between(-1.5, 1.5) as f32)),
        2 => Vec3::from_fn(|_, _| random.between(-6.5, 6.5).round() * 0.25),
        3 => along_edge,
        4 => in_plane,
        5 => in_plane.map(|x| f64::from(x as f32)),
        6 => a + Vec3::from_fn(|_, _| random.between(-1e-9, 1e-9)),
        7 => along_edge + Vec3::from_fn(|_, _| random.between(-3e-6, 3e-6)),
        _ => in_plane + Vec3::from_fn(|_, _| random.between(-3e-6, 3e-6)),
    }
}
