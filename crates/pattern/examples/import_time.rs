//! How long importing a Miura tessellation takes, by the number of its edges.

#![expect(clippy::print_stdout, reason = "prints a table")]

use std::fmt::Write as _;
use std::time::Instant;

use foldmotion_pattern::{ImportError, ImportOptions, import_fold, import_svg};

/// The lines of a tessellation of n × n parallelograms: ends and letter.
fn miura(n: usize) -> Vec<([[f64; 2]; 2], char)> {
    let at = |i: usize, j: usize| {
        let shift = if j % 2 == 1 { 0.5 } else { 0.0 };
        [i as f64 * 1.5 + shift, j as f64 * 1.25]
    };
    let mut lines = Vec::new();
    for i in 0..=n {
        for j in 0..n {
            let is_edge = i == 0 || i == n;
            let zigzag = if is_edge { 'B' } else { ['M', 'V'][i % 2] };
            lines.push(([at(i, j), at(i, j + 1)], zigzag));
            let across = if is_edge { 'B' } else { ['V', 'M'][(i + j) % 2] };
            lines.push(([at(j, i), at(j + 1, i)], across));
        }
    }
    lines
}

/// The lines with every inner end moved a little to and fro.
fn careless(lines: &[([[f64; 2]; 2], char)]) -> Vec<([[f64; 2]; 2], char)> {
    let mut random = fastrand::Rng::with_seed(1);
    let mut moved = |p: [f64; 2]| p.map(|x| x + 0.02 * (random.f64() - 0.5));
    lines
        .iter()
        .map(|&(ends, letter)| (if letter == 'B' { ends } else { ends.map(&mut moved) }, letter))
        .collect()
}

fn svg(lines: &[([[f64; 2]; 2], char)]) -> String {
    let mut text = "<svg xmlns=\"http://www.w3.org/2000/svg\">\n".to_owned();
    for ([a, b], letter) in lines {
        let colour = match letter {
            'B' => "#000",
            'M' => "#f00",
            _ => "#00f",
        };
        let _ = writeln!(
            text,
            "<path d=\"M{} {}L{} {}\" stroke=\"{colour}\"/>",
            a[0], a[1], b[0], b[1]
        );
    }
    text + "</svg>"
}

fn fold(lines: &[([[f64; 2]; 2], char)]) -> String {
    let points: Vec<[f64; 2]> = lines.iter().flat_map(|(ends, _)| *ends).collect();
    // The vertices as they are met first.
    let mut index = std::collections::BTreeMap::new();
    let mut vertices = Vec::new();
    let ends: Vec<usize> = points
        .iter()
        .map(|p| {
            *index.entry(p.map(f64::to_bits)).or_insert_with(|| {
                vertices.push(*p);
                vertices.len() - 1
            })
        })
        .collect();
    let edges: Vec<&[usize]> = ends.chunks(2).collect();
    let letters: Vec<String> = lines.iter().map(|(_, letter)| letter.to_string()).collect();
    serde_json::json!({
        "vertices_coords": vertices, "edges_vertices": edges, "edges_assignment": letters,
    })
    .to_string()
}

fn main() -> Result<(), ImportError> {
    println!("  edges  format           seconds  microseconds an edge");
    let options = ImportOptions::default();
    for n in [22, 50, 70, 100, 157] {
        let lines = miura(n);
        let texts = [
            ("SVG", svg(&lines)),
            ("SVG, careless", svg(&careless(&lines))),
            ("FOLD", fold(&lines)),
        ];
        for (format, text) in texts {
            let start = Instant::now();
            let imported = match format {
                "FOLD" => import_fold(text.as_bytes(), &options)?,
                _ => import_svg(text.as_bytes(), &options)?,
            };
            imported.check();
            let seconds = start.elapsed().as_secs_f64();
            let each = seconds * 1e6 / lines.len() as f64;
            println!("{:>7}  {format:<14} {seconds:>9.3}  {each:>8.2}", lines.len());
        }
    }
    Ok(())
}
