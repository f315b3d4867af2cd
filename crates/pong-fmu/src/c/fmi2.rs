//! The functions of FMI 2.0.

#![allow(non_snake_case, reason = "the standard names them")]
#![allow(clippy::too_many_arguments, reason = "the standard counts them")]

use super::both::{absent, none};
use super::component::{call, call_with_logger, free, instantiate};
use super::logger::{DISCARD, ERROR, Fmi2Log, Logger, OK, Sink, Status, c_text};
use super::pointers::{place, read, slice, text};
use crate::instance::{Instance, Kind};
use crate::load::folder_of_uri;
use crate::refusal::Refusal;
use std::ffi::{c_char, c_int, c_void};

/// `fmi2CallbackFunctions`.
#[repr(C)]
struct Callbacks {
    logger: Option<Fmi2Log>,
    allocate: *const c_void,
    free: *const c_void,
    step_finished: *const c_void,
    environment: *mut c_void,
}

/// `fmi2EventInfo`.
#[repr(C)]
struct EventInfo {
    new_discrete_states_needed: c_int,
    terminate: c_int,
    nominals_changed: c_int,
    values_changed: c_int,
    next_event_time_defined: c_int,
    next_event_time: f64,
}

/// `fmi2LastSuccessfulTime`.
const LAST_SUCCESSFUL_TIME: c_int = 2;

#[unsafe(no_mangle)]
extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

#[unsafe(no_mangle)]
extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2Instantiate(
    name: *const c_char,
    kind: c_int,
    guid: *const c_char,
    resources: *const c_char,
    callbacks: *const Callbacks,
    _visible: c_int,
    logging_on: c_int,
) -> *mut c_void {
    // SAFETY: by the contract of this module.
    let (name, guid, uri, callbacks) =
        unsafe { (text(name), text(guid), text(resources), callbacks.as_ref()) };
    let sink = match callbacks.and_then(|callbacks| callbacks.logger) {
        Some(log) => Sink::Fmi2(log, c_text(name.as_deref().unwrap_or_default())),
        None => Sink::None,
    };
    let environment = callbacks.map_or(std::ptr::null_mut(), |callbacks| callbacks.environment);
    let logger = Logger { sink, environment, tells_events: logging_on != 0 };
    let folder = match uri {
        Some(uri) => folder_of_uri(&uri),
        None => Err("fmuResourceLocation: it is NULL; give the URI of the folder `resources`".to_owned()),
    };
    let kind = if kind == 0 { Kind::ModelExchange } else { Kind::CoSimulation };
    instantiate(logger, kind, guid.as_deref(), folder)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2FreeInstance(component: *mut c_void) {
    // SAFETY: by the contract of this module.
    unsafe { free(component) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2SetDebugLogging(
    component: *mut c_void,
    on: c_int,
    _count: usize,
    _categories: *const *const c_char,
) -> Status {
    // SAFETY: by the contract of this module.
    unsafe {
        call_with_logger(component, |_, logger| {
            logger.tells_events = on != 0;
            Ok(())
        })
    }
}

calls! {
    fn fmi2SetupExperiment(_has_tolerance: c_int, _tolerance: f64, start: f64, _has_stop: c_int, _stop: f64)
        |instance| instance.set_start(start);
    fn fmi2EnterInitializationMode() |instance| instance.enter_initialization();

    fn fmi2GetReal(references: *const u32, count: usize, values: *mut f64)
        |instance| read(references, count, values, |reference| instance.number(reference));
    fn fmi2GetBoolean(references: *const u32, count: usize, values: *mut c_int)
        |instance| read(references, count, values, |reference| Ok(instance.flag(reference)?.into()));
    fn fmi2SetReal(references: *const u32, count: usize, values: *const f64) |instance| {
        let references = slice(references, count, "value references")?;
        instance.set_numbers(references, slice(values, count, "values")?)
    };
    fn fmi2GetInteger(_references: *const u32, count: usize, _values: *mut c_int) |_instance| none(count, "Integer");
    fn fmi2GetString(_references: *const u32, count: usize, _values: *mut *const c_char)
        |_instance| none(count, "String");
    fn fmi2SetInteger(_references: *const u32, count: usize, _values: *const c_int) |_instance| none(count, "Integer");
    fn fmi2SetBoolean(_references: *const u32, count: usize, _values: *const c_int)
        |_instance| none(count, "Boolean that can be set");
    fn fmi2SetString(_references: *const u32, count: usize, _values: *const *const c_char)
        |_instance| none(count, "String");

    fn fmi2GetDirectionalDerivative(
        _unknowns: *const u32, _unknown_count: usize, _knowns: *const u32, _known_count: usize, _seed: *const f64,
        _sensitivity: *mut f64
    ) |_instance| absent(FUNCTION, "differentiate by differences");

    fn fmi2NewDiscreteStates(info: *mut EventInfo) |instance| {
        let info = place(info, "event info")?;
        let outcome = instance.update_discrete_states()?;
        *info = EventInfo {
            new_discrete_states_needed: 0,
            terminate: 0,
            nominals_changed: 0,
            values_changed: c_int::from(outcome.states_changed),
            next_event_time_defined: 0,
            next_event_time: 0.0,
        };
        Ok(())
    };
    fn fmi2CompletedIntegratorStep(_never_back: c_int, enter_event_mode: *mut c_int, terminate: *mut c_int) |instance| {
        let (event, terminate) = (place(enter_event_mode, "enterEventMode")?, place(terminate, "terminateSimulation")?);
        (*event, *terminate) = (c_int::from(instance.completed_step()?), 0);
        Ok(())
    };

    fn fmi2DoStep(from: f64, length: f64, _never_back: c_int) |instance| instance.do_step(from, length);
    fn fmi2CancelStep() |_instance| absent(FUNCTION, "steps end before they return");
    fn fmi2SetRealInputDerivatives(
        _references: *const u32, count: usize, _orders: *const c_int, _values: *const f64
    ) |_instance| none(count, "derivative of an input");
    fn fmi2GetRealOutputDerivatives(
        _references: *const u32, count: usize, _orders: *const c_int, _values: *mut f64
    ) |_instance| none(count, "derivative of an output");
}

/// Returns the last time reached; other values are refused, because steps end before they return.
#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2GetRealStatus(component: *mut c_void, kind: c_int, value: *mut f64) -> Status {
    // SAFETY: by the contract of this module.
    let status = unsafe {
        call(component, |instance| {
            let value = place(value, "status")?;
            if kind != LAST_SUCCESSFUL_TIME {
                return Err(Refusal::discard(
                    "fmi2GetRealStatus: steps end before they return; ask for the last time",
                ));
            }
            *value = instance.time;
            Ok(())
        })
    };
    if status == ERROR { DISCARD } else { status }
}

/// Refuses a status request: nothing is ever pending.
macro_rules! no_status {
    ($($name:ident: $type:ty;)*) => {$(
        #[unsafe(no_mangle)]
        extern "C" fn $name(_component: *mut c_void, _kind: c_int, _value: *mut $type) -> Status {
            DISCARD
        }
    )*};
}

no_status! {
    fmi2GetStatus: Status;
    fmi2GetIntegerStatus: c_int;
    fmi2GetStringStatus: *const c_char;
}

/// Returns false: the FMU never ends a simulation.
#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2GetBooleanStatus(
    _component: *mut c_void,
    _kind: c_int,
    value: *mut c_int,
) -> Status {
    // SAFETY: by the contract of this module.
    match unsafe { place(value, "status") } {
        Ok(value) => {
            *value = 0;
            OK
        }
        Err(_) => ERROR,
    }
}
