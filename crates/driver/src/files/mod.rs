//! Trees of real files, and of none where there is no operating system.
#[cfg(unix)]
mod devfs;
#[cfg(not(unix))]
mod none;
#[cfg(unix)]
mod sysfs;

#[cfg(unix)]
pub use devfs::DevfsDir;
#[cfg(not(unix))]
pub use none::{DevfsDir, SysfsDir};
#[cfg(unix)]
pub use sysfs::SysfsDir;
