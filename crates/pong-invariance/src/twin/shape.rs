//! Twins of the same shape with another description: cut, reordered, regrouped, with other bounds or pairs.

use super::Twin;
use crate::base::Base;
use crate::cutting;
use crate::make::meshes;
use crate::random::{Random, rotation_between};
use crate::round_part::RoundKind;
use crate::scene::{Friction, Grouping, Mesh, Scene, Shape, Solid};
use pong_geometry::Vec3;

/// The Objects named in the other order, if no kind is on both sides.
pub fn swapped(scene: &Scene, _: &mut Random) -> Option<Twin> {
    let kinds = |body: usize| scene.bodies[body].shapes.iter().map(Shape::kind);
    (!kinds(0).any(|kind| kinds(1).any(|other| other == kind))).then_some(())?;
    let mut twin = Twin::of(scene);
    twin.scene.swapped = !scene.swapped;
    Some(twin)
}

/// Other bounding volumes and leaves around the same primitives.
pub fn bounded(scene: &Scene, random: &mut Random) -> Option<Twin> {
    let mut twin = Twin::of(scene);
    for body in &mut twin.scene.bodies {
        let bounds = (0..4).map(|_| random.pick(&["Aabb", "Sphere", "Obb"])).collect();
        let leaf_size = random.chance(0.5).then(|| 1 + random.below(8));
        body.grouping = Grouping { bounds, leaf_size, ..body.grouping.clone() };
    }
    Some(twin)
}

/// The primitives in the same order, in nested groups.
pub fn regrouped(scene: &Scene, random: &mut Random) -> Option<Twin> {
    let mut twin = Twin::of(scene);
    for body in &mut twin.scene.bodies {
        let mut left = body.shapes.len();
        let mut leaves = Vec::new();
        while left > 0 {
            let count = 1 + random.below(left);
            leaves.push(count);
            left -= count;
        }
        body.grouping = Grouping { leaves, depth: random.below(3), ..body.grouping.clone() };
    }
    Some(twin)
}

/// Primitives, triangles, corners and faces in another order, with other names.
pub fn reordered(scene: &Scene, random: &mut Random) -> Option<Twin> {
    let mut twin = Twin::of(scene);
    for body in &mut twin.scene.bodies {
        let order = random.order(body.shapes.len());
        // Adjoining holes must run in the same direction.
        let reverses = body.shapes.iter().any(|shape| matches!(shape, Shape::Round(_))) && random.chance(0.5);
        body.shapes =
            order.iter().map(|index| reordered_shape(&body.shapes[*index], reverses, random)).collect();
        body.names = random.order(body.shapes.len()).iter().map(|name| name + 10).collect();
    }
    Some(twin)
}

fn reordered_shape(shape: &Shape, reverses: bool, random: &mut Random) -> Shape {
    match shape {
        Shape::Round(part) if reverses => Shape::Round(part.reversed()),
        Shape::Mesh(mesh) => {
            let (vertices, new) = renumbered(&mesh.vertices, random);
            let turned = |triangle: [usize; 3], by: usize| [0, 1, 2].map(|k| new[triangle[(k + by) % 3]]);
            let order = random.order(mesh.triangles.len());
            let triangles =
                order.iter().map(|index| turned(mesh.triangles[*index], random.below(3))).collect();
            Shape::Mesh(Mesh { vertices, triangles, ..mesh.clone() })
        }
        Shape::Polyhedron(solid) => {
            let (vertices, new) = renumbered(&solid.vertices, random);
            let order = random.order(solid.faces.len());
            let mut faces = Vec::new();
            for index in &order {
                let mut face: Vec<usize> = solid.faces[*index].iter().map(|corner| new[*corner]).collect();
                let by = random.below(face.len());
                face.rotate_left(by);
                faces.push(face);
            }
            let is_inactive = |index: &usize| solid.inactive.contains(index);
            let inactive =
                order.iter().enumerate().filter(|(_, old)| is_inactive(old)).map(|(new, _)| new).collect();
            Shape::Polyhedron(Solid { vertices, faces, inactive })
        }
        other => other.clone(),
    }
}

/// Corners in another order, and the new index of each.
fn renumbered(vertices: &[Vec3], random: &mut Random) -> (Vec<Vec3>, Vec<usize>) {
    let order = random.order(vertices.len());
    let mut new = vec![0; order.len()];
    order.iter().enumerate().for_each(|(place, old)| new[*old] = place);
    (order.iter().map(|old| vertices[*old]).collect(), new)
}

