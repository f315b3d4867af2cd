//! Reading and writing of files. Only regular files of limited size are read; files named by other files must
//! lie in folders that the caller allows. A file is replaced as a whole or not at all.

use std::fs::{File, OpenOptions};
use std::io::{Error, ErrorKind, Read, Result, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

/// Maximum length of a file: byte offsets have 32 bits.
const LONGEST: u64 = u32::MAX as u64;

/// Opens a regular file for reading. Others are refused: a pipe could block for ever, and a device could
/// deliver bytes without end.
///
/// # Errors
/// The error of the system, or that the file is not regular.
pub fn open(path: &Path) -> Result<File> {
    let regular =
        |is_file: bool| is_file.then_some(()).ok_or_else(|| Error::other("it is not a regular file"));
    // Checked before opening, because opening a device can have side effects, and again afterwards, because
    // the name may point elsewhere by then.
    regular(std::fs::metadata(path)?.is_file())?;
    let file = at_once(OpenOptions::new().read(true)).open(path)?;
    regular(file.metadata()?.is_file())?;
    Ok(file)
}

/// Makes opening a pipe return without waiting for its other end.
#[cfg(unix)]
fn at_once(options: &mut OpenOptions) -> &mut OpenOptions {
    std::os::unix::fs::OpenOptionsExt::custom_flags(options, libc::O_NONBLOCK)
}

#[cfg(not(unix))]
fn at_once(options: &mut OpenOptions) -> &mut OpenOptions {
    options
}

/// Reads the bytes of a regular file.
///
/// # Errors
/// As [`open`], or that the file is longer than 4 GiB.
pub fn read(path: &Path) -> Result<Vec<u8>> {
    let too_long = || Error::other("it is longer than 4 GiB");
    let file = open(path)?;
    if file.metadata()?.len() > LONGEST {
        return Err(too_long());
    }
    let mut bytes = Vec::new();
    // Reads one byte past the limit: the length reported by the file system may be wrong.
    let read = file.take(LONGEST + 1).read_to_end(&mut bytes)?;
    if read as u64 > LONGEST { Err(too_long()) } else { Ok(bytes) }
}

/// Reads the text of a regular file.
///
/// # Errors
/// As [`read`], or that the file is not UTF-8.
pub fn read_text(path: &Path) -> Result<String> {
    String::from_utf8(read(path)?).map_err(|_| Error::other("it is no UTF-8 text"))
}

/// Reads a file named by another file. After links and `..` are resolved, it must lie in one of the folders
/// or below.
///
/// # Errors
/// As [`read`], or that the file lies elsewhere; the message says where.
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

/// File that replaces the one in its place when it is [finished](Self::finish). Until then the old file stays
/// unchanged.
#[derive(Debug)]
pub struct NewFile {
    file: Option<File>,
    /// Temporary file; `None` if the bytes go directly to the final path.
    beside: Option<PathBuf>,
    place: PathBuf,
}

impl NewFile {
    /// Creates a file. A link is followed; a pipe or a device, such as /dev/stdout, is written directly.
    ///
    /// # Errors
    /// The error of the system for the file or its folder.
    pub fn create(path: &Path) -> Result<Self> {
        let there = std::fs::metadata(path).ok();
        if there.as_ref().is_some_and(std::fs::Metadata::is_dir) {
            return Err(ErrorKind::IsADirectory.into());
        }
        if there.as_ref().is_some_and(|there| !there.is_file()) {
            return Self::in_place(path);
        }
        let place = if there.is_some() { path.canonicalize()? } else { path.to_owned() };
        place.file_name().ok_or(ErrorKind::InvalidInput)?;
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        // A short name: one made from the file's own name might be too long.
        let beside = place.with_file_name(format!(".pong.{}.{number}.part", std::process::id()));
        let file = File::create(&beside)?;
        let new = Self { file: Some(file), beside: Some(beside), place };
        if let (Some(there), Some(file)) = (there, &new.file) {
            file.set_permissions(there.permissions())?;
        }
        Ok(new)
    }

    /// Creates a file whose first rows are useful before it is finished: if no file exists, it grows in its
    /// final place.
    ///
    /// # Errors
    /// As [`create`](Self::create).
    pub fn growing(path: &Path) -> Result<Self> {
        if path.exists() { Self::create(path) } else { Self::in_place(path) }
    }

    fn in_place(path: &Path) -> Result<Self> {
        let file = OpenOptions::new().write(true).create(true).truncate(true).open(path)?;
        Ok(Self { file: Some(file), beside: None, place: path.to_owned() })
    }

    /// Moves the file to its final path once its bytes are on the disk.
    ///
    /// # Errors
    /// The error of the system; the old file is unchanged.
    pub fn finish(mut self) -> Result<()> {
        let Some(beside) = &self.beside else { return Ok(()) };
        if let Some(file) = self.file.take() {
            file.sync_all()?;
        }
        std::fs::rename(beside, &self.place)?;
        self.beside = None;
        Ok(())
    }
}

impl Write for NewFile {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        self.file.as_mut().ok_or(ErrorKind::BrokenPipe)?.write(bytes)
    }

    fn flush(&mut self) -> Result<()> {
        Ok(())
    }
}

impl Drop for NewFile {
    fn drop(&mut self) {
        if let Some(beside) = &self.beside {
            let _ = std::fs::remove_file(beside);
        }
    }
}

/// Writes a file as a whole or not at all: the old file stays until the new one is complete.
///
/// # Errors
/// The error of the system.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<()> {
    let mut new = NewFile::create(path)?;
    new.write_all(bytes)?;
    new.finish()
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use super::*;

    fn scratch(test: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("pong_files_{test}_{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        folder
    }

    #[test]
    fn a_pipe_keeps_no_reader_waiting() {
        let folder = scratch("pipe");
        let pipe = folder.join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let told = read(&pipe).unwrap_err().to_string();
        assert!(told.contains("not a regular file"), "{told}");
        // A pipe that replaces the file between the check and the opening.
        assert!(at_once(OpenOptions::new().read(true)).open(&pipe).is_ok());
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_file_is_replaced_whole_or_stays() {
        let folder = scratch("replace");
        let (place, link) = (folder.join("page"), folder.join("link"));
        replace(&place, b"old").unwrap();
        symlink(&place, &link).unwrap();
        for begin in [NewFile::create, NewFile::growing] {
            let mut cut = begin(&place).unwrap();
            cut.write_all(b"ne").unwrap();
            drop(cut);
            assert_eq!(std::fs::read(&place).unwrap(), b"old");
        }
        replace(&link, b"new").unwrap();
        assert_eq!(std::fs::read(&place).unwrap(), b"new");
        assert!(link.is_symlink());
        replace(Path::new("/dev/null"), b"gone").unwrap();
        assert!(replace(&folder, b"").is_err() && replace(&folder.join("none/page"), b"").is_err());
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 2, "nothing is left beside");
        std::fs::remove_dir_all(&folder).unwrap();
    }
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
        // A folder whose name begins with the same letters is a different folder.
        assert!(read_below(&other.join("b"), [folder.join("oth").as_path()]).is_err());
        for name in ["/dev/zero", "/"] {
            let told = super::read(Path::new(name)).unwrap_err().to_string();
            assert!(told.contains("regular"), "{name}: {told}");
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
