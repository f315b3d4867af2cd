//! Warnings of a frame in words: which bodies a missed contact, or a force that no longer grows, belongs to.

use pong_engine::World;

/// The first tunnelling of the last frame: primitive and movable group, each as `object/path`. `None` if nothing
/// tunnelled.
pub fn tunnelling_in_words(world: &World) -> Option<String> {
    let report = world.tunnelling()?;
    let primitive = world.scene().primitive_name(report.interface, report.primitive).ok()?;
    let through = world.scene().interface_name(report.through).ok()?;
    Some(format!("`{primitive}` through `{through}`"))
}

/// A solid that is deeper in a mesh than the regions below its facets in the last frame: its movable group and that of
/// the mesh, each as `object/path`. `None` if there is none.
pub fn deep_in_mesh_in_words(world: &World) -> Option<String> {
    let report = world.deep_in_mesh()?;
    let [other, mesh] = [report.other, report.mesh].map(|id| world.scene().interface_name(id).ok());
    Some(format!("`{}` in `{}`", other?, mesh?))
}
