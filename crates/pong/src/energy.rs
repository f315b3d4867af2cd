//! Energy ledger and energy accounts of contacts (`docs/theory.md`, 6). Both are off by default.

/// Energies of all contacts; kept with [`Config::ledger`](crate::Config).
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config { ledger: true, ..pong::Config::default() })?;
/// world.step()?;
/// // The host placed the ball in contact: ½·k·δ² is stored.
/// assert!((world.ledger().stored - 0.5 * 2e4 * 1e-6).abs() < 1e-12);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::Ledger;

/// Energies that went into contacts and came back.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config { accounts: Some(pong::energy::WrenchCoupling::Stages), ..pong::Config::default() })?;
/// world.step()?;
/// let account = world.account();
/// assert!((account.inserted - account.stored).abs() < 1e-12 && account.imbalance().abs() < 1e-12);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::EnergyAccount;

/// Account of a pair of movable groups; kept with [`Config::accounts`](crate::Config).
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config { accounts: Some(pong::energy::WrenchCoupling::Stages), ..pong::Config::default() })?;
/// world.step()?;
/// let account = world.pair_accounts().next().expect("one pair");
/// assert!(account.in_contact && !account.gains_energy());
/// # Ok(())
/// # }
/// ```
pub use pong_engine::PairEnergyAccount;

/// Outcome of an account.
///
/// ```
/// let received = pong::energy::EnergyAccount { work_in: 2.0, work_out: 1.0, ..Default::default() };
/// assert_eq!(received.verdict(), pong::energy::Verdict::Dissipated);
/// ```
pub use pong_engine::Verdict;

/// Use of a wrench by the host, on which its work depends.
///
/// ```
/// let held = pong::energy::WrenchCoupling::ZeroOrderHold { delay_frames: 1 };
/// assert_eq!(held.lag(), 1.5);
/// ```
pub use pong_engine::WrenchCoupling;
