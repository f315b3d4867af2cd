//! Scenes that together use every tester of a pair of kinds, every kind of contact memory, and every limit.

use super::stage::{Path, Scene};
use super::{box_polyhedron, model, plate_mesh, surface};
use pong_geometry::Vec3;
use pong_testkit::Random;

/// All scenes of the series.
pub fn all() -> Vec<Scene> {
    vec![stations(), arms(), sheets(), pieces(), own_kinds(), crowd(), bowl(), swarm(), round()]
}

fn rough(stiffness: f64) -> String {
    let rest = "normal: Linear(damping: 50.0, ramp: 1e-4), friction: Bristle(mu: 0.3, static_excess: 0.1, damping: 2.0)";
    surface(stiffness, rest)
}

/// Builds a list of primitives with unique names.
pub struct Parts {
    pub text: Vec<String>,
    random: Random,
}

impl Parts {
    pub fn new(seed: u64) -> Self {
        Self { text: Vec::new(), random: Random(seed) }
    }

    fn add(&mut self, kind: &str, rest: &str) {
        let number = self.text.len();
        self.text.push(format!("{kind}(name: \"{kind}_{number}\", {rest})"));
    }

    fn place(&mut self, center: [f64; 3], size: [f64; 3]) -> Vec3 {
        let mut around = |axis: usize| center[axis] + size[axis] * self.random.between(-1.0, 1.0);
        Vec3::new(around(0), around(1), around(2))
    }

    pub fn points(&mut self, count: usize, center: [f64; 3], size: [f64; 3]) {
        for _ in 0..count {
            let at = self.place(center, size);
            self.add("Point", &format!("position: {}", tuple(&at)));
        }
    }

    pub fn spheres(&mut self, count: usize, center: [f64; 3], size: [f64; 3], radius: f64) {
        for _ in 0..count {
            let at = self.place(center, size);
            let radius = radius * self.random.between(0.6, 1.0);
            self.add("Sphere", &format!("center: {}, radius: {radius:?}", tuple(&at)));
        }
    }

    pub fn ellipsoids(&mut self, count: usize, center: [f64; 3], size: [f64; 3], radius: f64) {
        for _ in 0..count {
            let at = self.place(center, size);
            let [a, b, c] = [1.0, 0.7, 0.5].map(|part| radius * part * self.random.between(0.7, 1.0));
            let rest = format!(
                "center: {}, semi_axes: ({a:?},{b:?},{c:?}), orientation: (0.8,0.0,0.6,0.0)",
                tuple(&at)
            );
            self.add("Ellipsoid", &rest);
        }
    }

    pub fn segments(&mut self, count: usize, center: [f64; 3], size: [f64; 3], length: f64) {
        for _ in 0..count {
            let at = self.place(center, size);
            let along = self.place([0.0; 3], [length, length, 0.1 * length]);
            self.add("LineSegment", &format!("ends: ({}, {})", tuple(&at), tuple(&(at + along))));
        }
    }

    pub fn rays(&mut self, count: usize, center: [f64; 3], size: [f64; 3], length: f64) {
        for index in 0..count {
            let at = self.place(center, size);
            let mut rest = format!("origin: {}, direction: (0.1,-0.2,-1), length: {length:?}", tuple(&at));
            rest += ["", ", response: Axial", ", reach: 0.02"][index % 3];
            self.add("Ray", &rest);
        }
    }

    fn every_mover(&mut self, center: [f64; 3], size: [f64; 3]) {
        let above = [center[0], center[1], center[2] + 0.06];
        self.points(40, center, size);
        self.segments(4, center, size, 0.5);
        self.rays(6, above, size, 0.08);
        self.spheres(6, above, size, 0.08);
        self.ellipsoids(4, above, size, 0.1);
    }

    pub fn joined(&self) -> String {
        self.text.join(", ")
    }
}

fn tuple(v: &Vec3) -> String {
    format!("({:?},{:?},{:?})", v.x, v.y, v.z)
}

fn waves(x: f64, y: f64) -> Vec3 {
    Vec3::new(x, y, 0.05 * libm::sin(3.0 * x) * libm::cos(2.0 * y))
}

