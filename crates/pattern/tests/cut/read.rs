//! Small readers of the SVG and DXF files, and the sheets that are written.

use std::collections::BTreeMap;

use foldmotion_pattern::{Assignment, Case, Unit, UnitSheet};

/// A line as a file has it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ReadLine {
    /// Its group or layer, in small letters.
    pub(crate) layer: String,
    /// x and y of both ends.
    pub(crate) ends: [[f64; 2]; 2],
    /// Every attribute or group code.
    pub(crate) words: BTreeMap<String, String>,
}

impl ReadLine {
    pub(crate) fn length(&self) -> f64 {
        let [[x1, y1], [x2, y2]] = self.ends;
        (x2 - x1).hypot(y2 - y1)
    }
}

/// Attributes of a tag, between its name and its end.
fn attributes(tag: &str) -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    let mut rest = tag;
    while let Some((name, after)) = rest.split_once("=\"") {
        let (value, after) = after.split_once('"').unwrap();
        let name = name.trim().rsplit(' ').next().unwrap();
        assert!(found.insert(name.to_owned(), value.to_owned()).is_none(), "{tag}");
        rest = after;
    }
    found
}

/// The attributes of `<svg>` and every line with the group it stands in.
pub(crate) fn svg(text: &str) -> (BTreeMap<String, String>, Vec<ReadLine>) {
    let mut root = BTreeMap::new();
    let mut group = None;
    let mut lines = Vec::new();
    for tag in text.split('<').skip(1).map(|t| t.split('>').next().unwrap()) {
        let words = attributes(tag);
        assert!(!words.contains_key("transform") && !words.contains_key("style"), "{tag}");
        match tag.split(' ').next().unwrap() {
            "svg" => root = words,
            "g" => {
                assert!(group.is_none(), "groups do not nest");
                assert_eq!(words["inkscape:groupmode"], "layer");
                assert_eq!(words["inkscape:label"], words["id"]);
                group = Some(words["id"].clone());
            }
            "/g" => group = None,
            "line" => {
                let at = |name: &str| words[name].parse().unwrap();
                lines.push(ReadLine {
                    layer: group.clone().unwrap(),
                    ends: [[at("x1"), at("y1")], [at("x2"), at("y2")]],
                    words,
                });
            }
            _ => {}
        }
    }
    assert!(group.is_none() && text.ends_with("</svg>\n"));
    (root, lines)
}

/// Pairs of group code and value.
pub(crate) fn pairs(text: &str) -> Vec<(u16, String)> {
    let all: Vec<&str> = text.lines().collect();
    assert!(all.len().is_multiple_of(2), "codes and values come in pairs");
    let pair = |p: &[&str]| (p[0].parse().unwrap(), p[1].to_owned());
    all.chunks(2).map(pair).collect()
}

/// Every LINE of a DXF.
pub(crate) fn dxf(text: &str) -> Vec<ReadLine> {
    let pairs = pairs(text);
    assert_eq!(pairs.last().unwrap(), &(0, "EOF".to_owned()));
    let starts: Vec<usize> = (0..pairs.len()).filter(|&i| pairs[i].0 == 0).collect();
    let entities = starts.windows(2).map(|w| &pairs[w[0]..w[1]]);
    entities
        .filter(|entity| entity[0].1 == "LINE")
        .map(|entity| {
            let words: BTreeMap<String, String> =
                entity[1..].iter().map(|(code, value)| (code.to_string(), value.clone())).collect();
            let at = |code: &str| words[code].parse().unwrap();
            ReadLine {
                layer: words["8"].to_lowercase(),
                ends: [[at("10"), at("20")], [at("11"), at("21")]],
                words,
            }
        })
        .collect()
}

/// Count and total length of the lines of each layer.
pub(crate) fn totals(lines: &[ReadLine]) -> BTreeMap<String, (usize, f64)> {
    let mut totals: BTreeMap<String, (usize, f64)> = BTreeMap::new();
    for line in lines {
        let total = totals.entry(line.layer.clone()).or_default();
        total.0 += 1;
        total.1 += line.length();
    }
    totals
}

/// The name of the layer of an edge.
pub(crate) fn layer(assignment: Assignment) -> &'static str {
    match assignment {
        Assignment::Border => "cut",
        Assignment::Mountain => "mountain",
        Assignment::Valley => "valley",
        Assignment::Facet => "facet",
        Assignment::Free => "free",
    }
}

/// Sheets of every case, 7 × 5, in metres, with heights that are no short decimals.
pub(crate) fn sheets() -> Vec<UnitSheet> {
    let h = 1.0 / 3.0;
    let units = [
        Unit::new(Case::E, h, h, None, None),
        Unit::new(Case::T, 0.7 * h, h, None, None),
        Unit::new(Case::S, 1.6 * h, h, None, None),
        Unit::new(Case::SII, 1.6 * h, h, Some(0.7), None),
        Unit::new(Case::SII, 1.6 * h, h, Some(0.7), Some(0.0)),
        Unit::new(Case::Plain, 2.5 * h, h, None, None),
    ];
    units.map(|unit| UnitSheet::new(unit.unwrap(), 7, 5).unwrap()).to_vec()
}

/// Count and total length, mm, of the sheet's edges of each layer.
pub(crate) fn expected(units: &UnitSheet, scale: f64) -> BTreeMap<String, (usize, f64)> {
    let mut totals: BTreeMap<String, (usize, f64)> = BTreeMap::new();
    let vertices = &units.sheet.vertices;
    for edge in &units.sheet.edges {
        let [a, b] = edge.vertices.map(|v| vertices[v as usize]);
        let total = totals.entry(layer(edge.assignment).to_owned()).or_default();
        total.0 += 1;
        total.1 += a.distance(b) * scale;
    }
    totals
}
