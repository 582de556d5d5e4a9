//! Trees of real files, and of none if there is no operating system.
#[cfg(unix)]
mod devfs;
#[cfg(not(unix))]
mod none;
#[cfg(unix)]
mod sysfs;

#[cfg(unix)]
pub use devfs::DevfsDir;
#[cfg(not(unix))]
pub(crate) use none::open_file;
#[cfg(not(unix))]
pub use none::{NoFiles as DevfsDir, NoFiles as SysfsDir};
#[cfg(unix)]
pub use sysfs::SysfsDir;
#[cfg(unix)]
pub(crate) use sysfs::open_file;