/// Every kind that can be A over every kind that can be B, one station each.
fn stations() -> Scene {
    let mut movers = Parts::new(1);
    for station in 0..4 {
        movers.every_mover([3.0 * f64::from(station), 0.0, 0.0], [0.35, 0.35, 0.02]);
    }
    movers.every_mover([12.0, 0.0, -0.5], [0.35, 0.35, 0.02]);
    let targets = [
        box_polyhedron("box", [0.0, 0.0, -0.2], [0.6, 0.6, 0.2], ""),
        plate_mesh("mesh", 12, 1.4, |x, y| waves(x, y) + Vec3::new(3.0, 0.0, 0.0)),
        "Sphere(name: \"ball\", center: (6,0,-0.38), radius: 0.4)".to_owned(),
        "Ellipsoid(name: \"egg\", center: (9,0,-0.28), semi_axes: (0.5,0.4,0.3))".to_owned(),
        "Plane(name: \"floor\", normal: (0,0,1), offset: -0.5)".to_owned(),
    ];
    let models = vec![
        model("movers", &rough(2e5), &movers.joined()),
        model("targets", &rough(1e6), &targets.join(", ")),
    ];
    let mut scene = Scene::new("stations", 300, models);
    scene.contact_capacity = Some(250);
    scene.paths = vec![
        Path {
            center: [0.0, 0.0, 0.01],
            swing: [0.05, 0.04, 0.05],
            period: [90.0, 130.0, 70.0],
            turn: [0.05, 0.001, 0.002],
            turn_period: 110.0,
        },
        Path { turn: [0.004, 0.0, 0.002], ..Path::still([0.0, 0.0, 0.0]) },
    ];
    scene.stiffness = |frame| Some(if frame < 150 { 2e5 } else { 3e5 });
    scene
}

/// Two arms of three movable groups each that touch each other, themselves and a bay; rays that may hit two
/// groups of one Object. Pairs are switched, and the history of Objects is cleared.
fn arms() -> Scene {
    let mut tip = Parts::new(2);
    tip.every_mover([0.0, 0.0, -0.05], [0.1, 0.1, 0.03]);
    let mut elbow = Parts::new(3);
    elbow.points(300, [0.0, 0.0, -0.05], [0.2, 0.2, 0.05]);
    elbow.spheres(4, [0.0, 0.0, 0.0], [0.2, 0.2, 0.05], 0.1);
    let arm = format!(
        "(format: \"pong-model\", version: 1, name: \"arm\", surfaces: {{ {} }}, root: (name: \"arm\", surface: \"s\", \
         groups: [(name: \"base\", primitives: [{}]), \
         (name: \"elbow\", movable: true, bound: Obb, groups: [(name: \"shell\", bound: Sphere, primitives: [{}]), \
         (name: \"tip\", movable: true, primitives: [{}])])]))",
        rough(5e5),
        box_polyhedron("block", [0.0, 0.0, 0.0], [0.3, 0.3, 0.1], ""),
        elbow.joined(),
        tip.joined()
    );
    let bay = [
        box_polyhedron("left", [-0.5, 0.0, -0.2], [0.5, 1.0, 0.2], "5"),
        box_polyhedron("right", [0.5, 0.0, -0.2], [0.5, 1.0, 0.2], "4"),
    ];
    let models = vec![arm, model("bay", &rough(1e6), &bay.join(", "))];
    let mut scene = Scene::new("arms", 300, models);
    scene.contact_capacity = Some(800);
    scene.objects = vec![0, 0, 1];
    scene.pairs = vec![(1, 0), (0, 0), (1, 1), (2, 0), (1, 2)];
    let swing = |center: [f64; 3], slow: f64| Path {
        center,
        swing: [0.06, 0.05, 0.06],
        period: [83.0 * slow, 61.0 * slow, 47.0 * slow],
        turn: [0.1, 0.08, 0.05],
        turn_period: 75.0,
    };
    scene.paths = vec![
        swing([0.3, 0.0, 0.12], 1.1),
        swing([-0.2, 0.1, 0.2], 1.0),
        swing([0.3, 0.1, 0.3], 0.9),
        swing([-0.4, -0.2, 0.1], 1.2),
        swing([0.1, 0.1, 0.18], 0.8),
        swing([-0.1, 0.0, 0.25], 1.0),
        Path::still([0.0, 0.0, 0.0]),
    ];
    scene.is_on = |frame, pair| match pair {
        0 => !(60..90).contains(&frame),
        3 => frame / 25 % 2 == 0,
        _ => true,
    };
    scene.forgets = |frame| match frame {
        120 => Some(1),
        201 => Some(2),
        _ => None,
    };
    scene
}

