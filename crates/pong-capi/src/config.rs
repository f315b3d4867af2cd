//! Settings of a world.

use crate::guard::{Failure, Outcome};
use crate::status::pong_status;
use crate::version::PONG_ABI_VERSION;
use pong_engine::Config;

/// Tells a configuration that pong_default_config() made from one that nobody filled in.
const COOKIE: u64 = 0x706f_6e67_2d63_6667;

/// Settings of a world. Make it with pong_default_config(), change what you like, hand it to
/// pong_create_world().
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_config {
    /// Set by pong_default_config(): size of this struct, bytes.
    pub struct_size: u32,
    /// Set by pong_default_config(): PONG_ABI_VERSION of the library.
    pub abi_version: u32,
    /// Set by pong_default_config(): checked by pong_create_world().
    pub cookie: u64,
    /// Most contacts of a frame; 0 takes the worst case of the scene, at most 65536. When a frame has more, the
    /// deepest are kept and the report has PONG_FLAG_CONTACT_LIMIT.
    pub contact_capacity: u64,
    /// 1 keeps energies for pong_get_ledger(); 0 (default) does not and costs nothing.
    pub keep_ledger: u32,
    /// Zero.
    pub reserved_u32: u32,
    /// Zero.
    pub reserved: [u64; 4],
}

/// The default settings.
#[unsafe(no_mangle)]
pub extern "C" fn pong_default_config() -> pong_config {
    pong_config {
        struct_size: size_of::<pong_config>() as u32,
        abi_version: PONG_ABI_VERSION,
        cookie: COOKIE,
        contact_capacity: 0,
        keep_ledger: 0,
        reserved_u32: 0,
        reserved: [0; 4],
    }
}

impl pong_config {
    /// The engine's settings, if the struct is one this library made.
    pub(crate) fn check(&self) -> Outcome<Config> {
        let expected = pong_default_config();
        let made_here = (self.cookie, self.struct_size, self.abi_version)
            == (expected.cookie, expected.struct_size, expected.abi_version);
        let known = self.reserved_u32 == 0 && self.reserved == [0; 4];
        if !made_here || !known {
            let cause = if made_here {
                "has values in its reserved fields"
            } else {
                "was not filled in by pong_default_config()"
            };
            let message = format!(
                "config: it {cause}; start from pong_default_config() and change only what is documented"
            );
            return Err(Failure::new(pong_status::Config, message));
        }
        let contact_capacity = match self.contact_capacity {
            0 => None,
            wanted => Some(usize::try_from(wanted).unwrap_or(usize::MAX)),
        };
        if contact_capacity.is_some_and(|wanted| wanted > MOST_CONTACTS) {
            let message = format!(
                "config: contact_capacity is {}; give at most {MOST_CONTACTS}, or 0 for the default",
                self.contact_capacity
            );
            return Err(Failure::new(pong_status::BadValue, message));
        }
        let ledger = match self.keep_ledger {
            0 => false,
            1 => true,
            other => {
                let message = format!("config: keep_ledger is {other}; give 0 or 1");
                return Err(Failure::new(pong_status::BadValue, message));
            }
        };
        Ok(Config { contact_capacity, ledger, workers: None })
    }
}

/// Beyond this a slip of the pen is likelier than a scene, and the memory could not be had.
const MOST_CONTACTS: usize = 1 << 24;
