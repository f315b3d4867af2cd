//! Version of the library, and the check that the header fits it.

pub use crate::abi::PONG_ABI_VERSION;
use crate::abi::fits;
use crate::failure::Failure;
use crate::guard::guarded;
use crate::layout::layout_hash;
use crate::status::pong_status;
use std::ffi::c_char;

const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");

/// Version of the library, "major.minor.patch". Lives as long as the library.
#[unsafe(no_mangle)]
pub extern "C" fn pong_version_string() -> *const c_char {
    VERSION.as_ptr().cast()
}

/// PONG_ABI_VERSION of the library; compare it with that of your header, or use PONG_CHECK_ABI().
#[unsafe(no_mangle)]
pub extern "C" fn pong_abi_version() -> u32 {
    PONG_ABI_VERSION
}

/// Hash of the layout of every struct and of every status number in the library; compare it with
/// PONG_LAYOUT_HASH of the header.
#[unsafe(no_mangle)]
pub extern "C" fn pong_layout_hash() -> u64 {
    layout_hash()
}

/// Checks that header and library fit: call it first, as PONG_CHECK_ABI(). PONG_STATUS_CONFIG if they do not.
/// A header of an earlier release of the same ABI fits.
#[unsafe(no_mangle)]
pub extern "C" fn pong_check_abi(abi_version: u32, hash: u64) -> pong_status {
    guarded(|| {
        if fits(abi_version, hash, layout_hash()) {
            return Ok(());
        }
        let message = format!(
            "pong.h is of ABI {abi_version} with layout {hash:#x}, the library of ABI {PONG_ABI_VERSION} with layout \
             {:#x}; compile against the pong.h of version {}, or build the library from the files that the header came with",
            layout_hash(),
            env!("CARGO_PKG_VERSION")
        );
        Err(Failure::new(pong_status::Config, message))
    })
}
