//! Calls that POSIX systems share: priorities and signals.

/// Sets the scheduling of the calling thread, by POSIX rather than by the kernel's own call, which musl does not have.
fn schedule(policy: libc::c_int, priority: libc::c_int) -> Result<(), String> {
    // SAFETY: an all-zero sched_param is valid on every system that has one, and the call reads it only.
    let refusal = unsafe {
        let mut parameters: libc::sched_param = std::mem::zeroed();
        parameters.sched_priority = priority;
        libc::pthread_setschedparam(libc::pthread_self(), policy, &parameters)
    };
    match refusal {
        0 => Ok(()),
        number => Err(std::io::Error::from_raw_os_error(number).to_string()),
    }
}

/// Asks for SCHED_FIFO with this priority for the calling thread.
pub fn raise_priority(priority: u8) -> Result<(), String> {
    schedule(libc::SCHED_FIFO, priority.into())
}

/// Gives the calling thread normal priority: a new thread inherits the priority of its creator. If the system refuses,
/// the thread keeps its priority.
pub fn lower_priority() {
    #[cfg(target_os = "linux")]
    let usual = 0;
    // The middle of what SCHED_OTHER has there; 0 would be the lowest.
    #[cfg(not(target_os = "linux"))]
    let usual = 31;
    let _ = schedule(libc::SCHED_OTHER, usual);
}

/// Runs `start` with signals blocked, so that the threads it creates handle none; the host's threads do. A
/// new thread inherits the signal mask, so no signal reaches it even at its start. The caller's mask is
/// restored afterwards.
///
/// Signals for a thread's own fault (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS) stay unblocked. No
/// other thread could take them. If the host's contact law crashes on a worker, the host's handler should see
/// it.
pub fn without_signals<T>(start: impl FnOnce() -> T) -> T {
    let _blocked = Blocked::all();
    start()
}

struct Blocked {
    before: libc::sigset_t,
}

impl Blocked {
    const OWN_FAULTS: [libc::c_int; 6] =
        [libc::SIGSEGV, libc::SIGBUS, libc::SIGFPE, libc::SIGILL, libc::SIGTRAP, libc::SIGSYS];

    fn all() -> Blocked {
        // SAFETY: an all-zero sigset_t is valid, the calls access only the two sets, and they cannot fail
        // with these arguments.
        unsafe {
            let (mut all, mut before): (libc::sigset_t, libc::sigset_t) = std::mem::zeroed();
            libc::sigfillset(&mut all);
            for signal in Self::OWN_FAULTS {
                libc::sigdelset(&mut all, signal);
            }
            libc::pthread_sigmask(libc::SIG_BLOCK, &all, &mut before);
            Blocked { before }
        }
    }
}

impl Drop for Blocked {
    fn drop(&mut self) {
        // SAFETY: restores the mask that the calling thread had before.
        unsafe {
            libc::pthread_sigmask(libc::SIG_SETMASK, &self.before, std::ptr::null_mut());
        }
    }
}
