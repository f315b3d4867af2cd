//! Laws by callback. Their results depend on the input and on the behaviour set by the sequence.

use pong::frames::pong_step;
use pong::law_types::{pong_friction_input, pong_friction_output, pong_normal_input};
use pong::status::pong_status;
use pong::world::pong_world;
use std::ffi::c_void;
use std::sync::atomic::{AtomicPtr, AtomicU8, Ordering};

/// Behaviour of the laws of a world.
pub struct Behaviour {
    kind: AtomicU8,
    world: AtomicPtr<pong_world>,
}

/// Number of behaviours; 0 is correct.
pub const KINDS: u8 = 7;
/// Behaviour that calls the same world from inside a law.
const CALLS_BACK: u8 = 4;

impl Behaviour {
    pub fn new(world: *mut pong_world) -> Self {
        Self { kind: AtomicU8::new(0), world: AtomicPtr::new(world) }
    }

    pub fn set(&self, kind: u8) {
        self.kind.store(kind % KINDS, Ordering::Relaxed);
    }

    /// True if the laws call their world back.
    pub fn calls_back(&self) -> bool {
        self.kind.load(Ordering::Relaxed) == CALLS_BACK
    }

    pub fn user(&self) -> *mut c_void {
        std::ptr::from_ref(self).cast_mut().cast()
    }

    /// The correct result, or a faulty one by behaviour.
    fn answer(&self, good: f64) -> f64 {
        match self.kind.load(Ordering::Relaxed) {
            1 => f64::NAN,
            2 => f64::INFINITY,
            3 => -good,
            CALLS_BACK => {
                // SAFETY: laws run while their world lives.
                let status = unsafe { pong_step(self.world.load(Ordering::Relaxed)) };
                assert_eq!(status, pong_status::Busy, "a call from inside a law");
                good
            }
            5 => f64::MAX,
            _ => good,
        }
    }
}

/// A spring.
pub unsafe extern "C" fn normal(input: *const pong_normal_input, user: *mut c_void) -> f64 {
    // SAFETY: the engine hands over an input, and the `user` pointer that it was given.
    let (input, behaviour) = unsafe { (&*input, &*user.cast::<Behaviour>()) };
    assert!(input.depth.is_finite() && input.depth_rate.is_finite() && input.depth >= 0.0, "{input:?}");
    assert!(input.parameter_count <= 2, "{input:?}");
    behaviour.answer(input.stiffness * input.depth)
}

/// Viscous friction that counts its calls.
pub unsafe extern "C" fn friction(
    input: *const pong_friction_input,
    state: *mut f64,
    output: *mut pong_friction_output,
    user: *mut c_void,
) {
    // SAFETY: as for `normal`; the state has the length that was registered, which is at least 1.
    let (input, behaviour, state, output) =
        unsafe { (&*input, &*user.cast::<Behaviour>(), &mut *state, &mut *output) };
    assert!(input.normal_force.is_finite() && input.slip_b.iter().all(|x| x.is_finite()), "{input:?}");
    *state += 1.0;
    output.force_b = input.slip_velocity_b.map(|v| -0.1 * v);
    output.force_b[0] = behaviour.answer(output.force_b[0]);
    if behaviour.kind.load(Ordering::Relaxed) == 6 {
        *state = f64::NAN;
    }
    output.sticks = input.stuck;
}
