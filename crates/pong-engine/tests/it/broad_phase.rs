//! Searches of the trees of a movable group. The contacts of an element are the same, bit for bit, if it is
//! the only one of its leaf, if other such elements are searched for in turns with it, and if it is one of a
//! group whose candidates do not fit in one list.

use crate::common::*;
use pong_engine::{Config, State, StatusBits, WorldBuilder};
use pong_geometry::{Quat, Vec3};
use pong_testkit::Random;
use pong_testkit::ron::carried_box;

const CELLS: usize = 40;

/// An uneven sheet of `2 CELLS²` triangles, 4 m wide, in other axes; a thick one that intersects it; and a
/// bed of as many boxes as there are cells in a quarter of it.
fn ground(random: &mut Random, turn: &Quat, shift: &Vec3) -> String {
    let at = |i: usize, cells: usize| 4.0 * (i as f64 / cells as f64 - 0.5);
    let mut sheet = || {
        let numbers = (0..=CELLS).flat_map(|j| (0..=CELLS).map(move |i| (i, j)));
        let vertex =
            |(i, j)| turn * Vec3::new(at(i, CELLS), at(j, CELLS), random.between(-0.03, 0.03)) + shift;
        numbers.map(vertex).collect::<Vec<_>>()
    };
    let number = |i: usize, j: usize| j * (CELLS + 1) + i;
    let cell = |(i, j)| {
        let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    let cells = (0..CELLS).flat_map(|j| (0..CELLS).map(move |i| (i, j)));
    let triangles: Vec<[usize; 3]> = cells.flat_map(cell).collect();
    let mut all = vec![
        triangle_mesh("sheet", &sheet(), &triangles, ""),
        triangle_mesh("thick sheet", &sheet(), &triangles, "thickness: 0.6,"),
    ];
    const BOXES: usize = CELLS / 2;
    for j in 0..BOXES {
        for i in 0..BOXES {
            let middle = Vec3::new(at(i, BOXES), at(j, BOXES), random.between(-0.07, -0.03));
            let about = [middle, Vec3::new(0.07, 0.08, 0.05)];
            all.push(carried_box(&format!("box{i}x{j}"), about, "", |corner| turn * corner + shift));
        }
    }
    model("ground", &steel(), &all.join(","))
}

fn steel() -> String {
    surface(1e5, "friction: Bristle(mu: 0.3, stiffness: 1e5)")
}

/// Elements that reach many of the ground's, a few, and one.
fn elements() -> Vec<(&'static str, String)> {
    let shape = |kind: &str, fields: &str| format!("{kind}(name: \"NAME\", {fields}),\n");
    let center = "center: (CENTER)";
    vec![
        ("point", shape("Point", "position: (CENTER)")),
        ("sphere", shape("Sphere", &format!("{center}, radius: 0.25"))),
        ("large sphere", shape("Sphere", &format!("{center}, radius: 30.0"))),
        ("ellipsoid", shape("Ellipsoid", &format!("{center}, semi_axes: (0.4, 0.3, 0.2)"))),
        ("ellipsoid on edge", shape("Ellipsoid", &format!("{center}, semi_axes: (0.2, 0.3, 0.4)"))),
        ("large ellipsoid", shape("Ellipsoid", &format!("{center}, semi_axes: (20.0, 15.0, 9.0)"))),
        ("capsule", shape("Capsule", "ends: ((CENTER), (END)), radius: 0.2")),
        ("line segment", shape("LineSegment", "ends: ((CENTER), (END))")),
    ]
}

fn element(shape: &str, name: &str, center: f64) -> String {
    let text = |x: f64| format!("{x:?}, 0.0, 0.0");
    shape.replace("NAME", name).replace("CENTER", &text(center)).replace("END", &text(center + 0.7))
}

/// Extent of an upright element below its centre, m.
fn reach(name: &str) -> f64 {
    match name {
        "sphere" => 0.25,
        "large sphere" => 30.0,
        "ellipsoid" | "capsule" => 0.2,
        "ellipsoid on edge" => 0.4,
        "large ellipsoid" => 9.0,
        _ => 0.0,
    }
}

#[test]
fn a_single_element_finds_what_it_finds_among_others() {
    let mut random = Random::new(91, 0, 0);
    for (name, shape) in elements() {
        let (turn, shift) = (random.rotation(), random.vector(3.0));
        let ground = ground(&mut random, &turn, &shift);
        let config = || Config { ledger: true, contact_capacity: Some(4000), ..Config::default() };
        let rig = |elements: String| Rig::with_config(config(), &model("a", &steel(), &elements), &ground);
        let own = element(&shape, "own", 0.0);
        let far = element(&shape, "far", 300.0);
        let mut rigs = [rig(own.clone()), rig(own + &far)];
        let (mut found, mut most) = (0, 0);
        for frame in 0..40 {
            let along = Vec3::new(random.between(-1.2, 1.2), random.between(-1.2, 1.2), 0.0);
            // In some frames the centre is near the sheets, or as far behind them as its size.
            let deep =
                reach(name) * [random.between(2.0, 2.2), random.between(0.9, 1.1), 0.0, 0.0][frame % 4];
            let height = reach(name) - deep + random.between(-0.04, 0.01);
            let tilt = Quat::from_scaled_axis(random.vector(0.01));
            let position = turn * (along + Vec3::z() * height) + shift;
            let velocity = random.vector(0.2);
            for rig in &mut rigs {
                rig.place([moving(position, turn * tilt, velocity, Vec3::zeros()), State::identity()]);
                let report = rig.world.step().unwrap();
                assert!(!report.status.contains(StatusBits::CONTACT_LIMIT), "{name}");
            }
            let [alone, among_others] = [told(&rigs[0].world), told(&rigs[1].world)];
            assert_eq!(alone, among_others, "{name}, frame {frame}");
            (found, most) = (found + alone.len(), most.max(alone.len()));
        }
        println!("{name}: {found} contacts, at most {most} in a frame");
        assert!(found > 10, "{name}: {found}");
    }
}

/// Elements of every kind, three of each, against two grounds of two batches and one cut into many leaves:
/// more elements than run together, of kinds with different queries, and one with more trees than there are
/// searches.
#[test]
fn elements_together_find_what_each_finds_alone() {
    let mut random = Random::new(92, 0, 0);
    let (turn, shift) = (random.rotation(), random.vector(3.0));
    let whole = ground(&mut random, &turn, &shift);
    let cut = whole.replacen("surface: \"s\",", "surface: \"s\", leaf_size: 300,", 1);
    let beside = shift + turn * Vec3::x() * 0.5;
    let grounds = [&whole, &ground(&mut random, &turn, &beside), &cut];
    let kinds = elements();
    let (mut found, mut busiest) = (0, 0);
    let config = || Config { ledger: true, contact_capacity: Some(20_000), ..Config::default() };
    let model_of = |number: usize| {
        let (name, shape) = &kinds[number % kinds.len()];
        model(name, &steel(), &element(shape, "own", 0.0))
    };
    let count = 3 * kinds.len();
    let ground_of = |number: usize| grounds[number / 2 % grounds.len()];
    let mut alone: Vec<Rig> =
        (0..count).map(|number| Rig::with_config(config(), &model_of(number), ground_of(number))).collect();

    let mut builder = WorldBuilder::new(config());
    let mut objects = Vec::new();
    for number in 0..count {
        let of_element = load(&mut builder, &model_of(number));
        objects.push(builder.create_object(of_element, &format!("element {number}")).unwrap());
    }
    // After the elements, so that the pairs of one ground are not consecutive.
    let beds = grounds.map(|text| load(&mut builder, text));
    let beds = [0, 1, 2].map(|bed| builder.create_object(beds[bed], &format!("bed {bed}")).unwrap());
    for (number, &object) in objects.iter().enumerate() {
        builder.pair(object, beds[number / 2 % beds.len()]).unwrap();
    }
    let interfaces: Vec<_> =
        objects.iter().map(|&object| builder.scene().interface(object, "").unwrap()).collect();
    let at_rest = beds.map(|bed| (builder.scene().interface(bed, "").unwrap(), State::identity()));
    let (mut together, _) = builder.seal().unwrap();

    for frame in 0..30 {
        let (mut expected, mut boxes) = (Vec::new(), 0);
        for (number, rig) in alone.iter_mut().enumerate() {
            let along = Vec3::new(random.between(-1.2, 1.2), random.between(-1.2, 1.2), 0.0);
            let height = reach(kinds[number % kinds.len()].0) + random.between(-0.04, 0.01);
            let tilt = Quat::from_scaled_axis(random.vector(0.01));
            let position = turn * (along + Vec3::z() * height) + shift;
            let state = moving(position, turn * tilt, random.vector(0.2), Vec3::zeros());
            rig.place([state, State::identity()]);
            together.set_state(interfaces[number], &state).unwrap();
            let report = rig.world.step().unwrap();
            assert!(!report.status.contains(StatusBits::CONTACT_LIMIT));
            expected.extend(told(&rig.world));
            boxes += rig.world.counts().boxes_tested;
        }
        together.set_states(&at_rest).unwrap();
        let report = together.step().unwrap();
        assert!(!report.status.contains(StatusBits::CONTACT_LIMIT));
        let mut contacts = told(&together);
        // In the order of pairs of movable groups, which differs in a world with several grounds.
        contacts.sort();
        expected.sort();
        assert!(contacts == expected, "frame {frame}: {} contacts, {} alone", contacts.len(), expected.len());
        assert_eq!(together.counts().boxes_tested, boxes, "frame {frame}");
        found += contacts.len();
        busiest = busiest.max(contacts.len());
    }
    println!("{found} contacts, at most {busiest} in a frame");
    assert!(found > 1000);
}

/// Spheres on a ground of 6,800 elements, in a leaf of eight chunks. They reach more elements than a list of
/// candidates holds, 1,024. The list has room for the elements that half of the chunks reach in the first
/// case, for those of a quarter in the second, and not even for those of one chunk in the third. The same
/// spheres in leaves of at most one chunk have the same contacts.
#[test]
fn candidates_beyond_the_list_are_searched_for_fewer_chunks() {
    const SPHERES: usize = 64;
    let mut random = Random::new(93, 0, 0);
    let ground = ground(&mut random, &Quat::identity(), &Vec3::zeros());
    let mut found = 0;
    for (wide, radius) in [(0.8, 0.05), (1.2, 0.05), (0.5, 3.0)] {
        let spheres = (0..SPHERES).map(|number| {
            let [x, y] = [random.between(-wide, wide), random.between(-wide, wide)];
            let center = format!("{x:?}, {y:?}, {radius:?}");
            format!("Sphere(name: \"sphere {number}\", center: ({center}), radius: {radius:?}),\n")
        });
        let whole = model("spheres", &steel(), &spheres.collect::<String>());
        let cut = whole.replacen("surface: \"s\",", "surface: \"s\", leaf_size: 8,", 1);
        assert_ne!(whole, cut);
        let config = || Config { contact_capacity: Some(20_000), ..Config::default() };
        let mut rigs = [whole, cut].map(|spheres| Rig::with_config(config(), &spheres, &ground));
        for frame in 0..5 {
            let position = Vec3::new(random.between(-0.1, 0.1), random.between(-0.1, 0.1), -0.02);
            let tilt = Quat::from_scaled_axis(random.vector(0.01));
            let [mut together, mut apart] = rigs.each_mut().map(|rig| {
                rig.place([at(position, tilt), State::identity()]);
                let report = rig.world.step().unwrap();
                assert!(!report.status.contains(StatusBits::CONTACT_LIMIT));
                told(&rig.world)
            });
            together.sort();
            apart.sort();
            assert!(together == apart, "radius {radius} m, frame {frame}");
            found += together.len();
        }
    }
    assert!(found > 1000, "{found}");
}