/// Balls and ellipsoids through sheets, from the front and from behind, and with their centres below the
/// surface.
fn sheets() -> Scene {
    let mut movers = Parts::new(4);
    movers.spheres(40, [0.0, 0.0, 0.0], [1.4, 1.4, 0.15], 0.12);
    movers.ellipsoids(20, [0.0, 0.0, 0.0], [1.4, 1.4, 0.15], 0.15);
    movers.rays(24, [0.0, 0.0, 0.1], [1.4, 1.4, 0.1], 0.3);
    let veil = plate_mesh("veil", 8, 2.0, |x, y| waves(y, x) + Vec3::new(0.0, 0.0, 0.25));
    let veil = veil.replace("TriangleMesh(", "TriangleMesh(two_sided: true, ");
    let thick = plate_mesh("sheet", 30, 3.0, waves).replace("TriangleMesh(", "TriangleMesh(thickness: 0.1, ");
    let models = vec![
        model("balls", &rough(1e5), &movers.joined()),
        model("sheet", &rough(1e5), &thick),
        model("veil", &rough(4e4), &veil),
    ];
    let mut scene = Scene::new("sheets", 300, models);
    scene.contact_capacity = Some(100);
    scene.objects = vec![0, 1, 2];
    scene.pairs = vec![(0, 1), (2, 0)];
    scene.paths = vec![
        Path {
            center: [0.0, 0.0, 0.0],
            swing: [0.1, 0.1, 0.3],
            period: [140.0, 110.0, 90.0],
            turn: [0.05, 0.06, 0.2],
            turn_period: 160.0,
        },
        Path::still([0.0; 3]),
        Path { swing: [0.0, 0.0, 0.05], ..Path::still([0.0; 3]) },
    ];
    scene
}

/// Everything deep into a plate of convex pieces with internal faces, so that the side of entry is
/// remembered.
fn pieces() -> Scene {
    let mut movers = Parts::new(5);
    movers.points(700, [0.0, 0.0, 0.0], [1.2, 0.4, 0.1]);
    movers.spheres(30, [0.0, 0.0, 0.05], [1.2, 0.4, 0.1], 0.1);
    movers.ellipsoids(20, [0.0, 0.0, 0.05], [1.2, 0.4, 0.05], 0.12);
    movers.segments(20, [0.0, 0.0, 0.0], [1.2, 0.4, 0.05], 0.6);
    movers.rays(20, [0.0, 0.0, 0.1], [1.2, 0.4, 0.1], 0.2);
    let piece = |index: i32| {
        let walls = ["5", "4,5", "4"][usize::from(index > 0) + usize::from(index == 5)];
        let center = -1.25 + 0.5 * f64::from(index);
        box_polyhedron(&format!("piece_{index}"), [center, 0.0, -0.1], [0.25, 0.5, 0.1], walls)
    };
    let plate: Vec<_> = (0..6).map(piece).collect();
    let models =
        vec![model("movers", &rough(1e5), &movers.joined()), model("plate", &rough(3e5), &plate.join(", "))];
    let mut scene = Scene::new("pieces", 300, models);
    scene.contact_capacity = Some(900);
    scene.paths = vec![
        Path {
            center: [0.0, 0.0, 0.02],
            swing: [0.4, 0.2, 0.15],
            period: [150.0, 90.0, 60.0],
            turn: [0.08, 0.05, 0.1],
            turn_period: 100.0,
        },
        Path::still([0.0; 3]),
    ];
    scene
}

