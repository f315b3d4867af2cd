//! Surfaces and slow reference answers shared by the oracle and feature tests.

pub mod rows;

use crate::common::{Random, random_motion};
use pong_geometry::interference::Interference;
use pong_geometry::interference::sphere_triangle::sphere_triangle;
use pong_geometry::interference::triangle_features::{Standing, TriangleContact};
use pong_geometry::primitive::{
    EdgePush, Lean, MayPush, NO_NEIGHBOR, Polyhedron, Sphere, TriangleRecord, TriangleSet,
};
use pong_geometry::{Transform, Vec3};

/// Records the largest error under a name and prints it when dropped.
pub struct Worst {
    name: &'static str,
    value: f64,
    count: u64,
}

impl Worst {
    pub fn new(name: &'static str) -> Self {
        Self { name, value: 0.0, count: 0 }
    }

    /// Records one error; fails if it is above the limit (or NaN).
    #[track_caller]
    pub fn note(&mut self, error: f64, limit: f64) {
        assert!(error <= limit, "{}: {error:e} > {limit:e} (after {} good ones)", self.name, self.count);
        self.value = self.value.max(error);
        self.count += 1;
    }
}

impl Drop for Worst {
    fn drop(&mut self) {
        println!("{}: worst {:.1e} of {}", self.name, self.value, self.count);
    }
}

// ---------------------------------------------------------------- triangle surfaces

/// Connects triangles: neighbours by common directed edges, one shell.
pub fn surface(vertices: Vec<Vec3>, triangles: &[[u32; 3]]) -> TriangleSet {
    let mut set = TriangleSet { vertices, triangles: Vec::new() };
    let edge = |t: &[u32; 3], k: usize| (t[k], t[(k + 1) % 3]);
    let mut owners = std::collections::HashMap::new();
    for (index, t) in triangles.iter().enumerate() {
        for k in 0..3 {
            assert!(owners.insert(edge(t, k), index as u32).is_none(), "edge run twice in one direction");
        }
    }
    for t in triangles {
        let across = |k: usize| {
            let (a, b) = edge(t, k);
            owners.get(&(b, a)).copied().unwrap_or(NO_NEIGHBOR)
        };
        let neighbors = [0, 1, 2].map(across);
        set.triangles.push(TriangleRecord {
            vertices: *t,
            neighbors,
            shell: 0,
            may_push: MayPush::ALL,
            edge_lean: Lean::ANY,
            vertex_lean: Lean::ANY,
        });
    }
    set
}

/// Surface with its triangles in another order and rotated within themselves.
pub fn shuffled(set: &TriangleSet, random: &mut Random) -> TriangleSet {
    let mut triangles: Vec<[u32; 3]> = set.triangles.iter().map(|t| t.vertices).collect();
    for i in (1..triangles.len()).rev() {
        triangles.swap(i, (random.bits() % (i as u64 + 1)) as usize);
    }
    for t in &mut triangles {
        t.rotate_left((random.bits() % 3) as usize);
    }
    surface(set.vertices.clone(), &triangles)
}

pub fn map_vertices(set: &TriangleSet, map: impl Fn(&Vec3) -> Vec3) -> TriangleSet {
    TriangleSet { vertices: set.vertices.iter().map(map).collect(), triangles: set.triangles.clone() }
}

pub fn moved_surface(set: &TriangleSet, x: &Transform) -> TriangleSet {
    map_vertices(set, |v| x.point(v))
}

pub fn rounded_to_f32(set: &TriangleSet) -> TriangleSet {
    map_vertices(set, |v| v.map(|c| f64::from(c as f32)))
}

/// Closed surface of a polyhedron: its faces as fans.
pub fn skin(polyhedron: &Polyhedron) -> TriangleSet {
    let mut triangles = Vec::new();
    for face in 0..polyhedron.faces.len() {
        let outline: Vec<u32> = polyhedron.rim(face).iter().map(|rim| rim.start).collect();
        for k in 1..outline.len() - 1 {
            triangles.push([outline[0], outline[k], outline[k + 1]]);
        }
    }
    surface(polyhedron.vertices.iter().map(|v| v.position).collect(), &triangles)
}

