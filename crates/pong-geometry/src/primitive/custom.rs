//! Primitives defined by a user.

use crate::Vec3;

/// Primitive defined by a Rust user. Its contact testers are registered with the engine by the name of its
/// kind.
pub trait CustomPrimitive: std::fmt::Debug + Send + Sync + std::any::Any {
    /// Returns the kind's name, as in the model file and in the registration of its testers.
    fn kind_name(&self) -> &str;

    /// Returns the largest `direction · x` over the primitive, in the frame of its movable group, m (support
    /// function).
    ///
    /// `direction` is a unit vector. If the result is infinite, the primitive is unbounded. Bounding volumes
    /// are fitted from this function.
    fn support(&self, direction: &Vec3) -> f64;

    /// Returns the primitive as `Any`, so that a tester can get its own type back.
    fn as_any(&self) -> &dyn std::any::Any;
}
