//! Reading of files: regular ones, of a size that fits, and, where a file names others, below the folders that the caller
//! allows.

use std::fs::File;
use std::io::{Error, Read, Result};
use std::path::Path;

/// Longer files are refused: places in them are counted in 32 bits.
const LONGEST: u64 = u32::MAX as u64;

/// The bytes of a regular file. A pipe could keep the reader waiting for ever, a device could go on until memory ends.
///
/// # Errors
/// What the system says, or that the file is not regular, or longer than 4 GiB.
pub fn read(path: &Path) -> Result<Vec<u8>> {
    if !std::fs::metadata(path)?.is_file() {
        return Err(Error::other("it is not a regular file"));
    }
    let mut bytes = Vec::new();
    // One byte more tells a file that is too long, whatever its folder says of its length.
    let read = File::open(path)?.take(LONGEST + 1).read_to_end(&mut bytes)?;
    if read as u64 > LONGEST { Err(Error::other("it is longer than 4 GiB")) } else { Ok(bytes) }
}

/// The text of a regular file.
///
/// # Errors
/// As [`read`], and that it is no UTF-8.
pub fn read_text(path: &Path) -> Result<String> {
    String::from_utf8(read(path)?).map_err(|_| Error::other("it is no UTF-8 text"))
}

/// The bytes of a regular file that another file names, if links and `..` followed it lies in one of these folders or below.
///
/// # Errors
/// As [`read`], and that the file lies elsewhere: the message says where.
pub fn read_below<'f>(path: &Path, folders: impl IntoIterator<Item = &'f Path>) -> Result<Vec<u8>> {
    let real = path.canonicalize()?;
    let holds = |folder: &Path| {
        let folder = if folder == Path::new("") { Path::new(".") } else { folder };
        folder.canonicalize().is_ok_and(|folder| real.starts_with(folder))
    };
    if folders.into_iter().any(holds) {
        return read(&real);
    }
    Err(Error::new(std::io::ErrorKind::PermissionDenied, outside(&real)))
}

fn outside(real: &Path) -> String {
    format!("it lies at {}, outside the folder of the file that names it", real.display())
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    #[test]
    fn only_regular_files_below_the_allowed_folders_are_read() {
        let folder = std::env::temp_dir().join(format!("pong_files_{}", std::process::id()));
        let (own, other) = (folder.join("own"), folder.join("other"));
        std::fs::create_dir_all(own.join("deep")).unwrap();
        std::fs::create_dir_all(&other).unwrap();
        std::fs::write(own.join("deep/a"), "a").unwrap();
        std::fs::write(other.join("b"), "b").unwrap();
        symlink(other.join("b"), own.join("link")).unwrap();
        symlink(own.join("deep/a"), own.join("near")).unwrap();
        let read = |name: &str, folders: &[&Path]| read_below(&own.join(name), folders.iter().copied());
        assert_eq!(read("deep/a", &[&own]).unwrap(), b"a");
        assert_eq!(read("near", &[&own]).unwrap(), b"a");
        for name in ["link", "../other/b", "deep/../../other/b"] {
            let told = read(name, &[&own]).unwrap_err().to_string();
            assert!(told.contains("outside the folder"), "{name}: {told}");
            assert_eq!(read(name, &[&own, &other]).unwrap(), b"b", "{name}");
        }
        // A folder whose name begins alike is another one.
        assert!(read_below(&other.join("b"), [folder.join("oth").as_path()]).is_err());
        for name in ["/dev/zero", "/"] {
            let told = super::read(Path::new(name)).unwrap_err().to_string();
            assert!(told.contains("regular"), "{name}: {told}");
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
