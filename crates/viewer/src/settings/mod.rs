//! Settings that are kept from one start to the next, unsaved scenes, keyboard shortcuts, and the file picker.

mod appearance;
mod help;
mod picker;
mod recent;
mod shortcuts;
mod unsaved;
mod view;

use eframe::Storage;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

pub(crate) use appearance::{Appearance, SCALES, apply};
pub(crate) use help::show_help;
pub(crate) use picker::{FilePicker, PickerResult};
pub(crate) use recent::RecentFiles;
pub(crate) use shortcuts::{Command, Group, commands_of, keys_of, name_of, pressed};
pub(crate) use unsaved::{UnsavedScene, UnsavedScenes};
pub(crate) use view::{Colour, PanelSettings, ViewSettings};

/// The key under which the settings are stored.
const KEY: &str = "settings";

#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(crate) struct Settings {
    pub(crate) recent: RecentFiles,
    /// Dark, light, or as the system.
    #[serde(rename = "look")]
    pub(crate) appearance: Appearance,
    /// The zoom factor of the whole window.
    pub(crate) scale: Scale,
    pub(crate) view: ViewSettings,
    pub(crate) panels: PanelSettings,
}

/// The zoom factor of the whole window, one of [`SCALES`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Scale(f32);

impl Default for Scale {
    fn default() -> Self {
        Self(SCALES[0])
    }
}

impl Scale {
    /// The factor: the one of [`SCALES`] nearest to the stored value.
    pub(crate) fn factor(self) -> f32 {
        let wanted = self.0.clamp(SCALES[0], SCALES[SCALES.len() - 1]);
        let far = |scale: &f32| (scale - wanted).abs();
        let nearest = SCALES.into_iter().min_by(|a, b| far(a).total_cmp(&far(b)));
        nearest.unwrap_or(SCALES[0])
    }

    /// The next larger factor; after the largest, the smallest.
    pub(crate) fn next(self) -> Self {
        let larger = SCALES.into_iter().find(|&scale| scale > self.factor());
        Self(larger.unwrap_or(SCALES[0]))
    }
}

impl Settings {
    /// The stored settings; whatever is missing or cannot be read gets its default.
    pub(crate) fn load(storage: Option<&dyn Storage>) -> Self {
        let stored = storage.and_then(|storage| storage.get_string(KEY));
        stored.map_or_else(Self::default, |json| Self::from_json(&json))
    }

    pub(crate) fn store(&self, storage: &mut dyn Storage) {
        // Numbers, strings and lists of them always serialise.
        if let Ok(json) = serde_json::to_string(self) {
            storage.set_string(KEY, json);
        }
    }

    fn from_json(json: &str) -> Self {
        let Ok(Value::Object(stored)) = serde_json::from_str(json) else {
            return Self::default();
        };
        Self {
            recent: field(&stored, "recent"),
            appearance: field(&stored, "look"),
            scale: field(&stored, "scale"),
            view: field(&stored, "view"),
            panels: field(&stored, "panels"),
        }
    }
}

/// One field, read by itself, so that an incompatible value of another version only resets this field.
fn field<T: DeserializeOwned + Default>(stored: &Map<String, Value>, name: &str) -> T {
    let value = stored.get(name).cloned();
    value.and_then(|value| serde_json::from_value(value).ok()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use eframe::egui::{Theme, Vec2};
    use egui_kittest::{Harness, HarnessBuilder};

    use super::*;

    /// A harness with this appearance.
    pub(super) fn builder<S>(appearance: Appearance, size: Vec2) -> HarnessBuilder<S> {
        let theme = match appearance {
            Appearance::Light => Theme::Light,
            _ => Theme::Dark,
        };
        Harness::builder()
            .with_size(size)
            .with_theme(theme)
            .with_context_setup(move |ctx| apply(ctx, appearance, 1.0))
    }

    /// Renders the window, saves the picture in the folder FOLDMOTION_PICTURES if it is set, and returns the brightness
    /// of a pixel.
    pub(super) fn drawn<S>(harness: &mut Harness<'_, S>, name: &str, [x, y]: [u32; 2]) -> u8 {
        let picture = harness.render().unwrap();
        if let Some(folder) = std::env::var_os("FOLDMOTION_PICTURES") {
            picture.save(Path::new(&folder).join(format!("{name}.png"))).unwrap();
        }
        picture.get_pixel(x, y).0[0]
    }

    #[test]
    fn settings_read_back_as_they_were_stored() {
        let mut settings = Settings::default();
        settings.appearance = Appearance::Light;
        settings.scale = settings.scale.next();
        settings.view.creases = false;
        settings.panels.text = true;
        settings.recent.add(&std::env::current_dir().unwrap());
        let json = serde_json::to_string(&settings).unwrap();
        assert_eq!(Settings::from_json(&json), settings);
    }

    #[test]
    fn what_another_version_wrote_falls_back_field_by_field() {
        let json = r#"{"recent": 3, "look": "sepia", "scale": 1e9, "new": [], "view": {"creases": false, "later": 1}, "panels": {"text": "yes"}}"#;
        let settings = Settings::from_json(json);
        assert_eq!(settings.appearance, Appearance::System);
        assert_eq!(settings.recent, RecentFiles::default());
        assert_eq!(settings.scale.factor(), 2.0);
        assert!(!settings.view.creases && settings.view.profile);
        assert_eq!(settings.panels, PanelSettings::default());
        for broken in ["", "[]", "null", "{\"look\":"] {
            assert_eq!(Settings::from_json(broken), Settings::default());
        }
    }

    #[test]
    fn scale_factors_repeat_after_the_largest() {
        let mut scale = Scale::default();
        let mut seen = Vec::new();
        for _ in 0..=SCALES.len() {
            seen.push(scale.factor());
            scale = scale.next();
        }
        assert_eq!(seen, [1.0, 1.25, 1.5, 2.0, 1.0]);
    }
}
