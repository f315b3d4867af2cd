//! More contacts than capacity: the deepest are kept, and the frame reports the limit and a sufficient
//! capacity, for any number of workers; the next frame that fits is exact again.

use crate::common::stage::{Hash, Path, Scene, Stage, workers};
use crate::common::{box_polyhedron, model, points, rough, shell_mesh};
use pong_engine::*;
use pong_testkit::Random;
use std::collections::{BTreeMap, BTreeSet};

/// Many points on a plane; the second body of the scene rises and sinks.
fn brush(count: usize) -> Scene {
    let floor = "Plane(name: \"floor\", normal: (0,0,1), offset: 0.0)";
    let models =
        vec![model("brush", &rough(1e4), &points(count, 0.02, 3)), model("floor", &rough(1e6), floor)];
    let mut scene = Scene::new("brush", 60, models);
    scene.paths = vec![
        Path {
            center: [0.0, 0.0, 0.002],
            swing: [0.01, 0.01, 0.011],
            period: [50.0, 40.0, 30.0],
            turn: [0.0, 0.0, 0.1],
            turn_period: 45.0,
        },
        Path::still([0.0; 3]),
    ];
    scene
}

/// Answers of a frame, without its report.
fn answers(stage: &Stage<'_>) -> Hash {
    let mut hash = Hash::default();
    for group in &stage.groups {
        hash.wrench(&stage.world.wrench(*group).unwrap());
    }
    stage.world.contacts_iter().for_each(|contact| hash.contact(&contact));
    let ledger = stage.world.ledger();
    [ledger.stored, ledger.work, ledger.dissipated].iter().for_each(|x| hash.word(x.to_bits()));
    hash
}

/// Steps a frame; returns its report and a hash of its answers.
fn step(stage: &mut Stage<'_>, frame: usize) -> (FrameReport, Hash) {
    stage.prepare(frame);
    let report = stage.world.step().unwrap();
    (report, answers(stage))
}

fn with_capacity(mut scene: Scene, capacity: usize) -> Scene {
    scene.contact_capacity = Some(capacity);
    scene
}

/// For independent contacts, the kept ones are the deepest of an unlimited world, with the same forces.
#[test]
fn the_deepest_are_kept() {
    let (roomy, tight) = (with_capacity(brush(1500), 2000), with_capacity(brush(1500), 100));
    let (mut roomy, mut tight) = (roomy.set_up(None), tight.set_up(None));
    let mut limited = 0;
    for frame in 0..60 {
        // No history, for both alike.
        for stage in [&mut roomy, &mut tight] {
            stage.world.clear_contact_history(stage.objects[0]).unwrap();
        }
        let ((all_report, _), (report, _)) = (step(&mut roomy, frame), step(&mut tight, frame));
        assert_eq!(all_report.status, StatusBits::default());
        let mut all = roomy.world.contacts();
        assert_eq!(report.contacts_wanted, all_report.contacts);
        assert_eq!(report.contacts as usize, all.len().min(100));
        assert_eq!(report.status.contains(StatusBits::CONTACT_LIMIT), all.len() > 100, "frame {frame}");
        limited += usize::from(all.len() > 100);
        all.sort_by(|a, b| b.depth.total_cmp(&a.depth));
        all.truncate(100);
        all.sort_by_key(|contact| contact.a.primitive);
        for (kept, expected) in tight.world.contacts_iter().zip(&all) {
            assert_eq!((kept.a.primitive, kept.depth), (expected.a.primitive, expected.depth));
            assert_eq!((kept.force, kept.point), (expected.force, expected.point));
        }
    }
    assert!((10..60).contains(&limited), "{limited} frames limited");
}

/// The kept contacts do not depend on the threads that found them, at any capacity, including ties.
#[test]
fn the_choice_is_the_same_for_any_number_of_workers() {
    for capacity in [1, 7, 64, 300, 999] {
        let scene = with_capacity(brush(4000), capacity);
        let mut alone = scene.set_up(None);
        let mut crews: Vec<_> = [1, 2, 7].map(|count| scene.set_up(workers(count))).into();
        for frame in 0..20 {
            let expected = (step(&mut alone, frame), alone.saved());
            for crew in &mut crews {
                assert_eq!((step(crew, frame), crew.saved()), expected, "{capacity}, frame {frame}");
            }
        }
    }
}

