//! The calls of the C interface around the engine's evaluation allocate nothing in a frame: states in,
//! commit, wrenches, contacts and report out.
//!
//! A program of its own, because it counts the calls of the process's allocator.

use pong::config::pong_default_config;
use pong::contacts::{pong_contact, pong_get_contacts};
use pong::frames::{pong_commit, pong_evaluate};
use pong::ids::{pong_interface_id, pong_model_id, pong_object_id};
use pong::interfaces::pong_find_interface;
use pong::models::pong_load_model_text;
use pong::objects::pong_create_object;
use pong::pairs::pong_pair_objects;
use pong::report::{pong_get_report, pong_report};
use pong::seal::pong_seal;
use pong::states::{pong_default_state, pong_set_states};
use pong::status::pong_status;
use pong::world::{pong_create_world, pong_destroy_world, pong_world};
use pong::wrenches::{PONG_REFERENCE_FRAME_COMMON, pong_get_wrenches, pong_wrench};
use pong_testkit::heap::{COUNTING, Telling, calls};
use std::mem::MaybeUninit;
use std::ptr::null_mut;

#[global_allocator]
static ALLOCATOR: Telling = COUNTING;

const BALL: &str = "(format: \"pong-model\", version: 1, name: \"ball\", surfaces: {\"s\": (stiffness: 1e4, friction: \
    Bristle(mu: 0.5))}, root: (name: \"ball\", surface: \"s\", primitives: [Sphere(name: \"b\", center: (0, 0, 0), \
    radius: 0.1)]))";
const GROUND: &str = "(format: \"pong-model\", version: 1, name: \"ground\", surfaces: {\"s\": (stiffness: 1e4)}, root: \
    (name: \"ground\", surface: \"s\", primitives: [Polyhedron(name: \"g\", vertices: [(-1, -1, -1), (1, -1, -1), \
    (1, 1, -1), (-1, 1, -1), (-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], faces: [[0, 3, 2, 1], [4, 5, 6, 7], \
    [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])]))";

fn ok(status: pong_status) {
    assert_eq!(status, pong_status::Ok);
}

struct Scene {
    world: *mut pong_world,
    roots: [pong_interface_id; 2],
}

fn build() -> Scene {
    let mut world = null_mut();
    let mut roots = [pong_interface_id { bits: 0 }; 2];
    let mut objects = [pong_object_id { bits: 0 }; 2];
    // SAFETY: pointers to variables on this stack, texts that end with a zero byte.
    unsafe {
        ok(pong_create_world(&pong_default_config(), &mut world));
        for (index, text) in [BALL, GROUND].into_iter().enumerate() {
            let mut model = pong_model_id { bits: 0 };
            let name = [c"ball", c"ground"][index].as_ptr();
            ok(pong_load_model_text(world, text.as_ptr().cast(), text.len(), name, null_mut(), &mut model));
            ok(pong_create_object(world, model, name, &mut objects[index]));
            ok(pong_find_interface(world, objects[index], c"".as_ptr(), &mut roots[index]));
        }
        ok(pong_pair_objects(world, objects[0], objects[1], null_mut()));
        ok(pong_seal(world, null_mut()));
    }
    Scene { world, roots }
}

/// Number of calls of the allocator around the evaluation of one frame.
fn frame(scene: &Scene, number: u32) -> usize {
    let mut states = [pong_default_state(); 2];
    states[0].position = [1e-4 * f64::from(number), 0.0, 0.099];
    let mut wrenches = MaybeUninit::<[pong_wrench; 2]>::uninit();
    let mut contacts = MaybeUninit::<[pong_contact; 4]>::uninit();
    let mut report = MaybeUninit::<pong_report>::uninit();
    let mut count = 0;
    let Scene { world, roots } = scene;
    let start = calls();
    // SAFETY: pointers to variables on this stack, with the lengths given.
    unsafe {
        ok(pong_set_states(*world, roots.as_ptr(), states.as_ptr(), 2));
        let before = calls();
        ok(pong_evaluate(*world));
        let evaluation = calls() - before;
        ok(pong_commit(*world));
        ok(pong_get_wrenches(
            *world,
            roots.as_ptr(),
            PONG_REFERENCE_FRAME_COMMON,
            wrenches.as_mut_ptr().cast(),
            2,
        ));
        ok(pong_get_contacts(*world, contacts.as_mut_ptr().cast(), 4, &mut count));
        ok(pong_get_report(*world, report.as_mut_ptr()));
        assert_eq!(count, 1);
        calls() - start - evaluation
    }
}

#[test]
fn the_calls_around_an_evaluation_allocate_nothing() {
    let scene = build();
    let calls: usize = (0..1000).map(|number| frame(&scene, number)).sum();
    assert_eq!(calls, 0, "calls of the allocator in 1000 frames");
    // SAFETY: made by `build`, destroyed once.
    ok(unsafe { pong_destroy_world(scene.world) });
}
