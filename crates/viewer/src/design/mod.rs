//! The design panel: profile, sheet, material, motion; the crease pattern; closed forms.
