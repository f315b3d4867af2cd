//! C functions as laws of the engine.

use crate::failure::{Failure, Outcome};
use crate::law_types::{pong_friction_input, pong_friction_output, pong_normal_input, pong_normal_law};
use crate::status::pong_status;
use pong_engine::{FrictionForce, FrictionInput, FrictionOutput, Laws, NormalForce, NormalInput};
use pong_fpenv::lent;
use pong_geometry::Vec3;
use std::ffi::c_void;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The caller's pointer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct User(pub *mut c_void);

// SAFETY: the pointer is only handed back to the caller's functions, which may be called from any thread by the
// contract of `pong_register_normal_law`.
unsafe impl Send for User {}
// SAFETY: as above; also from several threads at once.
unsafe impl Sync for User {}

/// Flag that is set when a law returns a number that is not finite.
#[derive(Clone, Debug, Default)]
pub(crate) struct Fault(Arc<AtomicBool>);

impl Fault {
    /// Returns the number, or zero and sets the flag if it is not finite.
    fn finite(&self, value: f64) -> f64 {
        if value.is_finite() {
            return value;
        }
        self.0.store(true, Ordering::Relaxed);
        0.0
    }
}

/// The faults of all laws of a world.
#[derive(Debug, Default)]
pub(crate) struct LawFaults {
    watched: Vec<(String, Fault)>,
    /// Index of the law that returned a number that is not finite in the last frame.
    failed: Option<usize>,
}

impl LawFaults {
    /// Adds a fault flag for a new law.
    pub fn watch(&mut self, name: &str) -> Fault {
        let fault = Fault::default();
        self.watched.push((name.to_owned(), fault.clone()));
        fault
    }

    /// Clones the laws for another world, with fault flags in `self`.
    pub fn watch_again(&mut self, callbacks: &[Callback]) -> (Vec<Callback>, Laws) {
        let (mut callbacks, mut laws) = (callbacks.to_vec(), Laws::default());
        for callback in &mut callbacks {
            match callback {
                Callback::Normal { name, law } => law.fault = self.watch(name),
                Callback::Friction { name, law } => law.fault = self.watch(name),
            }
            callback.add_to(&mut laws);
        }
        (callbacks, laws)
    }

    /// Notes which law failed in the last evaluation, and clears the flags.
    pub fn collect(&mut self) {
        self.failed = None;
        for (index, (_, fault)) in self.watched.iter().enumerate().rev() {
            if fault.0.swap(false, Ordering::Relaxed) {
                self.failed = Some(index);
            }
        }
    }

    /// Fails if a law returned a number that is not finite in the last frame.
    pub fn check(&self) -> Outcome {
        let Some(index) = self.failed else { return Ok(()) };
        let message = format!(
            "law `{}`: it returned a number that is not finite; the frame does not count: correct the law or the states \
             and evaluate again",
            self.watched[index].0
        );
        Err(Failure::new(pong_status::LawFailed, message))
    }
}

/// A law given by callback, as it was registered.
#[derive(Clone, Debug)]
pub(crate) enum Callback {
    Normal { name: String, law: NormalCallback },
    Friction { name: String, law: FrictionCallback },
}

impl Callback {
    /// Adds the law to the laws of a world.
    pub fn add_to(&self, laws: &mut Laws) {
        match self {
            Self::Normal { name, law } => laws.add_normal(name, Arc::new(law.clone())),
            Self::Friction { name, law } => laws.add_friction(name, Arc::new(law.clone())),
        }
    }
}

/// A normal force law given by callback.
#[derive(Clone, Debug)]
pub(crate) struct NormalCallback {
    pub force: unsafe extern "C" fn(*const pong_normal_input, *mut c_void) -> f64,
    pub stored: pong_normal_law,
    pub user: User,
    pub fault: Fault,
}

impl NormalForce for NormalCallback {
    fn force(&self, input: &NormalInput<'_>) -> f64 {
        // SAFETY: the function may be called by the contract of its registration; the input lives during the call.
        self.fault.finite(lent(|| unsafe { (self.force)(&c_input(input), self.user.0) }))
    }

    fn stored(&self, input: &NormalInput<'_>) -> f64 {
        let Some(stored) = self.stored else { return 0.0 };
        // SAFETY: as above.
        self.fault.finite(lent(|| unsafe { stored(&c_input(input), self.user.0) }))
    }
}

fn c_input(input: &NormalInput<'_>) -> pong_normal_input {
    pong_normal_input {
        depth: input.depth,
        depth_rate: input.rate,
        stiffness: input.stiffness,
        parameters: input.parameters.as_ptr(),
        parameter_count: input.parameters.len(),
    }
}

/// A friction law given by callback.
#[derive(Clone, Debug)]
pub(crate) struct FrictionCallback {
    pub evaluate:
        unsafe extern "C" fn(*const pong_friction_input, *mut f64, *mut pong_friction_output, *mut c_void),
    pub state_len: usize,
    pub user: User,
    pub fault: Fault,
}

impl FrictionForce for FrictionCallback {
    fn state_len(&self) -> usize {
        self.state_len
    }

    fn evaluate(&self, input: &FrictionInput<'_>, state: &mut [f64]) -> FrictionOutput {
        let c_input = pong_friction_input {
            normal_force: input.normal_force,
            normal_b: input.normal_b.into(),
            slip_b: input.slip_b.into(),
            slip_velocity_b: input.slip_velocity_b.into(),
            share: input.share,
            stiffness: input.stiffness,
            parameters: input.parameters.as_ptr(),
            parameter_count: input.parameters.len(),
            stuck: input.stuck.into(),
            reserved: 0,
        };
        let mut output = pong_friction_output::default();
        // SAFETY: the function may be called by the contract of its registration; all places live during the call and
        // `state` has `state_len` numbers.
        lent(|| unsafe { (self.evaluate)(&c_input, state.as_mut_ptr(), &mut output, self.user.0) });
        state.iter_mut().for_each(|number| *number = self.fault.finite(*number));
        FrictionOutput {
            force_b: Vec3::from(output.force_b.map(|component| self.fault.finite(component))),
            bristle_b: Vec3::zeros(),
            sticks: output.sticks != 0,
            stored: self.fault.finite(output.stored),
        }
    }
}
