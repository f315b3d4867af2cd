//! The functions of FMI 2.0.

#![allow(non_snake_case, reason = "the standard names them")]
#![allow(clippy::too_many_arguments, reason = "the standard counts them")]

use super::component::{call, call_with_logger, free, instantiate, state};
use super::logger::{DISCARD, ERROR, Fmi2Log, Logger, OK, Sink, Status, c_text};
use super::pointers::{place, slice, slice_mut, text};
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
    fn fmi2ExitInitializationMode() |instance| instance.exit_initialization();
    fn fmi2Terminate() |instance| instance.terminate();
    fn fmi2Reset() |instance| instance.reset();

    fn fmi2GetReal(references: *const u32, count: usize, values: *mut f64) |instance| {
        let references = slice(references, count, "value references")?;
        let values = slice_mut(values, count, "values")?;
        references.iter().zip(values).try_for_each(|(reference, value)| {
            *value = instance.number(*reference)?;
            Ok(())
        })
    };
    fn fmi2GetBoolean(references: *const u32, count: usize, values: *mut c_int) |instance| {
        let references = slice(references, count, "value references")?;
        let values = slice_mut(values, count, "values")?;
        references.iter().zip(values).try_for_each(|(reference, value)| {
            *value = c_int::from(instance.flag(*reference)?);
            Ok(())
        })
    };
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

    fn fmi2GetFMUstate(saved: *mut *mut c_void) |instance| state::get(instance, saved);
    fn fmi2SetFMUstate(saved: *mut c_void) |instance| instance.restore(state::bytes(saved)?);
    fn fmi2FreeFMUstate(saved: *mut *mut c_void) |_instance| state::free(saved);
    fn fmi2SerializedFMUstateSize(saved: *mut c_void, size: *mut usize) |_instance| {
        *place(size, "size")? = state::bytes(saved)?.len();
        Ok(())
    };
    fn fmi2SerializeFMUstate(saved: *mut c_void, bytes: *mut u8, size: usize)
        |_instance| state::serialize(saved, bytes, size);
    fn fmi2DeSerializeFMUstate(bytes: *const u8, size: usize, saved: *mut *mut c_void)
        |instance| state::deserialize(instance, bytes, size, saved);
    fn fmi2GetDirectionalDerivative(
        _unknowns: *const u32, _unknown_count: usize, _knowns: *const u32, _known_count: usize, _seed: *const f64,
        _sensitivity: *mut f64
    ) |_instance| absent("fmi2GetDirectionalDerivative", "differentiate by differences");

    fn fmi2EnterEventMode() |instance| instance.enter_event_mode();
    fn fmi2EnterContinuousTimeMode() |instance| instance.enter_continuous_mode();
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
    fn fmi2SetTime(time: f64) |instance| instance.set_time(time);
    fn fmi2SetContinuousStates(states: *const f64, count: usize)
        |instance| instance.set_states(slice(states, count, "states")?);
    fn fmi2GetContinuousStates(states: *mut f64, count: usize) |instance| {
        instance.check_count("fmi2GetContinuousStates", count)?;
        slice_mut(states, count, "states")?.copy_from_slice(instance.states()?);
        Ok(())
    };
    fn fmi2GetDerivatives(rates: *mut f64, count: usize) |instance| {
        instance.check_count("fmi2GetDerivatives", count)?;
        slice_mut(rates, count, "derivatives")?.copy_from_slice(instance.rates()?);
        Ok(())
    };
    fn fmi2GetNominalsOfContinuousStates(nominals: *mut f64, count: usize) |instance| {
        instance.check_count("fmi2GetNominalsOfContinuousStates", count)?;
        slice_mut(nominals, count, "nominal values")?.copy_from_slice(&instance.unit.variables.nominals);
        Ok(())
    };
    fn fmi2GetEventIndicators(_indicators: *mut f64, count: usize) |_instance| none(count, "event indicator");

    fn fmi2DoStep(from: f64, length: f64, _never_back: c_int) |instance| instance.do_step(from, length);
    fn fmi2CancelStep() |_instance| absent("fmi2CancelStep", "steps end before they return");
    fn fmi2SetRealInputDerivatives(
        _references: *const u32, count: usize, _orders: *const c_int, _values: *const f64
    ) |_instance| none(count, "derivative of an input");
    fn fmi2GetRealOutputDerivatives(
        _references: *const u32, count: usize, _orders: *const c_int, _values: *mut f64
    ) |_instance| none(count, "derivative of an output");
}

/// For kinds of variables of which there are none: asked for none of them, all is well.
fn none(count: usize, what: &str) -> Result<(), Refusal> {
    if count == 0 {
        return Ok(());
    }
    Err(Refusal::error(format!("{what}: the unit has none; take the variables of modelDescription.xml")))
}

/// For functions that the description says are not there.
fn absent(function: &str, cure: &str) -> Result<(), Refusal> {
    Err(Refusal::error(format!(
        "{function}: the unit does not have it, as modelDescription.xml says; {cure}"
    )))
}

/// Steps end before they return: only the time that was reached can be asked for.
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

/// Nothing is ever pending.
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

/// A simulation is never ended by the unit.
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
