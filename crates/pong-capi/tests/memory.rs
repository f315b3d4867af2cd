//! The memory checked before a call of set-up is enough for the call, and not far more.
//!
//! A program of its own, because it counts the calls of the process's allocator.

use pong::memory::of_text;
use pong_engine::{Config, WorkerSettings, WorldBuilder, WrenchCoupling};
use pong_model::Extensions;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::path::{Path, PathBuf};
use std::sync::Arc;

thread_local! {
    static NOW: Cell<isize> = const { Cell::new(0) };
    static PEAK: Cell<isize> = const { Cell::new(0) };
    // The block allocated last, and the peak before it.
    static LAST: Cell<(usize, isize)> = const { Cell::new((0, 0)) };
}

struct Counting;

fn count(bytes: isize) {
    let _ = NOW.try_with(|now| {
        now.set(now.get() + bytes);
        PEAK.with(|peak| peak.set(peak.get().max(now.get())));
    });
}

// SAFETY: every call is passed to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: by the contract of this function.
        let pointer = unsafe { System.alloc(layout) };
        let _ = LAST.try_with(|last| last.set((pointer.addr(), PEAK.get())));
        count(layout.size() as isize);
        pointer
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(-(layout.size() as isize));
        // A block that is freed before another is allocated only checks that there is enough memory. (The
        // temporary buffer of a sort is the same, and is ignored here.)
        let _ = LAST.try_with(|last| {
            if last.get().0 == pointer.addr() {
                PEAK.set(last.get().1);
            }
        });
        // SAFETY: by the contract of this function.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Peak of the memory in use during `work`, beyond that before, bytes.
fn peak_of<T>(work: impl FnOnce() -> T) -> (T, usize) {
    let before = NOW.get();
    PEAK.set(before);
    let result = work();
    (result, (PEAK.get() - before) as usize)
}

fn models(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in folder.read_dir().unwrap().flatten() {
        match entry.path() {
            folder if folder.is_dir() => found.extend(models(&folder)),
            file if file.extension().is_some_and(|extension| extension == "ron") => found.push(file),
            _ => {}
        }
    }
    found
}

const HEAD: &str = "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {\"s\": (stiffness: 1e4)}, \
                    root: (name: \"m\", surface: \"s\", ";

/// Texts with as many values as possible in few bytes.
fn dense() -> Vec<(&'static str, String)> {
    let many = |count: usize, each: &dyn Fn(usize) -> String| (0..count).map(each).collect::<String>();
    let point = |i| format!("Point(name:\"{i}\",position:({i},0,0)),");
    let ball = |i| format!("Sphere(name:\"{i}\",center:({i},0,0),radius:1),");
    let egg = |i| format!("Ellipsoid(name:\"{i}\",center:({i},0,0),semi_axes:(1,2,3)),");
    let triangle = |i| format!("Triangle(name:\"{i}\",vertices:(({i},0,0),({i},1,0),({i},0,1))),");
    let group = |i| format!("(name:\"{i}\",movable:true,primitives:[Point(name:\"p\",position:(0,0,{i}))]),");
    let vertex = |i| format!("({},{},{}),", i % 50, i / 50, (i * i) % 7);
    let face = |i| format!("({},{},{}),", i, i + 1, i + 50);
    let primitives = |list: String| format!("{HEAD}primitives:[{list}]))");
    vec![
        ("points", primitives(many(3000, &point))),
        ("balls", primitives(many(3000, &ball))),
        ("eggs", primitives(many(3000, &egg))),
        ("triangles", primitives(many(3000, &triangle))),
        ("groups", format!("{HEAD}groups:[{}]))", many(1000, &group))),
        (
            "mesh",
            primitives(format!(
                "TriangleMesh(name:\"t\",vertices:[{}],triangles:[{}])",
                many(2500, &vertex),
                many(2400, &face)
            )),
        ),
        ("numbers", format!("{HEAD}primitives:[{}]))", "0,".repeat(20_000))),
        ("brackets", "[".repeat(20_000)),
        ("faults", primitives(many(2000, &|i| format!("Point(nme:\"{i}\"),")))),
    ]
}

#[test]
fn what_a_text_asks_for_is_enough_and_not_far_more() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models");
    let mut texts: Vec<(String, String)> =
        dense().into_iter().map(|(name, text)| (name.to_owned(), text)).collect();
    for path in models(&root) {
        texts.push((path.display().to_string(), std::fs::read_to_string(&path).unwrap()));
    }
    let mut wrong = Vec::new();
    for (name, text) in texts {
        // Meshes are counted separately.
        let (loaded, taken) = peak_of(|| pong_model::parse(&text, &name, None, &Extensions::new()));
        let asked = of_text(text.as_bytes());
        println!("{name}: {} bytes, {taken} taken, {asked} asked for, {}", text.len(), loaded.is_ok());
        // A small text is covered by the minimum that every call checks.
        let far_more = loaded.is_ok() && text.len() > 10_000 && asked > 25 * taken;
        if taken > asked || far_more {
            wrong.push(format!("{name}: {taken} bytes taken, {asked} asked for"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// A world ready to be sealed, of two models, or of one model paired with itself.
fn world(config: Config, files: &[&str]) -> WorldBuilder {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models");
    let mut builder = WorldBuilder::new(config);
    let mut objects = Vec::new();
    for (index, file) in files.iter().enumerate() {
        let model = pong_model::load(&root.join(file), builder.scene().extensions()).unwrap();
        let model = builder.add_model(Arc::new(model));
        objects.push(builder.create_object(model, &format!("o{index}")).unwrap());
    }
    builder.pair(objects[0], objects[objects.len() - 1]).unwrap();
    builder
}

#[test]
fn what_a_seal_asks_for_is_enough_and_not_far_more() {
    let scenes: [&[&str]; 4] = [
        &["idss_docking/idss_active.ron", "idss_docking/idss_passive.ron"],
        &["rover/rover.ron", "rover/terrain.ron"],
        &["payload_retention/payload.ron", "payload_retention/bay.ron"],
        &["idss_docking/idss_active.ron"],
    ];
    let workers =
        |workers| Some(WorkerSettings { workers, oversubscribe: true, ..WorkerSettings::default() });
    for files in scenes {
        for (contact_capacity, workers, accounts) in [
            (None, None, None),
            (Some(1), None, None),
            (Some(30_000), None, Some(WrenchCoupling::Stages)),
            (Some(1), workers(4), Some(WrenchCoupling::Stages)),
            (Some(30_000), workers(2), None),
        ] {
            let config = Config { contact_capacity, workers, accounts, ..Config::default() };
            let told = format!("{files:?} {config:?}");
            let builder = world(config, files);
            let ((_world, report), taken) = peak_of(|| builder.seal().unwrap());
            println!("{taken} taken, {} asked for: {told}", report.memory);
            assert!(taken <= report.memory, "{taken} bytes taken, {} asked for: {told}", report.memory);
            // Allows for the stack of each worker and for the minimum that every call checks.
            let beside = report.workers.len() * (3 << 20) + (1 << 20);
            assert!(
                report.memory <= 3 * taken + beside,
                "{taken} taken, {} asked for: {told}",
                report.memory
            );
        }
    }
}