/// Custom laws, primitives and bounding volumes; Hertz contacts, regularised friction.
fn own_kinds() -> Scene {
    let own = "\"s\": (stiffness: 1.0, normal: Custom(name: \"quadratic\", parameters: [3e6]), \
               friction: Custom(name: \"glue\", parameters: [500.0]))";
    let hertz = "\"h\": (stiffness: 1e7, normal: HuntCrossley(dissipation: 0.4, exponent: 1.5), \
                 friction: Coulomb(mu: 0.4, slip_speed: 1e-2))";
    let surfaces = format!("{own}, {hertz}");
    let mut movers = Parts::new(6);
    movers.points(500, [0.0, 0.0, 0.0], [0.6, 0.6, 0.02]);
    movers.spheres(40, [0.0, 0.0, 0.05], [0.6, 0.6, 0.02], 0.08);
    let hard = "Sphere(name: \"hard\", center: (0.3,0.3,0.05), radius: 0.1, surface: \"h\")";
    let movers = model("movers", &surfaces, &format!("{}, {hard}", movers.joined()))
        .replace("root: (", "root: (bound: Custom(\"Everywhere\"), ");
    let targets = "Custom(name: \"post\", kind: \"Post\", parameters: [0.25]), \
                   Custom(name: \"pole\", kind: \"Post\", parameters: [0.1], surface: \"s\"), \
                   Plane(name: \"floor\", normal: (0,0,1), offset: 0.0), \
                   Plane(name: \"anvil\", normal: (0,0,1), offset: 0.01, surface: \"h\")";
    let targets = model("targets", &surfaces, targets);
    let friction = "friction: Bristle(mu: 0.2, damping: 0.0)";
    let pairs = format!(
        "pairs: [(surfaces: (\"h\", \"s\"), stiffness: 2e6, normal: Linear(damping: 20.0), {friction})],"
    );
    let with_pairs = |text: String| text.replace("root: (", &format!("{pairs} root: ("));
    let mut scene = Scene::new("own_kinds", 300, vec![with_pairs(movers), with_pairs(targets)]);
    scene.contact_capacity = Some(1400);
    scene.own_kinds = true;
    scene.paths = vec![
        Path {
            center: [0.1, 0.0, 0.0],
            swing: [0.15, 0.1, 0.03],
            period: [77.0, 101.0, 43.0],
            turn: [0.02, 0.02, 0.1],
            turn_period: 90.0,
        },
        Path::still([0.0; 3]),
    ];
    scene
}

/// More contacts than the capacity, most of the time.
fn crowd() -> Scene {
    let mut movers = Parts::new(7);
    movers.points(2500, [0.0, 0.0, 0.0], [0.8, 0.8, 0.04]);
    movers.spheres(30, [0.0, 0.0, 0.05], [0.8, 0.8, 0.05], 0.08);
    let plate = [
        box_polyhedron("block", [-0.5, 0.0, -0.1], [0.5, 0.9, 0.1], ""),
        plate_mesh("sheet", 16, 1.0, |x, y| waves(x, y) + Vec3::new(0.5, 0.0, 0.0)),
    ];
    let models =
        vec![model("movers", &rough(1e4), &movers.joined()), model("plate", &rough(1e6), &plate.join(", "))];
    let mut scene = Scene::new("crowd", 300, models);
    scene.contact_capacity = Some(60);
    scene.paths = vec![
        Path {
            center: [0.0, 0.0, 0.06],
            swing: [0.05, 0.05, 0.1],
            period: [90.0, 70.0, 80.0],
            turn: [0.01, 0.01, 0.1],
            turn_period: 120.0,
        },
        Path::still([0.0; 3]),
    ];
    scene
}

