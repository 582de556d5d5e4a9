//! Pictures in files: PNG and PBM are read, PNG is written.
use crate::brick::recorded::open_file;
use crate::error::{Access, Error, Result};
use std::io::Read;
use std::path::Path;

/// No picture for this screen is wider or higher.
const MOST: u32 = 4096;
/// No file of such a picture is longer, even if nothing in it is packed.
const MOST_BYTES: u64 = 1 << 27;

/// A picture: shades of gray, some of which may be missing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    width: u32,
    /// 0 is black; `None` where one sees through it.
    shades: Vec<Option<u8>>,
}

impl Picture {
    /// Reads a PNG or a PBM file. Colors become shades of gray; what is more
    /// than half transparent is left out.
    /// Errors: [`Error::Open`]; [`Error::Format`] for what is no such file, as an interlaced PNG.
    pub fn read(path: &Path) -> Result<Self> {
        let mut bytes = Vec::new();
        let (file, _) = open_file(path, "png")?;
        file.take(MOST_BYTES)
            .read_to_end(&mut bytes)
            .map_err(|source| Error::Read { path: path.to_owned(), source })?;
        let (format, picture) =
            if bytes.starts_with(b"P") { ("pbm", pbm(&bytes)) } else { ("png", png(&bytes)) };
        picture.map_err(|reason| Error::Format { path: path.to_owned(), format, reason })
    }

    /// Its pixels, from the upper left corner, and their shades.
    pub(crate) fn pixels(&self) -> impl Iterator<Item = ([i32; 2], u8)> {
        let at = |index: usize| {
            let index = u32::try_from(index).ok()?;
            let at = [index % self.width, index / self.width];
            Some([i32::try_from(at[0]).ok()?, i32::try_from(at[1]).ok()?])
        };
        let shades = self.shades.iter().enumerate();
        shades.filter_map(move |(index, shade)| Some((at(index)?, (*shade)?)))
    }
}

fn png(bytes: &[u8]) -> std::result::Result<Picture, String> {
    let header = minipng::decode_png_header(bytes).map_err(|error| error.to_string())?;
    let width = checked_size(header.width(), header.height())?;
    let mut buffer = vec![0; header.required_bytes_rgba8bpc()];
    let mut image = minipng::decode_png(bytes, &mut buffer).map_err(|error| error.to_string())?;
    image.convert_to_rgba8bpc().map_err(|error| error.to_string())?;
    let shade = |pixel: &[u8]| match *pixel {
        [red, green, blue, alpha] if alpha >= 128 => Some(luma([red, green, blue])),
        _ => None,
    };
    Ok(Picture { width, shades: image.pixels().chunks_exact(4).map(shade).collect() })
}

/// How bright a color is (ITU-R BT.601).
#[expect(clippy::cast_possible_truncation, reason = "a mean of bytes")]
pub(super) fn luma([red, green, blue]: [u8; 3]) -> u8 {
    ((299 * u32::from(red) + 587 * u32::from(green) + 114 * u32::from(blue)) / 1000) as u8
}

fn checked_size(width: u32, height: u32) -> std::result::Result<u32, String> {
    if (1..=MOST).contains(&width) && (1..=MOST).contains(&height) {
        Ok(width)
    } else {
        Err(format!("{width} x {height} pixels"))
    }
}

/// A portable bitmap: `P1` as text, `P4` packed, eight pixels a byte with the
/// leftmost first; 1 is black.
fn pbm(bytes: &[u8]) -> std::result::Result<Picture, String> {
    let mut rest = bytes;
    let kind = word(&mut rest);
    let mut number = || {
        let word = std::str::from_utf8(word(&mut rest)).ok();
        word.and_then(|word| word.parse().ok()).ok_or("it has no width or height")
    };
    let (width, height) = (number()?, number()?);
    checked_size(width, height)?;
    let count = (width * height) as usize;
    let shades: Vec<Option<u8>> = match kind {
        b"P1" => std::iter::from_fn(|| digit(&mut rest)).take(count).map(Some).collect(),
        b"P4" => {
            let line = (width as usize).div_ceil(8);
            // One blank is between the height and the pixels.
            let packed = rest.get(1..).unwrap_or_default().chunks_exact(line);
            let shades = packed.take(height as usize).flat_map(|line| {
                let bits =
                    line.iter().flat_map(|byte| (0..8).rev().map(move |bit| byte >> bit & 1));
                bits.take(width as usize)
            });
            shades.map(|bit| Some(if bit == 1 { 0 } else { 255 })).collect()
        }
        _ => return Err("it is neither P1 nor P4".to_owned()),
    };
    if shades.len() == count {
        Ok(Picture { width, shades })
    } else {
        Err("it is cut short".to_owned())
    }
}

