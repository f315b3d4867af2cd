//! Begin, end and peaks of contact between movable groups, for hosts that observe committed frames.

/// Observer of committed frames beside a world.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// use pong::monitor::PairMonitor;
/// let mut monitor = PairMonitor::new(&world)?;
/// world.step()?;
/// monitor.observe(&world, 1e-3)?;
/// assert_eq!(monitor.changes().len(), 1);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::PairMonitor;

/// Begin or end of contact.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// # use pong::monitor::PairMonitor;
/// # let mut monitor = PairMonitor::new(&world)?;
/// # world.step()?;
/// # monitor.observe(&world, 1e-3)?;
/// let change = monitor.changes().next().expect("the ball touches the ground");
/// assert!(change.begins && change.interfaces == [ball, ground]);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::ContactChange;

/// Peaks and means over a window of frames.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// # use pong::monitor::PairMonitor;
/// # let mut monitor = PairMonitor::new(&world)?;
/// # world.step()?;
/// # monitor.observe(&world, 1e-3)?;
/// let peaks = monitor.peaks().next().expect("the ball touches the ground");
/// assert!((peaks.peak_normal_force - 20.0).abs() < 1e-9);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::PairPeaks;