/// Faces cut into more triangles, solids into pieces: anywhere, and through the point where A pushes.
pub fn cut(base: &Base, random: &mut Random) -> Option<Twin> {
    cut_by_rule(base, random, BarsOn::Whole)
}

/// Solids that capsules and segments touch if a solid is cut.
#[derive(Clone, Copy, PartialEq)]
enum BarsOn {
    Whole,
    Pieces,
}

fn cut_by_rule(base: &Base, random: &mut Random, bars: BarsOn) -> Option<Twin> {
    let scene = &base.scene;
    if scene.is_of_solids() {
        return cut_volumes(base, random);
    }
    let mut twin = Twin::of(scene);
    let shapes = &scene.bodies[1].shapes;
    let aim = aim(base, random);
    let shapes = match shapes.as_slice() {
        [Shape::Mesh(mesh)] => vec![Shape::Mesh(cut_mesh(mesh, aim.map(|aim| aim.0), random))],
        [Shape::Polyhedron(_)] => {
            let pieces = cut_solid(shapes, aim, random)?;
            is_fair(base, &pieces, bars).then_some(())?;
            pieces.into_iter().map(Shape::Polyhedron).collect()
        }
        [Shape::Round(hole)] if hole.kind == RoundKind::Bore => {
            // A rod leans on both edges of a hole as a whole; behind one piece is not behind the other.
            let is_rod = |shape: &Shape| matches!(shape, Shape::Round(_) | Shape::Segment { .. });
            (scene.frames.len() == 1 && !scene.bodies[0].shapes.iter().any(is_rod)).then_some(())?;
            hole.cut(random.between(0.2, 0.8)).map(Shape::Round).to_vec()
        }
        [Shape::Plane { normal, offset }] => vec![Shape::Mesh(plate(base, normal, *offset, random)?)],
        _ => return None,
    };
    twin.scene.bodies[1] = scene.bodies[1].with_shapes(shapes);
    Some(twin)
}

/// A solid cut into pieces without internal faces that are declared one surface: the loader finds where they lie
/// against each other.
pub fn declared(base: &Base, random: &mut Random) -> Option<Twin> {
    let scene = &base.scene;
    let [Shape::Polyhedron(_)] = scene.bodies[1].shapes.as_slice() else { return None };
    // Cylinders and cones have the earlier rule on declared surfaces.
    let is_wheel = |shape: &Shape| matches!(shape, Shape::Round(part) if part.kind != RoundKind::Capsule);
    (!scene.is_of_solids() && !scene.bodies[0].shapes.iter().any(is_wheel)).then_some(())?;
    let mut twin = cut_by_rule(base, random, BarsOn::Pieces)?;
    let body = &mut twin.scene.bodies[1];
    body.is_one_surface = true;
    for shape in &mut body.shapes {
        if let Shape::Polyhedron(piece) = shape {
            piece.inactive.clear();
        }
    }
    Some(twin)
}

/// Solids of one primitive that touch by volume, cut into pieces.
fn cut_volumes(base: &Base, random: &mut Random) -> Option<Twin> {
    let mut twin = Twin::of(&base.scene);
    for (index, body) in base.scene.bodies.iter().enumerate() {
        let aim = aim(base, random).filter(|_| index == 1);
        if let Some(pieces) = cut_solid(&body.shapes, aim, random) {
            let shapes = pieces.into_iter().map(Shape::Polyhedron).collect();
            twin.scene.bodies[index] = body.with_shapes(shapes);
        }
    }
    (twin.scene.bodies != base.scene.bodies).then_some(twin)
}

/// The roles of A and B exchanged between two solids. A bristle depends on them to the third order of the angle
/// that a body turns in a frame.
pub fn exchanged(scene: &Scene, _: &mut Random) -> Option<Twin> {
    let has_bristle =
        scene.bodies.iter().any(|body| matches!(body.surface.friction, Friction::Bristle { .. }));
    (scene.bodies.iter().all(|body| body.is_solid) && !has_bristle).then_some(())?;
    let mut twin = Twin::of(scene);
    twin.scene.swapped = !scene.swapped;
    Some(twin)
}

