#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod diagnostics;
pub mod energy;
mod error;
pub mod law;
mod load;
pub mod monitor;

pub use error::Error;
pub use load::Load;

/// Settings of a world: contact capacity, energies, workers.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// let config = pong::Config { contact_capacity: Some(64), ..pong::Config::default() };
/// let (world, _) = pong::WorldBuilder::new(config).seal()?;
/// assert_eq!(world.contact_capacity(), 64);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::Config;

/// Set-up: models, Objects and pairs.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # use pong::{Config, Load, WorldBuilder};
/// # let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/ball.ron"));
/// let mut builder = WorldBuilder::new(Config::default());
/// let model = builder.load_text(text, "ball")?;
/// let (one, other) = (builder.create_object(model, "one")?, builder.create_object(model, "other")?);
/// builder.pair(one, other)?;
/// let (world, report) = builder.seal()?;
/// assert_eq!(report.group_pairs, 1);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::WorldBuilder;

/// Frames: states in, wrenches out.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// let stage = pong::State { position: [0.0, 0.0, 0.098], ..pong::State::identity() };
/// world.set_state(ball, &stage)?;
/// world.evaluate()?; // a stage: the world forgets it
/// let end = pong::State { position: [0.0, 0.0, 0.099], ..stage };
/// world.set_state(ball, &end)?;
/// world.commit()?; // the end of a step
/// assert!((world.wrench_common(ball)?.force.z - 20.0).abs() < 1e-9);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::World;

/// Names and ids of what was set up.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// let object = world.scene().object("ball")?;
/// assert_eq!(world.scene().interface(object, "")?, ball);
/// assert_eq!(world.scene().group_name(ball)?, "ball");
/// # Ok(())
/// # }
/// ```
pub use pong_engine::Scene;

/// State of one movable group, SI units, in the common frame.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// let falling = pong::State {
///     position: [0.0, 0.0, 0.1],
///     linear_velocity: [0.0, 0.0, -1.0],
///     ..pong::State::identity()
/// };
/// world.set_state(ball, &falling)?;
/// assert_eq!(world.state_as_set(ball)?, Some(&falling));
/// # Ok(())
/// # }
/// ```
pub use pong_engine::State;

/// Motion of a surface along itself: belts, tracks and turntables.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// let config = pong::Config { moving_surfaces: true, ..pong::Config::default() };
/// # let (mut world, [ball, ground], pair) = ball_on_ground(config)?;
/// let step = 1e-3;
/// let mut belt = pong::SurfaceMotion { linear_velocity: [0.5, 0.0, 0.0], ..Default::default() };
/// for _ in 0..10 {
///     world.set_surface_motion(ground, &belt)?;
///     world.step()?;
///     belt.advance(step);
/// }
/// assert!(world.wrench_common(ball)?.force.x > 0.0);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::SurfaceMotion;

/// Threads that share a frame with the caller. The results are bit-identical.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// let workers = pong::WorkerSettings { workers: 1, ..pong::WorkerSettings::default() };
/// let config = pong::Config { workers: Some(workers), ..pong::Config::default() };
/// let (mut world, [ball, _], _) = ball_on_ground(config)?;
/// world.step()?;
/// assert!((world.wrench_common(ball)?.force.z - 20.0).abs() < 1e-9);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::WorkerSettings;

/// Summary of a frame.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// let report = world.step()?;
/// assert_eq!(report.contacts, 1);
/// assert!(report.advised_capacity(world.contact_capacity()).is_none());
/// # Ok(())
/// # }
/// ```
pub use pong_engine::FrameReport;

/// Flags of a frame.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// let report = world.step()?;
/// assert!(report.status.is_complete());
/// assert!(!report.status.contains(pong::StatusBits::TUNNELLED));
/// # Ok(())
/// # }
/// ```
pub use pong_engine::StatusBits;

