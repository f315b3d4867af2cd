//! Number of the binary interface, and the headers that fit this library (docs/c_api.md, The binary
//! interface).

/// Number of the binary interface: the N of libpong.so.N.
pub const PONG_ABI_VERSION: u32 = 1;

/// PONG_LAYOUT_HASH of the headers of earlier releases of this ABI. A release only adds structs and status
/// numbers, which changes its hash; those of earlier headers keep their layouts and values here. There is no
/// earlier release.
const EARLIER_LAYOUTS: &[u64] = &[];

/// True if a program compiled with a header of this number and hash can call a library of layout `own`.
pub fn fits(abi_version: u32, hash: u64, own: u64) -> bool {
    fits_one_of(abi_version, hash, own, EARLIER_LAYOUTS)
}

fn fits_one_of(abi_version: u32, hash: u64, own: u64, earlier: &[u64]) -> bool {
    abi_version == PONG_ABI_VERSION && (hash == own || earlier.contains(&hash))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_of_earlier_releases_fit_and_later_ones_do_not() {
        let (own, earlier, later) = (3, [1, 2], 4);
        let fits = |abi_version, hash| fits_one_of(abi_version, hash, own, &earlier);
        assert!(fits(PONG_ABI_VERSION, own));
        assert!(earlier.iter().all(|hash| fits(PONG_ABI_VERSION, *hash)));
        assert!(!fits(PONG_ABI_VERSION, later));
        assert!(!fits(PONG_ABI_VERSION - 1, own) && !fits(PONG_ABI_VERSION + 1, own));
    }
}
