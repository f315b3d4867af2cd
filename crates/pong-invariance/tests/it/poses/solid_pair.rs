//! Random pairs of solids in a world, and random poses of A on B.

use pong_engine::{Config, InterfaceId, ObjectId, State, World, WorldBuilder};
use pong_geometry::{Pose, Quat, Twist, Vec3, Wrench};
use pong_invariance::cutting::cut_all;
use pong_invariance::make::{path, solids, volumes};
use pong_invariance::random::{Random, rotation_about, rotation_between};
use pong_invariance::scene::{Body, Friction, Normal, Shape, Solid, Surface};
use pong_invariance::text;
use pong_model::Extensions;
use std::sync::Arc;

/// Foundation modulus of the softer body, N/m³.
pub const SOFT: f64 = 2e7;
/// Foundation modulus of the stiffer body, N/m³.
const STIFF: f64 = 5e7;

/// Description and pose of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Variant {
    /// A turned anyhow.
    Turned,
    /// Both bodies turned and moved by up to 10 m.
    Moved,
    /// One or both bodies in pieces.
    Cut,
    /// All vertices rounded to single precision.
    SinglePrecision,
    /// The centres of both bodies near each other.
    Deep,
}

/// All variants, in turn.
pub const VARIANTS: [Variant; 5] =
    [Variant::Turned, Variant::Moved, Variant::Cut, Variant::SinglePrecision, Variant::Deep];

/// Pairs of shapes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    OnPlane,
    BoxOnBox,
    HullOnHull,
    ConcaveOnBox,
}

/// Shapes of a body: as a whole, and in pieces. The pieces are the whole where it is not cut.
#[derive(Clone)]
pub struct Shapes {
    pub whole: Vec<Shape>,
    pub pieces: Vec<Shape>,
}

impl Shapes {
    fn of(solid: Solid) -> Self {
        let whole = vec![Shape::Polyhedron(solid)];
        Self { pieces: whole.clone(), whole }
    }

    /// Rounds all vertices to single precision. Corners of boxes along the axes that are equal stay so.
    fn round(&mut self) {
        for vertex in self.whole.iter_mut().chain(&mut self.pieces).flat_map(Shape::vertices_mut) {
            *vertex = vertex.map(|x| f64::from(x as f32));
        }
    }

    /// Cuts the pieces by one to four planes through the inside.
    fn cut(&mut self, random: &mut Random) {
        let solid =
            |shape: &Shape| if let Shape::Polyhedron(solid) = shape { Some(solid.clone()) } else { None };
        let Some(mut pieces) = self.pieces.iter().map(solid).collect::<Option<Vec<_>>>() else { return };
        for _ in 0..1 + random.below(4) {
            let vertices: Vec<Vec3> = pieces.iter().flat_map(|piece| piece.vertices.clone()).collect();
            let middle = vertices.iter().sum::<Vec3>() / vertices.len() as f64;
            let through = middle + (random.pick(&vertices) - middle) * random.between(0.0, 0.5);
            let axis = Vec3::ith(random.below(3), 1.0);
            let normal = if random.chance(0.3) { axis } else { random.direction() };
            if let Some(cut) = cut_all(&pieces, &normal, normal.dot(&through)) {
                pieces = cut;
            }
        }
        self.pieces = pieces.into_iter().map(Shape::Polyhedron).collect();
    }
}

/// A pair of bodies as plain data.
pub struct Bodies {
    pub variant: Variant,
    pub shapes: [Shapes; 2],
    /// Foundation moduli, N/m³; infinite for a rigid body.
    pub moduli: [f64; 2],
    /// True if both bodies remember the side of entry.
    pub remembers: bool,
}

impl Bodies {
    /// Random bodies of a kind, in pieces if `is_cut`.
    pub fn random(kind: Kind, variant: Variant, is_cut: bool, random: &mut Random) -> Self {
        let is_round = random.chance(0.3);
        let block = |random: &mut Random| {
            let half = solids::extents(random, is_round);
            Shapes::of(solids::cuboid(&-half, &half))
        };
        let plane = || {
            let whole = vec![Shape::Plane { normal: Vec3::z(), offset: 0.0 }];
            Shapes { pieces: whole.clone(), whole }
        };
        let mut shapes = match kind {
            Kind::OnPlane => [Shapes::of(solids::any(random, is_round)), plane()],
            Kind::BoxOnBox => [block(random), block(random)],
            Kind::HullOnHull => [(); 2].map(|()| Shapes::of(solids::random_hull(random))),
            Kind::ConcaveOnBox => [concave(random, is_round), block(random)],
        };
        if kind == Kind::ConcaveOnBox && random.chance(0.5) {
            shapes.reverse();
        }
        let moduli = random.pick(&[[SOFT, STIFF], [SOFT, f64::INFINITY], [f64::INFINITY, SOFT]]);
        if variant == Variant::SinglePrecision {
            shapes.iter_mut().for_each(Shapes::round);
        }
        if is_cut {
            shapes.iter_mut().for_each(|shapes| shapes.cut(random));
        }
        Self { variant, shapes, moduli, remembers: random.chance(0.5) }
    }

