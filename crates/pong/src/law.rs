//! Force laws of the host, and surfaces with the laws that they name.
//!
//! A law must be pure: a frame may call it any number of times, from any thread.

/// Laws of the host by the names that models use. Give them to
/// [`WorldBuilder::with_extensions`](crate::WorldBuilder::with_extensions), or add them by
/// [`WorldBuilder::laws_mut`](crate::WorldBuilder::laws_mut).
///
/// ```
/// use pong::law::{Laws, NormalForce, NormalInput};
///
/// #[derive(Debug)]
/// struct Quadratic;
///
/// impl NormalForce for Quadratic {
///     fn force(&self, input: &NormalInput<'_>) -> f64 {
///         input.parameters[0] * input.depth * input.depth
///     }
///     fn stored(&self, input: &NormalInput<'_>) -> f64 {
///         input.parameters[0] * input.depth.powi(3) / 3.0
///     }
/// }
///
/// let mut laws = Laws::default();
/// laws.add_normal("quadratic", std::sync::Arc::new(Quadratic));
/// let builder = pong::WorldBuilder::with_extensions(pong::Config::default(), pong::Extensions::new(), laws);
/// assert_eq!(builder.scene().law_names().collect::<Vec<_>>(), ["quadratic"]);
/// ```
pub use pong_engine::Laws;

/// Normal force law of the host. The example `own_law` uses one.
///
/// ```
/// use pong::law::{Laws, NormalForce, NormalInput};
///
/// #[derive(Debug)]
/// struct Quadratic;
///
/// impl NormalForce for Quadratic {
///     fn force(&self, input: &NormalInput<'_>) -> f64 {
///         input.parameters[0] * input.depth * input.depth
///     }
///     fn stored(&self, input: &NormalInput<'_>) -> f64 {
///         input.parameters[0] * input.depth.powi(3) / 3.0
///     }
/// }
///
/// let mut laws = Laws::default();
/// laws.add_normal("quadratic", std::sync::Arc::new(Quadratic));
/// ```
pub use pong_engine::NormalForce;

/// Input of a normal force law.
///
/// ```
/// let input = pong::law::NormalInput { depth: 1e-3, rate: 0.0, stiffness: 2e4, parameters: &[] };
/// assert_eq!(input.stiffness * input.depth, 20.0);
/// ```
pub use pong_engine::NormalInput;

/// Derivatives of a contact's normal force.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// world.step()?;
/// let tangent = world.normal_tangents().next().flatten().expect("one contact of a built-in law");
/// assert_eq!((tangent.stiffness, tangent.damping), (2e4, 30.0));
/// # Ok(())
/// # }
/// ```
pub use pong_engine::NormalTangent;

/// Friction law of the host.
///
/// ```
/// use pong::law::{FrictionForce, FrictionInput, FrictionOutput, Laws};
///
/// #[derive(Debug)]
/// struct Viscous;
///
/// impl FrictionForce for Viscous {
///     fn state_len(&self) -> usize {
///         0
///     }
///     fn evaluate(&self, input: &FrictionInput<'_>, _state: &mut [f64]) -> FrictionOutput {
///         let coefficient = input.parameters[0] * input.share; // N·s/m
///         FrictionOutput { force_b: -coefficient * input.slip_velocity_b, ..FrictionOutput::free() }
///     }
/// }
///
/// let mut laws = Laws::default();
/// laws.add_friction("viscous", std::sync::Arc::new(Viscous));
/// ```
pub use pong_engine::FrictionForce;

/// Input of a friction law.
///
/// ```
/// use pong::law::FrictionInput;
/// fn limit(input: &FrictionInput<'_>) -> f64 {
///     input.parameters[0] * input.normal_force // N
/// }
/// ```
pub use pong_engine::FrictionInput;

/// Output of a friction law.
///
/// ```
/// let free = pong::law::FrictionOutput::free();
/// assert_eq!((free.force_b, free.sticks), (pong::Vec3::zeros(), false));
/// ```
pub use pong_engine::FrictionOutput;

/// Named surface of a model. A host may change its values in frames, but not its laws.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// let model = world.scene().models().next().expect("the ball").0;
/// let mut rubber = world.surface(model, "rubber")?.clone();
/// rubber.stiffness = 4e4;
/// world.set_surface(model, &rubber)?;
/// world.step()?;
/// assert!((world.wrench_common(ball)?.force.z - 40.0).abs() < 1e-9);
/// # Ok(())
/// # }
/// ```
pub use pong_model::Surface;

/// Normal force law of a surface.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// use pong::law::NormalLaw;
/// let model = world.scene().models().next().expect("the ball").0;
/// let law = &world.surface(model, "rubber")?.normal;
/// assert_eq!(*law, NormalLaw::Linear { damping: 30.0, ramp: 0.0 });
/// # Ok(())
/// # }
/// ```
pub use pong_model::NormalLaw;

/// Friction law of a surface.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/doc/ball_on_ground.rs"));
/// # fn main() -> Result<(), pong::Error> {
/// # let (mut world, [ball, ground], pair) = ball_on_ground(pong::Config::default())?;
/// use pong::law::FrictionLaw;
/// let model = world.scene().models().next().expect("the ball").0;
/// assert!(matches!(world.surface(model, "rubber")?.friction, FrictionLaw::Bristle { mu: 0.6, .. }));
/// # Ok(())
/// # }
/// ```
pub use pong_model::FrictionLaw;

/// Exponent of the depth in a normal force law.
///
/// ```
/// assert_eq!(pong::law::Exponent::ThreeHalves.value(), 1.5);
/// ```
pub use pong_model::Exponent;