/// Grid of `nx × ny` squares, each cut into two triangles; `place` gives the vertex of a node.
pub fn grid(nx: u32, ny: u32, place: impl Fn(u32, u32) -> Vec3) -> TriangleSet {
    let number = |i: u32, j: u32| j * (nx + 1) + i;
    let vertices = (0..=ny).flat_map(|j| (0..=nx).map(move |i| (i, j))).map(|(i, j)| place(i, j)).collect();
    let mut triangles = Vec::new();
    for j in 0..ny {
        for i in 0..nx {
            let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
            if (i + j) % 2 == 0 {
                triangles.extend([[a, b, c], [a, c, d]]);
            } else {
                triangles.extend([[a, b, d], [b, c, d]]);
            }
        }
    }
    surface(vertices, &triangles)
}

/// Regular flat plate of 2 × 2 m in z = 0.
pub fn regular_plate(n: u32) -> TriangleSet {
    let at = |i: u32| 2.0 * f64::from(i) / f64::from(n) - 1.0;
    grid(n, n, |i, j| Vec3::new(at(i), at(j), 0.0))
}

/// Flat disc of fans with irregular angles around irregular points: an inner and an outer ring.
pub fn fan_plate(random: &mut Random) -> TriangleSet {
    let count = 11_u32;
    let mut vertices = vec![Vec3::new(0.03, -0.05, 0.0)];
    for radius in [0.35, 1.2] {
        for k in 0..count {
            let angle = (f64::from(k) + random.between(-0.4, 0.4)) / f64::from(count) * std::f64::consts::TAU;
            let r = radius * random.between(0.85, 1.15);
            vertices.push(Vec3::new(r * angle.cos(), r * angle.sin(), 0.0));
        }
    }
    let mut triangles = Vec::new();
    for k in 0..count {
        let (a, b) = (1 + k, 1 + (k + 1) % count);
        let (c, d) = (a + count, b + count);
        triangles.extend([[0, a, b], [a, c, b], [b, c, d]]);
    }
    surface(vertices, &triangles)
}

