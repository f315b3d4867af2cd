//! The shared library that goes into an FMU.

/// Its file name, as cargo builds it on this platform.
pub const LIBRARY_FILE: &str = if cfg!(windows) {
    "pong_fmu.dll"
} else if cfg!(target_os = "macos") {
    "libpong_fmu.dylib"
} else {
    "libpong_fmu.so"
};

/// Version mark contained in every library, for the check that program and library have the same version.
pub(crate) const MARK: &str =
    concat!("pong-fmu library of version ", env!("CARGO_PKG_VERSION"), ", contents of version 1");

/// Platform of a library, as the two versions of FMI name it.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Platform {
    /// Folder of FMI 2.0 (section 2.3); the standard has none for AArch64, and importers look for that of FMI 3.0.
    pub(crate) fmi2: &'static str,
    /// Folder of FMI 3.0 (section 2.5.1.4).
    pub(crate) fmi3: &'static str,
    /// Ending of the file's name.
    pub(crate) ending: &'static str,
}

const fn platform(fmi2: &'static str, fmi3: &'static str, ending: &'static str) -> Platform {
    Platform { fmi2, fmi3, ending }
}

static LINUX: [Platform; 2] =
    [platform("linux64", "x86_64-linux", "so"), platform("aarch64-linux", "aarch64-linux", "so")];
static WINDOWS: Platform = platform("win64", "x86_64-windows", "dll");
static MACOS: [Platform; 2] =
    [platform("darwin64", "x86_64-darwin", "dylib"), platform("aarch64-darwin", "aarch64-darwin", "dylib")];

/// Returns the platform that the header of a library names: ELF, PE or Mach-O.
fn platform_of(bytes: &[u8]) -> Option<&'static Platform> {
    let word =
        |place: usize| Some(u32::from_le_bytes(bytes.get(place..place.checked_add(4)?)?.try_into().ok()?));
    let half = |place: usize| word(place).map(|word| word as u16);
    if bytes.starts_with(b"\x7fELF\x02\x01") {
        return match half(18)? {
            62 => Some(&LINUX[0]),
            183 => Some(&LINUX[1]),
            _ => None,
        };
    }
    if bytes.starts_with(b"MZ") {
        let header = word(0x3c)? as usize;
        let is_x86_64 =
            word(header)? == u32::from_le_bytes(*b"PE\0\0") && half(header.checked_add(4)?)? == 0x8664;
        return is_x86_64.then_some(&WINDOWS);
    }
    match (word(0)?, word(4)?) {
        (0xfeed_facf, 0x0100_0007) => Some(&MACOS[0]),
        (0xfeed_facf, 0x0100_000c) => Some(&MACOS[1]),
        _ => None,
    }
}

/// Checks that these bytes are a library for an FMU of this version.
///
/// # Errors
/// Cause and cure.
pub fn check_library(bytes: &[u8]) -> Result<(), String> {
    check(bytes).map(drop)
}

/// Checks a library and returns its platform.
pub(crate) fn check(bytes: &[u8]) -> Result<&'static Platform, String> {
    let platform = platform_of(bytes).ok_or(
        "it is no shared library for Linux or macOS on x86-64 or AArch64, or for Windows on x86-64; build it there: cargo \
         build -p pong-fmu",
    )?;
    if !bytes.windows(MARK.len()).any(|window| window == MARK.as_bytes()) {
        return Err(format!(
            "it is no library for FMUs of version {}; build or install it together with this program",
            env!("CARGO_PKG_VERSION")
        ));
    }
    Ok(platform)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn elf(machine: u8) -> Vec<u8> {
        let mut library = b"\x7fELF\x02\x01".to_vec();
        library.resize(18, 0);
        library.extend([machine, 0, 0, 0]);
        library
    }

    fn windows(machine: u16) -> Vec<u8> {
        let mut library = b"MZ".to_vec();
        library.resize(0x3c, 0);
        library.extend(0x80_u32.to_le_bytes());
        library.resize(0x80, 0);
        library.extend(b"PE\0\0");
        library.extend(machine.to_le_bytes());
        library.extend([0; 2]);
        library
    }

    fn macos(processor: u32) -> Vec<u8> {
        [0xfeed_facf_u32, processor].map(u32::to_le_bytes).concat()
    }

    #[test]
    fn only_libraries_of_this_version_are_taken() {
        let mut library = elf(62);
        assert!(check_library(&library).unwrap_err().contains("no library for FMUs of version"));
        library.extend(MARK.as_bytes());
        assert_eq!(check_library(&library), Ok(()));
    }

    /// Numbers of the machines are those of the formats: ELF `e_machine`, PE `Machine`, Mach-O `cputype`.
    #[test]
    fn a_library_goes_into_the_folder_of_its_platform() {
        for (library, fmi2, fmi3, ending) in [
            (elf(62), "linux64", "x86_64-linux", "so"),
            (elf(183), "aarch64-linux", "aarch64-linux", "so"),
            (windows(0x8664), "win64", "x86_64-windows", "dll"),
            (macos(0x0100_0007), "darwin64", "x86_64-darwin", "dylib"),
            (macos(0x0100_000c), "aarch64-darwin", "aarch64-darwin", "dylib"),
        ] {
            assert_eq!(check(&[&library, MARK.as_bytes()].concat()), Ok(&platform(fmi2, fmi3, ending)));
        }
    }

    #[test]
    fn what_is_no_library_of_a_known_platform_is_refused() {
        let cut = windows(0x8664)[..0x82].to_vec();
        let far = [windows(0x8664)[..0x3c].to_vec(), vec![0xff; 4]].concat();
        for bytes in
            [elf(243), windows(0x14c), macos(7), cut, far, b"MZ".to_vec(), b"!<arch>\n".to_vec(), vec![]]
        {
            assert!(check(&bytes).unwrap_err().contains("no shared library for"), "{bytes:?}");
        }
    }
}
