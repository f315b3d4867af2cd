//! Small scenes for the tests, written as an author would write them.
#![allow(dead_code)]

use pong_engine::{Config, InterfaceId, ModelId, ObjectId, PairId, State, World, WorldBuilder};
use pong_geometry::extension::Extensions;
use pong_geometry::{Pose, Quat, Vec3, Wrench};
use std::sync::Arc;

/// Two Objects, paired and sealed.
pub struct Rig {
    pub world: World,
    pub models: [ModelId; 2],
    pub objects: [ObjectId; 2],
    pub interfaces: [InterfaceId; 2],
    pub pair: PairId,
}

/// Wraps primitives into a model of one movable group.
pub fn model(name: &str, surfaces: &str, primitives: &str) -> String {
    format!(
        "(format: \"pong-model\", version: 1, name: \"{name}\", surfaces: {{ {surfaces} }},\n\
         root: (name: \"{name}\", surface: \"s\", primitives: [ {primitives} ]))"
    )
}

/// A surface named `s`.
pub fn surface(stiffness: f64, rest: &str) -> String {
    format!("\"s\": (stiffness: {stiffness:?}, {rest})")
}

pub fn load(builder: &mut WorldBuilder, text: &str) -> ModelId {
    let model = pong_model::parse(text, "test.ron", None, &Extensions::new());
    builder.add_model(Arc::new(model.unwrap_or_else(|errors| panic!("{errors}\n{text}"))))
}

impl Rig {
    pub fn new(a: &str, b: &str) -> Self {
        Self::with_config(Config { ledger: true, ..Config::default() }, a, b)
    }

    pub fn with_config(config: Config, a: &str, b: &str) -> Self {
        let mut builder = WorldBuilder::new(config);
        let models = [a, b].map(|text| load(&mut builder, text));
        let objects =
            [builder.create_object(models[0], "a").unwrap(), builder.create_object(models[1], "b").unwrap()];
        let pair = builder.pair(objects[0], objects[1]).unwrap();
        let interfaces = objects.map(|object| builder.scene().interface(object, "").unwrap());
        let (world, _) = builder.seal().unwrap();
        Self { world, models, objects, interfaces, pair }
    }

    /// Sets both states.
    pub fn place(&mut self, states: [State; 2]) {
        let [a, b] = states;
        self.world.set_states(&[(self.interfaces[0], a), (self.interfaces[1], b)]).unwrap();
    }

    /// Places A; B rests at the common origin.
    pub fn place_a(&mut self, position: Vec3, orientation: Quat) {
        self.place([at(position, orientation), State::identity()]);
    }

    pub fn wrench(&self, side: usize) -> Wrench {
        self.world.wrench_common(self.interfaces[side]).unwrap()
    }
}

/// A state at rest.
pub fn at(position: Vec3, q: Quat) -> State {
    State { position: position.into(), orientation: [q.w, q.i, q.j, q.k], ..State::identity() }
}

/// A moving state.
pub fn moving(position: Vec3, q: Quat, linear: Vec3, angular: Vec3) -> State {
    State { linear_velocity: linear.into(), angular_velocity: angular.into(), ..at(position, q) }
}

/// The same scene seen from another frame: at `pose`, drifting at `velocity`.
pub fn seen_from(state: &State, pose: &Pose, velocity: &Vec3) -> State {
    let moved = pose.compose(&state.pose());
    let twist = state.twist();
    moving(
        moved.position,
        moved.orientation,
        pose.orientation * twist.linear + velocity,
        pose.orientation * twist.angular,
    )
}

/// A unit box as a polyhedron, `half` extents around `center`.
pub fn box_polyhedron(name: &str, center: [f64; 3], half: [f64; 3], inactive: &str) -> String {
    let corner = |sx: f64, sy: f64, sz: f64| {
        format!(
            "({:?},{:?},{:?})",
            center[0] + sx * half[0],
            center[1] + sy * half[1],
            center[2] + sz * half[2]
        )
    };
    let v: Vec<String> = (0..8)
        .map(|i| {
            let s = |bit: i32| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
            corner(s(0), s(1), s(2))
        })
        .collect();
    format!(
        "Polyhedron(name: \"{name}\", vertices: [{}], faces: [[0,2,3,1],[4,5,7,6],[0,1,5,4],[2,6,7,3],[0,4,6,2],[1,3,7,5]], inactive_faces: [{inactive}])",
        v.join(",")
    )
}

/// A flat square plate of `n × n` cells, two triangles each, of side `size`, its vertices through `place`.
pub fn plate_mesh(name: &str, n: usize, size: f64, place: impl Fn(f64, f64) -> Vec3) -> String {
    let step = size / n as f64;
    let mut vertices = Vec::new();
    for j in 0..=n {
        for i in 0..=n {
            let p = place(i as f64 * step - size / 2.0, j as f64 * step - size / 2.0);
            vertices.push(format!("({:?},{:?},{:?})", p.x, p.y, p.z));
        }
    }
    let mut triangles = Vec::new();
    for j in 0..n {
        for i in 0..n {
            let v = j * (n + 1) + i;
            let (a, b, c, d) = (v, v + 1, v + n + 1, v + n + 2);
            if (i + j) % 2 == 0 {
                triangles.push(format!("({a},{b},{d}),({a},{d},{c})"));
            } else {
                triangles.push(format!("({a},{b},{c}),({b},{d},{c})"));
            }
        }
    }
    format!(
        "TriangleMesh(name: \"{name}\", vertices: [{}], triangles: [{}])",
        vertices.join(","),
        triangles.join(",")
    )
}