/// Points at one depth: ties go by summation order.
#[test]
fn ties_go_by_the_order_of_sums() {
    let grid = |index: usize| {
        let (x, y) = ((index % 50) as f64 * 0.02, (index / 50) as f64 * 0.02);
        format!("Point(name: \"p{index}\", position: ({x:?},{y:?},-0.001))")
    };
    let mut scene = brush(1);
    scene.models[0] = model("brush", &rough(1e4), &(0..2500).map(grid).collect::<Vec<_>>().join(","));
    scene.paths = vec![Path::still([0.0; 3]), Path::still([0.0; 3])];
    let scene = with_capacity(scene, 40);
    for crew in [None, workers(3)] {
        let mut stage = scene.set_up(crew);
        let (report, _) = step(&mut stage, 0);
        assert_eq!((report.contacts, report.contacts_wanted), (40, 2500));
        let kept: Vec<_> = stage.world.contacts_iter().map(|contact| contact.a.primitive).collect();
        assert_eq!(kept, (0..40).collect::<Vec<_>>());
    }
}

/// Sets exactly the capacity that a limited frame asks for: the flag is gone, and the answer is that of a
/// world with ample capacity.
fn check_what_is_wanted(scene: &dyn Fn(usize) -> Scene, tight: usize, roomy: usize, frames: usize) {
    let (tight, roomy) = (scene(tight), scene(roomy));
    let (mut tight, mut roomy) = (tight.set_up(None), roomy.set_up(None));
    let mut wanted = 0;
    let mut expected = Vec::new();
    for frame in 0..frames {
        let (report, _) = step(&mut tight, frame);
        wanted = wanted.max(report.contacts_wanted as usize);
        let (report, hash) = step(&mut roomy, frame);
        assert_eq!(report.status, StatusBits::default(), "{}: the roomy world is limited", roomy.scene.name);
        expected.push((report, hash));
    }
    let name = roomy.scene.name;
    let most = expected.iter().map(|(report, _)| report.contacts as usize).max().unwrap();
    println!("{name}: {most} contacts at most, {wanted} wanted");
    assert!(tight.world.report().contacts_wanted > 0 && wanted >= most);
    for crew in [None, workers(2)] {
        let enough = scene(wanted);
        let mut stage = enough.set_up(crew);
        for (frame, expected) in expected.iter().enumerate() {
            let got = step(&mut stage, frame);
            assert_eq!(got, *expected, "{name}: {wanted} were wanted, frame {frame}");
        }
    }
}

#[test]
fn what_a_limited_frame_wants_is_enough() {
    check_what_is_wanted(&|capacity| with_capacity(brush(1500), capacity), 50, 4000, 40);
}

/// Rays that hit several movable groups of one Object count once.
fn rays_on_two_groups(count: usize) -> Scene {
    let mut random = Random(5);
    let ray = |index| {
        let p = random.vector(0.4);
        format!(
            "Ray(name: \"r{index}\", origin: ({:?},{:?},0.1), direction: (0,0,-1), length: 0.3)",
            p.x, p.y
        )
    };
    let rays: Vec<_> = (0..count).map(ray).collect();
    let shelf = format!(
        "(format: \"pong-model\", version: 1, name: \"shelf\", surfaces: {{ {} }}, root: (name: \"shelf\", surface: \"s\", \
         groups: [(name: \"low\", primitives: [{}]), (name: \"high\", movable: true, primitives: [{}])]))",
        rough(1e6),
        box_polyhedron("slab", [0.0, 0.0, -0.1], [0.5, 0.5, 0.1], ""),
        box_polyhedron("slab", [0.0, 0.0, -0.1], [0.5, 0.5, 0.1], "")
    );
    let mut scene = Scene::new("rays", 20, vec![model("rays", &rough(1e4), &rays.join(",")), shelf]);
    let swing = Path { swing: [0.05, 0.05, 0.05], period: [23.0, 31.0, 17.0], ..Path::still([0.0; 3]) };
    scene.paths = vec![swing, Path::still([0.0, 0.0, -0.05]), Path::still([0.3, 0.0, 0.05])];
    scene
}

