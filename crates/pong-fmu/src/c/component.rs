//! Guards of every call by an importer: floating-point environment, panics, messages.

use super::logger::{DISCARD, ERROR, FATAL, Logger, OK, Status, WARNING};
use super::pointers::place;
use crate::instance::{Instance, Kind};
use crate::library::MARK;
use crate::load::load;
use crate::refusal::Refusal;
use std::any::Any;
use std::ffi::c_void;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;

/// Data behind the importer's pointer.
pub(super) struct Component {
    instance: Instance,
    pub logger: Logger,
    /// True after a fault inside the library, when nothing can be relied on.
    is_broken: bool,
}

/// Makes an instance; logs the reason and returns NULL if it fails.
pub(super) fn instantiate(
    logger: Logger,
    kind: Kind,
    token: Option<&str>,
    resources: Result<PathBuf, String>,
) -> *mut c_void {
    pong_fpenv::guarded(|| {
        let made = catch_unwind(AssertUnwindSafe(|| {
            let token = token.ok_or("instantiation token: it is NULL; give that of modelDescription.xml")?;
            let unit = load(&resources?, token)?;
            Ok::<_, String>(Instance::new(unit, kind))
        }));
        match made {
            Ok(Ok(mut instance)) => {
                logger.tell(OK, &format!("{}: instantiated by {MARK}", instance.unit.name));
                instance.warnings.drain(..).for_each(|warning| logger.tell(WARNING, &warning));
                Box::into_raw(Box::new(Component { instance, logger, is_broken: false })).cast()
            }
            Ok(Err(text)) => {
                logger.tell(ERROR, &text);
                std::ptr::null_mut()
            }
            Err(payload) => {
                logger.tell(FATAL, &fault(payload));
                std::ptr::null_mut()
            }
        }
    })
}

/// Calls an instance.
///
/// # Safety
/// As all functions of this module (`c/mod.rs`).
pub(super) unsafe fn call(
    component: *mut c_void,
    action: impl FnOnce(&mut Instance) -> Result<(), Refusal>,
) -> Status {
    // SAFETY: by the contract of this function.
    unsafe { call_with_logger(component, |instance, _| action(instance)) }
}

/// As [`call`], with the logger.
///
/// # Safety
/// As all functions of this module (`c/mod.rs`).
pub(super) unsafe fn call_with_logger(
    component: *mut c_void,
    action: impl FnOnce(&mut Instance, &mut Logger) -> Result<(), Refusal>,
) -> Status {
    pong_fpenv::guarded(|| {
        // SAFETY: NULL, or what `instantiate` made.
        let Ok(component) = (unsafe { place(component.cast::<Component>(), "instance") }) else {
            // Without an instance there is no logger, so no message.
            return ERROR;
        };
        if component.is_broken {
            component
                .logger
                .tell(FATAL, "instance: it is unusable after a fault inside the library; free it");
            return FATAL;
        }
        let Component { instance, logger, is_broken } = component;
        let status = match catch_unwind(AssertUnwindSafe(|| action(instance, logger))) {
            Ok(Ok(())) => OK,
            Ok(Err(refusal)) => {
                let status = if refusal.may_retry { DISCARD } else { ERROR };
                logger.tell(status, &refusal.text);
                status
            }
            Err(payload) => {
                *is_broken = true;
                logger.tell(FATAL, &fault(payload));
                FATAL
            }
        };
        instance.warnings.drain(..).for_each(|warning| logger.tell(WARNING, &warning));
        status
    })
}

/// Ends an instance.
///
/// # Safety
/// As all functions of this module (`c/mod.rs`).
pub(super) unsafe fn free(component: *mut c_void) {
    if component.is_null() {
        return;
    }
    pong_fpenv::guarded(|| {
        // SAFETY: what `instantiate` made, and the importer gives it up.
        let component = unsafe { Box::from_raw(component.cast::<Component>()) };
        // A panic must not reach C; the rest of the instance then leaks.
        let _ = catch_unwind(AssertUnwindSafe(|| drop(component)));
    });
}

fn fault(payload: Box<dyn Any + Send>) -> String {
    let said = match (payload.downcast_ref::<&str>(), payload.downcast_ref::<String>()) {
        (Some(text), _) => text,
        (_, Some(text)) => text.as_str(),
        _ => "no reason given",
    };
    let text = format!("a fault inside the library: {said}; free the instance and report this");
    // Forgotten, not dropped: the payload's destructor is unknown code.
    std::mem::forget(payload);
    text
}

/// A saved state in the importer's hands.
pub(super) mod state {
    use super::{Instance, Refusal, c_void, place};
    use crate::c::pointers::{slice, slice_mut};

    /// # Safety
    /// As all functions of this module (`c/mod.rs`).
    pub unsafe fn get(instance: &mut Instance, state: *mut *mut c_void) -> Result<(), Refusal> {
        // SAFETY: by the contract of this function; an existing state is overwritten.
        unsafe {
            let state = place(state, "FMU state")?;
            if let Some(bytes) = state.cast::<Vec<u8>>().as_mut() {
                instance.save(bytes);
                return Ok(());
            }
            let mut bytes = Vec::new();
            instance.save(&mut bytes);
            *state = Box::into_raw(Box::new(bytes)).cast();
        }
        Ok(())
    }

    /// # Safety
    /// As all functions of this module (`c/mod.rs`).
    pub unsafe fn bytes<'a>(state: *mut c_void) -> Result<&'a Vec<u8>, Refusal> {
        // SAFETY: NULL, or what `get` or `deserialize` made.
        unsafe { place(state.cast::<Vec<u8>>(), "FMU state") }.map(|bytes| &*bytes)
    }

    /// # Safety
    /// As all functions of this module (`c/mod.rs`).
    pub unsafe fn free(state: *mut *mut c_void) -> Result<(), Refusal> {
        // SAFETY: what `get` or `deserialize` made, and the importer gives it up.
        unsafe {
            let state = place(state, "FMU state")?;
            if !state.is_null() {
                drop(Box::from_raw(state.cast::<Vec<u8>>()));
            }
            *state = std::ptr::null_mut();
        }
        Ok(())
    }

    /// # Safety
    /// As all functions of this module (`c/mod.rs`).
    pub unsafe fn serialize(state: *mut c_void, out: *mut u8, size: usize) -> Result<(), Refusal> {
        // SAFETY: by the contract of this function.
        let (bytes, out) = unsafe { (bytes(state)?, slice_mut(out, size, "serialised state")?) };
        if out.len() < bytes.len() {
            return Err(Refusal::error(format!(
                "serialised state: the buffer has {size} bytes and the state {}; ask for its size",
                bytes.len()
            )));
        }
        out[..bytes.len()].copy_from_slice(bytes);
        Ok(())
    }

    /// # Safety
    /// As all functions of this module (`c/mod.rs`).
    pub unsafe fn deserialize(
        instance: &Instance,
        bytes: *const u8,
        size: usize,
        state: *mut *mut c_void,
    ) -> Result<(), Refusal> {
        // SAFETY: by the contract of this function.
        let (bytes, state) = unsafe { (slice(bytes, size, "serialised state")?, place(state, "FMU state")?) };
        instance.check_state(bytes)?;
        *state = Box::into_raw(Box::new(bytes.to_vec())).cast();
        Ok(())
    }
}
