//! A strip of states from a `motion.fold`, as SVG and PDF:
//!
//! `cargo run --release --example strip -- motion.fold strip [t …] [--grey] [--view iso|front|side|top|AZIMUTH,ELEVATION]`

use std::error::Error;
use std::fs::{self, File};
use std::io::BufReader;

use foldmotion_pattern::{FoldError, FoldFile, LayerOrder, Motion};
use foldmotion_record::{LineStyle, Marks, Pose, Provenance, StripOptions, Style, View, strip};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (source, name) = (arguments.next(), arguments.next());
    let (Some(source), Some(name)) = (source, name) else {
        return Err("motion.fold and the name of the figure are needed".into());
    };
    let (mut times, mut options) = (Vec::new(), StripOptions::default());
    options.unit = "h".to_owned();
    while let Some(argument) = arguments.next() {
        match &argument[..] {
            "--grey" => {
                options.style = Style::grey();
                options.lines = LineStyle::Dashed;
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
    let poses: Vec<Pose<'_>> = times
        .into_iter()
        .map(|time| Pose::at(&motion, &marks, time))
        .collect();
    let drawing = strip(&motion.sheet, &poses, &options)?.with_provenance(Provenance {
        title: format!("States of {source}"),
        producer: format!("foldmotion {}", env!("CARGO_PKG_VERSION")),
        ..Provenance::default()
    });
    fs::write(format!("{name}.svg"), drawing.svg()?)?;
    fs::write(format!("{name}.pdf"), drawing.pdf()?)?;
    Ok(())
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
