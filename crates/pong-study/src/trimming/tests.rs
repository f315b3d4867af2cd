//! Distances with closed forms, primitives removed and kept, output files.

use super::shape::Shape;
use super::{Output, Settings, Trimmed, trim};
use crate::Result;
use crate::runs::samples::{Folder, model, scene};
use pong_geometry::{Pose, Vec3};
use pong_model::{Extensions, Model};
use pong_testkit::Random;
use std::path::Path;

/// A falling ball of 0.1 m; its antenna is 2 m above, its tag is a primitive of a group of its own.
const BALL: &str = "groups: [(name: \"body\", primitives: [Sphere(name: \"skin\", center: (0, 0, 0), radius: 0.1), \
                    Point(name: \"antenna\", position: (0, 0, 2))]), \
                    (name: \"mast\", primitives: [Sphere(name: \"top\", center: (0, 0, 3), radius: 0.1)])]";
/// A floor of two boxes that form one solid, and a post far away.
fn floor() -> String {
    format!(
        "groups: [(name: \"slabs\", primitives: [{}, {}]), (name: \"posts\", primitives: [{}])]",
        slab("here", (-1.0, 1.0), "[3]"),
        slab("joined", (1.0, 3.0), "[5]"),
        slab("post", (-4.0, -3.9), "[]")
    )
}

/// A box between two values of x, 2 m wide, below z = 0; its `inactive` faces join another piece of the
/// solid.
fn slab(name: &str, (from, to): (f64, f64), inactive: &str) -> String {
    let corner = |x: f64, y: f64, z: f64| format!("({x}, {y}, {z})");
    let ring =
        |z: f64| [corner(from, -1.0, z), corner(to, -1.0, z), corner(to, 1.0, z), corner(from, 1.0, z)];
    format!(
        "Polyhedron(name: \"{name}\", vertices: [{}, {}], \
         faces: [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]], inactive_faces: {inactive})",
        ring(-1.0).join(", "),
        ring(0.0).join(", ")
    )
}

fn settings(margin: f64) -> Settings {
    Settings {
        margin,
        rounds: 1,
        frames: 64,
        duration_s: None,
        output: Output::default(),
        extensions: Extensions::new(),
    }
}

fn trimmed(path: &Path, settings: &Settings) -> Result<Trimmed> {
    trim(&[path], settings, &mut |_, _, _| Ok(()))
}

fn ball_on_floor(folder: &Folder) -> std::path::PathBuf {
    let start = "position: (0, 0, 0.0999), linear_velocity: (0.3, 0.1, -0.2)";
    scene(folder, ("ball", BALL), ("floor", &floor()), start)
}

fn paths(file: &Path) -> Vec<String> {
    let model = pong_model::load(file, &Extensions::new()).unwrap();
    model.bodies.iter().flat_map(|body| body.primitives.iter().map(|p| p.path.clone())).collect()
}

/// A group that a filter of the model or of the scene names keeps its nearest primitive, and the filter.
#[test]
fn groups_that_filters_name_stay() {
    let folder = Folder::new("trim_filters");
    let path = ball_on_floor(&folder);
    let text = std::fs::read_to_string(&path).unwrap();
    let filtered = text.replace("pairs:", "filters: [(\"ball/mast\", \"floor/slabs\")], pairs:");
    std::fs::write(&path, filtered).unwrap();
    let page = trimmed(&path, &settings(0.5)).unwrap();
    assert_eq!(paths(page.models[0].written.as_ref().unwrap()), ["ball/body/skin", "ball/mast/top"]);

    let arm = "(name: \"arm\", movable: true, primitives: [Sphere(name: \"hand\", center: (0, 0, 0), radius: 0.1)])";
    let root = BALL.replace("groups: [", &format!("groups: [{arm}, "));
    let of_model = model("ball", &root).replace("root:", "filters: [(\"arm\", \"mast\")], root:");
    let folder = Folder::new("trim_filters_of_model");
    let path = ball_on_floor(&folder);
    folder.write("ball.ron", &of_model);
    let bodies = "bodies: [(group: \"arm\", motion: Fixed, position: (0, 0, 3)), (";
    std::fs::write(&path, text.replacen("bodies: [(", bodies, 1)).unwrap();
    let written = trimmed(&path, &settings(0.5)).unwrap().models[0].written.clone().unwrap();
    assert_eq!(paths(&written), ["ball/body/skin", "ball/mast/top", "ball/arm/hand"]);
    let trimmed = pong_model::load(&written, &Extensions::new()).unwrap();
    assert_eq!(trimmed.filters, [["ball/arm".to_owned(), "ball/mast".to_owned()]]);
}

