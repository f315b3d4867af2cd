//! Primitives defined by a user.

use crate::Vec3;

/// Primitive defined by a Rust user. Its testers are registered with the engine by kind name.
pub trait CustomPrimitive: std::fmt::Debug + Send + Sync + std::any::Any {
    /// The kind's name, as in the model file and in the registration of its testers.
    fn kind_name(&self) -> &str;

    /// Support function: the largest `direction · x` over the primitive, in the frame of its movable group, m.
    ///
    /// `direction` is a unit vector. Infinity makes the primitive unbounded. Bounding volumes are fitted from it.
    fn support(&self, direction: &Vec3) -> f64;

    /// The primitive as `Any`, so that a tester can get its own type back.
    fn as_any(&self) -> &dyn std::any::Any;
}