    /// Foundation modulus of the pair, N/m³.
    pub fn modulus(&self) -> f64 {
        1.0 / (1.0 / self.moduli[0] + 1.0 / self.moduli[1])
    }

    /// Largest area of a section, of the order of the square of the smaller body's size, m².
    pub fn area(&self) -> f64 {
        let size = |shapes: &Shapes| {
            let vertices = all_vertices(&shapes.whole);
            let radius = vertices.iter().map(|vertex| vertex.norm()).fold(0.0, f64::max);
            if vertices.is_empty() { f64::INFINITY } else { 2.0 * radius }
        };
        size(&self.shapes[0]).min(size(&self.shapes[1])).powi(2)
    }

    /// Largest distance of a corner from the plane of its face, m: single precision bends faces of four corners.
    pub fn bend(&self) -> f64 {
        let mut most = 0.0_f64;
        for shape in self.shapes.iter().flat_map(|shapes| &shapes.whole) {
            let Shape::Polyhedron(solid) = shape else { continue };
            for face in &solid.faces {
                let corners: Vec<Vec3> = face.iter().map(|index| solid.vertices[*index]).collect();
                let normal = path::normal_of(&corners);
                most = corners
                    .iter()
                    .map(|corner| normal.dot(&(corner - corners[0])).abs())
                    .fold(most, f64::max);
            }
        }
        most
    }

    /// World of the whole bodies, or of their pieces.
    pub fn world(&self, of_pieces: bool) -> SolidWorld {
        let texts = [0, 1].map(|body| {
            let Shapes { whole, pieces } = &self.shapes[body];
            let shapes = if of_pieces { pieces } else { whole };
            model_text(shapes, self.moduli[body], self.remembers)
        });
        SolidWorld::new(&texts)
    }
}

/// An L of three boxes, as a mesh in half of the cases. The pieces are always boxes.
fn concave(random: &mut Random, is_round: bool) -> Shapes {
    let (_, bent, _) = volumes::FAMILIES.iter().find(|(name, ..)| *name == "solid_on_l").expect("a family");
    let pieces = bent(random, is_round);
    let vertices = all_vertices(&pieces);
    let extent = |axis: usize| {
        let along = vertices.iter().map(|vertex| vertex[axis]);
        [along.clone().fold(f64::INFINITY, f64::min), along.fold(f64::NEG_INFINITY, f64::max)]
    };
    if random.chance(0.5) {
        return Shapes { whole: pieces.clone(), pieces };
    }
    Shapes { whole: vec![volumes::l_mesh(extent(0), extent(1), extent(2))], pieces }
}

pub fn all_vertices(shapes: &[Shape]) -> Vec<Vec3> {
    shapes.iter().flat_map(|shape| shape.clone().vertices_mut().to_vec()).collect()
}

/// Model of a body with a foundation modulus, without friction and damping.
fn model_text(shapes: &[Shape], modulus: f64, remembers: bool) -> String {
    let is_rigid = modulus.is_infinite();
    let surface = Surface {
        stiffness: if is_rigid { modulus } else { 1e5 },
        normal: Normal::Linear { damping: 0.0, ramp: 0.0 },
        friction: Friction::Smooth,
    };
    let mut body = Body::new(shapes.to_vec(), surface);
    body.is_solid = !shapes.iter().any(|shape| matches!(shape, Shape::Plane { .. }));
    let text = text::model(&body, "body", "s");
    let foundation = if is_rigid { String::new() } else { format!("foundation: {modulus:?}, ") };
    let text = text.replacen("stiffness:", &format!("{foundation}stiffness:"), 1);
    text.replacen("surfaces:", &format!("entry_memory: {remembers}, surfaces:"), 1)
}

/// Two bodies in the engine.
pub struct SolidWorld {
    pub world: World,
    roots: [InterfaceId; 2],
    first: ObjectId,
}

