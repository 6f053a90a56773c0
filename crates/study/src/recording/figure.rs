//! `figure.svg` and `figure.pdf`: states side by side at one scale.

use foldmotion_geometry::Profile;
use foldmotion_pattern::{Unit, UnitSheet};
use foldmotion_record::{
    Bounds, Dimension, Drawing, FigureState, FilmOptions, LineStyle, Provenance, RecordError,
    StripOptions, strip,
};
use glam::{DVec2, DVec3};

use super::colours::legend;
use super::{ColourValues, Quantity, Recorder};
use crate::StudyError;
use crate::VERSION;
use crate::results::Results;
use crate::scene::{ColourChoice, OutputChoice};

/// The largest number of states in a row.
const COLUMNS: usize = 5;

/// Segments of the line that shows the profile.
const PROFILE_POINTS: u32 = 240;

impl Recorder<'_> {
    pub(super) fn figures(
        &self,
        values: ColourValues<'_>,
        results: &mut Results,
    ) -> Result<(), StudyError> {
        let (svg, pdf) = (OutputChoice::Svg, OutputChoice::Pdf);
        if !self.recording.has(svg) && !self.recording.has(pdf) {
            return Ok(());
        }
        let drawing = self.figure(values)?;
        if self.recording.has(svg) {
            results.write_bytes("figure.svg", drawing.svg()?.as_bytes())?;
        }
        if self.recording.has(pdf) {
            results.write_bytes("figure.pdf", &drawing.pdf()?)?;
        }
        Ok(())
    }

    fn figure(&self, values: ColourValues<'_>) -> Result<Drawing, StudyError> {
        let times = self.times();
        let poses: Vec<FigureState<'_>> = times.into_iter().map(|time| self.pose(time)).collect();
        let recording = self.recording;
        let mut options = StripOptions {
            columns: COLUMNS,
            view: recording.film.view,
            frame: frame(&recording.film),
            style: recording.film.style.clone(),
            unit: self.unit.to_owned(),
            legend: values.map(legend),
            // Over colours that show values, all creases look the same.
            has_key: values.is_none(),
            letters: recording.letters,
            ..StripOptions::default()
        };
        if recording.colour == ColourChoice::Grey {
            options.lines = LineStyle::Dashed;
        }
        if recording.film.is_transparent {
            options.background = None;
        }
        // If long labels leave no room, fewer states are put in a row.
        let drawing = loop {
            match strip(&self.motion.sheet, &poses, &options) {
                Err(RecordError::NoRoom { .. }) if options.columns > 1 => options.columns -= 1,
                drawing => break drawing?,
            }
        };
        Ok(drawing.with_provenance(Provenance {
            title: self.title.to_owned(),
            producer: format!("foldmotion {VERSION}"),
            scene: self.source_info.text(),
            hash: self.source_info.sha256.clone(),
        }))
    }

    fn pose(&self, time: f64) -> FigureState<'_> {
        let mut pose = FigureState::at(self.motion, &self.marks, time);
        if ![0.0, 1.0, 2.0].contains(&time) {
            // The name of the stage would leave less room for the states.
            pose.label = format!("t = {time}");
        }
        if let Some(quantity) = Quantity::of(self.recording.colour) {
            pose.values = quantity.values(&self.motion.sheet, &pose.positions);
        }
        if let Some(study) = self.units
            && self.recording.film.centre.is_none()
        {
            pose.positions = study.turned(time, &pose.positions);
            pose.spot = self.marks.spot_at(&self.motion.sheet, &pose.positions, time);
            if self.recording.has_profile && time == 0.0 {
                pose.target = profile_points(&study.profile);
            }
            let has_equal_units = study.units.has_equal_rows();
            if self.recording.has_dimensions && time == 1.0 && has_equal_units {
                pose.dimensions = self.dimensions(&study.units, &pose.positions);
            }
        }
        if self.recording.has_box && time >= 2.0 {
            pose.bounds = Some(self.bounds(&pose.positions));
        }
        pose
    }

    /// The dimensions h and W at the edges of the planar state, which lies along the axes with its rows along x.
    fn dimensions(&self, units: &UnitSheet, positions: &[DVec3]) -> Vec<Dimension> {
        let [low, high] = ends(positions);
        let (Unit { width, height, .. }, columns) = (units.unit, units.columns);
        let name = self.unit;
        let of_units = if columns > 1 {
            format!("W = {columns} w = {} {name}", short(width * columns as f64))
        } else {
            format!("w = {} {name}", short(width))
        };
        let dimension = |from: DVec3, to: DVec3, words: String| Dimension {
            ends: [from, to],
            inside: 0.5 * (low + high),
            words,
        };
        let row = low + height * DVec3::X;
        let corner = DVec3::new(high.x, low.y, low.z);
        vec![
            dimension(low, row, format!("h = {} {name}", short(height))),
            dimension(corner, DVec3::new(high.x, high.y, low.z), of_units),
        ]
    }

    /// The box of the compact state, which lies along the axes.
    fn bounds(&self, positions: &[DVec3]) -> Bounds {
        let [low, high] = ends(positions);
        let unit = self.unit;
        let closed_form = self.units.and_then(|study| study.closed_form);
        let words = closed_form.map(|form| {
            let [x, y, z] = form.extents.map(short);
            format!("closed form {x} × {y} × {z} {unit}")
        });
        Bounds {
            low,
            high,
            sizes: (high - low).to_array().map(|side| format!("{} {unit}", short(side))),
            words: words.unwrap_or_default(),
        }
    }
}

/// Points of Γ at the edge y = 0 of the deployed state.
fn profile_points(profile: &Profile) -> Vec<DVec3> {
    let point = |k: u32| {
        let p = profile.position(f64::from(k) / f64::from(PROFILE_POINTS));
        DVec3::new(p.x, 0.0, p.y)
    };
    (0..=PROFILE_POINTS).map(point).collect()
}

/// The corners of the box around `positions`.
fn ends(positions: &[DVec3]) -> [DVec3; 2] {
    let points = || positions.iter().copied();
    let low = points().fold(DVec3::INFINITY, DVec3::min);
    [low, points().fold(DVec3::NEG_INFINITY, DVec3::max)]
}

/// The part of the view that a camera with a centre and a width shows.
fn frame(film: &FilmOptions) -> Option<[DVec2; 2]> {
    let [middle, _] = film.view.extent([film.centre?]);
    let [across, down] = film.size.map(f64::from);
    let half = 0.5 * film.width? * DVec2::new(1.0, down / across);
    Some([middle - half, middle + half])
}

/// A length with four significant digits.
fn short(value: f64) -> String {
    let size = value.abs();
    if size < 1e-9 {
        return "0".to_owned();
    }
    if !(1e-3..1e6).contains(&size) {
        return format!("{value:.3e}");
    }
    #[expect(clippy::cast_sign_loss, reason = "clamped to 0 to 6 before")]
    let decimals = (3.0 - size.log10().floor()).clamp(0.0, 6.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_four_digits() {
        let numbers = [0.0, 1e-12, 5.0, 0.35, 5.3512, 12_345.6, 2.5e-7];
        let expected = ["0", "0", "5", "0.35", "5.351", "12346", "2.500e-7"];
        assert_eq!(numbers.map(short), expected);
    }
}
