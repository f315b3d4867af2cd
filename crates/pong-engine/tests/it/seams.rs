//! Seams have no effect (docs/theory.md, 2.2): a plate cut into triangles or convex pieces of any size acts
//! like one plane.

use crate::common::*;
use pong_geometry::{Quat, Vec3};
use pong_testkit::{Random, long_samples, samples};

const K: f64 = 1e5;
const SIZE: f64 = 1.0;

fn steel() -> String {
    surface(K, "normal: Linear(damping: 50.0)")
}

fn balls() -> String {
    let primitives = "Sphere(name: \"ball\", center: (0,0,0.1), radius: 0.1), \
        Ellipsoid(name: \"egg\", center: (0,0,0.06), semi_axes: (0.12,0.07,0.06), orientation: (0.8,0.0,0.0,0.6))";
    model("balls", &steel(), primitives)
}

fn plane() -> String {
    model("plane", &steel(), "Plane(name: \"p\", normal: (0,0,1), offset: 0.0)")
}

/// The plate rotated by an awkward rotation and rounded to f32, as a modelling tool stores it.
fn tilted(q: &Quat, f32_vertices: bool) -> impl Fn(f64, f64) -> Vec3 + '_ {
    move |x, y| {
        let p = q * Vec3::new(x, y, 0.0);
        if f32_vertices { p.map(|c| f64::from(c as f32)) } else { p }
    }
}

fn mesh(cells: usize, q: &Quat, f32_vertices: bool) -> String {
    model("mesh", &steel(), &plate_mesh("mesh", cells, SIZE, tilted(q, f32_vertices)))
}

/// Cells along a side of the plates of triangles.
fn grids() -> impl Iterator<Item = usize> {
    let most = samples(10_000);
    [1, 10, 100].into_iter().filter(move |cells| cells * cells <= most)
}

/// Pieces of the plates of boxes.
fn counts() -> impl Iterator<Item = usize> {
    let most = samples(20_000);
    [1, 2, 7, 2000, 20_000].into_iter().filter(move |count| *count <= most)
}

/// Slides the balls over plate and plane alike and returns the worst differences, relative to the normal
/// force: along the normal, and across it.
fn worst_difference(plate: &str, q: &Quat, random: &mut Random, places: &[Vec3]) -> (f64, f64) {
    let mut on_plate = Rig::new(&balls(), plate);
    let mut on_plane = Rig::new(&balls(), &plane());
    let normal = q * Vec3::z();
    let (mut along, mut across) = (0.0_f64, 0.0_f64);
    for place in places {
        // The plane lies flat: its scene is the plate's, in the plate's own axes.
        let local = Vec3::new(place.x, place.y, -1e-3);
        let spin = Quat::from_scaled_axis(random.vector(0.2));
        on_plate.place_a(q * local, q * spin);
        on_plane.place_a(local, spin);
        on_plate.world.step().unwrap();
        on_plane.world.step().unwrap();
        let force = on_plate.wrench(0).force;
        let expected = on_plane.wrench(0).force.z;
        assert!(expected > 50.0);
        along = along.max((force.dot(&normal) - expected).abs() / expected);
        across = across.max((force - normal * normal.dot(&force)).norm() / expected);
    }
    (along, across)
}

/// Random positions, and the worst ones: over vertices, edge midpoints and along edges of the grid.
fn places(cells: usize, random: &mut Random) -> Vec<Vec3> {
    let step = SIZE / cells as f64;
    let mut places: Vec<Vec3> = (0..long_samples(100, 300)).map(|_| random.vector(0.3)).collect();
    for i in 0..long_samples(20, 60) {
        let (a, b) = ((i % 7) as f64 - 3.0, (i % 5) as f64 - 2.0);
        let node = Vec3::new((a * step).clamp(-0.3, 0.3), (b * step).clamp(-0.3, 0.3), 0.0);
        places.push(node);
        places.push(node + Vec3::new(step / 2.0, 0.0, 0.0));
        places.push(node + Vec3::new(step / 2.0, step / 2.0, 0.0));
        places.push(node + Vec3::new(1e-16, -1e-16, 0.0));
    }
    places.iter().map(|p| p.map(|x| x.clamp(-0.3, 0.3))).collect()
}

