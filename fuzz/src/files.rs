//! A folder of this process for targets that need files, removed when the program ends.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

static FOLDER: OnceLock<PathBuf> = OnceLock::new();

/// The folder; in memory where the system has such a file system.
pub fn folder() -> &'static Path {
    FOLDER.get_or_init(|| {
        let memory = Path::new("/dev/shm");
        let base = if memory.is_dir() { memory.to_owned() } else { std::env::temp_dir() };
        let folder = base.join(format!("pong-fuzz-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder for the files of the targets");
        // SAFETY: the function takes nothing and does not unwind.
        unsafe { libc::atexit(remove) };
        folder
    })
}

/// Writes a file in that folder and returns its path.
pub fn write(name: &str, bytes: &[u8]) -> PathBuf {
    let path = folder().join(name);
    std::fs::write(&path, bytes).expect("a file of the targets");
    path
}

extern "C" fn remove() {
    if let Some(folder) = FOLDER.get() {
        let _ = std::fs::remove_dir_all(folder);
    }
}
