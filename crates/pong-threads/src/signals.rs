//! Blocking of signals, so that threads of the library handle no signals of the host.

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

#[cfg(unix)]
struct Blocked {
    before: libc::sigset_t,
}

#[cfg(unix)]
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

#[cfg(unix)]
impl Drop for Blocked {
    fn drop(&mut self) {
        // SAFETY: restores the mask that the calling thread had before.
        unsafe {
            libc::pthread_sigmask(libc::SIG_SETMASK, &self.before, std::ptr::null_mut());
        }
    }
}

#[cfg(not(unix))]
struct Blocked;

#[cfg(not(unix))]
impl Blocked {
    fn all() -> Blocked {
        Blocked
    }
}
