//! The functions that both versions of the standard have, each under its name there.

#![allow(non_snake_case, reason = "the standard names them")]

use super::component::{call, state};
use super::logger::Status;
use super::pointers::{place, slice, slice_mut};
use crate::instance::Instance;
use crate::refusal::Refusal;
use std::ffi::c_void;

calls! {
    fn fmi2ExitInitializationMode, fmi3ExitInitializationMode() |instance| instance.exit_initialization();
    fn fmi2Terminate, fmi3Terminate() |instance| instance.terminate();
    fn fmi2Reset, fmi3Reset() |instance| instance.reset();
    fn fmi2GetFMUstate, fmi3GetFMUState(saved: *mut *mut c_void) |instance| state::get(instance, saved);
    fn fmi2SetFMUstate, fmi3SetFMUState(saved: *mut c_void) |instance| instance.restore(state::bytes(saved)?);
    fn fmi2FreeFMUstate, fmi3FreeFMUState(saved: *mut *mut c_void) |_instance| state::free(saved);
    fn fmi2SerializedFMUstateSize, fmi3SerializedFMUStateSize(saved: *mut c_void, size: *mut usize) |_instance| {
        *place(size, "size")? = state::bytes(saved)?.len();
        Ok(())
    };
    fn fmi2SerializeFMUstate, fmi3SerializeFMUState(saved: *mut c_void, bytes: *mut u8, size: usize)
        |_instance| state::serialize(saved, bytes, size);
    fn fmi2DeSerializeFMUstate, fmi3DeserializeFMUState(bytes: *const u8, size: usize, saved: *mut *mut c_void)
        |instance| state::deserialize(instance, bytes, size, saved);
    fn fmi2EnterEventMode, fmi3EnterEventMode() |instance| instance.enter_event_mode();
    fn fmi2EnterContinuousTimeMode, fmi3EnterContinuousTimeMode() |instance| instance.enter_continuous_mode();
    fn fmi2SetTime, fmi3SetTime(time: f64) |instance| instance.set_time(time);
    fn fmi2SetContinuousStates, fmi3SetContinuousStates(states: *const f64, count: usize)
        |instance| instance.set_states(slice(states, count, "states")?);
    fn fmi2GetContinuousStates, fmi3GetContinuousStates(states: *mut f64, count: usize) |instance| {
        instance.check_count(FUNCTION, count)?;
        slice_mut(states, count, "states")?.copy_from_slice(instance.states()?);
        Ok(())
    };
    fn fmi2GetDerivatives, fmi3GetContinuousStateDerivatives(rates: *mut f64, count: usize) |instance| {
        instance.check_count(FUNCTION, count)?;
        slice_mut(rates, count, "derivatives")?.copy_from_slice(instance.rates()?);
        Ok(())
    };
    fn fmi2GetNominalsOfContinuousStates, fmi3GetNominalsOfContinuousStates(nominals: *mut f64, count: usize) |instance| {
        instance.check_count(FUNCTION, count)?;
        slice_mut(nominals, count, "nominal values")?.copy_from_slice(&instance.unit.variables.nominals);
        Ok(())
    };
    fn fmi2GetEventIndicators, fmi3GetEventIndicators(_indicators: *mut f64, count: usize) |_instance| none(count, "event indicator");
}

/// Reads or writes no variables, for types without variables; refuses any other count.
pub(super) fn none(count: usize, what: &str) -> Result<(), Refusal> {
    if count == 0 {
        return Ok(());
    }
    Err(Refusal::error(format!("{what}: the unit has none; take the variables of modelDescription.xml")))
}

/// Refuses a function that the model description declares absent.
pub(super) fn absent(function: &str, cure: &str) -> Result<(), Refusal> {
    Err(Refusal::error(format!(
        "{function}: the unit does not have it, as modelDescription.xml says; {cure}"
    )))
}
