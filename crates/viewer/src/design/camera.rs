//! The camera of films and figures.

use eframe::egui::Ui;
use foldmotion_study::scene::{CameraChoice, CameraScene, OwnCamera};

use super::form::{Field, Form};
use super::number::{Number, control_width};
use foldmotion_study::scene::fields::tip;

const CAMERAS: [(Option<CameraChoice>, &str); 6] = [
    (Some(CameraChoice::Iso), "iso"),
    (Some(CameraChoice::Front), "front"),
    (Some(CameraChoice::Side), "side"),
    (Some(CameraChoice::Top), "top"),
    (Some(CameraChoice::Turntable), "turntable"),
    (None, "own"),
];

pub(super) fn show(form: &mut Form<'_>, ui: &mut Ui) {
    let field = Field::new("record.camera", "camera");
    let given = form.scene.record.camera;
    let shown = match given {
        None => Some(CameraChoice::Iso),
        Some(CameraScene::Preset(preset)) => Some(preset),
        Some(CameraScene::Own(_)) => None,
    };
    form.scope(ui, "record.camera", |form, ui| {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 3.0;
            ui.label(field.name).on_hover_text(field.tip());
            ui.add_space(4.0);
            for (camera, name) in CAMERAS {
                let option = ui.selectable_label(camera == shown, name);
                let option = option.accessible_name(format!("camera {name}"));
                if option.clicked() && camera != shown {
                    form.scene.record.camera = match camera {
                        Some(CameraChoice::Iso) => None,
                        Some(preset) => Some(CameraScene::Preset(preset)),
                        None => Some(CameraScene::Own(OwnCamera {
                            azimuth: -60.0,
                            elevation: 30.0,
                            turn: None,
                            centre: None,
                            width: None,
                        })),
                    };
                    form.record(field.name, option.id, false);
                }
            }
        });
    });
    if let Some(CameraScene::Own(own)) = given {
        show_own_camera(form, ui, own);
    }
    form.errors_of(ui, "record.camera");
}

fn show_own_camera(form: &mut Form<'_>, ui: &mut Ui, own: OwnCamera) {
    let before = own;
    let mut own = own;
    for (name, most) in [("azimuth", 360.0), ("elevation", 90.0), ("turn", 3600.0)] {
        let number = Number::within(-most..=most).speed(0.5);
        let spoken = format!("camera {name}");
        form.scope(ui, &spoken, |form, ui| {
            ui.horizontal(|ui| {
                let tip = tip(&format!("record.camera.{name}"));
                super::form::name(ui, name, tip);
                let width = control_width(ui);
                let value = match name {
                    "azimuth" => own.azimuth,
                    "elevation" => own.elevation,
                    _ => own.turn.unwrap_or(0.0),
                };
                let new = form.required_cell(ui, "camera", &spoken, &number, width, value);
                match (name, new) {
                    ("azimuth", Some(new)) => own.azimuth = new,
                    ("elevation", Some(new)) => own.elevation = new,
                    (_, Some(new)) => own.turn = Some(new),
                    (_, None) => {}
                }
            });
        });
    }
    if own != before {
        form.scene.record.camera = Some(CameraScene::Own(own));
    }
}
