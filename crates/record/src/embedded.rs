//! The provenance inside a recorded file, read back.

use std::io::Cursor;

use serde_json::Value;

/// The deepest nesting of boxes of an MP4 that lead to the comment.
const MP4_PATH: [&[u8; 4]; 5] = [b"moov", b"udta", b"meta", b"ilst", b"\xA9cmt"];

/// The text of [`crate::FilmOptions::provenance`], [`crate::GlbOptions::provenance`], [`crate::obj()`] or
/// [`crate::Provenance::scene`] inside a GIF, MP4, PNG, GLB, OBJ, HTML, SVG or PDF that was written here; `None` if
/// there is none. The first bytes tell the format.
pub fn embedded(bytes: &[u8]) -> Option<String> {
    let text = match bytes {
        [b'G', b'I', b'F', b'8', ..] => gif(bytes),
        [0x89, b'P', b'N', b'G', ..] => png(bytes),
        [b'g', b'l', b'T', b'F', ..] => glb(bytes),
        [_, _, _, _, b'f', b't', b'y', b'p', ..] => mp4(bytes),
        [b'#', b' ', ..] => obj(bytes),
        [b'<', b'!', b'd' | b'D', ..] => html(bytes),
        _ => xml(bytes),
    };
    text.filter(|text| !text.is_empty())
}

/// The comment among the extensions before the first picture (GIF89a, sections 17 to 26).
fn gif(bytes: &[u8]) -> Option<String> {
    let flags = *bytes.get(10)?;
    let colours = if flags & 0x80 == 0 { 0 } else { 3 << ((flags & 7) + 1) };
    let mut rest = bytes.get(13 + colours..)?;
    while let [0x21, label, blocks @ ..] = rest {
        let mut text = Vec::new();
        rest = blocks;
        loop {
            let (&length, after) = rest.split_first()?;
            if length == 0 {
                rest = after;
                break;
            }
            text.extend(after.get(..length.into())?);
            rest = &after[length.into()..];
        }
        if *label == 0xFE {
            return String::from_utf8(text).ok();
        }
    }
    None
}

fn png(bytes: &[u8]) -> Option<String> {
    let reader = ::png::Decoder::new(Cursor::new(bytes)).read_info().ok()?;
    let texts = &reader.info().utf8_text;
    let text = texts.iter().find(|text| text.keyword == "Source")?;
    text.get_text().ok()
}

/// `asset.extras.provenance` of the first chunk.
fn glb(bytes: &[u8]) -> Option<String> {
    let length = u32::from_le_bytes(bytes.get(12..16)?.try_into().ok()?) as usize;
    let document: Value = serde_json::from_slice(bytes.get(20..)?.get(..length)?).ok()?;
    let text = document.pointer("/asset/extras/provenance")?;
    text.as_str().map(str::to_owned)
}

fn mp4(bytes: &[u8]) -> Option<String> {
    let mut within = bytes;
    for kind in MP4_PATH {
        within = child(within, *kind)?;
        if kind == b"meta" {
            // Version and flags.
            within = within.get(4..)?;
        }
    }
    // The type and the language.
    let data = child(within, *b"data")?.get(8..)?;
    String::from_utf8(data.to_vec()).ok()
}

/// The content of the first box of `kind` among `boxes`.
fn child(mut boxes: &[u8], kind: [u8; 4]) -> Option<&[u8]> {
    loop {
        let length = u32::from_be_bytes(boxes.get(..4)?.try_into().ok()?) as usize;
        let whole = boxes.get(..length).filter(|_| length >= 8)?;
        if whole[4..8] == kind {
            return Some(&whole[8..]);
        }
        boxes = &boxes[length..];
    }
}

/// The comment lines at the start, without those about the unit.
fn obj(bytes: &[u8]) -> Option<String> {
    let end = bytes.windows(3).position(|w| w == b"\no ")?;
    let head = std::str::from_utf8(&bytes[..end]).ok()?;
    let lines = head.lines().filter_map(|line| line.strip_prefix("# "));
    let lines: Vec<&str> = lines.filter(|line| !line.starts_with("unit:")).collect();
    Some(lines.join("\n"))
}

/// The scene in the JSON of the script element `provenance`.
fn html(bytes: &[u8]) -> Option<String> {
    const START: &[u8] = b"<script type=\"application/json\" id=\"provenance\">";
    let from = find(bytes, START)? + START.len();
    let rest = &bytes[from..];
    let data: Value = serde_json::from_slice(&rest[..find(rest, b"</script>")?]).ok()?;
    data.get("scene")?.as_str().map(str::to_owned)
}

fn find(bytes: &[u8], part: &[u8]) -> Option<usize> {
    bytes.windows(part.len()).position(|w| w == part)
}

/// The element `foldmotion:scene`, in an SVG or in the metadata of a PDF, which are not compressed.
fn xml(bytes: &[u8]) -> Option<String> {
    const START: &[u8] = b"<foldmotion:scene>";
    const END: &[u8] = b"</foldmotion:scene>";
    let from = find(bytes, START)? + START.len();
    let rest = &bytes[from..];
    let text = std::str::from_utf8(&rest[..find(rest, END)?]).ok()?;
    // In this sequence, because what is escaped may itself look like an escape.
    Some(text.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&"))
}
