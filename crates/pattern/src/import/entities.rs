//! The entities that an XML document defines, bounded.
//!
//! Illustrator names its namespaces by entities. Only those of the document's own type declaration are read; entities
//! that name others, by which a short file grows without bound, are refused, and files are never fetched.

use super::{ImportError, LARGEST_IMPORT_FILE};

/// The most entities of a document.
const MOST_ENTITIES: usize = 256;
/// The most bytes of an entity.
const LONGEST_ENTITY: usize = 4096;

/// Refuses entities by which the document could grow beyond the largest file.
///
/// # Errors
/// [`ImportError::Entities`].
pub(super) fn check_entities(text: &str) -> Result<(), ImportError> {
    let refused = |reason: &'static str| ImportError::Entities { reason };
    let mut longest = 0;
    for (index, declaration) in text.split("<!ENTITY").skip(1).enumerate() {
        if index == MOST_ENTITIES {
            return Err(refused("there are more than 256"));
        }
        let Some(value) = quoted(declaration) else { continue };
        if value.replace("&#", "").contains(['&', '%']) {
            return Err(refused("one is made of others"));
        }
        longest = longest.max(value.len());
        if longest > LONGEST_ENTITY {
            return Err(refused("one is longer than 4096 bytes"));
        }
    }
    let references = text.bytes().filter(|byte| *byte == b'&').count();
    if longest * references > LARGEST_IMPORT_FILE {
        return Err(refused("with them the file is too large"));
    }
    Ok(())
}

/// The first text in quotes of a declaration.
fn quoted(declaration: &str) -> Option<&str> {
    let start = declaration.find(['"', '\''])?;
    let quote = declaration[start..].chars().next()?;
    declaration[start + 1..].split(quote).next()
}
