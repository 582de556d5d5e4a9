//! The screen.
//!
//! Programs draw on a [`Frame`], which [`show`] then copies to the framebuffer in one go, so that
//! nobody sees half of it. The panel shows four shades of gray. ev3dev before 4.14.34 shows black
//! and white only: one bit for a pixel, 1 is black, the least significant bit is on the left. Since
//! then there are 32 bits for a pixel, XRGB.
pub mod frame;
pub mod picture;

use crate::brick::screen::frame::{Frame, HEIGHT, WIDTH};
use crate::brick::screen::picture::luma;
use crate::devfs::{Devfs, Stream, open};
use crate::device::read_file;
use crate::error::{Access, Error, Result};
use crate::sysfs::Sysfs;
use std::path::{Path, PathBuf};

/// Copies a frame to the screen; `None` if there is no screen of the EV3's.
/// Errors: the kernel's, as EACCES for a user who is not in the group `video`.
pub fn show(tree: &dyn Sysfs, dev: &dyn Devfs, frame: &Frame) -> Result<Option<()>> {
    let path = path(dev);
    let Some(stream) = open(dev, &path, Access::Write)? else {
        return Ok(None);
    };
    let Some(layout) = Layout::of(tree, &*stream) else {
        return Ok(None);
    };
    let bytes = layout.bytes(frame.shades());
    let mut rest = &*bytes;
    while !rest.is_empty() {
        let written = stream.write(rest).map_err(|source| Error::Write {
            path: path.clone(),
            text: format!("{} bytes", bytes.len()),
            source,
        })?;
        rest = rest.get(written.max(1)..).unwrap_or_default();
    }
    Ok(Some(()))
}

/// The picture on the screen, whichever program drew it: shades line by line, 0
/// is black. `None` if there is no screen of the EV3's.
/// Errors: the kernel's; [`Error::Malformed`] where it is cut short.
pub fn seen(tree: &dyn Sysfs, dev: &dyn Devfs) -> Result<Option<Vec<u8>>> {
    let path = path(dev);
    let Some(stream) = open(dev, &path, Access::Read)? else {
        return Ok(None);
    };
    let Some(layout) = Layout::of(tree, &*stream) else {
        return Ok(None);
    };
    let mut bytes = vec![0; layout.length()];
    let mut filled = 0;
    while let Some(rest) = bytes.get_mut(filled..).filter(|rest| !rest.is_empty()) {
        let read = stream.read(rest);
        match read.map_err(|source| Error::Read { path: path.clone(), source })? {
            0 => return Err(cut_short(&path)),
            length => filled += length,
        }
    }
    Ok(Some(layout.shades(&bytes)))
}

fn path(dev: &dyn Devfs) -> PathBuf {
    dev.root().join("fb0")
}

fn cut_short(path: &Path) -> Error {
    Error::Malformed {
        path: path.to_owned(),
        text: String::new(),
        expected: "as many bytes as the screen has",
    }
}

/// No line of such a screen has more bytes.
const MOST: usize = 4096;

/// How the framebuffer is laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Layout {
    /// One bit for a pixel, `line` bytes for a line.
    Bits { line: usize },
    /// Four bytes for a pixel: blue, green, red, nothing.
    Xrgb { line: usize },
}

impl Layout {
    const BITS: Self = Self::Bits { line: 24 };
    const XRGB: Self = Self::Xrgb { line: 712 };

    fn length(self) -> usize {
        let (Self::Bits { line } | Self::Xrgb { line }) = self;
        line * HEIGHT as usize
    }

    /// The layout by the attributes of the framebuffer; `None` if there are none, or
    /// if the screen is not the EV3's.
    fn told(tree: &dyn Sysfs) -> Option<Self> {
        let told = |name: &str| {
            let path = tree.root().join("graphics/fb0").join(name);
            read_file(tree, &path).ok()
        };
        let bits: u32 = told("bits_per_pixel")?.trim().parse().ok()?;
        let size = told("virtual_size")?;
        let (width, height) = size.trim().split_once(',')?;
        if (width.parse(), height.parse()) != (Ok(WIDTH), Ok(HEIGHT)) {
            return None;
        }
        let line: usize = told("stride")?.trim().parse().ok()?;
        let (least, layout) = match bits {
            1 => (WIDTH.div_ceil(8), Self::Bits { line }),
            32 => (WIDTH * 4, Self::Xrgb { line }),
            _ => return None,
        };
        (least as usize..=MOST).contains(&line).then_some(layout)
    }

    /// The layout by the number of bytes.
    fn of_length(length: u64) -> Option<Self> {
        [Self::BITS, Self::XRGB].into_iter().find(|layout| layout.length() as u64 == length)
    }

    /// The layout of an open screen. For a file, its length decides.
    fn of(tree: &dyn Sysfs, stream: &dyn Stream) -> Option<Self> {
        match stream.length() {
            Some(length) => Self::of_length(length),
            None => Self::told(tree),
        }
    }

    /// Shades, line by line, as the screen has them.
    fn bytes(self, shades: &[u8]) -> Vec<u8> {
        let mut bytes = vec![0; self.length()];
        let (Self::Bits { line } | Self::Xrgb { line }) = self;
        let lines = bytes.chunks_exact_mut(line.max(1)).zip(shades.chunks_exact(WIDTH as usize));
        for (bytes, shades) in lines {
            match self {
                Self::Bits { .. } => {
                    for (byte, eight) in bytes.iter_mut().zip(shades.chunks(8)) {
                        let dark = (0..).zip(eight).filter(|(_, shade)| **shade < 128);
                        *byte = dark.fold(0, |byte, (bit, _)| byte | (1 << bit));
                    }
                }
                Self::Xrgb { .. } => {
                    for (bytes, shade) in bytes.chunks_exact_mut(4).zip(shades) {
                        bytes.copy_from_slice(&[*shade, *shade, *shade, 0]);
                    }
                }
            }
        }
        bytes
    }

    /// Shades, line by line, from the bytes of the screen.
    fn shades(self, bytes: &[u8]) -> Vec<u8> {
        let (Self::Bits { line } | Self::Xrgb { line }) = self;
        let shades = bytes.chunks_exact(line.max(1)).flat_map(|bytes| {
            let shades: Vec<u8> = match self {
                Self::Bits { .. } => bytes
                    .iter()
                    .flat_map(|byte| {
                        (0..8).map(move |bit| if byte & (1 << bit) == 0 { 255 } else { 0 })
                    })
                    .collect(),
                Self::Xrgb { .. } => bytes
                    .chunks_exact(4)
                    .map(|pixel| match pixel {
                        [blue, green, red, _] => luma([*red, *green, *blue]),
                        _ => 0,
                    })
                    .collect(),
            };
            shades.into_iter().take(WIDTH as usize)
        });
        shades.collect()
    }
}