#[test]
fn what_rays_want_is_enough() {
    check_what_is_wanted(&|capacity| with_capacity(rays_on_two_groups(300), capacity), 20, 4000, 20);
}

/// Frames over the limit have no lasting effect. A contact that was always kept equals that of a world with
/// ample capacity, including its history, and so does a whole frame once the dropped contacts have ended.
#[test]
fn after_the_limit_a_frame_that_fits_is_exact() {
    for crew in [None, workers(3)] {
        let (tight, roomy) = (with_capacity(brush(1500), 300), with_capacity(brush(1500), 2000));
        let (mut tight, mut roomy) = (tight.set_up(crew), roomy.set_up(None));
        // Points whose contact was dropped once and continued in the roomy world.
        let mut left_out = BTreeSet::new();
        let (mut limited, mut exact) = (0, 0);
        for frame in 0..120 {
            let ((report, _), (roomy_report, _)) = (step(&mut tight, frame), step(&mut roomy, frame));
            let [kept, all] = [&tight, &roomy].map(contacts_by_point);
            left_out.retain(|point| all.contains_key(point));
            left_out.extend(all.keys().filter(|point| !kept.contains_key(point)));
            for (point, contact) in kept.iter().filter(|(point, _)| !left_out.contains(point)) {
                assert_eq!(all[point], *contact, "frame {frame}, point {point}");
            }
            limited += usize::from(!report.status.is_complete());
            if limited > 0 && left_out.is_empty() {
                exact += 1;
                assert_eq!(report, roomy_report);
                let wrenches = [&tight, &roomy].map(|stage| stage.world.wrench(stage.groups[0]).unwrap());
                assert_eq!(wrenches[0], wrenches[1], "frame {frame}");
            }
        }
        assert!(limited > 20 && exact > 20, "{limited} frames limited, {exact} exact after them");
    }
}

fn contacts_by_point(stage: &Stage<'_>) -> BTreeMap<u32, Hash> {
    let hashed = |contact: Contact| {
        let mut hash = Hash::default();
        hash.contact(&contact);
        (contact.a.primitive, hash)
    };
    stage.world.contacts_iter().map(hashed).collect()
}

/// Ten thousand contacts of as many points, in a world that holds them and in one that does not.
#[test]
fn ten_thousand_contacts_of_points() {
    let mut scene = brush(10_000);
    scene.paths[0] = Path { swing: [0.01, 0.0, 0.0], ..Path::still([0.0, 0.0, -0.02]) };
    let roomy = with_capacity(scene, 10_000);
    let mut alone = roomy.set_up(None);
    let mut crew = roomy.set_up(workers(3));
    for frame in 0..4 {
        let expected = step(&mut alone, frame);
        assert_eq!((expected.0.contacts, expected.0.status), (10_000, StatusBits::default()));
        assert_eq!(step(&mut crew, frame), expected);
    }
    let mut scene = brush(10_000);
    scene.paths[0] = roomy.paths[0];
    let tight = with_capacity(scene, 9_999);
    for crew in [None, workers(3)] {
        let (report, _) = step(&mut tight.set_up(crew), 0);
        assert_eq!((report.contacts, report.contacts_wanted), (9_999, 10_000));
        assert!(report.status.contains(StatusBits::CONTACT_LIMIT));
    }
}

/// Balls in a shell that fits them: all its triangles touch them.
fn balls_in(shell: String, balls: usize) -> Scene {
    let ball = |index| format!("Sphere(name: \"b{index}\", center: (0,0,{index}e-5), radius: 0.2)");
    let balls: Vec<_> = (0..balls).map(ball).collect();
    let models = vec![model("ball", &rough(1e4), &balls.join(",")), model("shell", &rough(1e6), &shell)];
    let mut scene = Scene::new("balls in a shell", 6, models);
    let swing = Path { swing: [1e-5, 1e-5, 1e-5], period: [11.0, 13.0, 7.0], ..Path::still([0.0; 3]) };
    scene.paths = vec![swing, Path::still([0.0; 3])];
    scene
}

/// With its centre below a convex surface, a ball is pushed by one face, and the others are only remembered.
#[test]
fn what_is_only_remembered_is_wanted_too() {
    let scene = |capacity| with_capacity(balls_in(shell_mesh(16, 0.3, 2.8, false), 1), capacity);
    check_what_is_wanted(&scene, 40, 2000, 6);
}

