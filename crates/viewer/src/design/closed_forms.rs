//! The closed forms, kept up to date while the user edits: the unit, the compact box in every case that w/h allows, and
//! the size of the deployed sheet.

use eframe::egui::{self, RichText, Ui};
use foldmotion_pattern::{Case, CompactBox, PatternError, Sheet};
use foldmotion_study::{Draft, UnitDraft};
use glam::DVec3;

use super::form::{Form, NOTE_SIZE, name, note};
use super::number::formatted;
use super::unit_size::UnitSize;

/// Measurements of the last draft.
#[derive(Debug, Default)]
pub(super) struct Measurements {
    of: Option<u64>,
    deployed: DVec3,
    flat: [f64; 2],
    pub(super) counts: Counts,
}

/// Numbers of vertices, facets and creases of a sheet, and whether its pattern is developable and flat-foldable.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Counts {
    vertices: usize,
    facets: usize,
    creases: usize,
    is_developable: bool,
    is_flat_foldable: bool,
}

impl Counts {
    fn of(draft: &Draft) -> Self {
        let sheet: &Sheet = draft.sheet();
        let (pattern, vertices) = match draft {
            Draft::Units(units) => (&units.pattern, units.units.pattern_vertices()),
            Draft::Imported(study) => (&study.pattern, sheet.vertices.len()),
        };
        Self {
            vertices,
            facets: sheet.facets.len(),
            creases: sheet.edges.iter().filter(|edge| edge.is_crease()).count(),
            is_developable: pattern.is_developable(),
            is_flat_foldable: pattern.is_flat_foldable(),
        }
    }

    pub(super) fn show(&self, ui: &mut Ui) {
        let text =
            format!("{} vertices, {} facets, {} creases", self.vertices, self.facets, self.creases);
        let tip = "Vertices, facets, and mountain and valley creases of the pattern";
        value_row(ui, "sheet", &text, tip);
        let foldable = if self.is_flat_foldable {
            "locally flat-foldable"
        } else {
            "not locally flat-foldable"
        };
        let developable = if self.is_developable { "developable" } else { "not developable" };
        let tip = "Developable: the sector angles at each vertex sum to 2π. Locally flat-foldable: alternate angles sum to π, and the \
             numbers of mountains and valleys differ by two (section 2).";
        value_row(ui, "vertices", &format!("{developable}, {foldable}"), tip);
    }
}

impl Measurements {
    /// Measures the draft, once for each draft.
    pub(super) fn update(&mut self, form: &Form<'_>) {
        if self.of == Some(form.draft_number) {
            return;
        }
        let Some(draft) = form.draft else { return };
        self.of = Some(form.draft_number);
        self.counts = Counts::of(draft);
        if let Draft::Units(units) = draft {
            let [low, high] = units
                .deployed
                .iter()
                .fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], &p| {
                    [low.min(p), high.max(p)]
                });
            self.deployed = high - low;
            let columns = units.units.columns as f64;
            self.flat = [units.division.length(), columns * units.units.unit.width];
        }
    }

    pub(super) fn show(&mut self, form: &mut Form<'_>, ui: &mut Ui) {
        form.section(ui, "Closed forms", true, &[], |form, ui| {
            self.update(form);
            let Some(draft) = form.draft.and_then(Draft::units) else {
                ui.label(RichText::new("no sheet yet").weak());
                show_cases(form, ui);
                return;
            };
            show_unit(draft, ui);
            show_cases(form, ui);
            if !draft.units.has_equal_rows() {
                ui.label(note(ui, "the table applies to equal rows"));
            }
            self.show_sizes(draft, ui);
            self.counts.show(ui);
        });
    }

    fn show_sizes(&self, draft: &UnitDraft, ui: &mut Ui) {
        let [x, y, z] = self.deployed.to_array();
        let tip = "Extents of the deployed state along x, y and z";
        value_row(ui, "deployed", &sizes(&[x, y, z]), tip);
        let tip = "Size of the crease pattern: Nr h and W";
        value_row(ui, "flat", &sizes(&self.flat), tip);
        let Some(compact) = draft.closed_form else {
            let tip = "The unmodified rectangle has no closed form.";
            value_row(ui, "compact", "no closed form", tip);
            return;
        };
        let tip = "x = Nr h − (Nr − 1) a, y = Nc (2s + 2d), z = a (equations 3 to 7)";
        value_row(ui, "compact", &sizes(&compact.extents), tip);
        let (area, volume) = (x * z, x * y * z);
        let mut ratios = vec![format!("area {}", times(area / compact.area))];
        if compact.volume > 0.0 && volume > 0.0 {
            ratios.push(format!("volume {}", times(volume / compact.volume)));
        }
        let tip = "The box of the deployed state divided by that of the compact one: area in the x–z plane (equations 3 to 5), \
             and volume (equations 6 and 7) if the compact state is not flat.";
        value_row(ui, "size ratio", &ratios.join(", "), tip);
    }
}

