//! What a colour means.

use super::drawing::Role;

/// The part of the brightest channel by which the channels must differ for a colour to have a hue.
const LEAST_SATURATION: f64 = 0.35;
/// The least difference of the channels of a colour with a hue, of 255.
const LEAST_CHROMA: f64 = 50.0;
/// The brightest channel of a colour that is taken for black, of 255.
const DARKEST: f64 = 64.0;
/// The hues that are taken for each colour, degrees. What lies between them could be either.
const HUES: [(f64, f64, Role); 6] = [
    (0.0, 25.0, Role::Mountain),
    (45.0, 75.0, Role::Facet),
    (75.0, 160.0, Role::Cut),
    (200.0, 270.0, Role::Valley),
    (285.0, 336.0, Role::Free),
    (336.0, 360.0, Role::Mountain),
];

/// What a colour means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Meaning {
    /// One of the six colours.
    Exact(Role),
    /// The one of the six colours whose hue is near.
    Near(Role),
    /// Grey, white or a hue between two colours: an auxiliary line.
    Auxiliary,
}

/// The meaning of red, green and blue.
pub(super) fn meaning(colour: [u8; 3]) -> Meaning {
    match colour {
        [0, 0, 0] => return Meaning::Exact(Role::Border),
        [255, 0, 0] => return Meaning::Exact(Role::Mountain),
        [0, 0, 255] => return Meaning::Exact(Role::Valley),
        [0, 255, 0] => return Meaning::Exact(Role::Cut),
        [255, 255, 0] => return Meaning::Exact(Role::Facet),
        [255, 0, 255] => return Meaning::Exact(Role::Free),
        _ => {}
    }
    let [red, green, blue] = colour.map(f64::from);
    let (most, least) = (red.max(green).max(blue), red.min(green).min(blue));
    let chroma = most - least;
    if chroma < LEAST_CHROMA || chroma < LEAST_SATURATION * most {
        let is_black = most <= DARKEST;
        return if is_black { Meaning::Near(Role::Border) } else { Meaning::Auxiliary };
    }
    let hue = if most == red {
        (60.0 * (green - blue) / chroma).rem_euclid(360.0)
    } else if most == green {
        60.0 * (blue - red) / chroma + 120.0
    } else {
        60.0 * (red - green) / chroma + 240.0
    };
    let found = HUES.iter().find(|(from, to, _)| (*from..=*to).contains(&hue));
    found.map_or(Meaning::Auxiliary, |(.., role)| Meaning::Near(*role))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_of_print_are_read_by_their_hue_and_others_are_auxiliary() {
        for (colour, role) in [
            ([0xed, 0x1c, 0x24], Role::Mountain),
            ([0xc1, 0x27, 0x2d], Role::Mountain),
            ([0x2e, 0x31, 0x92], Role::Valley),
            ([0x00, 0x71, 0xbc], Role::Valley),
            ([0x23, 0x1f, 0x20], Role::Border),
            ([0x00, 0xa6, 0x51], Role::Cut),
            ([0xff, 0xf2, 0x00], Role::Facet),
            ([0xec, 0x00, 0x8c], Role::Free),
        ] {
            assert_eq!(meaning(colour), Meaning::Near(role), "{colour:x?}");
        }
        for colour in [
            [0x80, 0x80, 0x80],
            [0xff, 0xff, 0xff],
            [0x00, 0xff, 0xff],
            [0xf7, 0x94, 0x1e],
            [0xff, 0xe0, 0xe0],
        ] {
            assert_eq!(meaning(colour), Meaning::Auxiliary, "{colour:x?}");
        }
    }
}
