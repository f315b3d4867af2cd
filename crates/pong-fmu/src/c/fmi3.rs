//! The functions of FMI 3.0.

#![allow(non_snake_case, reason = "the standard names them")]
#![allow(clippy::too_many_arguments, reason = "the standard counts them")]

use super::both::{absent, none};
use super::component::{call, call_with_logger, free, instantiate};
use super::logger::{ERROR, Fmi3Log, Logger, Sink, Status};
use super::pointers::{place, read, slice, text};
use crate::instance::{Instance, Kind};
use crate::refusal::Refusal;
use std::ffi::{c_char, c_int, c_void};
use std::path::PathBuf;

/// `fmi3Boolean`, a `bool` of C: taken as a byte, because not every byte is a valid `bool` of Rust.
type Boolean = u8;

/// Cure in the message of an absent function.
const DO_WITHOUT: &str = "do without it";

#[unsafe(no_mangle)]
extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

/// # Safety
/// As all functions of this module (`c/mod.rs`).
unsafe fn instantiate3(
    kind: Kind,
    token: *const c_char,
    resources: *const c_char,
    logging_on: Boolean,
    environment: *mut c_void,
    log: Option<Fmi3Log>,
) -> *mut c_void {
    // SAFETY: by the contract of this function.
    let (token, path) = unsafe { (text(token), text(resources)) };
    let logger =
        Logger { sink: log.map_or(Sink::None, Sink::Fmi3), environment, tells_events: logging_on != 0 };
    let folder = match &path {
        Some(path) => Ok(PathBuf::from(path.as_ref())),
        None => Err("resourcePath: it is NULL; give the path of the folder `resources`".to_owned()),
    };
    instantiate(logger, kind, token.as_deref(), folder)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3InstantiateModelExchange(
    _name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: Boolean,
    logging_on: Boolean,
    environment: *mut c_void,
    log: Option<Fmi3Log>,
) -> *mut c_void {
    // SAFETY: by the contract of this module.
    unsafe { instantiate3(Kind::ModelExchange, token, resources, logging_on, environment, log) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3InstantiateCoSimulation(
    _name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: Boolean,
    logging_on: Boolean,
    event_mode_used: Boolean,
    _early_return_allowed: Boolean,
    _required: *const u32,
    required_count: usize,
    environment: *mut c_void,
    log: Option<Fmi3Log>,
    _intermediate_update: *const c_void,
) -> *mut c_void {
    let refused = match (event_mode_used != 0, required_count) {
        (true, _) => Some("eventModeUsed: co-simulation has no event mode here; instantiate with fmi3False"),
        (_, 1..) => Some("requiredIntermediateVariables: there are no intermediate updates; ask for none"),
        _ => None,
    };
    if let Some(reason) = refused {
        let sink = log.map_or(Sink::None, Sink::Fmi3);
        pong_fpenv::guarded(|| Logger { sink, environment, tells_events: false }.tell(ERROR, reason));
        return std::ptr::null_mut();
    }
    // SAFETY: by the contract of this module.
    unsafe { instantiate3(Kind::CoSimulation, token, resources, logging_on, environment, log) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3InstantiateScheduledExecution(
    _name: *const c_char,
    _token: *const c_char,
    _resources: *const c_char,
    _visible: Boolean,
    _logging_on: Boolean,
    environment: *mut c_void,
    log: Option<Fmi3Log>,
    _clock_update: *const c_void,
    _lock: *const c_void,
    _unlock: *const c_void,
) -> *mut c_void {
    let sink = log.map_or(Sink::None, Sink::Fmi3);
    let reason = "scheduled execution: the unit does not have it; use Model Exchange or Co-Simulation";
    pong_fpenv::guarded(|| Logger { sink, environment, tells_events: false }.tell(ERROR, reason));
    std::ptr::null_mut()
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3FreeInstance(component: *mut c_void) {
    // SAFETY: by the contract of this module.
    unsafe { free(component) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3SetDebugLogging(
    component: *mut c_void,
    on: Boolean,
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
    fn fmi3EnterInitializationMode(
        _has_tolerance: Boolean, _tolerance: f64, start: f64, _has_stop: Boolean, _stop: f64
    ) |instance| instance.set_start(start).and_then(|()| instance.enter_initialization());

    fn fmi3GetFloat64(references: *const u32, count: usize, values: *mut f64, value_count: usize) |instance| {
        same_count(count, value_count)?;
        read(references, count, values, |reference| instance.number(reference))
    };
    fn fmi3GetBoolean(references: *const u32, count: usize, values: *mut Boolean, value_count: usize) |instance| {
        same_count(count, value_count)?;
        read(references, count, values, |reference| Ok(instance.flag(reference)?.into()))
    };
    fn fmi3SetFloat64(references: *const u32, count: usize, values: *const f64, value_count: usize) |instance| {
        same_count(count, value_count)?;
        let references = slice(references, count, "value references")?;
        instance.set_numbers(references, slice(values, count, "values")?)
    };

    fn fmi3EvaluateDiscreteStates() |_instance| Ok(());
    fn fmi3UpdateDiscreteStates(
        needs_update: *mut Boolean, terminate: *mut Boolean, nominals_changed: *mut Boolean,
        values_changed: *mut Boolean, has_next_time: *mut Boolean, next_time: *mut f64
    ) |instance| {
        let flags = [needs_update, terminate, nominals_changed, has_next_time];
        let values_changed = place(values_changed, "valuesOfContinuousStatesChanged")?;
        let next_time = place(next_time, "nextEventTime")?;
        for flag in flags {
            place(flag, "result of fmi3UpdateDiscreteStates")?;
        }
        let outcome = instance.update_discrete_states()?;
        for flag in flags {
            *place(flag, "result of fmi3UpdateDiscreteStates")? = 0;
        }
        (*values_changed, *next_time) = (Boolean::from(outcome.states_changed), 0.0);
        Ok(())
    };
    fn fmi3CompletedIntegratorStep(
        _never_back: Boolean, enter_event_mode: *mut Boolean, terminate: *mut Boolean
    ) |instance| {
        let (event, terminate) = (place(enter_event_mode, "enterEventMode")?, place(terminate, "terminateSimulation")?);
        (*event, *terminate) = (Boolean::from(instance.completed_step()?), 0);
        Ok(())
    };
    fn fmi3GetNumberOfContinuousStates(count: *mut usize) |instance| {
        *place(count, "nContinuousStates")? = instance.unit.variables.nominals.len();
        Ok(())
    };
    fn fmi3GetNumberOfEventIndicators(count: *mut usize) |_instance| {
        *place(count, "nEventIndicators")? = 0;
        Ok(())
    };

    fn fmi3DoStep(
        from: f64, length: f64, _never_back: Boolean, event_needed: *mut Boolean, terminate: *mut Boolean,
        early_return: *mut Boolean, last_time: *mut f64
    ) |instance| {
        for flag in [event_needed, terminate, early_return] {
            *place(flag, "result of fmi3DoStep")? = 0;
        }
        let last_time = place(last_time, "lastSuccessfulTime")?;
        *last_time = instance.time;
        instance.do_step(from, length)?;
        *last_time = instance.time;
        Ok(())
    };

    fn fmi3GetNumberOfVariableDependencies(_variable: u32, _count: *mut usize)
        |_instance| absent(FUNCTION, DO_WITHOUT);
    fn fmi3GetVariableDependencies(
        _dependent: u32, _elements: *mut usize, _independents: *mut u32, _of_independents: *mut usize,
        _kinds: *mut c_int, _count: usize
    ) |_instance| absent(FUNCTION, DO_WITHOUT);
    fn fmi3GetDirectionalDerivative(
        _unknowns: *const u32, _unknown_count: usize, _knowns: *const u32, _known_count: usize, _seed: *const f64,
        _seed_count: usize, _sensitivity: *mut f64, _sensitivity_count: usize
    ) |_instance| absent(FUNCTION, DO_WITHOUT);
    fn fmi3GetAdjointDerivative(
        _unknowns: *const u32, _unknown_count: usize, _knowns: *const u32, _known_count: usize, _seed: *const f64,
        _seed_count: usize, _sensitivity: *mut f64, _sensitivity_count: usize
    ) |_instance| absent(FUNCTION, DO_WITHOUT);
    fn fmi3EnterConfigurationMode() |_instance| absent(FUNCTION, DO_WITHOUT);
    fn fmi3ExitConfigurationMode() |_instance| absent(FUNCTION, DO_WITHOUT);
    fn fmi3EnterStepMode() |_instance| absent(FUNCTION, DO_WITHOUT);
    fn fmi3ActivateModelPartition(_clock: u32, _time: f64) |_instance| absent(FUNCTION, DO_WITHOUT);
    fn fmi3GetOutputDerivatives(
        _references: *const u32, count: usize, _orders: *const i32, _values: *mut f64, _value_count: usize
    ) |_instance| none(count, "derivative of an output");
    fn fmi3GetBinary(
        _references: *const u32, count: usize, _sizes: *mut usize, _values: *mut *const u8, _value_count: usize
    ) |_instance| none(count, "variable of type Binary");
    fn fmi3SetBinary(
        _references: *const u32, count: usize, _sizes: *const usize, _values: *const *const u8, _value_count: usize
    ) |_instance| none(count, "variable of type Binary");
    fn fmi3GetClock(_references: *const u32, count: usize, _values: *mut Boolean) |_instance| none(count, "clock");
    fn fmi3SetClock(_references: *const u32, count: usize, _values: *const Boolean) |_instance| none(count, "clock");
    fn fmi3GetIntervalDecimal(_references: *const u32, count: usize, _intervals: *mut f64, _kinds: *mut c_int)
        |_instance| none(count, "clock");
    fn fmi3SetIntervalDecimal(_references: *const u32, count: usize, _intervals: *const f64)
        |_instance| none(count, "clock");
    fn fmi3GetIntervalFraction(
        _references: *const u32, count: usize, _counters: *mut u64, _resolutions: *mut u64, _kinds: *mut c_int
    ) |_instance| none(count, "clock");
    fn fmi3SetIntervalFraction(
        _references: *const u32, count: usize, _counters: *const u64, _resolutions: *const u64
    ) |_instance| none(count, "clock");
    fn fmi3GetShiftDecimal(_references: *const u32, count: usize, _shifts: *mut f64) |_instance| none(count, "clock");
    fn fmi3SetShiftDecimal(_references: *const u32, count: usize, _shifts: *const f64) |_instance| none(count, "clock");
    fn fmi3GetShiftFraction(_references: *const u32, count: usize, _counters: *mut u64, _resolutions: *mut u64)
        |_instance| none(count, "clock");
    fn fmi3SetShiftFraction(_references: *const u32, count: usize, _counters: *const u64, _resolutions: *const u64)
        |_instance| none(count, "clock");
}

/// Types without variables.
macro_rules! no_variables {
    ($($get:ident, $set:ident: $type:ty, $what:literal;)*) => {
        calls! {$(
            fn $get(_references: *const u32, count: usize, _values: *mut $type, _value_count: usize)
                |_instance| none(count, $what);
            fn $set(_references: *const u32, count: usize, _values: *const $type, _value_count: usize)
                |_instance| none(count, $what);
        )*}
    };
}

no_variables! {
    fmi3GetFloat32, fmi3SetFloat32: f32, "variable of type Float32";
    fmi3GetInt8, fmi3SetInt8: i8, "variable of type Int8";
    fmi3GetUInt8, fmi3SetUInt8: u8, "variable of type UInt8";
    fmi3GetInt16, fmi3SetInt16: i16, "variable of type Int16";
    fmi3GetUInt16, fmi3SetUInt16: u16, "variable of type UInt16";
    fmi3GetInt32, fmi3SetInt32: i32, "variable of type Int32";
    fmi3GetUInt32, fmi3SetUInt32: u32, "variable of type UInt32";
    fmi3GetInt64, fmi3SetInt64: i64, "variable of type Int64";
    fmi3GetUInt64, fmi3SetUInt64: u64, "variable of type UInt64";
    fmi3GetString, fmi3SetString: *const c_char, "variable of type String";
}

calls! {
    fn fmi3SetBoolean(_references: *const u32, count: usize, _values: *const Boolean, _value_count: usize)
        |_instance| none(count, "Boolean that can be set");
}

fn same_count(references: usize, values: usize) -> Result<(), Refusal> {
    if references == values {
        return Ok(());
    }
    Err(Refusal::error(format!(
        "{references} value references and {values} values; all variables are scalars: give as many of both"
    )))
}
