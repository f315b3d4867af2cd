//! Fitting of a bounding volume of a given kind around shapes.

use super::bounded::support;
use super::volume::{BoundKind, Bounded, Volume};
use super::{aabb, obb, sphere};
use crate::Vec3;
use crate::extension::Extensions;

/// Returns a volume of the given kind around shapes in the frame of one movable group, with margin
/// ([`RELATIVE_MARGIN`](super::RELATIVE_MARGIN)).
///
/// If any shape is infinite, the result is [`Volume::Unbounded`], whatever the kind.
///
/// # Errors
/// The reason as text. Possible reasons are an empty list, shapes whose extent is NaN, a volume that would
/// not be finite, a custom kind that is not registered, and a fitter that returns a volume of another kind.
pub fn fit(kind: &BoundKind, things: &[&dyn Bounded], ext: &Extensions) -> Result<Volume, String> {
    let Some((min, max)) = bounds(things)? else { return Ok(Volume::Unbounded) };
    let volume = match kind {
        BoundKind::Aabb => aabb::fit_aabb_bounds(min, max),
        BoundKind::Sphere => sphere::fit_sphere(things, &((min + max) * 0.5)).inflated(),
        BoundKind::Obb => obb::fit_obb(things).inflated(),
        BoundKind::Custom(name) => fit_custom(name, things, ext)?,
    };
    if !volume.is_finite() {
        return Err(format!("the {} volume around these things is not finite", kind.name()));
    }
    Ok(volume)
}

fn fit_custom(name: &str, things: &[&dyn Bounded], ext: &Extensions) -> Result<Volume, String> {
    let fitter =
        ext.volume(name).ok_or_else(|| format!("no bounding volume of kind \"{name}\" is registered"))?;
    let volume = fitter(things);
    if volume.kind_name() != name {
        return Err(format!("the fitter of \"{name}\" made a volume of kind \"{}\"", volume.kind_name()));
    }
    Ok(Volume::Custom(volume))
}

/// Returns the minimum and maximum coordinates of all shapes; `None` if one is infinite.
///
/// The six supports along the axes find every unbounded shape: an unbounded convex set extends to infinity in
/// some direction, and therefore along an axis that is not perpendicular to this direction.
fn bounds(things: &[&dyn Bounded]) -> Result<Option<(Vec3, Vec3)>, String> {
    if things.is_empty() {
        return Err("there is nothing to bound".to_owned());
    }
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    let max = Vec3::from(axes.map(|e| support(things, &e)));
    let min = Vec3::from(axes.map(|e| -support(things, &-e)));
    if min.iter().chain(max.iter()).any(|x| x.is_nan()) {
        return Err("the extent of what is to be bounded is not a number".to_owned());
    }
    if max.max() == f64::INFINITY || min.min() == f64::NEG_INFINITY {
        return Ok(None);
    }
    // A support of −∞ means that there are no points.
    if (max - min).min() < 0.0 {
        return Err("there is nothing to bound".to_owned());
    }
    Ok(Some((min, max)))
}