#[test]
fn what_never_came_near_goes_with_its_group() {
    let folder = Folder::new("trim_goes");
    let page = trimmed(&ball_on_floor(&folder), &settings(0.5)).unwrap();
    let [ball, floor] = &page.models[..] else { panic!("{} models", page.models.len()) };
    let gone: Vec<(&str, f64)> = ball.gone.iter().map(|gone| (gone.path.as_str(), gone.nearest)).collect();
    assert_eq!(
        gone.iter().map(|(path, _)| *path).collect::<Vec<_>>(),
        ["ball/body/antenna", "ball/mast/top"]
    );
    // The ball begins to roll: the antenna 2 m above it comes down by some centimetres, and the mast's end by
    // less.
    assert!((1.7..2.1).contains(&gone[0].1) && (2.6..3.0).contains(&gone[1].1), "{gone:?}");
    assert_eq!(paths(ball.written.as_ref().unwrap()), ["ball/body/skin"]);
    // The second slab is 1 m away, but part of one solid with the first.
    assert_eq!(paths(floor.written.as_ref().unwrap()), ["floor/slabs/here", "floor/slabs/joined"]);
    let run = &page.runs[0];
    assert_eq!(run.frames, 101);
    assert_eq!(run.testers[&("Point".to_owned(), "Polyhedron".to_owned())], [3, 0]);
    assert_eq!(run.testers[&("Sphere".to_owned(), "Polyhedron".to_owned())], [6, 2]);
    assert!(
        super::report::page(&page).contains("Contact testers that nothing needs any more: Point–Polyhedron.")
    );
}

#[test]
fn the_margin_decides() {
    let folder = Folder::new("trim_margin");
    let run = ball_on_floor(&folder);
    let page = trimmed(&run, &settings(2.5)).unwrap();
    let gone: Vec<&str> = page.models[0].gone.iter().map(|gone| gone.path.as_str()).collect();
    assert_eq!(gone, ["ball/mast/top"]);
    let settings = Settings { output: Output { folder: None, force: true }, ..settings(10.0) };
    let page = trimmed(&run, &settings).unwrap();
    assert!(page.models.iter().all(|model| model.gone.is_empty() && model.written.is_none()));
    assert!(
        trimmed(&run, &self::settings(-1.0)).is_err() && trimmed(&run, &self::settings(f64::NAN)).is_err()
    );
}

/// A movable group keeps its nearest primitive, because a host sets its state.
#[test]
fn a_movable_group_keeps_one_primitive() {
    let folder = Folder::new("trim_movable");
    let far =
        "primitives: [Point(name: \"high\", position: (0, 0, 9)), Point(name: \"low\", position: (0, 0, 5))]";
    let run = scene(&folder, ("far", far), ("floor", &floor()), "position: (0, 0, 0)");
    let page = trimmed(&run, &settings(0.1)).unwrap();
    assert_eq!(paths(page.models[0].written.as_ref().unwrap()), ["far/low"]);
}

#[test]
fn files_that_are_there_and_logs_without_a_folder_are_refused() {
    let folder = Folder::new("trim_refused");
    let run = ball_on_floor(&folder);
    trimmed(&run, &settings(0.5)).unwrap();
    let told = trimmed(&run, &settings(0.5)).unwrap_err().to_string();
    assert!(told.contains("ball_trimmed.ron: it is there already"), "{told}");
}