fn show_unit(draft: &UnitDraft, ui: &mut Ui) {
    let unit = &draft.units.unit;
    let ratio = unit.width / unit.height;
    let text = format!("{} × {}, w/h = {}", brief(unit.width), brief(unit.height), brief(ratio));
    let tip = "w = W/Nc, and h is the mean length of a segment.";
    value_row(ui, "unit w × h", &text, tip);
    let text = format!(
        "{}: a = {}, s = {}, 2d = {}",
        draft.units.case_name(),
        brief(unit.flap),
        brief(unit.side_pad),
        brief(unit.centre_pad)
    );
    let tip = "Flap a, side pad s, centre pad 2d: the width of a column is s + a + 2d + a + s (figures 2 to 5).";
    value_row(ui, "case", &text, tip);
}

/// Shows a table of the compact box in every case.
fn show_cases(form: &mut Form<'_>, ui: &mut Ui) {
    form.scope(ui, "cases beside each other", |form, ui| {
        egui::Grid::new("cases")
            .num_columns(5)
            .striped(true)
            .min_col_width(22.0)
            .min_row_height(15.0)
            .spacing([14.0, 1.0])
            .show(ui, |ui| {
                let heads = [
                    ("case", "Case of the units"),
                    ("a", "Width of a flap: h/2 in E and S, w/2 in T, λh/2 in SII"),
                    ("x × y × z", "Compact box: Nr h − (Nr − 1) a, Nc (2s + 2d), a"),
                    ("A", "Area in the x–z plane (equations 3, 4, 5)"),
                    ("V", "Volume (equations 6, 7); 0 if the compact state is flat"),
                ];
                for (head, tip) in heads {
                    ui.label(note(ui, head)).on_hover_text(tip);
                }
                ui.end_row();
                for case in [Case::E, Case::T, Case::S, Case::SII] {
                    show_case(form, ui, case);
                    ui.end_row();
                }
            });
    });
}

fn show_case(form: &Form<'_>, ui: &mut Ui, case: Case) {
    let sheet = &form.scene.sheet;
    let size = UnitSize::of(form, sheet.case);
    let small = |text: String| RichText::new(text).size(NOTE_SIZE);
    let unit = size.and_then(|size| Some((size, size.unit(case, sheet.lambda, sheet.offset)?)));
    match unit {
        Some((size, Ok(unit))) => {
            let Some(compact) = CompactBox::closed_form(&unit, size.rows, size.columns) else {
                return;
            };
            ui.label(small(case.name().to_owned()).strong());
            ui.label(small(brief(unit.flap)));
            ui.label(small(sizes(&compact.extents)));
            ui.label(small(brief(compact.area)));
            ui.label(small(brief(compact.volume)));
        }
        other => {
            let why = match other {
                Some((_, Err(PatternError::CaseContradictsUnit { need, .. }))) => {
                    format!("needs {need}")
                }
                Some((_, Err(_))) => "λ or d out of range".to_owned(),
                _ => "w is not known".to_owned(),
            };
            ui.label(small(case.name().to_owned()).weak());
            ui.label(small("–".to_owned()).weak());
            ui.label(small(why).weak());
        }
    }
}

/// A row with a name and a value.
pub(super) fn value_row(ui: &mut Ui, title: &str, text: &str, tip: &str) {
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = 17.0;
        ui.horizontal(|ui| {
            name(ui, title, tip);
            ui.add(egui::Label::new(text).wrap()).on_hover_text(tip);
        });
    });
}

fn sizes(sizes: &[f64]) -> String {
    let sizes: Vec<String> = sizes.iter().copied().map(brief).collect();
    sizes.join(" × ")
}

fn times(ratio: f64) -> String {
    format!("{}×", brief(ratio))
}

/// Formats a number with four significant digits.
fn brief(number: f64) -> String {
    formatted(number, 4)
}
