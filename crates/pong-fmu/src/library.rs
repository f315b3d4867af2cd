//! The shared library that goes into an FMU.

/// Its file name, as cargo builds it.
pub const LIBRARY_FILE: &str = "libpong_fmu.so";

/// Version mark contained in every library, for the check that program and library have the same version.
pub(crate) const MARK: &str =
    concat!("pong-fmu library of version ", env!("CARGO_PKG_VERSION"), ", contents of version 1");

/// `e_machine` of x86-64.
const X86_64: u8 = 62;

/// Checks that these bytes are a library for an FMU of this version.
///
/// # Errors
/// Cause and cure.
pub fn check_library(bytes: &[u8]) -> Result<(), String> {
    let is_elf = bytes.starts_with(b"\x7fELF\x02\x01");
    if !is_elf || bytes.get(18..20) != Some(&[X86_64, 0]) {
        return Err(
            "it is no shared library for Linux on x86-64; build it there: cargo build -p pong-fmu".to_owned()
        );
    }
    if !bytes.windows(MARK.len()).any(|window| window == MARK.as_bytes()) {
        return Err(format!(
            "it is no library for FMUs of version {}; build or install it together with this program",
            env!("CARGO_PKG_VERSION")
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_libraries_of_this_version_are_taken() {
        let mut library = b"\x7fELF\x02\x01".to_vec();
        library.resize(18, 0);
        library.extend([X86_64, 0]);
        assert!(check_library(&library).unwrap_err().contains("no library for FMUs of version"));
        library.extend(MARK.as_bytes());
        assert_eq!(check_library(&library), Ok(()));
        library[18] = 183;
        assert!(check_library(&library).unwrap_err().contains("x86-64"));
        assert!(check_library(b"MZ").is_err());
    }
}
