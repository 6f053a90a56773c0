//! Words with raised and lowered parts.

/// Raised and lowered letters are this part as large as the others.
const SMALL: f64 = 0.7;
/// Their distance above or below the base line as a part of the size.
const SHIFT: f64 = 0.32;

/// Letters of one size and height.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Run {
    pub(super) text: String,
    /// Part of the words' size.
    pub(super) scale: f64,
    /// The height above the base line, as a part of the size.
    pub(super) rise: f64,
}

/// The runs of `text`: `^x`, `^{xyz}` raised, `_x`, `_{xyz}` lowered.
pub(super) fn runs(text: &str) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    let mut push = |text: &str, scale: f64, rise: f64| match runs.last_mut() {
        Some(last) if last.rise == rise => last.text.push_str(text),
        _ => runs.push(Run { text: text.to_owned(), scale, rise }),
    };
    let mut rest = text;
    while let Some(letter) = rest.chars().next() {
        let after = &rest[letter.len_utf8()..];
        let rise = match letter {
            '^' => SHIFT,
            '_' => -SHIFT,
            _ => {
                push(&rest[..letter.len_utf8()], 1.0, 0.0);
                rest = after;
                continue;
            }
        };
        let (part, tail) = part(after);
        push(part, SMALL, rise);
        rest = tail;
    }
    runs
}

/// One character or a part in braces, and what comes after it.
fn part(text: &str) -> (&str, &str) {
    if let Some((inside, tail)) = text.strip_prefix('{').and_then(|t| t.split_once('}')) {
        return (inside, tail);
    }
    let length = text.chars().next().map_or(0, char::len_utf8);
    text.split_at(length)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(text: &str) -> Vec<(String, i32)> {
        let sign = |rise: f64| i32::from(rise > 0.0) - i32::from(rise < 0.0);
        let runs = runs(text).into_iter();
        runs.map(|run| (run.text, sign(run.rise))).collect()
    }

    #[test]
    fn marks_raise_and_lower_what_follows_them() {
        let expected = [("U", 0), ("O", 1), (" w", 0), ("12", -1), ("!", 0)];
        let expected = expected.map(|(text, sign)| (text.to_owned(), sign));
        assert_eq!(parts("U^O w_{12}!"), expected);
    }

    #[test]
    fn a_mark_at_the_end_and_an_open_brace_harm_nothing() {
        assert_eq!(parts("a^"), [("a".to_owned(), 0), (String::new(), 1)]);
        let open = [("{", 1), ("b", 0)].map(|(text, sign)| (text.to_owned(), sign));
        assert_eq!(parts("^{b"), open);
    }
}
