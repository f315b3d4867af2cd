//! Reading of files: regular ones, of a size that fits, and, where a file names others, below the folders that the caller
//! allows. Writing of files: whole in their place, or not at all.

use std::fs::{File, OpenOptions};
use std::io::{Error, ErrorKind, Read, Result, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

/// Longer files are refused: places in them are counted in 32 bits.
const LONGEST: u64 = u32::MAX as u64;

/// A regular file, open for reading. A pipe could keep the reader waiting for ever, a device could go on until memory ends.
///
/// # Errors
/// What the system says, or that the file is not regular.
pub fn open(path: &Path) -> Result<File> {
    let regular =
        |is_file: bool| is_file.then_some(()).ok_or_else(|| Error::other("it is not a regular file"));
    // Before it is opened, because opening alone can move a device; and after, because the name can lead elsewhere by then.
    regular(std::fs::metadata(path)?.is_file())?;
    let file = at_once(OpenOptions::new().read(true)).open(path)?;
    regular(file.metadata()?.is_file())?;
    Ok(file)
}

/// Opens a pipe without waiting for its other end.
#[cfg(unix)]
fn at_once(options: &mut OpenOptions) -> &mut OpenOptions {
    std::os::unix::fs::OpenOptionsExt::custom_flags(options, libc::O_NONBLOCK)
}

#[cfg(not(unix))]
fn at_once(options: &mut OpenOptions) -> &mut OpenOptions {
    options
}

/// The bytes of a regular file.
///
/// # Errors
/// As [`open`], and that the file is longer than 4 GiB.
pub fn read(path: &Path) -> Result<Vec<u8>> {
    let too_long = || Error::other("it is longer than 4 GiB");
    let file = open(path)?;
    if file.metadata()?.len() > LONGEST {
        return Err(too_long());
    }
    let mut bytes = Vec::new();
    // One byte more tells a file that is too long, whatever its folder says of its length.
    let read = file.take(LONGEST + 1).read_to_end(&mut bytes)?;
    if read as u64 > LONGEST { Err(too_long()) } else { Ok(bytes) }
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

/// A file that takes its place whole when it is [finished](Self::finish). Until then, and if it never is, whatever was there
/// stays as it was.
#[derive(Debug)]
pub struct NewFile {
    file: Option<File>,
    /// Where the bytes are until the file is whole; `None` if they go straight into their place.
    beside: Option<PathBuf>,
    place: PathBuf,
}

impl NewFile {
    /// Begins a file. A link is followed; a pipe or a device, such as /dev/stdout, is written as it is.
    ///
    /// # Errors
    /// What the system says of the place or of its folder.
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
        // Short, because a name that fits may have no room for more.
        let beside = place.with_file_name(format!(".pong.{}.{number}.part", std::process::id()));
        let file = File::create(&beside)?;
        let new = Self { file: Some(file), beside: Some(beside), place };
        if let (Some(there), Some(file)) = (there, &new.file) {
            file.set_permissions(there.permissions())?;
        }
        Ok(new)
    }

    /// Begins a file whose first rows are of use: where nothing is there that could be lost, it grows in its place.
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

    /// Puts the file into its place, once its bytes are on the disk.
    ///
    /// # Errors
    /// What the system says; what was there before stays.
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

/// Writes a file that is there whole or not at all: what was there stays until the new one is complete.
///
/// # Errors
/// What the system says.
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
        // A pipe that takes the place of a file between the question and the answer.
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
        // A folder whose name begins alike is another one.
        assert!(read_below(&other.join("b"), [folder.join("oth").as_path()]).is_err());
        for name in ["/dev/zero", "/"] {
            let told = super::read(Path::new(name)).unwrap_err().to_string();
            assert!(told.contains("regular"), "{name}: {told}");
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
