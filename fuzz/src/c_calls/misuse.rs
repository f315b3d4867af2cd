//! Two threads on one world: one of them is refused, without other effects.

use super::session::{Session, Sure, check};
use super::set_up::COSTS_MAX;
use pong::contacts::pong_contact_count;
use pong::frames::{pong_commit, pong_evaluate, pong_step};
use pong::status::pong_status;
use pong::world::pong_world;
use pong::wrenches::{pong_get_wrench, pong_wrench};

/// A pointer shared with another thread.
#[derive(Clone, Copy)]
struct Shared(*mut pong_world);

// SAFETY: the library allows calls of one world from any thread, and refuses concurrent ones.
unsafe impl Send for Shared {}

/// Calls of each thread.
const CALLS: usize = 24;

impl Session<'_> {
    pub fn two_threads(&mut self) {
        let (world, known) = self.world();
        if self.costs >= COSTS_MAX || known == Sure::Wrong {
            return;
        }
        self.costs += 2;
        self.alone = false;
        let interface = self.host().and_then(|host| host.ids.interfaces.first().copied());
        let interface = interface.unwrap_or(pong::ids::pong_interface_id { bits: 0 });
        let shared = Shared(world);
        let calls = move || {
            let world = { shared }.0;
            for k in 0..CALLS {
                let mut wrench = pong_wrench { force: [0.0; 3], moment: [0.0; 3] };
                let mut count = 0;
                // SAFETY: the world lives until both threads are done; the output arguments are local to this
                // thread.
                let status = unsafe {
                    match k % 5 {
                        0 => pong_step(world),
                        1 => pong_evaluate(world),
                        2 => pong_get_wrench(world, interface, 0, &mut wrench),
                        3 => pong_contact_count(world, &mut count),
                        _ => pong_commit(world),
                    }
                };
                check("one of two threads", status, Sure::Unknown);
                crate::count::call(status == pong_status::Ok);
                assert!(wrench.force.iter().chain(&wrench.moment).all(|x| x.is_finite()), "{wrench:?}");
            }
        };
        std::thread::scope(|scope| {
            let other = scope.spawn(calls);
            calls();
            // Joins explicitly: the scope waits for the calls only, and the thread's last allocations would
            // look like a leak.
            other.join().expect("no panic");
        });
        if let Some(host) = self.host() {
            host.has_frame = false;
        }
    }
}
