//! An edit of a scene, written into its text: what did not change keeps its bytes, comments and order.

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

/// The text of `old` with what differs in `new` written into it.
///
/// Changed values stand where the old ones stood, with their comments; new keys follow the ones that they follow in a
/// scene; the comments above a removed key stay, the one beside its value goes with it, as do those of a removed table. None where the text is no TOML.
/// Whether the result says `new` is the caller's to check: a text that did not say `old` may not.
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
    let mut orphans = Vec::new();
    table::edit(
        document.as_table_mut(),
        &old,
        &new,
        &mut EditContext::root(&mut orphans),
    );
    comments::reattach(&mut document, orphans);
    let edited = format!("{head}{document}");
    // A header that has become the first needs no empty line above.
    let edited = match edited.strip_prefix('\n') {
        Some(rest) if !body.starts_with(['\n', '\r']) => rest,
        _ => &edited,
    };
    // The editor writes line feeds only.
    Some(if body.contains("\r\n") {
        format!("{mark}{}", edited.replace('\n', "\r\n"))
    } else {
        format!("{mark}{edited}")
    })
}

const BYTE_ORDER_MARK: &str = "\u{feff}";

/// Where in the document an edit is.
struct EditContext<'a> {
    /// The context of the header above, in the order of headers.
    position: isize,
    /// Whether this is the document itself.
    root: bool,
    /// Comments that have lost what they stood above.
    orphans: &'a mut Vec<DetachedComment>,
}

impl<'a> EditContext<'a> {
    fn root(orphans: &'a mut Vec<DetachedComment>) -> Self {
        Self {
            position: 0,
            root: true,
            orphans,
        }
    }

    fn within(&mut self, table: &toml_edit::Table) -> EditContext<'_> {
        EditContext {
            position: table.position().unwrap_or(self.position),
            root: false,
            orphans: self.orphans,
        }
    }

    /// Keeps a comment for whatever follows the header at hand.
    fn keep_comment(&mut self, comment: String) {
        self.orphans.push(DetachedComment {
            position: self.position,
            comment,
        });
    }
}