/// Balls in a funnel that fits them: more contacts of one ball, with normals further apart, than can be
/// shared exactly.
fn bowl() -> Scene {
    let mut movers = Parts::new(8);
    for _ in 0..5 {
        movers.add("Sphere", "center: (0,0,0), radius: 0.2");
    }
    movers.add("Ellipsoid", "center: (0,0,0), semi_axes: (0.2,0.19,0.18)");
    let place = |x: f64, y: f64| {
        // A sphere without its lid, with its front inside.
        let (up, around) = (2.2 * (y + 0.5), std::f64::consts::TAU * (x + 0.5));
        let out = 0.198 * libm::sin(up + 0.3);
        Vec3::new(out * libm::sin(around), out * libm::cos(around), -0.198 * libm::cos(up + 0.3))
    };
    let bowl = plate_mesh("bowl", 18, 1.0, place);
    let models = vec![model("balls", &rough(1e5), &movers.joined()), model("bowl", &rough(1e5), &bowl)];
    let mut scene = Scene::new("bowl", 20, models);
    scene.contact_capacity = Some(2000);
    scene.paths = vec![
        Path {
            center: [0.0, 0.0, 0.0005],
            swing: [0.001, 0.001, 0.001],
            period: [23.0, 31.0, 41.0],
            turn: [0.1, 0.1, 0.1],
            turn_period: 60.0,
        },
        Path::still([0.0; 3]),
    ];
    scene
}

/// Enough pairs that the work of a frame is laid out in two rounds.
fn swarm() -> Scene {
    const OBJECTS: usize = 60;
    let mut body = Parts::new(9);
    body.points(3, [0.0; 3], [0.2, 0.2, 0.2]);
    body.segments(1, [0.0; 3], [0.2, 0.2, 0.2], 0.2);
    body.text.push("Sphere(name: \"ball\", center: (0,0,0), radius: 0.1)".to_owned());
    body.text.push("Ellipsoid(name: \"egg\", center: (0.1,0,0), semi_axes: (0.2,0.1,0.15))".to_owned());
    let mut scene = Scene::new("swarm", 24, vec![model("bee", &rough(1e4), &body.joined())]);
    scene.contact_capacity = Some(5000);
    scene.objects = vec![0; OBJECTS];
    scene.pairs = (0..OBJECTS).flat_map(|a| (a + 1..OBJECTS).map(move |b| (b, a))).collect();
    let mut random = Random(10);
    scene.paths = (0..OBJECTS)
        .map(|_| Path {
            center: random_triple(&mut random, 0.12),
            swing: [0.05, 0.05, 0.05],
            period: [random.between(20.0, 60.0), random.between(20.0, 60.0), random.between(20.0, 60.0)],
            turn: random_triple(&mut random, 0.5),
            turn_period: random.between(30.0, 90.0),
        })
        .collect();
    scene.forgets = |frame| (frame % 7 == 3).then_some(frame);
    scene
}

fn random_triple(random: &mut Random, size: f64) -> [f64; 3] {
    [0; 3].map(|_| random.between(-size, size))
}