/// Passes over blanks and comments.
fn skip_blanks(rest: &mut &[u8]) {
    while let [first, after @ ..] = *rest {
        *rest = match first {
            b'#' => after.splitn(2, |byte| *byte == b'\n').nth(1).unwrap_or_default(),
            first if first.is_ascii_whitespace() => after,
            _ => return,
        };
    }
}

fn word<'a>(rest: &mut &'a [u8]) -> &'a [u8] {
    skip_blanks(rest);
    let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
    let (word, after) = rest.split_at(end);
    *rest = after;
    word
}

/// The next pixel of a `P1`; blanks between them need not be.
fn digit(rest: &mut &[u8]) -> Option<u8> {
    skip_blanks(rest);
    let (first, after) = rest.split_first()?;
    *rest = after;
    match first {
        b'0' => Some(255),
        b'1' => Some(0),
        _ => None,
    }
}

/// Writes shades, line by line, to a PNG file. Errors: [`Error::Open`].
pub fn write_png(path: &Path, width: u32, height: u32, shades: &[u8]) -> Result<()> {
    let written = std::fs::write(path, to_png(width, height, shades));
    written.map_err(|source| Error::Open { path: path.to_owned(), access: Access::Write, source })
}

/// A PNG file of these shades, line by line. It is not compressed, which would take more memory of
/// the program than it saves on the disk; but a pixel has no more bits than it needs.
pub fn to_png(width: u32, height: u32, shades: &[u8]) -> Vec<u8> {
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    let bits = bits_needed(shades);
    let mut header = Vec::new();
    header.extend(width.to_be_bytes());
    header.extend(height.to_be_bytes());
    // Gray, and the only compression, filters and order there are.
    header.extend([bits, 0, 0, 0, 0]);
    chunk(&mut file, *b"IHDR", &header);
    let mut data = Vec::new();
    for line in shades.chunks(width.max(1) as usize) {
        // Its filter: none.
        data.push(0);
        let packed = line.chunks(usize::from(8 / bits)).map(|pixels| {
            (0..).zip(pixels).fold(0, |byte, (index, shade)| {
                byte | shade >> (8 - bits) << (8 - bits * (index + 1))
            })
        });
        data.extend(packed);
    }
    chunk(&mut file, *b"IDAT", &stored(&data));
    chunk(&mut file, *b"IEND", &[]);
    file
}

/// One bit for black and white, two for the panel's shades, else eight.
fn bits_needed(shades: &[u8]) -> u8 {
    if shades.iter().all(|shade| *shade == 0 || *shade == 255) {
        1
    } else if shades.iter().all(|shade| shade % 85 == 0) {
        2
    } else {
        8
    }
}

/// A zlib stream that holds its data as they are (RFC 1950, 1951).
fn stored(data: &[u8]) -> Vec<u8> {
    let mut stream = vec![0x78, 0x01];
    let mut blocks = data.chunks(usize::from(u16::MAX)).peekable();
    while let Some(block) = blocks.next() {
        let length = u16::try_from(block.len()).unwrap_or(u16::MAX);
        stream.push(u8::from(blocks.peek().is_none()));
        stream.extend(length.to_le_bytes());
        stream.extend((!length).to_le_bytes());
        stream.extend(block);
    }
    let (low, high) = data.iter().fold((1, 0), |(low, high), byte| {
        let low = (low + u32::from(*byte)) % 65521;
        (low, (high + low) % 65521)
    });
    stream.extend((high << 16 | low).to_be_bytes());
    stream
}

fn chunk(file: &mut Vec<u8>, name: [u8; 4], data: &[u8]) {
    let length = u32::try_from(data.len()).unwrap_or(u32::MAX);
    file.extend(length.to_be_bytes());
    let start = file.len();
    file.extend(name);
    file.extend(data);
    let sum = crc(file.get(start..).unwrap_or_default());
    file.extend(sum.to_be_bytes());
}

/// The check sum of PNG's chunks (CRC-32 of ISO 3309).
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |sum, byte| {
        (0..8).fold(sum ^ u32::from(*byte), |sum, _| {
            (sum >> 1) ^ if sum & 1 == 1 { 0xEDB8_8320 } else { 0 }
        })
    })
}