/// A point where A pushes in some frame, and the outward normal there, in B's group.
fn aim(base: &Base, random: &mut Random) -> Option<(Vec3, Vec3)> {
    let frame = random.below(base.answers.len());
    let contacts = &base.answers[frame].contacts;
    if contacts.is_empty() || base.scene.bodies[1].place != pong_geometry::Pose::identity() {
        return None;
    }
    let touch = &contacts[random.below(contacts.len())];
    let x_bw = base.scene.frames[frame][1].pose().inverse();
    Some((x_bw.orientation * touch.point + x_bw.position, x_bw.orientation * touch.normal))
}

fn cut_mesh(mesh: &Mesh, aim: Option<Vec3>, random: &mut Random) -> Mesh {
    let mut mesh = mesh.clone();
    if let Some(aim) = aim.filter(|_| random.chance(0.6)) {
        cutting::cut_at(&mut mesh, &aim, random.chance(0.5));
    }
    if mesh.triangles.len() < 100 && random.chance(0.2) {
        return cutting::cut_in_four(&mesh);
    }
    let steps = random.below(4);
    cutting::cut_mesh(&mesh, random, steps)
}

fn cut_solid(shapes: &[Shape], aim: Option<(Vec3, Vec3)>, random: &mut Random) -> Option<Vec<Solid>> {
    let [Shape::Polyhedron(solid)] = shapes else { return None };
    let mut pieces = vec![solid.clone()];
    for _ in 0..1 + random.below(4) {
        let middle = solid.vertices.iter().sum::<Vec3>() / solid.vertices.len() as f64;
        let (through, normal) = match aim.filter(|_| random.chance(0.7)) {
            Some((foot, out)) => (foot, random.across(&out)),
            None => {
                let toward = random.pick(&solid.vertices);
                (middle + (toward - middle) * random.between(0.0, 0.5), random.direction())
            }
        };
        if let Some(cut) = cutting::cut_all(&pieces, &normal, normal.dot(&through)) {
            pieces = cut;
        }
    }
    (pieces.len() > 1).then_some(pieces)
}

/// A plate of triangles in place of a half space, so large that nothing reaches its boundary and so thick
/// that nothing passes through. For spheres, capsules and ellipsoids only: a plunger depends on a triangle's
/// thickness.
fn plate(base: &Base, normal: &Vec3, offset: f64, random: &mut Random) -> Option<Mesh> {
    let is_round_shape = |shape: &Shape| match shape {
        Shape::Sphere { .. } | Shape::Ellipsoid { .. } => true,
        Shape::Round(part) => part.kind == RoundKind::Capsule,
        _ => false,
    };
    base.scene.bodies[0].shapes.iter().all(is_round_shape).then_some(())?;
    let normal = normal.normalize();
    let size = base.scene.size;
    let middle = aim(base, random).map_or(normal * offset, |(foot, _)| foot);
    let middle = middle - normal * (normal.dot(&middle) - offset);
    let turn = rotation_between(&Vec3::z(), &normal);
    let mut plate = meshes::plate(random, false);
    // Corner or seam under the contact point, or neither.
    let under = match random.below(3) {
        0 => random.pick(&plate.vertices),
        1 => {
            let [p, q, _] = random.pick(&plate.triangles);
            let t = random.unit();
            plate.vertices[p] * (1.0 - t) + plate.vertices[q] * t
        }
        _ => random.vector(0.3),
    };
    // Near the plate's boundary its end would be in reach.
    let under = if under.x.abs().max(under.y.abs()) > 0.6 { Vec3::zeros() } else { under };
    for vertex in &mut plate.vertices {
        let flat = Vec3::new(vertex.x - under.x, vertex.y - under.y, 0.0);
        *vertex = middle + turn * (flat * (40.0 * size));
    }
    plate.thickness = Some(100.0 * size);
    Some(plate)
}

/// Tests whether pieces can give the answer of the whole: the push must leave by the piece in which it
/// begins, and the path of entry must lead into that piece directly. A piece only knows its own faces: a
/// point deep in one piece and nearest to a face of another, a step through one piece into the next, or an
/// ellipsoid that overlaps several pieces has a different answer (docs/invariances.md).
fn is_fair(base: &Base, pieces: &[Solid], bars: BarsOn) -> bool {
    let [Shape::Polyhedron(whole)] = base.scene.bodies[1].shapes.as_slice() else { return false };
    let cut = Cut { base, whole, pieces, bars, slack: 1e-9 * base.scene.size };
    (0..base.scene.frames.len()).all(|frame| {
        let shapes = base.scene.bodies[0].shapes.iter().enumerate();
        shapes.into_iter().all(|(index, shape)| cut.is_fair_for(frame, index, shape))
    })
}

