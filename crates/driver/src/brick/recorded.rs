//! Files of pictures and sounds.
use crate::error::{Access, Error, Result};
use crate::files;
use std::fs::File;
use std::path::Path;

/// Opens a file to read it, and says how long it is. A directory cannot be read, a named pipe
/// would block us, and a device may have no end.
pub(crate) fn open_file(path: &Path, format: &'static str) -> Result<(File, u64)> {
    let (file, metadata) = files::open_file(path, Access::Read).map_err(|source| Error::Open {
        path: path.to_owned(),
        access: Access::Read,
        source,
    })?;
    if metadata.is_file() {
        Ok((file, metadata.len()))
    } else {
        let reason = "it is no regular file".to_owned();
        Err(Error::Format { path: path.to_owned(), format, reason })
    }
}
