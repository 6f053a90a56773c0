//! From the bytes of a file to its text: UTF-8 and UTF-16, with and without a byte order mark.

use std::borrow::Cow;

use super::ImportError;

/// The bytes at the start of a file in which the name of its encoding is looked for.
const DECLARATION: usize = 200;

/// The text of a file without its byte order mark.
///
/// Without a mark, UTF-16 is known by the zero that stands beside the first letter; XML that declares ISO 8859-1 or
/// Windows-1252 is read byte by byte, so that letters beyond ISO 8859-1 may come out as others.
///
/// # Errors
/// [`ImportError::NotUtf8`], [`ImportError::NotUtf16`].
pub(super) fn text(bytes: &[u8]) -> Result<Cow<'_, str>, ImportError> {
    match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => utf8(rest),
        [0xfe, 0xff, rest @ ..] => utf16(rest, u16::from_be_bytes),
        [0xff, 0xfe, rest @ ..] => utf16(rest, u16::from_le_bytes),
        [0, letter, ..] if *letter != 0 => utf16(bytes, u16::from_be_bytes),
        [letter, 0, ..] if *letter != 0 => utf16(bytes, u16::from_le_bytes),
        _ => utf8(bytes),
    }
}

fn utf8(bytes: &[u8]) -> Result<Cow<'_, str>, ImportError> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(Cow::Borrowed(text)),
        Err(_) if is_declared_latin(bytes) => {
            Ok(Cow::Owned(bytes.iter().map(|&byte| char::from(byte)).collect()))
        }
        Err(error) => Err(ImportError::NotUtf8 { byte: error.valid_up_to() }),
    }
}

/// Whether an XML declaration names an encoding of one byte a letter.
fn is_declared_latin(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(DECLARATION)];
    let start = String::from_utf8_lossy(start).to_ascii_lowercase();
    let declared = start.split("?>").next().unwrap_or_default();
    declared.starts_with("<?xml")
        && ["iso-8859-1", "latin1", "windows-1252"].iter().any(|name| declared.contains(name))
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Result<Cow<'_, str>, ImportError> {
    let (pairs, rest) = bytes.as_chunks::<2>();
    let mut text = String::with_capacity(pairs.len());
    for letter in char::decode_utf16(pairs.iter().map(|pair| unit(*pair))) {
        text.push(letter.map_err(|_| ImportError::NotUtf16)?);
    }
    if rest.is_empty() { Ok(Cow::Owned(text)) } else { Err(ImportError::NotUtf16) }
}