#[test]
fn a_plate_of_two_to_twenty_thousand_triangles_is_one_plane() {
    let mut random = Random(9);
    let turns = [Quat::identity(), Quat::from_scaled_axis(Vec3::new(0.4, -0.9, 1.3))];
    for cells in grids() {
        for q in &turns {
            let places = places(cells, &mut random);
            let (along, across) = worst_difference(&mesh(cells, q, false), q, &mut random, &places);
            println!(
                "{} triangles: normal force off by {along:.1e}, side force {across:.1e}",
                2 * cells * cells
            );
            assert!(along <= 1e-9 && across <= 1e-9, "{cells} cells: {along:e} {across:e}");
        }
    }
}

/// With vertices in f32 the plate itself is wavy: slopes are the rounding over the cell size, height errors
/// the rounding over the depth of 1 mm.
#[test]
fn f32_vertices_show_only_their_own_waviness() {
    let mut random = Random(10);
    let q = Quat::from_scaled_axis(Vec3::new(-0.7, 0.3, 0.2));
    for cells in grids() {
        let places = places(cells, &mut random);
        let (along, across) = worst_difference(&mesh(cells, &q, true), &q, &mut random, &places);
        let rounding = f64::from(f32::EPSILON) * SIZE;
        let (height, slope) = (4.0 * rounding / 1e-3, 8.0 * rounding * cells as f64 / SIZE);
        println!(
            "{} f32 triangles: normal force off by {along:.1e}, side force {across:.1e}",
            2 * cells * cells
        );
        assert!(along <= height + slope && across <= slope, "{cells} cells: {along:e} {across:e}");
    }
}

fn pieces(count: usize) -> String {
    let width = SIZE / count as f64;
    let boxes: Vec<String> = (0..count)
        .map(|i| {
            // Faces 4 and 5 look along −x and +x: the internal faces to the neighbours.
            let walls = match (i > 0, i + 1 < count) {
                (true, true) => "4,5",
                (true, false) => "4",
                (false, true) => "5",
                (false, false) => "",
            };
            let left = i as f64 * width - SIZE / 2.0;
            let right = (i + 1) as f64 * width - SIZE / 2.0;
            box_between(&format!("b{i}"), [left, -0.5, -0.4], [right, 0.5, 0.0], walls)
        })
        .collect();
    model("pieces", &steel(), &boxes.join(","))
}

fn box_between(name: &str, low: [f64; 3], high: [f64; 3], walls: &str) -> String {
    let v: Vec<String> = (0..8)
        .map(|i| {
            let c = |axis: usize| if i >> axis & 1 == 1 { high[axis] } else { low[axis] };
            format!("({:?},{:?},{:?})", c(0), c(1), c(2))
        })
        .collect();
    format!(
        "Polyhedron(name: \"{name}\", vertices: [{}], faces: [[0,2,3,1],[4,5,7,6],[0,1,5,4],[2,6,7,3],[0,4,6,2],[1,3,7,5]], inactive_faces: [{walls}])",
        v.join(",")
    )
}

#[test]
fn abutting_pieces_are_one_plate_for_balls() {
    let mut random = Random(12);
    let q = Quat::identity();
    for count in counts() {
        let places = places(count, &mut random);
        let (along, across) = worst_difference(&pieces(count), &q, &mut random, &places);
        println!("{count} pieces: normal force off by {along:.1e}, side force {across:.1e}");
        assert!(along <= 1e-9 && across <= 1e-9, "{count} pieces: {along:e} {across:e}");
    }
}

#[test]
fn abutting_pieces_are_one_plate_for_points_and_bars() {
    let movers = "Point(name: \"p\", position: (0.1,0.02,0.0)), \
                  LineSegment(name: \"l\", ends: ((-0.2,0.1,0.0),(0.2,-0.1,0.0)))";
    let movers = model("movers", &steel(), movers);
    let mut random = Random(13);
    for count in counts() {
        let mut on_pieces = Rig::new(&movers, &pieces(count));
        let mut on_plane = Rig::new(&movers, &plane());
        for step in 0..400 {
            let mut place = random.vector(0.15);
            if step % 4 == 0 {
                // The point exactly over an internal face.
                place.x = (place.x / (SIZE / count as f64)).round() * (SIZE / count as f64) - 0.1;
            }
            place.z = -1e-3;
            let spin = Quat::from_scaled_axis(Vec3::new(0.0, 0.0, random.between(-0.5, 0.5)));
            for rig in [&mut on_pieces, &mut on_plane] {
                rig.place_a(place, spin);
                rig.world.step().unwrap();
            }
            let (got, expected) = (on_pieces.wrench(0), on_plane.wrench(0));
            let force = (got.force - expected.force).norm() / expected.force.norm();
            assert!(force <= 1e-9, "{count} pieces, step {step}: {force:e} {got:?} {expected:?}");
            let moment = (got.moment - expected.moment).norm() / expected.force.norm();
            assert!(moment <= 1e-9, "{count} pieces, step {step}: moment off by {moment:e}");
        }
    }
}