impl SolidWorld {
    fn new(texts: &[String; 2]) -> Self {
        let mut builder = WorldBuilder::new(Config::default());
        let objects = [0, 1].map(|body| {
            let name = ["a", "b"][body];
            let model = pong_model::parse(&texts[body], name, None, &Extensions::new());
            let model =
                builder.add_model(Arc::new(model.unwrap_or_else(|error| panic!("{error}\n{}", texts[body]))));
            builder.create_object(model, name).expect("an Object")
        });
        builder.pair(objects[0], objects[1]).expect("a pair");
        let (world, _) = builder.seal().expect("a world");
        let roots = objects.map(|object| world.scene().interface(object, "").expect("the root group"));
        Self { world, roots, first: objects[0] }
    }

    /// Wrench on A about its origin in the common frame, and stored energy, J, at rest at these poses of A and B.
    pub fn at(&mut self, [a, b]: &[Pose; 2]) -> (Wrench, f64) {
        let still = |pose: &Pose| State::from_motion(pose, &Twist::zero());
        self.world.set_states(&[(self.roots[0], still(a)), (self.roots[1], still(b))]).expect("states");
        self.world.evaluate().expect("a frame");
        let wrench = self.world.wrench_common(self.roots[0]).expect("a wrench");
        (wrench, self.world.contacts_iter().map(|contact| contact.stored).sum())
    }

    /// Clears the contact state, and commits poses at which A is just apart from B along a direction.
    pub fn begin(&mut self, start: &Start) {
        self.world.clear_contact_history(self.first).expect("an Object");
        let [a, b] = start.here;
        let mut lift = 1e-3;
        let apart = |lift: f64| [Pose { position: a.position + start.normal * lift, ..a }, b];
        while self.at(&apart(lift)).1 > 0.0 {
            lift *= 1.5;
        }
        self.world.commit().expect("a commit");
    }

    /// Sum of the normal forces, N: forces on opposite sides of a body may cancel in the wrench.
    pub fn pressed(&self) -> f64 {
        self.world.contacts_iter().map(|contact| contact.normal_force).sum()
    }

    /// Greatest effective depth of a contact, m.
    pub fn depth(&self) -> f64 {
        self.world.contacts_iter().map(|contact| contact.depth).fold(0.0, f64::max)
    }
}

/// Poses of A and B, and the direction in the common frame from which A came.
pub struct Start {
    pub here: [Pose; 2],
    pub normal: Vec3,
}

/// Places A on B: a vertex of A below a face, an edge or a corner of B, often with parallel faces and edges.
pub fn place(shapes: &[Shapes; 2], variant: Variant, random: &mut Random) -> Start {
    let [a, b] = [0, 1].map(|body| &shapes[body].whole);
    let foot = path::foot(random, b, false);
    let quarter = |random: &mut Random| {
        let turns = random.below(4) as f64;
        rotation_about(&Vec3::ith(random.below(3), 1.0), turns * std::f64::consts::FRAC_PI_2)
    };
    let orientation = match random.below(4) {
        0 => quarter(random),
        1 => flush(a, &foot.normal, random),
        _ => random.orientation(),
    };
    let down = orientation.inverse() * -foot.normal;
    let heights = |p: &&Vec3, q: &&Vec3| down.dot(p).total_cmp(&down.dot(q));
    let vertices = all_vertices(a);
    let lowest = vertices.iter().max_by(heights).expect("a vertex");
    let is_plane = matches!(b[0], Shape::Plane { .. });
    let depth = match variant {
        Variant::Deep => random.between(0.3, 1.5),
        _ => random.log_between(1e-4, 0.3),
    };
    let position = match variant {
        Variant::Deep if !is_plane => random.vector(0.3),
        _ => foot.place - foot.normal * depth - orientation * lowest,
    };
    let frame = match variant {
        Variant::Moved => Pose { position: random.vector(10.0), orientation: random.orientation() },
        _ => Pose::identity(),
    };
    let here = Pose { position, orientation };
    Start { here: [frame.compose(&here), frame], normal: frame.orientation * foot.normal }
}

/// Orientation at which a random face of A lies flat against a face of the outward normal `normal`.
fn flush(a: &[Shape], normal: &Vec3, random: &mut Random) -> Quat {
    let corners: Vec<Vec3> = match &a[random.below(a.len())] {
        Shape::Polyhedron(solid) => {
            solid.faces[random.below(solid.faces.len())].iter().map(|index| solid.vertices[*index]).collect()
        }
        Shape::Mesh(mesh) => random.pick(&mesh.triangles).map(|index| mesh.vertices[index]).to_vec(),
        _ => return random.orientation(),
    };
    let turned = rotation_between(&path::normal_of(&corners), &-normal);
    rotation_about(normal, random.between(-3.0, 3.0)) * turned
}
