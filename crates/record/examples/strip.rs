//! A strip of states from a `motion.fold`, as SVG and PDF:
//!
//! `cargo run --release --example strip -- motion.fold strip [t …] [--grey] [--box] [--strain] [--view iso|front|side|top|AZIMUTH,ELEVATION]`

mod common;

use std::error::Error;
use std::fs;

use foldmotion_record::{
    Bounds, Legend, LineStyle, Marks, Pose, Provenance, StripOptions, Style, View, strip,
};
use glam::DVec3;

use crate::common::{read, strains};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (source, name) = (arguments.next(), arguments.next());
    let (Some(source), Some(name)) = (source, name) else {
        return Err("motion.fold and the name of the figure are needed".into());
    };
    let (mut times, mut options) = (Vec::new(), StripOptions::default());
    let mut has_box = false;
    "h".clone_into(&mut options.unit);
    while let Some(argument) = arguments.next() {
        match &argument[..] {
            "--grey" => {
                options.style = Style::grey();
                options.lines = LineStyle::Dashed;
            }
            "--box" => has_box = true,
            "--strain" => {
                options.legend = Some(Legend {
                    title: "largest strain of an edge, %".to_owned(),
                    range: [0.0, 2.0],
                });
            }
            "--view" => options.view = view(&arguments.next().unwrap_or_default())?,
            time => times.push(time.parse()?),
        }
    }
    if times.is_empty() {
        times = vec![0.0, 0.5, 1.0, 1.5, 2.0];
    }
    let motion = read(&source)?;
    let marks = Marks::default();
    let pose = |time| {
        let mut pose = Pose::at(&motion, &marks, time);
        pose.values = strains(&motion.sheet, &pose.positions);
        pose.bounds = has_box.then(|| bounds(&pose.positions, motion.sheet.unit_length));
        pose
    };
    let poses: Vec<Pose<'_>> = times.into_iter().map(pose).collect();
    let drawing = strip(&motion.sheet, &poses, &options)?.with_provenance(Provenance {
        title: format!("States of {source}"),
        producer: format!("foldmotion {}", env!("CARGO_PKG_VERSION")),
        ..Provenance::default()
    });
    fs::write(format!("{name}.svg"), drawing.svg()?)?;
    fs::write(format!("{name}.pdf"), drawing.pdf()?)?;
    Ok(())
}

/// The box around the positions.
fn bounds(positions: &[DVec3], unit: f64) -> Bounds {
    let low = positions.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = positions
        .iter()
        .copied()
        .fold(DVec3::NEG_INFINITY, DVec3::max);
    Bounds {
        low,
        high,
        sizes: ((high - low) / unit)
            .to_array()
            .map(|side| format!("{side:.2} h")),
        words: String::new(),
    }
}

fn view(text: &str) -> Result<View, Box<dyn Error>> {
    if let Some(view) = View::from_name(text) {
        return Ok(view);
    }
    let (azimuth, elevation) = text.split_once(',').ok_or("two angles are needed")?;
    Ok(View::Around {
        azimuth: azimuth.parse()?,
        elevation: elevation.parse()?,
    })
}
