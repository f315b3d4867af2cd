//! Counts, times, threads and memory of frames. None of them is needed to use a wrench.

/// Counts of a frame: [`World::counts`](crate::World::counts).
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// world.step()?;
/// assert_eq!(world.counts().primitives_tested(), 1);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::FrameCounts;

/// Tests of one pair of kinds, and hits.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// world.step()?;
/// let (a, b, tally) = world.counts().testers().next().expect("one test");
/// assert_eq!((a.name(), b.name(), tally.met), ("Sphere", "Plane", 1));
/// # Ok(())
/// # }
/// ```
pub use pong_engine::Tally;

/// Kind of a primitive, in counts.
///
/// ```
/// assert_eq!(pong::diagnostics::PrimitiveKind::Sphere.name(), "Sphere");
/// ```
pub use pong_geometry::primitive::PrimitiveKind;

/// Stage of a frame.
///
/// ```
/// let names = pong::diagnostics::Stage::ALL.map(|stage| stage.name());
/// assert_eq!(names[1], "contacts");
/// ```
pub use pong_engine::Stage;

/// Times of a frame by stage; with a clock of the host.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// fn now_ns() -> u64 {
///     use std::{sync::LazyLock, time::Instant};
///     static START: LazyLock<Instant> = LazyLock::new(Instant::now);
///     START.elapsed().as_nanos() as u64
/// }
/// world.set_clock(now_ns);
/// world.step()?;
/// let times = world.stage_times();
/// let sum: u64 = pong::diagnostics::Stage::ALL.into_iter().map(|stage| times.of(stage)).sum();
/// assert!(sum > 0);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::StageTimes;

/// Part of the contact stage.
///
/// ```
/// assert_eq!(pong::diagnostics::Work::NarrowPhase.name(), "narrow phase");
/// ```
pub use pong_engine::Work;

/// Times of one thread by part of the contact stage; with a clock of the host.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// world.step()?;
/// let caller = world.thread_times().next().expect("the calling thread");
/// assert_eq!(caller.sum(), 0); // no clock was set
/// # Ok(())
/// # }
/// ```
pub use pong_engine::WorkTimes;

/// Share of one thread in the last frame that was shared.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config { workers: Some(pong::WorkerSettings::default()), ..pong::Config::default() })?;
/// world.step()?;
/// for work in world.thread_work() {
///     println!("{} blocks", work.blocks);
/// }
/// # Ok(())
/// # }
/// ```
pub use pong_engine::ThreadWork;

/// Core and priority that a worker got.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config { workers: Some(pong::WorkerSettings::default()), ..pong::Config::default() })?;
/// for worker in world.worker_starts() {
///     println!("{worker}");
/// }
/// # Ok(())
/// # }
/// ```
pub use pong_engine::WorkerStart;

/// Answer of the system to a request for a core or a priority.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config { workers: Some(pong::WorkerSettings::default()), ..pong::Config::default() })?;
/// use pong::diagnostics::Grant;
/// assert!(world.worker_starts().iter().all(|worker| worker.core == Grant::NotAsked));
/// # Ok(())
/// # }
/// ```
pub use pong_threads::Grant;

/// Peak use of memory against its capacity.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// world.step()?;
/// let memory = world.memory();
/// assert!(memory.contacts_peak <= memory.contacts_capacity);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::MemoryReport;
