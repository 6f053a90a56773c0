//! The report as a table on the terminal.

use std::fmt::Write as _;

use foldmotion_geometry::Number;

use super::{OutcomeKind, Report};

impl Report {
    /// The table for the terminal.
    pub fn table(&self) -> String {
        let mut out = String::new();
        let unit = &self.length_unit;
        // Writing into a string cannot fail.
        let _ = writeln!(out, "{}\n\n{}", self.outcome.line(), self.title);
        self.write_subject(&mut out);
        let _ = writeln!(
            out,
            "pattern: {}developable, {}locally flat-foldable; {} vertices, {} facets",
            if self.pattern.developable { "" } else { "not " },
            if self.pattern.flat_foldable { "" } else { "not " },
            self.pattern.vertex_count,
            self.pattern.facet_count
        );
        self.write_box(&mut out);
        if let Some(map) = &self.map {
            let _ = writeln!(out, "{}", map.line(unit));
        }
        let _ = writeln!(
            out,
            "\nstage    peak strain   mean strain   facet bending   converged   residual"
        );
        for s in &self.stages {
            let _ = writeln!(
                out,
                "{:<8} {:>10.3} %  {:>10.4} %  {:>11.2} deg   {:<9}   {:.2}",
                s.name.name(),
                s.peak_strain * 100.0,
                s.mean_strain * 100.0,
                s.peak_facet_bending_deg,
                if s.converged { "yes" } else { "no" },
                Number(s.residual)
            );
        }
        let _ = writeln!(out, "{}", self.fold_angles.words());
        for symmetry in &self.symmetry {
            let _ = writeln!(out, "{}", symmetry.line());
        }
        let _ = writeln!(
            out,
            "strain is |l/l0 - 1|: its peak over the edges and frames of a stage, its mean over both; residual is the \
             largest unbalanced force left"
        );
        if let Some(stop) = &self.stop {
            let _ = writeln!(out, "{}", stop.line());
        }
        for s in self.stages.iter().filter(|s| !s.snaps.is_empty()) {
            let _ = writeln!(out, "{}", s.snap_line());
        }
        if let Some(layers) = &self.layer_order {
            let end = self.path.end_t;
            let _ = writeln!(out, "{}; the motion got as far as t = {end:.4}", layers.line());
        }
        self.write_verdict(&mut out);
        self.write_path(&mut out);
        let e = &self.engine;
        if let (Some(gap), Some(end)) = (e.contact_gap, e.final_gap) {
            let unit = self.tolerance_unit();
            let (gap, end) = (format!("{:.3}", Number(gap)), format!("{:.3}", Number(end)));
            let at_end = if gap == end {
                String::new()
            } else {
                format!(", {end} {unit} in the last state")
            };
            let _ = writeln!(out, "layers keep {gap} {unit} apart{at_end}");
        }
        let _ = writeln!(
            out,
            "engine {}: {} steps in {:.2} s, {} thread(s), {}; check {:.2} s, record {:.2} s",
            e.name.name(),
            e.steps,
            e.seconds,
            e.threads,
            e.device,
            self.seconds.check,
            self.seconds.record
        );
        out
    }

    /// The sheet that was folded.
    fn write_subject(&self, out: &mut String) {
        let unit = &self.length_unit;
        if let Some(import) = &self.import {
            out.push_str(&import.lines(unit));
        }
        if let (Some(case), Some(rows), Some(columns), Some(of_unit), Some(division)) =
            (&self.case, self.rows, self.columns, self.unit, &self.division)
        {
            let _ = writeln!(
                out,
                "case {case}, {rows} x {columns} units, w = {:.6} {unit}, h = {:.6} {unit}; row heights equal to within |R_max| = {:.2} after {} iterations",
                Number(of_unit.width),
                Number(of_unit.height),
                Number(division.max_residual),
                division.iterations
            );
        }
        if let Some(unfold) = &self.unfold {
            let _ = writeln!(out, "{}", unfold.line());
        }
    }