/// First tunnelling event of a frame.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// world.step()?;
/// let below = pong::State { position: [0.0, 0.0, -5.0], ..pong::State::identity() };
/// world.set_state(ball, &below)?;
/// world.evaluate()?;
/// // A plane has no far side: everything below it stays in contact.
/// assert!(world.tunnelling().is_none());
/// # Ok(())
/// # }
/// ```
pub use pong_engine::TunnellingReport;

/// Solid that is deeper in a mesh than the regions below its facets.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// world.step()?;
/// // A ball and a plane have no such regions.
/// assert!(world.deep_in_mesh().is_none());
/// # Ok(())
/// # }
/// ```
pub use pong_engine::DeepInMeshReport;

/// One contact of the last frame.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// world.step()?;
/// let contact = world.contacts()[0];
/// assert!((contact.depth - 1e-3).abs() < 1e-12);
/// assert!((contact.normal_force - 20.0).abs() < 1e-9);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::Contact;

/// A or B of a contact.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// world.step()?;
/// let side = world.contacts()[0].a;
/// assert_eq!(side.interface, ball);
/// assert_eq!(world.scene().primitive_path(ball, side.primitive)?, "ball/shell");
/// # Ok(())
/// # }
/// ```
pub use pong_engine::ContactSide;

/// Derivatives of the wrenches of two movable groups that touch, with respect to their poses and twists.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// world.evaluate()?;
/// let tangent = &world.tangents()?[0];
/// assert_eq!(tangent.groups, [ball, ground]);
/// assert!((tangent.stiffness[0][0][(2, 2)] - 2e4).abs() < 1e-6);
/// // Solids and laws of the host have no closed form: there this takes differences.
/// assert!(!world.complete_tangents()?[0].by_differences);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::PairTangent;

/// A block of a [`PairTangent`]: rows force and moment, columns translation and rotation.
///
/// ```
/// let spring = pong::TangentMatrix::from_diagonal_element(2e4);
/// assert_eq!(spring[(2, 2)], 2e4);
/// ```
pub use pong_engine::TangentMatrix;

/// Stiffness and damping that act in one contact.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// world.step()?;
/// let springs = world.contact_tangents().next().flatten().expect("one contact of built-in laws");
/// assert_eq!((springs.normal.stiffness, springs.normal.damping), (2e4, 30.0));
/// # Ok(())
/// # }
/// ```
pub use pong_engine::ContactTangent;

/// Face, edge or vertex of B that pushes, with its index.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// world.step()?;
/// let feature = world.contacts()[0].feature;
/// assert_eq!((feature.kind(), feature.index()), (pong::FeatureKind::Face, 0));
/// # Ok(())
/// # }
/// ```
pub use pong_geometry::interference::{Feature, FeatureKind};

/// Friction that exists before the first step of a run.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// let holding = pong::FrictionPreload::Holding(pong::Vec3::new(1.0, 0.0, 0.0));
/// assert_eq!(world.preload_friction(pair, &holding)?, 1);
/// world.evaluate()?;
/// assert!((world.wrench_common(ball)?.force.x - 1.0).abs() < 1e-9);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::FrictionPreload;

/// Outcome of [`World::continue_from`].
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// world.step()?;
/// let (mut larger, _) = pong::WorldBuilder::extending(&world).seal()?;
/// let continued = larger.continue_from(&world)?;
/// assert_eq!((continued.objects, continued.contacts), (2, 1));
/// # Ok(())
/// # }
/// ```
pub use pong_engine::Continuation;

/// Result of a seal: sizes, workers, warnings.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut builder, [ball, ground], pair) = set_up(pong::Config::default())?;
/// let (_world, report) = builder.seal()?;
/// assert_eq!((report.group_pairs, report.warnings.len()), (1, 0));
/// assert!(report.notes.is_empty());
/// # Ok(())
/// # }
/// ```
pub use pong_engine::SealReport;