fn primitives(text: &str) -> Model {
    pong_model::parse(&model("m", &format!("primitives: [{text}]")), "m", None, &Extensions::new()).unwrap()
}

fn apart(a: &Model, b: &Model, x_wa: &Pose, x_wb: &Pose) -> f64 {
    let (a, b) = (Shape::new(&a.bodies[0], 0), Shape::new(&b.bodies[0], 0));
    a.apart(&b, &Pose::relative(x_wa, x_wb).transform())
}

/// Distances of balls and planes have closed forms, in any pose and either order.
#[test]
fn distances_of_balls_and_planes_are_exact() {
    let ball = primitives("Sphere(name: \"ball\", center: (0.3, -0.2, 0.1), radius: 0.25)");
    let plane = primitives("Plane(name: \"plane\", normal: (0.6, 0, 0.8), offset: 0.4)");
    let mut random = Random::new(11, 0, 0);
    for _ in 0..200 {
        let [x_wa, x_wb] = [(); 2].map(|()| pose(&mut random));
        let center = |x: &Pose| x.transform().point(&Vec3::new(0.3, -0.2, 0.1));
        let balls = (center(&x_wa) - center(&x_wb)).norm() - 0.5;
        assert!((apart(&ball, &ball, &x_wa, &x_wb) - balls).abs() < 1e-12);
        let x_bw = x_wb.transform().inverse();
        let height = x_bw.point(&center(&x_wa)).dot(&Vec3::new(0.6, 0.0, 0.8)) - 0.4 - 0.25;
        assert!((apart(&ball, &plane, &x_wa, &x_wb) - height).abs() < 1e-12);
        assert!((apart(&plane, &ball, &x_wb, &x_wa) - height).abs() < 1e-12);
    }
}

/// A lower bound is never above the distance between any two points of the primitives, rotated and moved at
/// random.
#[test]
fn distances_are_lower_bounds() {
    let kinds = [
        (
            "LineSegment(name: \"x\", ends: ((-0.5, 0.1, 0), (0.4, 0.2, 0.3)))",
            vec![(-0.5, 0.1, 0.0), (0.4, 0.2, 0.3)],
        ),
        (
            "TriangleMesh(name: \"x\", vertices: [(0, 0, 0), (1, 0, 0.2), (0, 1, 0.1), (1, 1, 0)], triangles: [(0, 1, 2), (1, 3, 2)])",
            vec![(0.0, 0.0, 0.0), (1.0, 0.0, 0.2), (0.0, 1.0, 0.1), (1.0, 1.0, 0.0)],
        ),
    ];
    let mut random = Random::new(5, 0, 0);
    let mut nearly = 0;
    for _ in 0..2000 {
        let picked = [(); 2].map(|()| &kinds[(random.bits() % 2) as usize]);
        let poses = [(); 2].map(|()| pose(&mut random));
        let bound = apart(&primitives(picked[0].0), &primitives(picked[1].0), &poses[0], &poses[1]);
        let mut least = f64::INFINITY;
        for one in &picked[0].1 {
            for other in &picked[1].1 {
                let place = |x: &Pose, &(a, b, c): &(f64, f64, f64)| x.transform().point(&Vec3::new(a, b, c));
                least = least.min((place(&poses[0], one) - place(&poses[1], other)).norm());
            }
        }
        assert!(bound <= least + 1e-12, "{bound} {least}");
        nearly += usize::from(bound > 0.5 * least);
    }
    // The bounds must also be close: a bound of zero would pass, too.
    assert!(nearly > 1000, "{nearly}");
}

fn pose(random: &mut Random) -> Pose {
    let mut number = || random.between(-2.0, 2.0);
    let place = Vec3::new(number(), number(), number());
    let quaternion = [number(), number(), number(), number()];
    let length = libm::sqrt(quaternion.iter().map(|part| part * part).sum());
    Pose::new(place, quaternion.map(|part| part / length))
}
