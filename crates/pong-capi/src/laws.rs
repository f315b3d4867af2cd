//! Registration of force laws by callback.

use crate::failure::{Failure, Outcome};
use crate::guard::setting_up;
use crate::handle::{Inner, pong_world};
use crate::law_adapters::{Callback, FrictionCallback, NormalCallback, User};
use crate::law_types::{pong_friction_law, pong_normal_law};
use crate::pointers::text;
use crate::status::pong_status;
use std::ffi::{c_char, c_void};

/// Adds a normal force law that models then name as Custom(name: "...", parameters: [...]). Before sealing.
///
/// `force` returns the force of a whole contact in N (negative counts as 0), `stored` the energy stored at this
/// depth in J; with NULL for `stored` none is stored, and the ledger takes all of it as dissipated. Both must
/// be pure (same input, same answer) and may be called from any thread and from several at once; they must not
/// throw, jump out or call this world. `user` is passed to them unchanged and must live as long as the world.
/// PONG_STATUS_DUPLICATE: there is a normal law of this name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_register_normal_law(
    world: *mut pong_world,
    name: *const c_char,
    force: pong_normal_law,
    stored: pong_normal_law,
    user: *mut c_void,
) -> pong_status {
    setting_up(world, |inner| {
        let name = text(name, "name")?;
        let force = force.ok_or_else(|| no_function("force"))?;
        inner.check_new_law(name, |known| matches!(known, Callback::Normal { name: n, .. } if n == name))?;
        let fault = inner.law_faults.watch(name);
        let law = NormalCallback { force, stored, user: User(user), fault };
        inner.register(Callback::Normal { name: name.to_owned(), law })
    })
}

/// Adds a friction law that keeps `state_len` numbers per contact (at most 64) as contact state. The same rules
/// as for pong_register_normal_law().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_register_friction_law(
    world: *mut pong_world,
    name: *const c_char,
    state_len: usize,
    law: pong_friction_law,
    user: *mut c_void,
) -> pong_status {
    setting_up(world, |inner| {
        let name = text(name, "name")?;
        let evaluate = law.ok_or_else(|| no_function("law"))?;
        if state_len > MOST_NUMBERS {
            let message = format!(
                "law `{name}`: state_len is {state_len}; a law keeps at most {MOST_NUMBERS} numbers per contact"
            );
            return Err(Failure::new(pong_status::BadValue, message));
        }
        inner
            .check_new_law(name, |known| matches!(known, Callback::Friction { name: n, .. } if n == name))?;
        let fault = inner.law_faults.watch(name);
        let law = FrictionCallback { evaluate, state_len, user: User(user), fault };
        inner.register(Callback::Friction { name: name.to_owned(), law })
    })
}

const MOST_NUMBERS: usize = 64;

fn no_function(name: &str) -> Failure {
    Failure::new(pong_status::NullArgument, format!("`{name}` is NULL; pass a function"))
}

impl Inner {
    /// Refuses a law after the seal, and one whose name is taken.
    fn check_new_law(&mut self, name: &str, is_same: impl Fn(&Callback) -> bool) -> Outcome {
        self.phase.set_up("register a law")?;
        if self.callbacks.iter().any(is_same) {
            let message = format!("law `{name}`: already there; use another name");
            return Err(Failure::new(pong_status::Duplicate, message));
        }
        Ok(())
    }

    fn register(&mut self, callback: Callback) -> Outcome {
        callback.add_to(self.phase.set_up("register a law")?.laws_mut());
        self.callbacks.push(callback);
        Ok(())
    }
}