/// Everything over a log, a roller and a plug that lie down, and in a hole; rods and pins too large for it,
/// in it and through a mouth. Round parts on a floor.
fn round() -> Scene {
    let mut movers = Parts::new(11);
    for station in 0..3 {
        let x = 3.0 * f64::from(station);
        movers.every_mover([x, 0.0, 0.0], [0.35, 0.35, 0.02]);
        for turn in [0.0, 0.25, 0.5] {
            movers.add("Capsule", &format!("ends: (({x:?},-0.5,0.1),({x:?},{turn:?},0.08)), radius: 0.1"));
        }
    }
    movers.every_mover([9.0, 0.0, 0.0], [0.32, 0.32, 0.3]);
    for (index, side) in ["(8.8,0.1,0)", "(9.1,-0.2,0.1)", "(9.25,0.1,-0.2)"].into_iter().enumerate() {
        movers.add("Ray", &format!("origin: {side}, direction: (1,{index},0.1), length: 0.2"));
    }
    let in_hole = [
        "Capsule(name: \"rod\", ends: ((9.2,0.02,-0.5),(9.18,0,0.1)), radius: 0.1)",
        "Cylinder(name: \"pin\", ends: ((9,0,-0.2),(9.01,0,0.2)), radius: 0.29)",
        "Cylinder(name: \"tight\", ends: ((9,0,-0.2),(9,0.01,0.6)), radius: 0.302)",
        "Cylinder(name: \"through\", ends: ((9,0,0.9),(9.03,0,-0.8)), radius: 0.28)",
    ];
    let on_floor = [
        "Capsule(name: \"log\", ends: ((12,0,-0.41),(12.3,0,-0.4)), radius: 0.1)",
        "Cylinder(name: \"roller\", ends: ((12,1,-0.41),(12.3,1,-0.4)), radius: 0.1)",
        "Cone(name: \"plug\", ends: ((12,2,-0.41),(12.3,2,-0.43)), radii: (0.1,0.08))",
        "Capsule(name: \"on_box\", ends: ((14.7,0,0.08),(15.3,0.1,0.1)), radius: 0.1)",
        "Capsule(name: \"over_box\", ends: ((15.1,0.2,0.3),(15.9,0.2,-0.4)), radius: 0.15)",
        "Cylinder(name: \"drum\", ends: ((2.7,0,0.09),(3.2,0.05,0.09)), radius: 0.1)",
        "Cone(name: \"stub\", ends: ((2.6,0.1,0.08),(2.9,0.1,0.09)), radii: (0.1,0.09))",
        "Cylinder(name: \"over_plug\", ends: ((5.8,0,0.09),(6.2,0.02,0.1)), radius: 0.1)",
        "Cone(name: \"on_plug\", ends: ((5.6,0.05,0.09),(5.9,0.05,0.1)), radii: (0.1,0.08))",
        "Cylinder(name: \"wheel\", ends: ((14.8,0.1,0.09),(15.2,0.12,0.09)), radius: 0.1)",
        "Cone(name: \"knob\", ends: ((14.8,-0.2,0.09),(15.0,-0.2,0.1)), radii: (0.1,0.11))",
        "Cylinder(name: \"tyre\", ends: ((17.9,0.3,0.09),(18.2,0.3,0.09)), radius: 0.1)",
        "Cone(name: \"tip\", ends: ((17.9,-0.3,0.09),(18.1,-0.3,0.09)), radii: (0.1,0.11))",
        "Capsule(name: \"on_plate\", ends: ((17.8,0,0.08),(18.2,0.1,0.1)), radius: 0.1)",
    ];
    movers.text.extend(in_hole.iter().chain(&on_floor).map(|text| (*text).to_owned()));
    let targets = [
        "Capsule(name: \"log\", ends: ((-0.5,0,-0.3),(0.5,0,-0.31)), radius: 0.3)",
        "Cylinder(name: \"roller\", ends: ((2.5,0,-0.3),(3.5,0,-0.3)), radius: 0.3)",
        "Cone(name: \"plug\", ends: ((5.5,0,-0.3),(6.5,0,-0.3)), radii: (0.32,0.28))",
        "Bore(name: \"hole\", ends: ((9,0,-0.3),(9,0,0.3)), radii: (0.3,0.31), thickness: 0.1)",
        "Plane(name: \"floor\", normal: (0,0,1), offset: -0.5)",
        &box_polyhedron("box", [15.0, 0.0, -0.2], [0.5, 0.4, 0.2], ""),
        &plate_mesh("plate", 5, 1.0, |x, y| Vec3::new(18.0 + x, y, 0.01 * (x * 7.0).sin())),
    ];
    let models = vec![
        model("movers", &rough(2e5), &movers.joined()),
        model("targets", &rough(1e6), &targets.join(", ")),
    ];
    let mut scene = Scene::new("round", 200, models);
    // The length of the state block follows from the capacity.
    scene.contact_capacity = Some(8601);
    scene.paths = vec![
        Path {
            center: [0.0, 0.0, 0.0],
            swing: [0.03, 0.04, 0.05],
            period: [90.0, 130.0, 70.0],
            turn: [0.004, 0.003, 0.002],
            turn_period: 110.0,
        },
        Path { turn: [0.004, 0.0, 0.002], ..Path::still([0.0, 0.0, 0.0]) },
    ];
    scene
}
