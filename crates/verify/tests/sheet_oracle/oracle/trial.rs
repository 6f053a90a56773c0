//! Tests of both proofs: their answers compared with the truth, counted by class.

use std::fmt;

use foldmotion_check::{CollisionOptions, CollisionReport, Verdict, collisions};
use foldmotion_pattern::Motion;
use foldmotion_verify::{Verification, verify};
use rayon::prelude::*;

use super::{class::Class, scene::Truth, yardstick::shows_crossing};

/// The results for a scene.
#[derive(Debug, Clone)]
pub(crate) struct Trial {
    pub(crate) number: u64,
    pub(crate) truth: Truth,
    /// The verdict; `None` if the motion was refused.
    pub(crate) verdict: Option<Verdict>,
    pub(crate) is_right: bool,
    /// Whether the second proof verifies the report, refutes it, or leaves something open.
    pub(crate) verified: Option<Verified>,
    /// Whether the report without its penetrations is refuted by more than counts.
    pub(crate) tampering_found: Option<bool>,
    /// The smallest separation, stated and true.
    pub(crate) separation: Option<[f64; 2]>,
    pub(crate) shows_crossing: bool,
    pub(crate) triangles: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Verified {
    Proved,
    Refuted,
    Unproved,
}

/// The motion of a scene and its truth.
pub(crate) fn motion_of(class: Class, number: u64) -> (Motion, Truth, Option<f64>) {
    let mut random = class.random(number);
    let scene = class.scene(&mut random);
    let is_plain = random.index(3) == 0;
    let motion = if is_plain { scene.motion() } else { scene.varied(&mut random) };
    (motion, scene.truth, scene.separation)
}

/// Whether a verdict agrees with the truth; undecided never does.
pub(crate) fn is_right(truth: Truth, verdict: Verdict) -> bool {
    match truth {
        Truth::Penetrating => verdict == Verdict::Penetrating,
        Truth::Touching => verdict == Verdict::Touching,
        Truth::Free => verdict == Verdict::Free,
        Truth::NotThrough => matches!(verdict, Verdict::Free | Verdict::Touching),
        Truth::Open => verdict != Verdict::Undecided,
    }
}

/// The report with its penetrations removed.
fn without_penetrations(report: &CollisionReport) -> CollisionReport {
    CollisionReport {
        verdict: Verdict::Touching,
        first: None,
        penetrations: Vec::new(),
        ..report.clone()
    }
}

/// Whether the second proof finds the removed penetration, and not only the wrong counts.
fn is_found(verification: &Verification) -> bool {
    let is_count = |field: &str| {
        ["pairs_tested", "decided_by", "touching_pairs", "clusters", "verdict"]
            .iter()
            .any(|count| field.starts_with(count))
    };
    verification.refuted.iter().any(|refutation| !is_count(&refutation.field))
}

/// Tests both proofs on a scene.
pub(crate) fn try_scene(class: Class, number: u64) -> Trial {
    let (motion, truth, separation) = motion_of(class, number);
    let mut random = class.random(!number);
    let mut trial = Trial {
        number,
        truth,
        verdict: None,
        is_right: false,
        verified: None,
        tampering_found: None,
        separation: None,
        shows_crossing: shows_crossing(&motion, &mut random),
        triangles: motion.sheet.faces.len(),
    };
    let Ok(report) = collisions(&motion, &CollisionOptions::default(), &|_| true) else {
        return trial;
    };
    trial.verdict = Some(report.verdict);
    trial.is_right = is_right(truth, report.verdict);
    trial.separation =
        separation.zip(report.min_separation).map(|(truth, stated)| [stated.distance, truth]);
    let verification = verify(&motion, &report);
    trial.verified = Some(if verification.is_verified() {
        Verified::Proved
    } else if verification.refuted.is_empty() {
        Verified::Unproved
    } else {
        Verified::Refuted
    });
    if truth == Truth::Penetrating {
        trial.tampering_found = Some(is_found(&verify(&motion, &without_penetrations(&report))));
    }
    trial
}

/// The results for the scenes of a class.
#[derive(Debug, Clone, Default)]
pub(crate) struct Tally {
    pub(crate) sheets: u64,
    /// The number of scenes whose truth is penetrating, touching, free, not through, open.
    pub(crate) truths: [u64; 5],
    /// The number of verdicts: penetrating, touching, free, undecided, refused.
    pub(crate) verdicts: [u64; 5],
    /// Scenes that penetrate but have another verdict.
    pub(crate) missed: Vec<u64>,
    /// Scenes that do not penetrate but have that verdict.
    pub(crate) false_alarms: Vec<u64>,
    /// Scenes that are free but called touching, or the other way round.
    pub(crate) wrong_nearness: Vec<u64>,
    pub(crate) undecided: Vec<u64>,
    /// Scenes with a right report that the second proof refutes; or leaves unproved.
    pub(crate) refuted: Vec<u64>,
    pub(crate) unproved: Vec<u64>,
    /// Scenes with a wrong report that the second proof verifies.
    pub(crate) wrong_verified: Vec<u64>,
    /// Scenes whose removed penetrations were not found.
    pub(crate) tampering_passed: Vec<u64>,
    /// Scenes whose stated separation is above the truth; or below it by more than stated.
    pub(crate) separation_high: Vec<u64>,
    pub(crate) separation_low: Vec<u64>,
    /// The number of crossings that the yardstick shows: of penetrating scenes, of others, of free ones.
    pub(crate) shown: [u64; 3],
    pub(crate) shown_free: Vec<u64>,
    pub(crate) most_triangles: usize,
}

impl Tally {
    fn count(&mut self, trial: &Trial) {
        let number = trial.number;
        let at = match trial.truth {
            Truth::Penetrating => 0,
            Truth::Touching => 1,
            Truth::Free => 2,
            Truth::NotThrough => 3,
            Truth::Open => 4,
        };
        self.sheets += 1;
        self.truths[at] += 1;
        self.most_triangles = self.most_triangles.max(trial.triangles);
        self.count_verdict(trial);
        match trial.verified {
            Some(Verified::Refuted) if trial.is_right => self.refuted.push(number),
            Some(Verified::Unproved) if trial.is_right => self.unproved.push(number),
            Some(Verified::Proved) if !trial.is_right => self.wrong_verified.push(number),
            _ => {}
        }
        if trial.tampering_found == Some(false) {
            self.tampering_passed.push(number);
        }
        if let Some([stated, truth]) = trial.separation {
            if stated > truth + 1e-9 {
                self.separation_high.push(number);
            } else if stated < truth - 1.1e-8 - 1.1e-4 * truth {
                self.separation_low.push(number);
            }
        }
        if trial.shows_crossing {
            self.shown[[0, 1, 2, 1, 1][at]] += 1;
            if at == 2 {
                self.shown_free.push(number);
            }
        }
    }

