//! Patterns drawn for the tests.

use foldmotion_pattern::{
    FlatFolding, FoundLayers, ImportOptions, ImportedPattern, LayerError, LayerOptions,
    import_fold, import_svg,
};
use serde_json::{Value, json};

/// A sheet cut into rectangles by lines at `xs` and `ys`. Facets are numbered row by row from the lower left.
///
/// `upright`: the letter of the crease at the left of facet (column, row), `level`: of the crease below it.
pub(crate) fn grid(
    xs: &[f64],
    ys: &[f64],
    upright: &dyn Fn(usize, usize) -> char,
    level: &dyn Fn(usize, usize) -> char,
) -> Value {
    let [columns, rows] = [xs.len() - 1, ys.len() - 1];
    let vertex = |i: usize, j: usize| j * xs.len() + i;
    let vertices: Vec<Value> =
        ys.iter().flat_map(|y| xs.iter().map(move |x| json!([x, y]))).collect();
    let mut edges = Vec::new();
    let mut letters = Vec::new();
    let mut faces = Vec::new();
    for j in 0..=rows {
        for i in 0..=columns {
            if j < rows {
                edges.push([vertex(i, j), vertex(i, j + 1)]);
                let is_border = i == 0 || i == columns;
                letters.push(if is_border { 'B' } else { upright(i, j) }.to_string());
            }
            if i < columns {
                edges.push([vertex(i, j), vertex(i + 1, j)]);
                let is_border = j == 0 || j == rows;
                letters.push(if is_border { 'B' } else { level(i, j) }.to_string());
            }
            if i < columns && j < rows {
                let corners =
                    [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
                faces.push(corners);
            }
        }
    }
    json!({
        "file_spec": 1.2, "vertices_coords": vertices, "edges_vertices": edges,
        "edges_assignment": letters, "faces_vertices": faces,
    })
}

/// A strip of pieces of these lengths; `letters`: its creases in order.
pub(crate) fn strip(lengths: &[f64], letters: &str) -> Value {
    let mut xs = vec![0.0];
    xs.extend(lengths.iter().scan(0.0, |sum, length| {
        *sum += length;
        Some(*sum)
    }));
    let letters: Vec<char> = letters.chars().collect();
    grid(&xs, &[0.0, 1.0], &|i, _| letters[i - 1], &|_, _| 'B')
}

/// Lines 0, 1, …, `n`.
pub(crate) fn lines(n: usize) -> Vec<f64> {
    (0..=n).map(|k| k as f64).collect()
}

pub(crate) fn of_fold(file: &Value) -> ImportedPattern {
    import_fold(file.to_string().as_bytes(), &ImportOptions::default()).unwrap()
}

/// Lines of an SVG: (letter, x1, y1, x2, y2), y upwards.
pub(crate) fn of_lines(lines: &[(char, f64, f64, f64, f64)]) -> ImportedPattern {
    let mut text = "<svg xmlns=\"http://www.w3.org/2000/svg\">".to_owned();
    for (letter, x1, y1, x2, y2) in lines {
        let stroke = match letter {
            'M' => "#f00",
            'V' => "#00f",
            'U' => "#f0f",
            _ => "#000",
        };
        let (y1, y2) = (-y1, -y2);
        let line = format!(r#"<line stroke="{stroke}" x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}"/>"#);
        text.push_str(&line);
    }
    import_svg((text + "</svg>").as_bytes(), &ImportOptions::default()).unwrap()
}

pub(crate) fn find(imported: &ImportedPattern) -> Result<FlatFolding, LayerError> {
    let options = LayerOptions { solutions: 1_000_000, ..LayerOptions::default() };
    FlatFolding::find(imported, &imported.targets, &options)
}

/// How many orders a pattern has.
pub(crate) fn count(imported: &ImportedPattern) -> u64 {
    match find(imported).unwrap().found {
        FoundLayers::Order { solutions, .. } => solutions.unwrap(),
        FoundLayers::None { .. } => 0,
        FoundLayers::Undecided { steps } => panic!("undecided after {steps} steps"),
    }
}

/// The facets that have no order.
pub(crate) fn contradicting(imported: &ImportedPattern) -> Vec<u32> {
    match find(imported).unwrap().found {
        FoundLayers::None { facets, given } => {
            assert!(given.is_empty());
            facets
        }
        other => panic!("expected no order, found {other:?}"),
    }
}
