//! The page of a folder of results, from its motion.fold and, where they are there, report.json and certificate.json:
//!
//! `cargo run --release --example page -- out/shelter-sii motion.html [--tolerance 1e-3]`

#![expect(clippy::print_stdout, reason = "a program says what it did")]

mod common;

use std::error::Error;
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::Path;

use foldmotion_pattern::{Assignment, Frame, Motion};
use foldmotion_record::{Curve, Marks, Page, PageOptions, Panel, Provenance, Values, page};

use crate::common::{read, strains};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (folder, name) = (arguments.next(), arguments.next());
    let (Some(folder), Some(name)) = (folder, name) else {
        return Err("a folder of results and the name of the page are needed".into());
    };
    let mut options = PageOptions::default();
    while let Some(argument) = arguments.next() {
        match &argument[..] {
            "--tolerance" => options.tolerance = arguments.next().unwrap_or_default().parse()?,
            other => return Err(format!("{other} is not known").into()),
        }
    }
    let folder = Path::new(&folder);
    let fold = folder.join("motion.fold");
    let motion = read(&fold.to_string_lossy())?;
    let text = |name| fs::read_to_string(folder.join(name)).ok();
    let (report, certificate) = (text("report.json"), text("certificate.json"));
    let marks = certificate.as_deref().map(marks).transpose()?;
    options.provenance = Provenance {
        title: title(report.as_deref()).unwrap_or_else(|| folder.display().to_string()),
        producer: format!("foldmotion {}", env!("CARGO_PKG_VERSION")),
        ..Provenance::default()
    };
    let values = [
        values(&motion, "strain, %", 1.0, |frame| {
            strains(&motion.sheet, &frame.positions)
        }),
        values(&motion, "facet bending, °", 10.0, |frame| {
            bending(&motion, frame)
        }),
    ];
    let keys = page(
        &Page {
            motion: &motion,
            marks: &marks.unwrap_or_default(),
            values: &values,
            panels: &values.each_ref().map(|values| panel(&motion, values)),
            report: report.as_deref(),
            certificate: certificate.as_deref(),
            fold: Some(&fs::read(&fold)?),
        },
        &options,
        BufWriter::new(File::create(&name)?),
    )?;
    println!(
        "{} of {} frames hold the motion within {:.1e}",
        keys.frames.len(),
        motion.frames.len(),
        keys.error
    );
    Ok(())
}

/// The triangles that penetrate each other, from then on.
fn marks(certificate: &str) -> Result<Marks, Box<dyn Error>> {
    let certificate: serde_json::Value = serde_json::from_str(certificate)?;
    let mut marks = Marks::default();
    for entry in certificate["penetrations"].as_array().into_iter().flatten() {
        let time = entry["t"].as_f64().unwrap_or_default();
        let triangles = entry["pair"]["triangles"].as_array().into_iter().flatten();
        for face in triangles.filter_map(serde_json::Value::as_u64) {
            marks.insert(u32::try_from(face)?, time, f64::MAX);
        }
    }
    Ok(marks)
}

fn title(report: Option<&str>) -> Option<String> {
    let report: serde_json::Value = serde_json::from_str(report?).ok()?;
    Some(report.get("title")?.as_str()?.to_owned())
}

fn values(motion: &Motion, title: &str, high: f64, of: impl Fn(&Frame) -> Vec<f64>) -> Values {
    Values {
        title: title.to_owned(),
        range: [0.0, high],
        frames: motion.frames.iter().map(of).collect(),
    }
}

/// How far the facet of each triangle is bent, degrees.
fn bending(motion: &Motion, frame: &Frame) -> Vec<f64> {
    let sheet = &motion.sheet;
    let mut facets = vec![0.0_f64; sheet.facets.len()];
    let angles = sheet.fold_angles(&frame.positions);
    for (edge, angle) in sheet.edges.iter().zip(angles) {
        if let (Assignment::Facet, Some(angle), Some(face)) =
            (edge.assignment, angle, edge.faces[0])
        {
            let facet = sheet.face_facets[face as usize] as usize;
            facets[facet] = facets[facet].max(angle.abs().to_degrees());
        }
    }
    sheet
        .face_facets
        .iter()
        .map(|&f| facets[f as usize])
        .collect()
}

/// The largest value over time.
fn panel(motion: &Motion, values: &Values) -> Panel {
    let points = motion.frames.iter().zip(&values.frames);
    let largest = |values: &Vec<f64>| values.iter().copied().fold(0.0, f64::max);
    Panel {
        title: if values.range[1] > 5.0 {
            "largest facet bending, degrees"
        } else {
            "largest strain, %"
        },
        is_logarithmic: false,
        curves: vec![Curve {
            name: "largest",
            points: points
                .map(|(frame, values)| (frame.time, largest(values)))
                .collect(),
        }],
    }
}
