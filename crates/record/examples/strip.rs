//! A strip of states from a `motion.fold`, as SVG and PDF:
//!
//! `cargo run --release --example strip -- motion.fold strip [t …] [--grey] [--box] [--strain] [--view iso|front|side|top|AZIMUTH,ELEVATION]`

use std::error::Error;
use std::fs::{self, File};
use std::io::BufReader;

use foldmotion_pattern::{FoldError, FoldFile, LayerOrder, Motion, Sheet};
use foldmotion_record::{
    Bounds, Legend, LineStyle, Marks, Pose, Provenance, StripOptions, Style, View, strip,
};
use glam::DVec3;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (source, name) = (arguments.next(), arguments.next());
    let (Some(source), Some(name)) = (source, name) else {
        return Err("motion.fold and the name of the figure are needed".into());
    };
    let (mut times, mut options) = (Vec::new(), StripOptions::default());
    let mut has_box = false;
    options.unit = "h".to_owned();
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

/// The largest change of length of a triangle's edges, per cent.
fn strains(sheet: &Sheet, positions: &[DVec3]) -> Vec<f64> {
    let flat = sheet.planar();
    let strain = |face: &[u32; 3]| {
        let edges = [0, 1, 2].map(|i| [face[i], face[(i + 1) % 3]].map(|v| v as usize));
        let changes = edges.map(|[a, b]| {
            let rest = flat[a].distance(flat[b]);
            100.0 * (positions[a].distance(positions[b]) / rest - 1.0).abs()
        });
        changes.into_iter().fold(0.0, f64::max)
    };
    sheet.faces.iter().map(strain).collect()
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

/// The motion in the file, with the layer order of its last frame.
fn read(path: &str) -> Result<Motion, Box<dyn Error>> {
    let file = FoldFile::read(BufReader::new(File::open(path)?))?;
    let mut frames = Vec::new();
    let mut last = LayerOrder::default();
    file.frames::<FoldError>(BufReader::new(File::open(path)?), &mut |frame, order| {
        frames.push(frame);
        last = order.clone();
        Ok(())
    })?;
    // The order is that of the faces in the file; triangles of one face do not overlap.
    let mut of_face = vec![Vec::new(); file.polygons.len()];
    for (triangle, &face) in (0..).zip(&file.triangle_faces) {
        of_face[face as usize].push(triangle);
    }
    let mut compact_order = LayerOrder::default();
    for (f, g, sign) in last.iter() {
        for &a in &of_face[f as usize] {
            for &b in &of_face[g as usize] {
                compact_order.insert(a, b, sign);
            }
        }
    }
    Ok(Motion {
        sheet: file.sheet,
        frames,
        compact_order,
    })
}
