//! The appearance of the window: dark or light, and the zoom factor.

use eframe::egui::{self, Color32, CornerRadius, Stroke, Style, Theme, ThemePreference, vec2};
use serde::{Deserialize, Serialize};

/// Zoom factors of the whole window; the larger ones are for presentations.
pub(crate) const SCALES: [f32; 4] = [1.0, 1.25, 1.5, 2.0];

/// Dark or light.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Appearance {
    /// As the system.
    #[default]
    System,
    /// Light text on a dark background.
    Dark,
    /// Dark text on a light background.
    Light,
}

impl Appearance {
    pub(crate) const ALL: [Self; 3] = [Self::System, Self::Dark, Self::Light];

    /// The opposite of the current theme.
    pub(crate) fn other(ctx: &egui::Context) -> Self {
        match ctx.theme() {
            Theme::Dark => Self::Light,
            Theme::Light => Self::Dark,
        }
    }

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::System => "as the system is",
            Self::Dark => "dark",
            Self::Light => "light",
        }
    }
}

/// Applies the appearance to the window. Call it at the start and when a setting has changed, not in every frame,
/// because it resets the user's keyboard zoom.
pub(crate) fn apply(ctx: &egui::Context, appearance: Appearance, scale: f32) {
    for theme in [Theme::Dark, Theme::Light] {
        ctx.set_style_of(theme, style_of(theme));
    }
    ctx.set_theme(match appearance {
        Appearance::System => ThemePreference::System,
        Appearance::Dark => ThemePreference::Dark,
        Appearance::Light => ThemePreference::Light,
    });
    ctx.set_zoom_factor(scale);
}

/// The frame around a modal dialog.
pub(super) fn modal_frame(ctx: &egui::Context) -> egui::Frame {
    egui::Frame::window(&ctx.global_style()).inner_margin(14.0)
}

/// The colours that differ between dark and light.
struct Palette {
    ground: Color32,
    raised: Color32,
    sunken: Color32,
    line: Color32,
    text: Color32,
    accent: Color32,
    chosen: Color32,
    warning: Color32,
    error: Color32,
}

const DARK: Palette = Palette {
    ground: Color32::from_rgb(30, 31, 34),
    raised: Color32::from_rgb(38, 40, 44),
    sunken: Color32::from_rgb(21, 22, 24),
    line: Color32::from_rgb(58, 61, 66),
    text: Color32::from_rgb(214, 216, 219),
    accent: Color32::from_rgb(92, 164, 224),
    chosen: Color32::from_rgb(30, 62, 94),
    warning: Color32::from_rgb(255, 166, 66),
    error: Color32::from_rgb(255, 112, 102),
};

const LIGHT: Palette = Palette {
    ground: Color32::from_rgb(245, 246, 247),
    raised: Color32::from_rgb(255, 255, 255),
    sunken: Color32::from_rgb(255, 255, 255),
    line: Color32::from_rgb(205, 208, 213),
    text: Color32::from_rgb(38, 41, 46),
    accent: Color32::from_rgb(20, 98, 165),
    chosen: Color32::from_rgb(194, 221, 245),
    warning: Color32::from_rgb(158, 80, 0),
    error: Color32::from_rgb(190, 24, 24),
};

fn style_of(theme: Theme) -> Style {
    let palette = match theme {
        Theme::Dark => &DARK,
        Theme::Light => &LIGHT,
    };
    let mut style = theme.default_style();
    style.spacing.item_spacing = vec2(8.0, 5.0);
    style.spacing.button_padding = vec2(7.0, 3.0);
    style.spacing.interact_size.y = 22.0;
    let rounded = CornerRadius::same(4);
    let visuals = &mut style.visuals;
    visuals.panel_fill = palette.ground;
    visuals.window_fill = palette.raised;
    visuals.window_stroke = Stroke::new(1.0, palette.line);
    visuals.window_corner_radius = rounded;
    visuals.menu_corner_radius = rounded;
    visuals.extreme_bg_color = palette.sunken;
    visuals.hyperlink_color = palette.accent;
    visuals.warn_fg_color = palette.warning;
    visuals.error_fg_color = palette.error;
    visuals.selection.bg_fill = palette.chosen;
    visuals.selection.stroke = Stroke::new(1.0, palette.text);
    let widgets = &mut visuals.widgets;
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, palette.line);
    widgets.noninteractive.fg_stroke = Stroke::new(1.0, palette.text);
    widgets.inactive.fg_stroke = Stroke::new(1.0, palette.text);
    widgets.hovered.bg_stroke = Stroke::new(1.0, palette.accent);
    widgets.active.bg_stroke = Stroke::new(1.0, palette.accent);
    for state in [
        &mut widgets.noninteractive,
        &mut widgets.inactive,
        &mut widgets.hovered,
        &mut widgets.active,
        &mut widgets.open,
    ] {
        state.corner_radius = rounded;
        state.expansion = 0.0;
    }
    style
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The contrast of two colours, from their relative luminance as in WCAG 2.1.
    fn contrast(a: Color32, b: Color32) -> f64 {
        let channel = |c: u8| {
            let c = f64::from(c) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        };
        let luminance = |c: Color32| {
            0.2126 * channel(c.r()) + 0.7152 * channel(c.g()) + 0.0722 * channel(c.b())
        };
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn text_has_enough_contrast_on_every_background() {
        assert!(contrast(Color32::BLACK, Color32::WHITE) > 20.9);
        for palette in [&DARK, &LIGHT] {
            for ground in [palette.ground, palette.raised, palette.sunken, palette.chosen] {
                assert!(contrast(palette.text, ground) > 7.0);
            }
            for colour in [palette.accent, palette.warning, palette.error] {
                assert!(contrast(colour, palette.ground) > 4.5, "{colour:?}");
            }
        }
    }

    #[test]
    fn an_appearance_is_applied_to_the_window() {
        let ctx = egui::Context::default();
        apply(&ctx, Appearance::Light, 1.5);
        assert_eq!(ctx.theme(), Theme::Light);
        apply(&ctx, Appearance::Dark, 1.0);
        assert_eq!(ctx.theme(), Theme::Dark);
    }
}