/// A solid and its pieces.
struct Cut<'b> {
    base: &'b Base,
    whole: &'b Solid,
    pieces: &'b [Solid],
    bars: BarsOn,
    slack: f64,
}

impl Cut<'_> {
    /// Tests one primitive of A in one frame.
    fn is_fair_for(&self, frame: usize, index: usize, shape: &Shape) -> bool {
        let back = self.base.scene.frames[frame][1].pose().orientation.inverse();
        let mut touches =
            self.base.answers[frame].contacts.iter().filter(|touch| touch.of[0] as usize == index);
        let at = |p: &Vec3| self.seen(frame, p);
        match shape {
            Shape::Point { position } => {
                let from = at(position);
                touches.all(|touch| self.leaves(&from, &(back * touch.normal), touch.depth))
                    && self.comes_in(frame, position)
                    && self.keeps_its_face(frame, index, position)
            }
            Shape::Sphere { center, radius } => {
                let from = at(center);
                is_outside(self.whole, &from, self.slack)
                    || touches.all(|touch| self.leaves(&from, &(back * touch.normal), touch.depth - radius))
                        && self.comes_in(frame, center)
                        && self.keeps_its_face(frame, index, center)
            }
            Shape::Ellipsoid { semi_axes, .. } => touches.all(|touch| touch.depth < 0.05 * semi_axes.min()),
            Shape::Ray { origin, .. } => is_outside(self.whole, &at(origin), self.slack),
            Shape::Segment { .. } if self.bars == BarsOn::Whole => true,
            Shape::Round(part) if part.kind == RoundKind::Capsule && self.bars == BarsOn::Whole => true,
            Shape::Segment { ends } => {
                let Some(first) = touches.next() else { return true };
                let is_flat = touches.all(|touch| (touch.normal - first.normal).norm() < 1e-9);
                let out = back * first.normal;
                let mut ends = ends.iter().map(at).map(|end| (end, depth_along(self.whole, &end, &out)));
                is_flat
                    && ends.all(|(end, depth)| self.is_least(&end, depth) && self.leaves(&end, &out, depth))
            }
            Shape::Round(part) => {
                let ends = part.ends.map(|end| at(&end));
                // On a whole both ends of a capsule yield: pieces know this of an end that leaves by a face.
                let mut by_its_end = touches.all(|touch| {
                    let out = back * touch.normal;
                    let foot = |end: &Vec3| end - out * (part.radii[0] - touch.depth);
                    let is_foot = |end: &Vec3| is_inside(self.whole, &foot(end), self.slack);
                    touch.weight == 1.0 && ends.get(touch.end as usize).is_some_and(is_foot)
                });
                by_its_end |= part.kind != RoundKind::Capsule;
                by_its_end && is_passed_by(self.whole, &ends, self.slack)
            }
            Shape::Plane { .. } | Shape::Polyhedron(_) | Shape::Mesh(_) => true,
        }
    }

    /// A point of A's group in a frame, in B's group.
    fn seen(&self, frame: usize, place: &Vec3) -> Vec3 {
        let states = &self.base.scene.frames[frame];
        let x_ba = pong_geometry::Pose::relative(&states[0].pose(), &states[1].pose())
            .compose(&self.base.scene.bodies[0].place);
        x_ba.orientation * place + x_ba.position
    }

    fn holds(&self, x: &Vec3) -> impl Iterator<Item = &Solid> {
        self.pieces.iter().filter(move |piece| is_inside(piece, x, self.slack))
    }

    /// Tests whether one piece contains both a point and the surface point towards which it is pushed.
    fn leaves(&self, from: &Vec3, out: &Vec3, depth: f64) -> bool {
        let foot = from + out * depth;
        self.holds(from).any(|piece| is_inside(piece, &foot, self.slack))
    }

    /// Tests whether no face of the whole is nearer to an inner point than `depth`.
    fn is_least(&self, place: &Vec3, depth: f64) -> bool {
        self.whole.faces.iter().all(|face| {
            let (normal, p) = plane_of(self.whole, face);
            normal.dot(&(p - place)) >= depth - self.slack
        })
    }

    /// Tests whether an inner point is pushed by the face of entry, or by the same face as in the frame
    /// before. From that face, memory moves across the edges of faces, and a piece does not have all of them.
    fn keeps_its_face(&self, frame: usize, index: usize, place: &Vec3) -> bool {
        let normal_in = |frame: usize| {
            let back = self.base.scene.frames[frame][1].pose().orientation.inverse();
            let mut touches = self.base.answers[frame].contacts.iter();
            touches.find(|touch| touch.of[0] as usize == index).map(|touch| back * touch.normal)
        };
        let Some(now) = normal_in(frame).filter(|_| frame > 0) else { return true };
        let before = self.seen(frame - 1, place);
        let from = match is_outside(self.whole, &before, self.slack) {
            true => entered_by(self.whole, &before, &self.seen(frame, place)),
            false => normal_in(frame - 1),
        };
        from.is_some_and(|from| (from - now).norm() < 1e-9)
    }

    /// Tests whether the straight path since the frame before enters from outside, or from the same piece.
    fn comes_in(&self, frame: usize, place: &Vec3) -> bool {
        let now = self.seen(frame, place);
        if frame == 0 || is_outside(self.whole, &now, self.slack) {
            return true;
        }
        let before = self.seen(frame - 1, place);
        let entry = entry(self.whole, &before, &now);
        self.holds(&now).any(|piece| is_inside(piece, &entry, self.slack))
    }
}