/// Refused seal, with the builder.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # use pong::{Config, WorldBuilder};
/// let empty = Config { contact_capacity: Some(0), ..Config::default() };
/// let refused = WorldBuilder::new(empty).seal().err().expect("no room for a contact");
/// let (_builder, reason) = refused.into_parts();
/// assert!(reason.to_string().contains("contact capacity"));
/// # Ok(())
/// # }
/// ```
pub use pong_engine::SealError;

/// Warning of a seal: primitives that ignore each other.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut builder, [ball, ground], pair) = set_up(pong::Config::default())?;
/// let (_world, report) = builder.seal()?;
/// for warning in &report.warnings {
///     eprintln!("{warning}");
/// }
/// # assert!(report.warnings.is_empty());
/// # Ok(())
/// # }
/// ```
pub use pong_engine::SetupWarning;

/// Note of a seal: friction that one surface lacks, known limits, filters without effect.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut builder, [ball, ground], pair) = set_up(pong::Config::default())?;
/// let (_world, report) = builder.seal()?;
/// assert!(!report.notes.iter().any(|note| matches!(note, pong::SetupNote::NoFriction { .. })));
/// # Ok(())
/// # }
/// ```
pub use pong_engine::SetupNote;

/// Pairs of Objects that a warning is about.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// let met = pong::MetIn { objects: ["ball".to_owned(), "ground".to_owned()], more: 2 };
/// assert_eq!(met.to_string(), "`ball` and `ground` and 2 more pairs");
/// # Ok(())
/// # }
/// ```
pub use pong_engine::MetIn;

/// Refusal by the engine: set-up or frame.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// use pong::EngineError;
/// let nowhere = pong::State { position: [f64::NAN, 0.0, 0.0], ..pong::State::identity() };
/// assert!(matches!(world.set_state(ball, &nowhere), Err(EngineError::BadState { .. })));
/// # Ok(())
/// # }
/// ```
pub use pong_engine::EngineError;

/// Refusal of a saved contact state.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// use pong::{EngineError, StateError};
/// assert_eq!(world.restore_state(&[0; 64]), Err(EngineError::State(StateError::Foreign)));
/// # Ok(())
/// # }
/// ```
pub use pong_engine::StateError;

/// Id of a model in a world.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut builder, [ball, ground], pair) = set_up(pong::Config::default())?;
/// use pong::Load;
/// let model: pong::ModelId = builder.load_text(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/ball.ron")), "ball")?;
/// builder.create_object(model, "second ball")?;
/// # Ok(())
/// # }
/// ```
pub use pong_engine::ModelId;

/// Id of an Object in a world.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut builder, [ball, ground], pair) = set_up(pong::Config::default())?;
/// assert_eq!(builder.scene().object_name(ball)?, "ball");
/// # Ok(())
/// # }
/// ```
pub use pong_engine::ObjectId;

/// Id of a pair of Objects.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// world.set_pair_enabled(pair, false)?;
/// assert_eq!(world.step()?.contacts, 0);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::PairId;

/// Id of a movable group of an Object.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// let object = world.scene().object("ball")?;
/// let root: pong::InterfaceId = world.scene().interface(object, "")?;
/// world.step()?;
/// assert!(world.wrench(root)?.force.z > 0.0);
/// # Ok(())
/// # }
/// ```
pub use pong_engine::InterfaceId;

/// Force and moment. The call that returns one states the point and the axes.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// world.step()?;
/// let pong::Wrench { force, moment } = world.wrench(ball)?;
/// assert!((force.z - 20.0).abs() < 1e-9 && moment.norm() < 1e-9);
/// # Ok(())
/// # }
/// ```
pub use pong_geometry::Wrench;

/// Position and orientation of a movable group.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// let (pose, _) = world.state(ball)?.expect("it was set");
/// assert_eq!(pose, pong::Pose::new(pong::Vec3::new(0.0, 0.0, 0.099), [1.0, 0.0, 0.0, 0.0]));
/// # Ok(())
/// # }
/// ```
pub use pong_geometry::Pose;