    fn count_verdict(&mut self, trial: &Trial) {
        let number = trial.number;
        let at = match trial.verdict {
            Some(Verdict::Penetrating) => 0,
            Some(Verdict::Touching) => 1,
            Some(Verdict::Free) => 2,
            Some(Verdict::Undecided) => 3,
            None => 4,
        };
        self.verdicts[at] += 1;
        match (trial.truth, trial.verdict) {
            _ if trial.is_right => {}
            (_, None | Some(Verdict::Undecided)) => self.undecided.push(number),
            (Truth::Penetrating, _) => self.missed.push(number),
            (_, Some(Verdict::Penetrating)) => self.false_alarms.push(number),
            _ => self.wrong_nearness.push(number),
        }
    }

    pub(crate) fn add(&mut self, other: &Self) {
        self.sheets += other.sheets;
        self.most_triangles = self.most_triangles.max(other.most_triangles);
        let sums = [
            (&mut self.truths[..], &other.truths[..]),
            (&mut self.verdicts, &other.verdicts),
            (&mut self.shown, &other.shown),
        ];
        for (sum, more) in sums {
            sum.iter_mut().zip(more).for_each(|(s, m)| *s += m);
        }
        let lists = self.lists_mut().into_iter().zip(other.lists());
        lists.for_each(|(list, (_, more))| list.extend(more));
    }

    fn lists_mut(&mut self) -> [&mut Vec<u64>; 11] {
        [
            &mut self.missed,
            &mut self.false_alarms,
            &mut self.wrong_nearness,
            &mut self.undecided,
            &mut self.refuted,
            &mut self.unproved,
            &mut self.wrong_verified,
            &mut self.tampering_passed,
            &mut self.separation_high,
            &mut self.separation_low,
            &mut self.shown_free,
        ]
    }

    /// The numbers of the scenes with errors, by kind of error.
    pub(crate) fn lists(&self) -> [(&'static str, &Vec<u64>); 11] {
        [
            ("missed", &self.missed),
            ("false alarm", &self.false_alarms),
            ("wrong nearness", &self.wrong_nearness),
            ("undecided", &self.undecided),
            ("right but refuted", &self.refuted),
            ("right but unproved", &self.unproved),
            ("wrong but verified", &self.wrong_verified),
            ("tampering passed", &self.tampering_passed),
            ("separation too large", &self.separation_high),
            ("separation too small", &self.separation_low),
            ("yardstick shows free crossing", &self.shown_free),
        ]
    }
}

/// Tests scenes `0..count` of a class.
pub(crate) fn try_class(class: Class, count: u64) -> Tally {
    let trials: Vec<Trial> =
        (0..count).into_par_iter().map(|number| try_scene(class, number)).collect();
    let mut tally = Tally::default();
    for trial in &trials {
        tally.count(trial);
    }
    tally
}

/// The meaning of the columns of a [`Tally`].
pub(crate) const HEADER: &str = "\
class            sheets | truth:  pen touch  free  n.t. open | verdict: pen touch  free undec error \
| missed alarm near undec | refut unpro w.ver tampr | sep> sep< | shown pen other free";

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [p, t, r, n, o] = self.truths;
        write!(f, "{:>6} | {p:>11} {t:>5} {r:>5} {n:>5} {o:>4} |", self.sheets)?;
        let [p, t, r, u, e] = self.verdicts;
        write!(f, " {p:>12} {t:>5} {r:>5} {u:>5} {e:>5} |")?;
        let n = self.lists().map(|(_, list)| list.len());
        write!(f, " {:>6} {:>5} {:>4} {:>5} |", n[0], n[1], n[2], n[3])?;
        write!(f, " {:>5} {:>5} {:>5} {:>5} |", n[4], n[5], n[6], n[7])?;
        write!(f, " {:>4} {:>4} |", n[8], n[9])?;
        let [p, o, r] = self.shown;
        write!(f, " {p:>9} {o:>5} {r:>4}")
    }
}