    /// The unit of tolerances and separations.
    fn tolerance_unit(&self) -> &'static str {
        if self.import.is_some() { "mean edges" } else { "h" }
    }

    fn write_box(&self, out: &mut String) {
        let unit = &self.length_unit;
        let title = if self.outcome.is_at_end() {
            "compact box".to_owned()
        } else {
            format!("at t={:.4}", self.path.end_t)
        };
        let _ = writeln!(
            out,
            "\n{title:<18} x            y            z            area         volume"
        );
        let row = |name: &str, extents: [f64; 3], area: f64, volume: f64| {
            let mut line = format!("{name:<12}");
            for value in extents.into_iter().chain([area, volume]) {
                let _ = write!(line, " {value:>12.6}");
            }
            line
        };
        let c = &self.compact;
        let _ = writeln!(out, "{}  ({unit})", row("measured", c.extents, c.area, c.volume));
        if let Some(f) = &self.closed_form {
            let _ = writeln!(out, "{}", row("closed form", f.extents, f.area, f.volume));
            if let Some(f) = &self.thick_closed_form {
                let _ = writeln!(out, "{}", row("with layers", f.extents, f.area, f.volume));
            }
        } else if self.import.is_none() {
            let _ = writeln!(out, "closed form  none for an unmodified rectangle");
        }
        if let Some(e) = &c.relative_error {
            let name = if self.thick_closed_form.is_some() { "thick error" } else { "error" };
            let mut line = format!("{name:<12}");
            for value in e.extents.into_iter().chain([e.area, e.volume]) {
                let _ = write!(line, " {:>12}", format!("{:.2}", Number(value)));
            }
            let _ = writeln!(out, "{line}");
            let absolute = [("x", 0), ("y", 1), ("z", 2)].map(|(name, axis)| {
                let compared = self.thick_closed_form.or(self.closed_form);
                let is_flat = compared.is_some_and(|f| f.extents[axis] == 0.0);
                if is_flat { name } else { "" }
            });
            if absolute.concat() != "" {
                let _ = writeln!(
                    out,
                    "(errors of {} and of the area or volume with a factor of 0 are absolute, in h, h\u{b2}, h\u{b3}, since the closed form is 0)",
                    absolute.concat()
                );
            }
        }
        if let Some(words) = &c.explanation {
            let _ = writeln!(out, "{words}");
        }
        if let Some(rms) = c.rms_to_exact {
            let _ = writeln!(
                out,
                "vertices lie {:.2} h (rms) from the exact compact state",
                Number(rms)
            );
        }
    }

    fn write_path(&self, out: &mut String) {
        let p = &self.path;
        let refined = match p.refinements {
            0 => String::new(),
            n => format!(
                ", {} of them added in {n} further run(s) to decide between frames",
                p.added_frames
            ),
        };
        let straying = match (p.straying, p.straying_t) {
            (Some(stray), Some(t)) => format!(
                "straight paths between them stray from the computed motion by about {:.2} {} at most (t = {t:.4})",
                Number(stray),
                self.tolerance_unit()
            ),
            _ => "how far straight paths between them stray is unknown: too few frames".to_owned(),
        };
        let _ = writeln!(out, "{} frames{refined}; {straying}", p.frames);
    }

    /// The part of the motion that the verdict is about, unless it is the whole motion.
    fn part_judged(&self) -> &'static str {
        match self.outcome.kind {
            OutcomeKind::Jammed | OutcomeKind::Stopped => " of the motion up to its last state",
            _ => "",
        }
    }

    fn write_verdict(&self, out: &mut String) {
        let c = &self.collision;
        let h = self.tolerance_unit();
        let _ = writeln!(
            out,
            "\ncollisions{}: {} (tolerance {} {h}; {} pairs tested; {} touch, {} penetrate)",
            self.part_judged(),
            c.verdict,
            Number(c.tolerance),
            c.pairs_tested,
            c.touching_pairs,
            c.penetrating_pairs
        );
        if let Some(stopped) = &c.stopped {
            let _ = writeln!(out, "{}", stopped.line());
        }
        if let (Some(d), Some(t)) = (c.min_separation, c.min_separation_t) {
            let _ = writeln!(
                out,
                "smallest separation of facets that share no vertex: {:.4} {h} at t = {t:.4}",
                Number(d)
            );
        }
        if let Some(first) = &c.first {
            let _ = writeln!(out, "first at {}", first.line(h));
        }
        if let Some(within) = c.first_within_unit.as_ref().filter(|w| c.first.as_ref() != Some(w)) {
            let _ = writeln!(out, "first within one unit at {}", within.line(h));
        }
    }
}
