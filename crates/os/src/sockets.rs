//! Names of local sockets.
use std::fs::File;
use std::io;
use std::os::fd::AsRawFd as _;
use std::path::Path;

/// The bytes of a path that fit into the address of a socket in each system: with a zero at their
/// end 108 in Linux, 104 in BSD.
const FITS: usize = 100;

/// Calls `act` with a path of the same file that fits into the address of a socket. A long one
/// goes by the folder's descriptor, as folders for temporary files may be deep.
///
/// # Errors
/// `act` fails, or the folder cannot be opened.
pub fn with_address<T>(path: &Path, act: impl FnOnce(&Path) -> io::Result<T>) -> io::Result<T> {
    match (path.parent(), path.file_name()) {
        (Some(folder), Some(name)) if path.as_os_str().len() > FITS => {
            let folder = File::open(folder)?;
            act(&Path::new("/proc/self/fd").join(folder.as_raw_fd().to_string()).join(name))
        }
        _ => act(path),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::net::{UnixListener, UnixStream};

    #[test]
    fn sockets_in_deep_folders_are_bound_and_reached() {
        let base = std::env::temp_dir().join(format!("ev3-os-{}", std::process::id()));
        let folder = base.join("deep".repeat(30));
        std::fs::create_dir_all(&folder).unwrap();
        for path in [base.join("socket"), folder.join("socket")] {
            let listener = with_address(&path, |path| UnixListener::bind(path)).unwrap();
            let stream = with_address(&path, |path| UnixStream::connect(path));
            assert!(stream.is_ok() && listener.accept().is_ok(), "{}", path.display());
        }
        let missing = with_address(&folder.join("none/socket"), |path| UnixStream::connect(path));
        assert_eq!(missing.unwrap_err().kind(), io::ErrorKind::NotFound);
        std::fs::remove_dir_all(base).unwrap();
    }
}