/// Friction is shared like the normal force: no bump, no doubled bristle while rolling over seams.
#[test]
fn friction_does_not_see_the_seams() {
    let rough = surface(K, "friction: Bristle(mu: 0.5)");
    let ball = model("ball", &rough, "Sphere(name: \"b\", center: (0,0,0), radius: 0.1)");
    let plate = model("plate", &rough, &plate_mesh("m", 40, SIZE, |x, y| Vec3::new(x, y, 0.0)));
    let flat = model("flat", &rough, "Plane(name: \"p\", normal: (0,0,1), offset: 0.0)");
    let mut rigs = [Rig::new(&ball, &plate), Rig::new(&ball, &flat)];
    for step in 0..2000 {
        let t = f64::from(step) * 1e-3;
        let position = Vec3::new(0.25 * (2.0 * t).sin(), 0.25 * (3.0 * t).cos(), 0.099);
        let velocity = Vec3::new(0.5 * (2.0 * t).cos(), -0.75 * (3.0 * t).sin(), 0.0);
        let turn = Quat::from_scaled_axis(Vec3::new(0.0, 3.0 * t, 0.0));
        for rig in &mut rigs {
            let state = moving(position, turn, velocity, Vec3::new(0.0, 3.0, 0.0));
            rig.place([state, pong_engine::State::identity()]);
            rig.world.step().unwrap();
        }
        let [got, expected] = [rigs[0].wrench(0).force, rigs[1].wrench(0).force];
        assert!((got - expected).norm() <= 1e-9 * expected.norm(), "step {step}: {got:?} {expected:?}");
    }
}

/// A roof in two pieces, with the ridge where their internal faces meet, and the same roof in one.
fn roofs() -> [String; 2] {
    let halves = "Polyhedron(name: \"l\", vertices: [(-1,-1,0),(0,-1,0),(0,1,0),(-1,1,0),(0,-1,0.5),(0,1,0.5)], \
                  faces: [[0,3,2,1],[0,4,5,3],[1,2,5,4],[0,1,4],[2,3,5]], inactive_faces: [2]), \
                  Polyhedron(name: \"r\", vertices: [(1,-1,0),(0,-1,0),(0,1,0),(1,1,0),(0,-1,0.5),(0,1,0.5)], \
                  faces: [[0,1,2,3],[0,3,5,4],[1,4,5,2],[0,4,1],[3,2,5]], inactive_faces: [2])";
    let whole = "Polyhedron(name: \"w\", vertices: [(-1,-1,0),(1,-1,0),(1,1,0),(-1,1,0),(0,-1,0.5),(0,1,0.5)], \
                 faces: [[0,3,2,1],[0,4,5,3],[1,2,5,4],[0,1,4],[2,3,5]])";
    [model("halves", &steel(), halves), model("whole", &steel(), whole)]
}

/// A bar across a ridge is carried by it, wherever the pieces of the body meet.
#[test]
fn a_bar_across_a_ridge_between_two_pieces_is_carried() {
    let bar = model("bar", &steel(), "LineSegment(name: \"l\", ends: ((-0.6,0,0),(0.6,0.1,0)))");
    let mut rigs = roofs().map(|roof| Rig::new(&bar, &roof));
    let (mut random, mut touched) = (Random(14), 0);
    for step in 0..500 {
        let place =
            Vec3::new(random.between(-0.2, 0.2), random.between(-0.5, 0.5), 0.5 - random.between(1e-6, 2e-2));
        let spin = Quat::from_scaled_axis(Vec3::new(0.1, 0.3, 0.4).component_mul(&random.vector(1.0)));
        let wrenches = rigs.each_mut().map(|rig| {
            rig.place_a(place, spin);
            rig.world.step().unwrap();
            rig.wrench(0)
        });
        let size = wrenches[1].force.norm();
        touched += i32::from(size > 0.0);
        let error =
            (wrenches[0].force - wrenches[1].force).norm() + (wrenches[0].moment - wrenches[1].moment).norm();
        assert!(error <= 1e-9 * size, "step {step}: {wrenches:?}");
    }
    assert!(touched > 300, "{touched}");
}
