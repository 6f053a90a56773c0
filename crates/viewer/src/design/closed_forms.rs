//! The closed forms, live: the unit, the compact box of every case that w/h allows, the deployed size.

use eframe::egui::{self, RichText, Ui};
use foldmotion_pattern::{Case, CompactBox, PatternError, Sheet};
use foldmotion_study::{Draft, UnitDraft};
use glam::DVec3;

use super::form::{Form, NOTE_SIZE, name, note};
use super::number::{decimal, scientific};
use super::unit_size::UnitSize;

/// What was measured of the draft last.
#[derive(Debug, Default)]
pub(super) struct Measurements {
    of: Option<u64>,
    deployed: DVec3,
    flat: [f64; 2],
    pub(super) counts: Counts,
}

/// Vertices, facets and creases of a sheet.
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
        let text = format!(
            "{} vertices, {} facets, {} creases",
            self.vertices, self.facets, self.creases
        );
        fact(
            ui,
            "sheet",
            &text,
            "mountain and valley creases of the pattern",
        );
        let foldable = if self.is_flat_foldable {
            "flat-foldable"
        } else {
            "not flat-foldable"
        };
        let developable = if self.is_developable {
            "developable"
        } else {
            "not developable"
        };
        fact(
            ui,
            "vertices",
            &format!("{developable}, {foldable}"),
            "developable: sector angles sum to 2π; flat-foldable: alternate ones to π, mountains and valleys differ by two \
             (section 2)",
        );
    }
}

impl Measurements {
    /// What is measured of a draft, once for each.
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
                ui.label(RichText::new("nothing to fold yet").weak());
                show_cases(form, ui);
                return;
            };
            show_unit(draft, ui);
            show_cases(form, ui);
            if !draft.units.has_equal_rows() {
                ui.label(note(ui, "the table is that of equal rows"));
            }
            self.show_sizes(draft, ui);
            self.counts.show(ui);
        });
    }

    fn show_sizes(&self, draft: &UnitDraft, ui: &mut Ui) {
        let [x, y, z] = self.deployed.to_array();
        fact(
            ui,
            "deployed",
            &sizes(&[x, y, z]),
            "extents of the deployed state along x, y and z",
        );
        fact(
            ui,
            "flat",
            &sizes(&self.flat),
            "Nr h and W: the crease pattern",
        );
        let Some(compact) = draft.closed_form else {
            fact(
                ui,
                "compact",
                "no closed form",
                "the unmodified rectangle has none",
            );
            return;
        };
        fact(
            ui,
            "compact",
            &sizes(&compact.extents),
            "x = Nr h − (Nr − 1) a, y = Nc (2s + 2d), z = a (equations 3 to 7)",
        );
        let (area, volume) = (x * z, x * y * z);
        let mut ratios = vec![format!("area {}", times(area / compact.area))];
        if compact.volume > 0.0 && volume > 0.0 {
            ratios.push(format!("volume {}", times(volume / compact.volume)));
        }
        fact(
            ui,
            "size ratio",
            &ratios.join(", "),
            "box of the deployed state over the compact one: area in the x–z plane (equations 3 to 5), and volume \
             (equations 6 and 7) where the compact state is not flat",
        );
    }
}

fn show_unit(draft: &UnitDraft, ui: &mut Ui) {
    let unit = &draft.units.unit;
    let ratio = unit.width / unit.height;
    let text = format!(
        "{} × {}, w/h = {}",
        brief(unit.width),
        brief(unit.height),
        brief(ratio)
    );
    fact(
        ui,
        "unit w × h",
        &text,
        "w = W/Nc and h, the mean length of a segment",
    );
    let text = format!(
        "{}: a = {}, s = {}, 2d = {}",
        draft.units.case_name(),
        brief(unit.flap),
        brief(unit.side_pad),
        brief(unit.centre_pad)
    );
    fact(
        ui,
        "case",
        &text,
        "flap a, side pad s, centre pad 2d: a column is s | a | 2d | a | s wide (figures 2 to 5)",
    );
}

/// What every case would give, beside each other.
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
                    ("case", "the case"),
                    (
                        "a",
                        "width of a flap: h/2 of E and S, w/2 of T, λh/2 of SII",
                    ),
                    (
                        "x × y × z",
                        "the compact box: Nr h − (Nr − 1) a, Nc (2s + 2d), a",
                    ),
                    ("A", "area in the x–z plane (equations 3, 4, 5)"),
                    (
                        "V",
                        "volume (equations 6, 7); 0 where the compact state is flat",
                    ),
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

/// A name and what is known of it.
pub(super) fn fact(ui: &mut Ui, title: &str, text: &str, tip: &str) {
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

/// A number in four digits.
pub(super) fn brief(number: f64) -> String {
    let size = number.abs();
    if size != 0.0 && !(1e-3..1e6).contains(&size) {
        return scientific(number, 2);
    }
    decimal(number, 4)
}
