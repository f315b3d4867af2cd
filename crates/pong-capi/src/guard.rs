//! Guards of every entry from C: floating-point environment, lock, panics, message.

use crate::failure::{Failure, Outcome, Why};
use crate::handle::{Inner, pong_world};
use crate::memory;
use crate::message;
use crate::pointers::Out;
use crate::status::pong_status;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Mutex, MutexGuard, TryLockError};

/// Runs an entry that has no world: sets the engine's floating-point environment, catches panics, and turns
/// the outcome into a status and a message (empty on success).
pub(crate) fn guarded(call: impl FnOnce() -> Outcome) -> pong_status {
    pong_fpenv::guarded(|| {
        let failure = match catch_unwind(AssertUnwindSafe(call)) {
            Ok(Ok(())) => {
                // Cleared at the end, not at the beginning: a law called meanwhile may have called Pong and left
                // a message.
                message::clear();
                return pong_status::Ok;
            }
            Ok(Err(failure)) => failure,
            Err(payload) => fault(payload),
        };
        match failure.why {
            Why::Text(text) => message::set(&text),
            Why::Error(error) => message::set_short(format_args!("{error}")),
        }
        failure.status
    })
}

/// Data behind a lock that C holds by an opaque pointer.
pub(crate) trait Locked {
    type Inner;
    /// Noun for messages.
    const NOUN: &'static str;
    /// Function of pong.h that makes it.
    const MADE_BY: &'static str;

    fn inner(&self) -> &Mutex<Self::Inner>;
}

impl Locked for pong_world {
    type Inner = Inner;
    const NOUN: &'static str = "world";
    const MADE_BY: &'static str = "pong_create_world()";

    fn inner(&self) -> &Mutex<Inner> {
        &self.inner
    }
}

/// As [`guarded`], with the world: one call at a time. A panic poisons the world's lock, and so the world.
///
/// # Safety
/// `world` is NULL or a living world.
pub(crate) unsafe fn with_world(
    world: *const pong_world,
    call: impl FnOnce(&mut Inner) -> Outcome,
) -> pong_status {
    guarded(|| call(&mut *lock(world, "world")?))
}

/// Locks what a pointer names and returns its data, until the guard is dropped. `name` is that of the argument.
///
/// # Safety
/// `handle` is NULL or lives as long as the guard.
pub(crate) unsafe fn lock<'w, H: Locked + 'w>(
    handle: *const H,
    name: &str,
) -> Outcome<MutexGuard<'w, H::Inner>> {
    let noun = H::NOUN;
    // SAFETY: by the contract of this function; shared access is enough, the lock guards the rest.
    let Some(handle) = (unsafe { handle.as_ref() }) else {
        let message = format!("`{name}` is NULL; give a {noun} made by {}", H::MADE_BY);
        return Err(Failure::new(pong_status::NullArgument, message));
    };
    handle.inner().try_lock().map_err(|refused| match refused {
        TryLockError::WouldBlock => Failure::new(
            pong_status::Busy,
            format!(
                "the {noun} is in another call; call it from one thread at a time and never from inside a law"
            ),
        ),
        TryLockError::Poisoned(_) => Failure::new(
            pong_status::Panic,
            format!("the {noun} is unusable after an earlier fault inside the library; destroy it"),
        ),
    })
}

/// As [`with_world`], for calls that return one value: written to `pointer`, the argument `name` of messages.
///
/// # Safety
/// As [`with_world`]; `pointer` is NULL or may be written.
pub(crate) unsafe fn get<T>(
    world: *const pong_world,
    (pointer, name): (*mut T, &str),
    call: impl FnOnce(&mut Inner) -> Outcome<T>,
) -> pong_status {
    with_world(world, |inner| {
        let out = Out::new(pointer, name)?;
        out.set(call(inner)?);
        Ok(())
    })
}

/// As [`with_world`], for calls of set-up that take little memory: refused if that memory is not available.
///
/// # Safety
/// As [`with_world`].
pub(crate) unsafe fn setting_up(
    world: *const pong_world,
    call: impl FnOnce(&mut Inner) -> Outcome,
) -> pong_status {
    with_world(world, |inner| {
        memory::require_small()?;
        call(inner)
    })
}

fn fault(payload: Box<dyn Any + Send>) -> Failure {
    let reason = match (payload.downcast_ref::<&str>(), payload.downcast_ref::<String>()) {
        (Some(text), _) => text,
        (_, Some(text)) => text.as_str(),
        _ => "no reason given",
    };
    let message = format!("a fault inside the library: {reason}; destroy the world and report this");
    // Leaked, not dropped: the payload's destructor is unknown code, and would run outside the guard.
    std::mem::forget(payload);
    Failure::new(pong_status::Panic, message)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::pong_default_config;
    use crate::frames::pong_step;
    use crate::world::{pong_create_world, pong_destroy_world};
    use std::ffi::CStr;

    fn last_message() -> String {
        // SAFETY: the message ends with a zero byte and lives until the next call.
        unsafe { CStr::from_ptr(crate::message::pointer()) }.to_str().unwrap().to_owned()
    }

    #[test]
    fn a_panic_inside_leaves_the_environment_of_the_host() {
        let before = pong_fpenv::current();
        assert_eq!(guarded(|| panic!("thrown inside")), pong_status::Panic);
        assert_eq!(pong_fpenv::current(), before);
    }

    #[test]
    fn a_panic_becomes_a_status_and_poisons_the_world() {
        let mut world = std::ptr::null_mut();
        // SAFETY: valid places; the world is destroyed once, at the end.
        unsafe {
            assert_eq!(pong_create_world(&pong_default_config(), &mut world), pong_status::Ok);
            let status = with_world(world, |_| panic!("index {} out of range", 7));
            assert_eq!(status, pong_status::Panic);
            assert!(last_message().contains("index 7 out of range"), "{}", last_message());
            assert_eq!(pong_step(world), pong_status::Panic);
            assert!(last_message().contains("destroy it"), "{}", last_message());
            assert_eq!(pong_destroy_world(world), pong_status::Ok);
        }
    }

    #[test]
    fn a_call_from_inside_a_call_is_refused() {
        let mut world = std::ptr::null_mut();
        // SAFETY: valid places; the world is destroyed once, at the end.
        unsafe {
            assert_eq!(pong_create_world(&pong_default_config(), &mut world), pong_status::Ok);
            let mut inner = pong_status::Ok;
            let outer = with_world(world, |_| {
                inner = pong_step(world);
                Ok(())
            });
            assert_eq!((outer, inner), (pong_status::Ok, pong_status::Busy));
            assert_eq!(pong_step(world), pong_status::WrongPhase);
            assert_eq!(pong_destroy_world(world), pong_status::Ok);
        }
    }

    #[test]
    fn a_success_clears_the_message() {
        assert_eq!(guarded(|| Err(Failure::new(pong_status::BadValue, "too\0long"))), pong_status::BadValue);
        assert_eq!(last_message(), "too\\u{0}long");
        assert_eq!(guarded(|| Ok(())), pong_status::Ok);
        assert_eq!(last_message(), "");
    }
}
