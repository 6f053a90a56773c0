//! Random sheets with slits, holes and split tips: whatever they do, with contact no facet passes through another.

use foldmotion_check::Verdict;
use foldmotion_random::Random;
use foldmotion_study::{SceneSource, Study};
use serde_json::{Value, json};

/// Sheets of the test.
const SHEETS: u64 = 240;

/// A grid of triangles, its inner vertices moved about, some of them missing; inner edges are mountains, valleys,
/// joined facets or slits at random.
fn random_sheet(seed: u64) -> Value {
    let mut random = Random::new(seed);
    let side = 3 + random.index(2);
    let mut at = Vec::new();
    for row in 0..=side {
        for column in 0..=side {
            let inside = |k: usize| k > 0 && k < side;
            let move_by = |is_free: bool, random: &mut Random| {
                if is_free { 0.3 * random.number() } else { 0.0 }
            };
            let x = column as f64 + move_by(inside(column), &mut random);
            let y = row as f64 + move_by(inside(row), &mut random);
            at.push([x, y]);
        }
    }
    let mut faces: Vec<[usize; 3]> = Vec::new();
    for row in 0..side {
        for column in 0..side {
            let a = row * (side + 1) + column;
            let [a, b, c, d] = [a, a + 1, a + side + 2, a + side + 1];
            faces.extend(if random.index(2) == 0 {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, b, d], [b, c, d]]
            });
        }
    }
    if random.index(3) == 0 {
        faces.remove(random.index(faces.len()));
    }
    file_of(&at, &faces, &mut random)
}

/// The FOLD file of a triangulation.
fn file_of(at: &[[f64; 2]], faces: &[[usize; 3]], random: &mut Random) -> Value {
    let mut edges: Vec<([usize; 2], Vec<usize>)> = Vec::new();
    for (face, &[a, b, c]) in faces.iter().enumerate() {
        for side in [[a, b], [b, c], [c, a]] {
            let side = [side[0].min(side[1]), side[0].max(side[1])];
            match edges.iter_mut().find(|(edge, _)| *edge == side) {
                Some((_, beside)) => beside.push(face),
                None => edges.push((side, vec![face])),
            }
        }
    }
    let mut letter = |beside: &[usize]| match random.index(12) {
        _ if beside.len() == 1 => "B",
        0..4 => "M",
        4..8 => "V",
        8..10 => "F",
        _ => "C",
    };
    let mut letters: Vec<&str> = edges.iter().map(|(_, beside)| letter(beside)).collect();
    join_pieces(&edges, &mut letters, faces.len());
    let edges: Vec<[usize; 2]> = edges.into_iter().map(|(edge, _)| edge).collect();
    json!({
        "file_spec": 1.2,
        "frame_classes": ["creasePattern"],
        "vertices_coords": at,
        "edges_vertices": edges,
        "edges_assignment": letters,
        "faces_vertices": faces,
    })
}

/// Makes valleys of the slits that would cut the sheet to pieces.
fn join_pieces(edges: &[([usize; 2], Vec<usize>)], letters: &mut [&str], faces: usize) {
    let mut piece: Vec<usize> = (0..faces).collect();
    let mut join = |beside: &[usize]| {
        let [from, to] = [piece[beside[0]], piece[beside[1]]];
        piece.iter_mut().filter(|p| **p == from).for_each(|p| *p = to);
        from != to
    };
    let is_inner = |beside: &[usize]| beside.len() == 2;
    for ((_, beside), letter) in edges.iter().zip(&*letters) {
        if is_inner(beside) && *letter != "C" {
            join(beside);
        }
    }
    for ((_, beside), letter) in edges.iter().zip(letters) {
        if is_inner(beside) && *letter == "C" && join(beside) {
            *letter = "V";
        }
    }
}

/// The verdict on the folding of a sheet, or why it cannot be folded.
fn verdict(file: &Value, settings: &[&str]) -> Result<Verdict, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sheet.fold");
    std::fs::write(&path, file.to_string()).unwrap();
    let mut source = SceneSource::read(&path).map_err(|e| e.to_string())?;
    for setting in settings {
        source.set(setting).unwrap();
    }
    let study = Study::resolve(&source).map_err(|e| e.to_string())?;
    let folded = study.compute(&|_, _| true).map_err(|e| e.to_string())?;
    Ok(study.report_of(&folded).collision.verdict)
}

const FEW: [&str; 2] = ["motion.frames=24", "motion.budget=\"1500 steps\""];

#[test]
fn no_random_cut_sheet_passes_through_itself_with_contact() {
    let (mut folded, mut refused, mut penetrating) = (0, Vec::new(), Vec::new());
    let sheets = std::env::var("CUT_SHEETS").map_or(SHEETS, |n| n.parse().unwrap());
    for seed in 0..sheets {
        match verdict(&random_sheet(seed), &FEW) {
            Ok(Verdict::Penetrating) => penetrating.push(seed),
            Ok(_) => folded += 1,
            Err(why) => refused.push((seed, why)),
        }
    }
    assert!(penetrating.is_empty(), "sheets {penetrating:?}");
    // A sheet whose missing triangle cuts it to pieces is refused, and one with a triangle too thin.
    assert!(folded >= SHEETS * 9 / 10, "only {folded} folded: {refused:?}");
}

#[test]
fn without_contact_some_of_them_do() {
    let without = [&FEW[..], &["motion.contact=false"]].concat();
    let passes = |seed| verdict(&random_sheet(seed), &without) == Ok(Verdict::Penetrating);
    assert!((0..20).any(passes));
}