/// Entry point of a straight path into a solid; its start if it begins inside.
fn entry(solid: &Solid, from: &Vec3, to: &Vec3) -> Vec3 {
    let t = last_entry(solid, from, to).map_or(0.0, |(t, _)| t);
    from + (to - from) * t.min(1.0)
}

/// Normal of the face by which a straight path enters a solid.
fn entered_by(solid: &Solid, from: &Vec3, to: &Vec3) -> Option<Vec3> {
    last_entry(solid, from, to).map(|(_, normal)| normal)
}

/// Last plane that a straight path crosses inwards: fraction of the path, and normal.
fn last_entry(solid: &Solid, from: &Vec3, to: &Vec3) -> Option<(f64, Vec3)> {
    let mut last: Option<(f64, Vec3)> = None;
    for face in &solid.faces {
        let (normal, p) = plane_of(solid, face);
        let [start, end] = [from, to].map(|x| normal.dot(&(x - p)));
        if start > 0.0 && end < start {
            let at = start / (start - end);
            last = last.filter(|(t, _)| *t >= at).or(Some((at, normal)));
        }
    }
    last
}

fn plane_of(solid: &Solid, face: &[usize]) -> (Vec3, Vec3) {
    let [p, q, r] = [0, 1, 2].map(|k| solid.vertices[face[k]]);
    ((q - p).cross(&(r - p)).normalize(), p)
}

/// Depth below the faces with this normal.
fn depth_along(solid: &Solid, x: &Vec3, out: &Vec3) -> f64 {
    let highest = solid.vertices.iter().map(|v| out.dot(v)).fold(f64::NEG_INFINITY, f64::max);
    highest - out.dot(x)
}

fn is_inside(solid: &Solid, x: &Vec3, slack: f64) -> bool {
    solid.faces.iter().all(|face| {
        let (normal, p) = plane_of(solid, face);
        normal.dot(&(x - p)) <= slack
    })
}

/// Tests whether a straight path stays outside.
fn is_passed_by(solid: &Solid, [from, to]: &[Vec3; 2], slack: f64) -> bool {
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for face in &solid.faces {
        let (normal, p) = plane_of(solid, face);
        let [start, end] = [from, to].map(|x| normal.dot(&(x - p)) - slack);
        if start > 0.0 && end > 0.0 {
            return true;
        }
        if start > 0.0 {
            enters = enters.max(start / (start - end));
        } else if end > 0.0 {
            leaves = leaves.min(start / (start - end));
        }
    }
    enters > leaves
}

/// Tests whether a point is certainly outside: on the surface counts as inside.
fn is_outside(solid: &Solid, x: &Vec3, slack: f64) -> bool {
    !is_inside(solid, x, slack)
}