/// Velocities of a movable group.
///
/// ```
/// let twist = pong::Twist { linear: pong::Vec3::new(1.0, 0.0, 0.0), ..pong::Twist::zero() };
/// let rolling = pong::State::from_motion(&pong::Pose::identity(), &twist);
/// assert_eq!(rolling.linear_velocity, [1.0, 0.0, 0.0]);
/// ```
pub use pong_geometry::Twist;

/// Vector of three components, of crate nalgebra.
///
/// ```
/// assert_eq!(pong::Vec3::new(3.0, 0.0, 4.0).norm(), 5.0);
/// ```
pub use pong_geometry::Vec3;

/// Unit quaternion, of crate nalgebra; a [`State`] takes its components as (w, x, y, z).
///
/// ```
/// let turned = pong::Quat::from_scaled_axis(pong::Vec3::z() * std::f64::consts::FRAC_PI_2);
/// let state = pong::State { orientation: [turned.w, turned.i, turned.j, turned.k], ..pong::State::identity() };
/// assert!((state.pose().orientation * pong::Vec3::x() - pong::Vec3::y()).norm() < 1e-15);
/// ```
pub use pong_geometry::Quat;

/// The host's own kinds of primitives and bounding volumes; the traits for them are in crate `pong-
/// geometry`.
///
/// ```
/// use pong::{Config, Extensions, WorldBuilder, law::Laws};
/// let mut extensions = Extensions::new();
/// extensions.allow_files_below("/usr/share/meshes");
/// let builder = WorldBuilder::with_extensions(Config::default(), extensions, Laws::default());
/// assert_eq!(builder.scene().extensions().folders_allowed().count(), 1);
/// ```
pub use pong_model::Extensions;

/// Validated, immutable model. [`Load`] makes one; it may serve several worlds.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// use std::sync::Arc;
/// let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/ball.ron"));
/// let model = Arc::new(pong::parse_model(text, "ball.ron", None, &pong::Extensions::new())?);
/// let mut builder = pong::WorldBuilder::new(pong::Config::default());
/// builder.add_model(Arc::clone(&model));
/// assert_eq!(model.name, "ball");
/// # Ok(())
/// # }
/// ```
pub use pong_model::Model;

/// All faults of a model.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut builder, [ball, ground], pair) = set_up(pong::Config::default())?;
/// use pong::{Error, Load};
/// let Err(Error::Model(faults)) = builder.load_text("(format: )", "bad.ron") else { panic!("it is no model") };
/// assert_eq!((faults.0[0].file.as_str(), faults.0[0].line), ("bad.ron", 1));
/// # Ok(())
/// # }
/// ```
pub use pong_model::ModelErrors;

/// One fault of a model: file, line, column, cause and cure.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut builder, [ball, ground], pair) = set_up(pong::Config::default())?;
/// # use pong::{Error, Load};
/// # let Err(Error::Model(faults)) = builder.load_text("(format: )", "bad.ron") else { panic!("it is no model") };
/// let fault: &pong::ModelError = &faults.0[0];
/// assert!(fault.to_string().starts_with("bad.ron:1:") && !fault.cure.is_empty());
/// # Ok(())
/// # }
/// ```
pub use pong_model::ModelError;

/// Model from a text, to be shared by several worlds. [`Load::load_text`] is shorter for one.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/ground.ron"));
/// let ground = pong::parse_model(text, "ground.ron", None, &pong::Extensions::new())?;
/// assert_eq!(ground.surfaces[0].name, "stone");
/// # Ok(())
/// # }
/// ```
pub use pong_model::parse as parse_model;

/// Model from a file, to be shared by several worlds. [`Load::load`] is shorter for one.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// let file = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/ground.ron");
/// let ground = pong::load_model(file.as_ref(), &pong::Extensions::new())?;
/// assert_eq!(ground.name, "ground");
/// # Ok(())
/// # }
/// ```
pub use pong_model::load as load_model;
