//! ZIP files with the features that FMUs need: deflated, without dates, so that equal contents give equal
//! bytes.

use flate2::Compression;
use flate2::write::DeflateEncoder;
use std::io::Write;

/// 1980-01-01, the first date of the format.
const DATE: u16 = 0x0021;
const DEFLATED: u16 = 8;
/// Version 2.0: folders and deflated files.
const VERSION: u16 = 20;
/// Flag of UTF-8 names.
const UTF_8: u16 = 1 << 11;
/// Host system Unix, with permissions in the upper half of the external attributes.
const UNIX: u16 = 3 << 8;

/// A ZIP file being written.
#[derive(Default)]
pub(crate) struct Zip {
    bytes: Vec<u8>,
    directory: Vec<u8>,
    entries: u16,
}

impl Zip {
    /// Adds a file. Its name has slashes and does not begin with one.
    ///
    /// # Errors
    /// Beyond the limits of the format: a file or a sum of files over 4 GiB, or more than 65,535 of them.
    pub fn add(&mut self, name: &str, content: &[u8], is_executable: bool) -> Result<(), String> {
        let packed = deflated(content);
        let mut crc = flate2::Crc::new();
        crc.update(content);
        let size = |size: usize| {
            u32::try_from(size)
                .map_err(|_| format!("{name}: an FMU holds at most 4 GiB; leave out large meshes"))
        };
        let (at, packed_len, len) = (size(self.bytes.len())?, size(packed.len())?, size(content.len())?);
        self.entries =
            self.entries.checked_add(1).ok_or(format!("{name}: an FMU holds at most 65,535 files"))?;
        // Common fields of the entry and the central directory.
        let mut common = Vec::new();
        for value in [VERSION, UTF_8, DEFLATED, 0, DATE] {
            common.extend(value.to_le_bytes());
        }
        for value in [crc.sum(), packed_len, len] {
            common.extend(value.to_le_bytes());
        }
        common.extend((name.len() as u16).to_le_bytes());
        common.extend(0_u16.to_le_bytes());
        self.bytes.extend(0x0403_4b50_u32.to_le_bytes());
        self.bytes.extend(&common);
        self.bytes.extend(name.as_bytes());
        self.bytes.extend(packed);
        self.directory.extend(0x0201_4b50_u32.to_le_bytes());
        self.directory.extend((UNIX | VERSION).to_le_bytes());
        self.directory.extend(common);
        // No comment, first disk, no internal attributes.
        self.directory.extend([0; 6]);
        let mode: u32 = if is_executable { 0o100_755 } else { 0o100_644 };
        self.directory.extend((mode << 16).to_le_bytes());
        self.directory.extend(at.to_le_bytes());
        self.directory.extend(name.as_bytes());
        Ok(())
    }

    /// Returns the complete file.
    pub fn finish(mut self) -> Result<Vec<u8>, String> {
        let sizes = [self.directory.len(), self.bytes.len()].map(u32::try_from);
        let [Ok(directory), Ok(at)] = sizes else {
            return Err("an FMU holds at most 4 GiB; leave out large meshes".to_owned());
        };
        self.bytes.extend(&self.directory);
        self.bytes.extend(0x0605_4b50_u32.to_le_bytes());
        self.bytes.extend([0; 4]);
        self.bytes.extend(self.entries.to_le_bytes());
        self.bytes.extend(self.entries.to_le_bytes());
        self.bytes.extend(directory.to_le_bytes());
        self.bytes.extend(at.to_le_bytes());
        self.bytes.extend([0; 2]);
        Ok(self.bytes)
    }
}

fn deflated(content: &[u8]) -> Vec<u8> {
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(content).expect("a vector takes all bytes");
    encoder.finish().expect("a vector takes all bytes")
}
