//! Edits of a scene, written into its text: everything that is unchanged keeps its bytes, comments and order.

mod array;
mod comments;
mod literal;
mod table;
mod value;

#[cfg(test)]
mod tests;

use foldmotion_study::Scene;
use toml_edit::DocumentMut;

use comments::DetachedComment;
use value::Keys;

/// The text of `old`, with the differences to `new` written into it.
///
/// Changed values keep their position and comments. New keys are placed in the order in which a scene lists its keys.
/// Comments above a removed key stay; the comment beside its value and those of a removed table are removed with it.
/// `None` if the text is not valid TOML. The caller must check that the result means `new`, because a text that does
/// not mean `old` may not.
pub(super) fn edited(text: &str, old: &Scene, new: &Scene) -> Option<String> {
    let (old, new) = (Keys::of(old)?, Keys::of(new)?);
    if old == new {
        return Some(text.to_owned());
    }
    let (mark, body) = match text.strip_prefix(BYTE_ORDER_MARK) {
        Some(body) => (BYTE_ORDER_MARK, body),
        None => ("", text),
    };
    let mut document: DocumentMut = body.parse().ok()?;
    let head = if document.as_table().is_empty() {
        comments::take_all(&mut document)
    } else {
        String::new()
    };
    let mut detached = Vec::new();
    table::edit(document.as_table_mut(), &old, &new, &mut EditContext::root(&mut detached));
    comments::reattach(&mut document, detached);
    let edited = format!("{head}{document}");
    // A header that has become the first needs no empty line above it.
    let edited = match edited.strip_prefix('\n') {
        Some(rest) if !body.starts_with(['\n', '\r']) => rest,
        _ => &edited,
    };
    // toml_edit writes line feeds only.
    Some(if body.contains("\r\n") {
        format!("{mark}{}", edited.replace('\n', "\r\n"))
    } else {
        format!("{mark}{edited}")
    })
}

const BYTE_ORDER_MARK: &str = "\u{feff}";

/// The position of an edit in the document.
struct EditContext<'a> {
    /// The position of the header above, in the order of headers.
    position: isize,
    /// Whether this is the root table of the document.
    root: bool,
    /// Comments whose key or table was removed.
    detached: &'a mut Vec<DetachedComment>,
}

impl<'a> EditContext<'a> {
    fn root(detached: &'a mut Vec<DetachedComment>) -> Self {
        Self { position: 0, root: true, detached }
    }

    fn within(&mut self, table: &toml_edit::Table) -> EditContext<'_> {
        EditContext {
            position: table.position().unwrap_or(self.position),
            root: false,
            detached: self.detached,
        }
    }

    /// Keeps a comment for whatever follows the current header.
    fn keep_comment(&mut self, comment: String) {
        self.detached.push(DetachedComment { position: self.position, comment });
    }
}
