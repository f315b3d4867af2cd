//! Pairs of Objects to test.

use crate::failure::{Failure, Outcome};
use crate::guard::{setting_up, with_world};
use crate::handle::pong_world;
use crate::ids::{pong_object_id, pong_pair_id};
use crate::pointers::{Out, text};
use crate::status::pong_status;
use std::ffi::c_char;

/// Declares that two Objects may touch. The movable groups of an Object that is paired with itself are tested
/// against each other. Before sealing. `pair` may be NULL. PONG_STATUS_DUPLICATE: they are a pair already.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_pair_objects(
    world: *mut pong_world,
    a: pong_object_id,
    b: pong_object_id,
    pair: *mut pong_pair_id,
) -> pong_status {
    setting_up(world, |inner| {
        let out = Out::optional(pair, "pair")?;
        let id = inner.phase.set_up("pair objects")?.pair(a.id(), b.id())?;
        inner.pair_count += 1;
        out.set(id.into());
        Ok(())
    })
}

/// As pong_pair_objects(), by the names of the Objects.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_pair_by_name(
    world: *mut pong_world,
    a: *const c_char,
    b: *const c_char,
    pair: *mut pong_pair_id,
) -> pong_status {
    setting_up(world, |inner| {
        let out = Out::optional(pair, "pair")?;
        let scene = inner.phase.scene();
        let (a, b) = (scene.object(text(a, "a")?)?, scene.object(text(b, "b")?)?);
        let id = inner.phase.set_up("pair objects")?.pair(a, b)?;
        inner.pair_count += 1;
        out.set(id.into());
        Ok(())
    })
}

/// Excludes contacts between two groups, each with everything below it, at no cost in a frame. The groups may
/// be movable or not, and belong to two Objects or to one (`a` and `b` alike). A group is named by its path
/// in the model (`root/arm/tip`), its path below the root (`arm/tip`) or its bare name where only one group
/// has it; an empty path is the whole Object. Before sealing; the Objects may be paired before or later.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_filter_groups(
    world: *mut pong_world,
    a: pong_object_id,
    group_a: *const c_char,
    b: pong_object_id,
    group_b: *const c_char,
) -> pong_status {
    setting_up(world, |inner| {
        let (group_a, group_b) = (text(group_a, "group_a")?, text(group_b, "group_b")?);
        inner.phase.set_up("filter groups")?.filter(a.id(), group_a, b.id(), group_b)?;
        Ok(())
    })
}

/// Switches a pair on (1, as it begins) or off (0), before or after sealing. A pair that is off has no
/// contacts. Both drop the contact state of the pair at once: bristles begin anew, as after
/// pong_clear_contact_history(). Switching to the present setting does nothing.
///
/// Wrenches and contacts stay those of the last frame until the next evaluation, so evaluate before the
/// wrenches are read again. pong_commit() and pong_step() evaluate by themselves; pong_log_frame() is refused
/// until then. A log records the switch by itself.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_set_pair_enabled(
    world: *mut pong_world,
    pair: pong_pair_id,
    enabled: i32,
) -> pong_status {
    with_world(world, |inner| {
        let enabled = yes_or_no(enabled)?;
        inner.phase.set_pair_enabled(pair.id(), enabled)?;
        inner.log_event(|log| log.pair_switched(pair.id(), enabled));
        Ok(())
    })
}

fn yes_or_no(value: i32) -> Outcome<bool> {
    match value {
        0 => Ok(false),
        1 => Ok(true),
        other => Err(Failure::new(pong_status::BadValue, format!("`enabled` is {other}; give 0 or 1"))),
    }
}
