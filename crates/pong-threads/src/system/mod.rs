//! Requests to the operating system, one file per system with the same functions: the cores of the
//! process, binding, priorities, signals. Time, files and threads themselves come from the standard library.
//! `docs/platforms.md` has the table.

mod grants;
#[cfg(unix)]
mod posix;

#[cfg_attr(target_os = "linux", path = "linux.rs")]
#[cfg_attr(target_os = "macos", path = "macos.rs")]
#[cfg_attr(windows, path = "windows.rs")]
#[cfg_attr(not(any(target_os = "linux", target_os = "macos", windows)), path = "other.rs")]
mod this;

pub use grants::Grants;
pub use this::{GRANTS, bind, cores, lower_priority, raise_priority, without_signals};

#[cfg(test)]
mod tests {
    use super::*;

    /// A platform that says that it cannot grant something refuses it, in the same words.
    #[test]
    fn what_is_not_granted_is_refused() {
        std::thread::spawn(|| {
            let core = cores().first().copied().unwrap_or_default();
            assert_eq!(bind(core).err().as_deref(), GRANTS.no_binding);
            if let Some(why) = GRANTS.no_fifo {
                assert_eq!(raise_priority(1), Err(why.to_owned()));
            }
            lower_priority();
        })
        .join()
        .unwrap();
    }

    #[test]
    fn a_core_that_does_not_exist_is_refused() {
        std::thread::spawn(|| assert!(bind(1 << 20).is_err())).join().unwrap();
    }
}