/// More candidates of one chunk than its capacity, few of which push.
#[test]
fn what_one_ball_wants_is_enough() {
    let scene = |capacity| with_capacity(balls_in(shell_mesh(34, 0.05, 0.7, true), 1), capacity);
    check_what_is_wanted(&scene, 40, 4000, 3);
}

/// Far more candidates of one chunk than its capacity, and more than can be shared: the frame reports it, the
/// same for any number of workers.
#[test]
fn ten_thousand_contacts_of_one_ball() {
    for (cells, capacity) in [(72, 10_000), (72, 300), (24, 600), (24, 40)] {
        let scene = with_capacity(balls_in(shell_mesh(cells, 0.25, 2.85, true), 2), capacity);
        let mut alone = scene.set_up(None);
        let mut crew = scene.set_up(workers(2));
        for frame in 0..2 {
            let expected = step(&mut alone, frame);
            println!("{cells} cells, room for {capacity}: {:?}", expected.0);
            assert_eq!(step(&mut crew, frame), expected, "{cells} cells, room for {capacity}, frame {frame}");
            assert_eq!(crew.saved(), alone.saved());
            assert!(expected.0.status.contains(StatusBits::LOAD_SHARING_LIMIT), "{:?}", expected.0);
            assert!(expected.0.contacts > 0);
        }
        // Lifted out of the shell by their own width, the balls touch little, and the limit has no effect any
        // more.
        for stage in [&mut alone, &mut crew] {
            stage.world.clear_contact_history(stage.objects[0]).unwrap();
            let ball = stage.groups[0];
            stage.world.set_state(ball, &Path::still([0.0, 0.0, 0.01]).at(0)).unwrap();
            stage.world.evaluate().unwrap();
        }
        assert_eq!(answers(&alone), answers(&crew));
    }
}

/// A host that sets the capacity advised by each report reaches a frame that leaves nothing out.
#[test]
fn what_is_advised_is_enough_in_the_end() {
    for start in [40, 600, 1000] {
        let mut capacities = vec![start];
        while let Some(advised) = {
            let capacity = *capacities.last().unwrap();
            let scene = with_capacity(balls_in(shell_mesh(24, 0.25, 2.85, true), 1), capacity);
            step(&mut scene.set_up(None), 0).0.advised_capacity(capacity)
        } {
            assert!(
                advised > *capacities.last().unwrap() && capacities.len() < 12,
                "{capacities:?}, then {advised}"
            );
            capacities.push(advised);
        }
        println!("{capacities:?}");
        assert!(capacities.len() > 1);
    }
}

/// An unreasonable capacity is refused before any of it is allocated; the message states its size and the
/// maximum. More workers need more memory.
#[test]
fn a_capacity_that_takes_too_much_memory_is_refused() {
    let refusal = |wanted: usize, workers: Option<WorkerSettings>| {
        let scene = brush(10);
        let mut builder =
            WorldBuilder::new(Config { contact_capacity: Some(wanted), workers, ..Config::default() });
        let mut object = |text: &String| {
            let model = pong_model::parse(text, "scene.ron", None, builder.scene().extensions()).unwrap();
            let model = builder.add_model(std::sync::Arc::new(model));
            builder.create_object(model, "object").or_else(|_| builder.create_object(model, "other")).unwrap()
        };
        let objects: Vec<_> = scene.models.iter().map(&mut object).collect();
        builder.pair(objects[0], objects[1]).unwrap();
        let refused = builder.seal().err()?.to_string();
        assert!(refused.contains("contact capacity") && refused.contains("GiB"), "{refused}");
        let most = refused.split("give at most ").nth(1).unwrap().split(' ').next().unwrap();
        Some(most.parse::<usize>().unwrap())
    };
    assert_eq!(refusal(1 << 12, None), None);
    let most = refusal(1 << 24, None).unwrap();
    assert!((1 << 20..1 << 24).contains(&most), "{most}");
    assert_eq!(refusal(most + 1, None), Some(most));
    assert_eq!(refusal(usize::MAX, None), Some(most));
    assert!(refusal(usize::MAX, workers(3)).unwrap() < most);
}
