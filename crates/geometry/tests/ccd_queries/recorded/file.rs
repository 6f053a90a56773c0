//! Reads files of queries.
//!
//! A query has eight lines: its four vertices at t = 0, then at t = 1. A line is x, y, z, each as numerator and
//! denominator, and 1 if the features meet, otherwise 0. Vertex–face: v, f0, f1, f2; edge–edge: ea0, ea1, eb0, eb1.

use std::{error::Error, fmt, fs, path::Path};

use glam::DVec3;
use num_bigint::BigInt;

use super::ratio::nearest;
use crate::oracle::contact::Query;

/// The number of lines of a query.
const LINES: usize = 8;

/// The features of the queries in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Features {
    VertexFace,
    EdgeEdge,
}

/// A query with its truth.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Recorded {
    /// The number of its first line, from 1.
    pub(crate) line: usize,
    pub(crate) query: Query,
    /// Whether the features meet, according to the file.
    pub(crate) meets: bool,
    /// Whether a coordinate is not an f64 and was rounded to the nearest.
    pub(crate) is_rounded: bool,
}

/// The queries of a file.
#[derive(Debug)]
pub(crate) struct QueryFile {
    pub(crate) name: String,
    pub(crate) queries: Vec<Recorded>,
}

/// Why a file cannot be read.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Malformed {
    /// The number of the line, from 1.
    pub(crate) line: usize,
    pub(crate) reason: &'static str,
}

impl fmt::Display for Malformed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.reason)
    }
}

impl Error for Malformed {}

impl Features {
    /// The features according to the name of a file; `None` if it is not a file of queries.
    fn of(name: &str) -> Option<Self> {
        if name.ends_with("vertex-face.csv") {
            Some(Self::VertexFace)
        } else if name.ends_with("edge-edge.csv") {
            Some(Self::EdgeEdge)
        } else {
            None
        }
    }
}

/// The files of queries in a folder, by name: `*vertex-face.csv` and `*edge-edge.csv`.
pub(crate) fn read_folder(folder: &Path) -> Result<Vec<QueryFile>, Box<dyn Error>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().and_then(|name| name.to_str());
        let Some((name, features)) = name.and_then(|n| Some((n, Features::of(n)?))) else {
            continue;
        };
        let queries = parse(&fs::read_to_string(&path)?, features);
        let queries = queries.map_err(|malformed| format!("{name}, {malformed}"))?;
        let name = name.to_owned();
        files.push(QueryFile { name, queries });
    }
    files.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(files)
}

/// Parses the queries of a text.
pub(crate) fn parse(text: &str, features: Features) -> Result<Vec<Recorded>, Malformed> {
    let mut corners = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let malformed = |reason| Malformed { line: index + 1, reason };
        corners.push(Corner::parse(line).map_err(malformed)?);
    }
    let query = |(index, corners): (usize, &[Corner])| {
        let malformed = |reason| Malformed { line: index * LINES + 1, reason };
        let corners: &[Corner; LINES] =
            corners.try_into().map_err(|_| malformed("a query of fewer than 8 lines"))?;
        if corners.iter().any(|c| c.meets != corners[0].meets) {
            return Err(malformed("the lines of the query differ in its truth"));
        }
        let path = |k: usize| [corners[k].position, corners[k + 4].position];
        let [p, q, r, s] = [path(0), path(1), path(2), path(3)];
        Ok(Recorded {
            line: index * LINES + 1,
            query: match features {
                Features::VertexFace => Query::VertexFacet(p, [q, r, s]),
                Features::EdgeEdge => Query::EdgeEdge([p, q], [r, s]),
            },
            meets: corners[0].meets,
            is_rounded: corners.iter().any(|c| c.is_rounded),
        })
    };
    corners.chunks(LINES).enumerate().map(query).collect()
}

/// A line of a query.
struct Corner {
    position: DVec3,
    is_rounded: bool,
    meets: bool,
}

impl Corner {
    fn parse(line: &str) -> Result<Self, &'static str> {
        let cells: Vec<&str> = line.trim().split(',').map(str::trim).collect();
        let [x_n, x_d, y_n, y_d, z_n, z_d, truth] = cells[..] else {
            return Err("not 7 columns");
        };
        let whole = |cell: &str| cell.parse::<BigInt>().map_err(|_| "not a whole number");
        let ratio = |n, d| nearest(&whole(n)?, &whole(d)?).ok_or("no finite number");
        let [x, y, z] = [ratio(x_n, x_d)?, ratio(y_n, y_d)?, ratio(z_n, z_d)?];
        Ok(Self {
            position: DVec3::new(x.value, y.value, z.value),
            is_rounded: !(x.is_exact && y.is_exact && z.is_exact),
            meets: match truth {
                "0" => false,
                "1" => true,
                _ => return Err("the truth is neither 0 nor 1"),
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(truth: [u8; 8]) -> String {
        let row = |(k, truth): (usize, u8)| format!("{k},1,-{k},2,1,8388608,{truth}\n");
        truth.into_iter().enumerate().map(row).collect()
    }

    #[test]
    fn vertices_are_paired_with_themselves_at_the_end() {
        let text = rows([1; 8]) + &rows([0; 8]);
        let z = 1.0 / 8_388_608.0;
        let path = |k: u8| {
            let (k, end) = (f64::from(k), f64::from(k + 4));
            [DVec3::new(k, -k / 2.0, z), DVec3::new(end, -end / 2.0, z)]
        };
        let read = parse(&text, Features::VertexFace).unwrap();
        assert_eq!([read[0].line, read[1].line], [1, 9]);
        assert_eq!([read[0].meets, read[1].meets], [true, false]);
        let Query::VertexFacet(v, facet) = read[0].query else {
            panic!("{:?}", read[0]);
        };
        assert_eq!((v, facet), (path(0), [path(1), path(2), path(3)]));
        let read = parse(&text, Features::EdgeEdge).unwrap();
        let Query::EdgeEdge(a, b) = read[1].query else {
            panic!("{:?}", read[1]);
        };
        assert_eq!((a, b), ([path(0), path(1)], [path(2), path(3)]));
        assert!(read.iter().all(|r| !r.is_rounded));
    }

    #[test]
    fn a_coordinate_that_is_not_an_f64_is_rounded_and_marked() {
        let text = rows([0; 8]).replacen("\n3,1,", "\n1,3,", 1);
        let read = parse(&text, Features::EdgeEdge).unwrap();
        assert!(read[0].is_rounded);
    }

    #[test]
    fn malformed_files_are_refused_with_the_line() {
        let refused = |text: &str| {
            let malformed = parse(text, Features::EdgeEdge).unwrap_err();
            (malformed.line, malformed.reason)
        };
        let sound = rows([0; 8]);
        let short = sound.lines().take(7).collect::<Vec<_>>().join("\n");
        assert_eq!(refused(&short), (1, "a query of fewer than 8 lines"));
        let torn = rows([0, 0, 0, 1, 0, 0, 0, 0]);
        let differ = (9, "the lines of the query differ in its truth");
        assert_eq!(refused(&(sound.clone() + &torn)), differ);
        let with = |cell: &str| sound.replacen("\n2,1,", &format!("\n{cell}"), 1);
        assert_eq!(refused(&with("2,0,")), (3, "no finite number"));
        assert_eq!(refused(&with("2.5,1,")), (3, "not a whole number"));
        assert_eq!(refused(&with("2,1,1,")), (3, "not 7 columns"));
        let truth = rows([2; 8]);
        assert_eq!(refused(&truth), (1, "the truth is neither 0 nor 1"));
    }
}