/// Star-shaped closed surface with valleys and ridges: a sphere of `rings × sectors` with dents.
pub fn dented_ball(rings: u32, sectors: u32, dent: f64, random: &mut Random) -> TriangleSet {
    let mut vertices = vec![Vec3::z()];
    for r in 1..rings {
        let polar = std::f64::consts::PI * f64::from(r) / f64::from(rings);
        for s in 0..sectors {
            let angle = std::f64::consts::TAU * f64::from(s) / f64::from(sectors);
            let radius = 1.0 + dent * random.between(-1.0, 1.0);
            vertices
                .push(Vec3::new(polar.sin() * angle.cos(), polar.sin() * angle.sin(), polar.cos()) * radius);
        }
    }
    vertices.push(-Vec3::z());
    let south = vertices.len() as u32 - 1;
    let number = |r: u32, s: u32| 1 + (r - 1) * sectors + s % sectors;
    let mut triangles = Vec::new();
    for s in 0..sectors {
        triangles.push([0, number(1, s), number(1, s + 1)]);
        for r in 1..rings - 1 {
            let [a, b, c, d] = [number(r, s), number(r + 1, s), number(r + 1, s + 1), number(r, s + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
        triangles.push([south, number(rings - 1, s + 1), number(rings - 1, s)]);
    }
    surface(vertices, &triangles)
}

/// Hilly open sheet.
pub fn hilly_sheet(n: u32, hill: f64, random: &mut Random) -> TriangleSet {
    let heights: Vec<f64> = (0..(n + 1) * (n + 1)).map(|_| random.between(-hill, hill)).collect();
    let at = |i: u32| 2.0 * f64::from(i) / f64::from(n) - 1.0;
    grid(n, n, |i, j| Vec3::new(at(i), at(j), heights[(j * (n + 1) + i) as usize]))
}

// ---------------------------------------------------------------- nearest points

/// Surfaces of every kind, of about unit size, by name.
pub fn surfaces(random: &mut Random) -> Vec<(&'static str, TriangleSet)> {
    let hull = crate::common::stretched_hull(20, Vec3::new(1.0, 0.8, 0.6));
    let sheet = hilly_sheet(6, 0.2, random);
    vec![
        ("plate", regular_plate(5)),
        ("fans", fan_plate(random)),
        ("hull", skin(&hull)),
        ("dented ball", dented_ball(6, 9, 0.3, random)),
        ("sheet", shuffled(&sheet, random)),
    ]
}

/// Point of a segment nearest to `p`.
pub fn nearest_on_segment(p: &Vec3, a: &Vec3, b: &Vec3) -> Vec3 {
    let along = b - a;
    a + along * ((p - a).dot(&along) / along.norm_squared()).clamp(0.0, 1.0)
}

/// Point of a triangle nearest to `p`: the foot if its barycentric coordinates allow, else the best of the
/// three sides.
pub fn nearest_on_triangle(p: &Vec3, [a, b, c]: &[Vec3; 3]) -> Vec3 {
    let (u, v, w) = (b - a, c - a, p - a);
    let (uu, uv, vv, wu, wv) = (u.dot(&u), u.dot(&v), v.dot(&v), w.dot(&u), w.dot(&v));
    let determinant = uu * vv - uv * uv;
    let (s, t) = ((wu * vv - wv * uv) / determinant, (wv * uu - wu * uv) / determinant);
    if s >= 0.0 && t >= 0.0 && s + t <= 1.0 {
        return a + u * s + v * t;
    }
    [(a, b), (b, c), (c, a)]
        .map(|(from, to)| nearest_on_segment(p, from, to))
        .into_iter()
        .min_by(|x, y| (x - p).norm().total_cmp(&(y - p).norm()))
        .expect("three sides")
}

/// Point of a surface that is a local minimum of the distance to the centre.
#[derive(Clone, Debug)]
pub struct Nearest {
    pub foot: Vec3,
    pub distance: f64,
    /// Triangles that contain the foot.
    pub triangles: Vec<u32>,
    /// Largest height of the centre over one of the triangles.
    pub height_max: f64,
}

/// All local minima of the distance from `p` to a surface, by definition: a triangle is convex, so its
/// nearest point is a local minimum if no adjacent triangle comes nearer.
pub fn local_minima(set: &TriangleSet, p: &Vec3, within: f64, scale: f64) -> Vec<Nearest> {
    let count = set.triangles.len() as u32;
    let corners: Vec<[Vec3; 3]> = (0..count).map(|t| set.corners(t)).collect();
    let nearest: Vec<Vec3> = corners.iter().map(|c| nearest_on_triangle(p, c)).collect();
    let touch = 1e-9 * scale;
    let mut found: Vec<Nearest> = Vec::new();
    for foot in &nearest {
        let distance = (p - foot).norm();
        if distance > within || found.iter().any(|other| (other.foot - foot).norm() < touch) {
            continue;
        }
        let triangles: Vec<u32> = (0..count)
            .filter(|&t| (nearest_on_triangle(foot, &corners[t as usize]) - foot).norm() < touch)
            .collect();
        if triangles.iter().any(|&t| (p - nearest[t as usize]).norm() < distance - 1e-12 * scale) {
            continue;
        }
        let mut height_max = f64::NEG_INFINITY;
        for &t in &triangles {
            let c = &corners[t as usize];
            let height = set.normal(t).dot(&(p - c[0]));
            height_max = height_max.max(height);
        }
        found.push(Nearest { foot: *foot, distance, triangles, height_max });
    }
    found
}

/// All contacts of a sphere with a surface.
pub fn all_contacts(sphere: &Sphere, set: &TriangleSet, thickness: f64) -> Vec<TriangleContact> {
    let mut found = Vec::new();
    for t in 0..set.triangles.len() as u32 {
        sphere_triangle(sphere, set, t, thickness, &mut |contact| found.push(contact));
    }
    found
}

/// Contacts that count: fallbacks only if nothing else is as deep.
pub fn counting_contacts(sphere: &Sphere, set: &TriangleSet, thickness: f64) -> Vec<Interference> {
    let all = all_contacts(sphere, set, thickness);
    let deepest = all
        .iter()
        .filter(|c| c.standing != Standing::Spare)
        .map(|c| c.interference.depth)
        .fold(0.0, f64::max);
    all.iter()
        .filter(|c| c.standing != Standing::Spare || deepest < c.interference.depth * (1.0 - 1e-9))
        .map(|c| c.interference)
        .collect()
}

/// Shared force in units of k: the shortest t with n·t ≥ δ for all, by coordinate ascent on its dual.
pub fn shared_push(contacts: &[Interference]) -> Vec3 {
    let mut lambda = vec![0.0_f64; contacts.len()];
    let mut t = Vec3::zeros();
    for _ in 0..4000 {
        let before = t;
        for (i, c) in contacts.iter().enumerate() {
            let next = (lambda[i] + c.depth - c.normal_b.dot(&t)).max(0.0);
            t += c.normal_b * (next - lambda[i]);
            lambda[i] = next;
        }
        if (t - before).norm() <= 1e-16 * t.norm() {
            break;
        }
    }
    t
}

/// Solid angle of a closed surface seen from `p`, over 4π: 1 inside, 0 outside.
pub fn winding_number(set: &TriangleSet, p: &Vec3) -> f64 {
    let mut sum = 0.0;
    for t in 0..set.triangles.len() as u32 {
        let [a, b, c] = set.corners(t).map(|corner| corner - p);
        let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
        let triple = a.dot(&b.cross(&c));
        let below = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
        sum += 2.0 * triple.atan2(below);
    }
    sum / (4.0 * std::f64::consts::PI)
}

// ---------------------------------------------------------------- polyhedra

/// Corners of a face, counter-clockwise.
pub fn polygon(polyhedron: &Polyhedron, face: usize) -> Vec<Vec3> {
    polyhedron.rim(face).iter().map(|rim| polyhedron.vertices[rim.start as usize].position).collect()
}

/// Point of the whole outer surface nearest to `p`, over triangles fanned from every face; and its face.
pub fn nearest_on_polyhedron(polyhedron: &Polyhedron, p: &Vec3) -> (Vec3, usize) {
    let mut best = (Vec3::zeros(), 0);
    let mut least = f64::INFINITY;
    for face in 0..polyhedron.faces.len() {
        let corners = polygon(polyhedron, face);
        for k in 1..corners.len() - 1 {
            let foot = nearest_on_triangle(p, &[corners[0], corners[k], corners[k + 1]]);
            let distance = (foot - p).norm();
            if distance < least {
                least = distance;
                best = (foot, face);
            }
        }
    }
    best
}

/// Connects the pieces of one body as the loader does: an edge where two active faces of the whole surface
/// meet convexly pushes once, from the lowest piece; a vertex pushes if all its edges are convex or flat.
pub fn join_pieces(pieces: &mut [Polyhedron]) {
    let same = |a: &Vec3, b: &Vec3| a == b;
    let ends = |p: &Polyhedron, e: usize| p.edges[e].vertices.map(|v| p.vertices[v as usize].position);
    // (ends, active faces there as (normal, outward), pieces and edge numbers)
    type Entry = ([Vec3; 2], Vec<(Vec3, Vec3)>, Vec<(usize, usize)>);
    let mut edges: Vec<Entry> = Vec::new();
    for (index, piece) in pieces.iter().enumerate() {
        for number in 0..piece.edges.len() {
            let here = ends(piece, number);
            let entry = match edges.iter().position(|e| same(&e.0[0], &here[0]) && same(&e.0[1], &here[1])) {
                Some(found) => found,
                None => {
                    edges.push((here, Vec::new(), Vec::new()));
                    edges.len() - 1
                }
            };
            edges[entry].2.push((index, number));
            for (face, data) in piece.faces.iter().enumerate().filter(|(_, f)| f.active) {
                if let Some(rim) = piece.rim(face).iter().find(|rim| rim.edge as usize == number) {
                    edges[entry].1.push((data.normal, rim.outward));
                }
            }
        }
    }
    let convex = |faces: &[(Vec3, Vec3)]| faces.len() == 2 && faces[0].0.dot(&faces[1].1) > 1e-9;
    let flat = |faces: &[(Vec3, Vec3)]| faces.len() == 2 && faces[0].0.dot(&faces[1].1).abs() <= 1e-9;
    for piece in pieces.iter_mut() {
        piece.change(|parts| {
            parts.edges.iter_mut().for_each(|edge| (edge.push, edge.convex) = (None, None));
            parts.cone_edges.clear();
            for vertex in &mut parts.vertices {
                (vertex.pushes, vertex.first_cone, vertex.cone_count) = (false, 0, 0);
            }
        });
    }
    for (_, faces, owners) in &edges {
        if convex(faces) {
            let (piece, number) = *owners.iter().min().expect("an owner");
            let push = EdgePush { normals: [faces[0].0, faces[1].0], outwards: [faces[0].1, faces[1].1] };
            pieces[piece].change(|parts| parts.edges[number].push = Some(push));
            for &(piece, number) in owners {
                pieces[piece].change(|parts| parts.edges[number].convex = Some(push));
            }
        }
    }
    let mut done: Vec<Vec3> = Vec::new();
    for piece in pieces.iter_mut() {
        for vertex in 0..piece.vertices.len() {
            let place = piece.vertices[vertex].position;
            if done.contains(&place) {
                continue;
            }
            done.push(place);
            let star: Vec<&Entry> =
                edges.iter().filter(|e| e.0.contains(&place) && !e.1.is_empty()).collect();
            let spoiled = star.iter().any(|e| !convex(&e.1) && !flat(&e.1));
            let rising = star.iter().filter(|e| convex(&e.1)).count();
            if spoiled || rising < 3 {
                continue;
            }
            let first = piece.cone_edges.len() as u32;
            piece.change(|parts| {
                for (ends, ..) in &star {
                    let other = if ends[0] == place { ends[1] } else { ends[0] };
                    parts.cone_edges.push((other - place).normalize());
                }
                let count = parts.cone_edges.len() as u32 - first;
                let entry = &mut parts.vertices[vertex];
                (entry.pushes, entry.first_cone, entry.cone_count) = (true, first, count);
            });
        }
    }
}

/// Marks internal faces closed in the lower of the two pieces.
pub fn close_lower_walls(pieces: &mut [Polyhedron]) {
    for lower in 0..pieces.len() {
        for face in 0..pieces[lower].faces.len() {
            let (normal, offset, active) = {
                let f = &pieces[lower].faces[face];
                (f.normal, f.offset, f.active)
            };
            let has_twin = pieces[lower + 1..].iter().any(|other| {
                other.faces.iter().any(|g| {
                    !g.active && g.normal.dot(&normal) < -1.0 + 1e-12 && (g.offset + offset).abs() < 1e-9
                })
            });
            pieces[lower].change(|parts| parts.faces[face].closed = !active && has_twin);
        }
    }
}

/// Body of two wedges with a slanted internal face between them, rotated at random and rebuilt from the
/// rotated corners.
pub fn wedges(random: &mut Random) -> Vec<Polyhedron> {
    let motion = random_motion(random, 1.0);
    let lean = random.between(-0.4, 0.4);
    let corners = |left: [f64; 2], right: [f64; 2]| -> Vec<Vec3> {
        [-0.8, 0.7]
            .iter()
            .flat_map(|&y| {
                [(left[0], -0.5), (left[1], 0.4), (right[0], -0.5), (right[1], 0.4)].map(|(x, z)| (x, y, z))
            })
            .map(|(x, y, z)| motion.point(&Vec3::new(x, y, z)))
            .collect()
    };
    let wall = motion.vector(&Vec3::new(0.9, 0.0, -lean)).normalize();
    let through = motion.point(&Vec3::new(0.0, 0.0, -0.5));
    let is_wall = |n: &Vec3, d: f64| n.dot(&wall).abs() > 1.0 - 1e-9 && (d - n.dot(&through)).abs() < 1e-9;
    let mut pieces = vec![
        crate::common::hull_with_walls(&corners([-1.0, -1.0], [0.0, lean]), &is_wall),
        crate::common::hull_with_walls(&corners([0.0, lean], [1.0, 1.0]), &is_wall),
    ];
    for piece in &pieces {
        assert_eq!(piece.faces.iter().filter(|f| !f.active).count(), 1);
    }
    // The loader makes opposite internal faces exact opposites.
    let wall = pieces[0].faces.iter().find(|f| !f.active).map(|f| (f.normal, f.offset)).expect("wall");
    pieces[1].change(|parts| {
        for face in parts.faces.iter_mut().filter(|f| !f.active) {
            (face.normal, face.offset) = (-wall.0, -wall.1);
        }
    });
    close_lower_walls(&mut pieces);
    join_pieces(&mut pieces);
    pieces
}

/// Seams of the outlines of two pieces: both ends, and the outward normal of the active face there.
pub fn seams(pieces: &[Polyhedron]) -> Vec<(Vec3, Vec3, Vec3)> {
    let piece = &pieces[0];
    let mut seams = Vec::new();
    for (index, face) in piece.faces.iter().enumerate().filter(|(_, f)| f.active) {
        for rim in piece.rim(index).iter().filter(|r| !piece.faces[r.neighbor as usize].active) {
            let ends = piece.edges[rim.edge as usize].vertices.map(|v| piece.vertices[v as usize].position);
            seams.push((ends[0], ends[1], face.normal));
        }
    }
    seams
}

/// Next representable number up (`ulps` > 0) or down.
pub fn nudge(x: f64, ulps: i64) -> f64 {
    let mut x = x;
    for _ in 0..ulps.abs() {
        x = if ulps > 0 { x.next_up() } else { x.next_down() };
    }
    x
}
