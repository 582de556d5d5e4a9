//! Files of pictures and sounds.
use crate::error::{Access, Error, Result};
#[cfg(unix)]
use rustix::fs::OFlags;
use std::fs::{File, OpenOptions};
#[cfg(unix)]
use std::os::unix::fs::OpenOptionsExt;
use std::path::Path;

/// Opens a file to read it, and says how long it is. A directory cannot be read, a named pipe
/// would block us, and a device may have no end.
pub(crate) fn open_file(path: &Path, format: &'static str) -> Result<(File, u64)> {
    let cannot = |source| Error::Open { path: path.to_owned(), access: Access::Read, source };
    let mut options = OpenOptions::new();
    options.read(true);
    #[cfg(unix)]
    options.custom_flags(OFlags::NONBLOCK.bits().try_into().unwrap_or_default());
    let file = options.open(path).map_err(cannot)?;
    let metadata = file.metadata().map_err(cannot)?;
    if metadata.is_file() {
        Ok((file, metadata.len()))
    } else {
        let reason = "it is no regular file".to_owned();
        Err(Error::Format { path: path.to_owned(), format, reason })
    }
}
