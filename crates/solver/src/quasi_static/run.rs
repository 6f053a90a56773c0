//! The run: load steps along the stages of the schedule.

use std::ops::RangeInclusive;

use foldmotion_pattern::Frame;
use glam::DVec3;

use super::closing::Closing;
use super::configuration::{Configuration, largest};
use super::contact::ContactField;
use super::history::History;
use super::jam::{FOLDED_WITHIN, find_jam};
use super::newton::{Newton, SearchOutcome, Tolerance};
use super::outcome::{FrameFigures, QuasiStaticRun, StageOutcome, Stop, StopReason};
use super::release::Release;
use super::snap::{Snap, add_snap};
use super::step_control::StepControl;
use super::{QuasiStaticOptions, contact_force, force_scale, rounding_force};
use crate::{HingeKind, Model, Schedule, Snapshot, SolverError, Stage, Watcher};

/// The last Newton step of an equilibrium moves no node further, in unit lengths: without contact, and with it.
const STEP_TOLERANCE: f64 = 1e-9;
const CONTACT_STEP_TOLERANCE: f64 = 1e-6;
/// What further steps with the same factor would add may be this many times what rounding leaves of the positions; with
/// contact, of the order of a Newton step squared.
const REMAINDER: f64 = 8.0 * f64::EPSILON;
const CONTACT_REMAINDER: f64 = 1e-10;
/// With contact the tolerance of the forces is this many times what it is without.
const CONTACT_LENIENCE: f64 = 1e3;
/// After a load step that took more iterations than this nothing is extrapolated.
const HARD_ITERATIONS: usize = 30;
/// An extrapolated state with more than this many times the energy of the last one is no help.
const USELESS_ENERGY: f64 = 100.0;
/// Stage-local times closer than this are the same but for rounding.
const SAME_TIME: f64 = 1e-12;
/// Creases this near to their targets, radians, follow them.
const FOLLOWING: f64 = 0.5;
/// The iterations allowed in a snap, over those allowed elsewhere.
const SNAP_BUDGET: usize = 40;
/// The iterations of one load step of a sheet that passes through snaps. A large sheet, which each of them takes longer,
/// makes do with fewer: about this number over its triangles.
const PASSING_ITERATIONS: RangeInclusive<usize> = 4..=12;
const PASSING_ITERATIONS_BY_TRIANGLES: usize = 12_000;
/// The iterations of the last load step of a stage of such a sheet, and after layers are let go.
const ENDING_ITERATIONS: usize = 400;
const RELEASE_ITERATIONS: u64 = 300;

/// Folds the sheet of `model` slowly along `schedule`, from `start` (one position for each vertex, in the sheet's
/// unit).
///
/// At every load step the sheet is brought to the nearest minimum of its energy downhill from the last state, itself
/// extrapolated. Load steps hit every t = 2k/frames and every requested time; between them they shorten where Newton's
/// method fails and grow again where it is easy. Where short ones fail too, the sheet snaps: the search is given time
/// to descend to the next equilibrium, however far. `progress` is called after each load step and after each Newton
/// step within it, and ends the run by returning false.
///
/// With contact, the frames at t = 2k/frames keep the whole gap and the straight paths between frames 0.4 of it: where
/// they would not, states of the search are recorded as frames between. Facets that started in touch, which have no gap,
/// do not cross each other in any frame. Towards the end of stage fold the gap [closes](super::Contact::final_gap).
///
/// Every run ends: load steps shrink to no less than a thousandth of the longest, and a stage takes no more Newton
/// iterations than [`QuasiStaticOptions::iterations_a_step`] or [`QuasiStaticOptions::budget`] allows. A stage that
/// finds no equilibrium in them ends the run: what was reached is returned, with [`StageOutcome::converged`] false and
/// the evidence in [`StageOutcome::stop`]. Where contact keeps creases from their targets, [`QuasiStaticRun::jam`] says
/// so.
///
/// # Errors
/// Options out of range, counts that do not fit the model, positions that are not finite, a matrix too large, a gap
/// too large, a start that crosses itself if there is contact, and [`SolverError::Cancelled`].
pub fn run_quasi_static(
    model: &Model,
    schedule: &Schedule,
    start: &[DVec3],
    options: &QuasiStaticOptions,
    progress: Watcher<'_>,
) -> Result<QuasiStaticRun, SolverError> {
    options.validate()?;
    schedule.check_start(model, start)?;
    let positions = model.to_model(start);
    // The angles of the first targets tell which turn a hinge near ±π is in.
    let mut angles = vec![0.0; model.hinges.len()];
    if let Some(&stage) = options.stages.first() {
        schedule.targets(stage, 0.0, &mut angles);
    }
    let contact = match options.contact {
        Some(contact) => {
            let force = contact_force(model, options.snap_control);
            Some(ContactField::new(model, contact, force, &positions)?)
        }
        None => None,
    };
    let mut run = Run {
        model,
        schedule,
        options,
        progress,
        newton: Newton::new(model, contact, options.support, options.snap_control.most_rounds())?,
        state: Configuration::new(model, positions, angles),
        targets: vec![0.0; model.hinges.len()],
        last_recorded: Vec::new(),
        crossed: None,
        outcome: QuasiStaticRun::default(),
    };
    for &stage in &options.stages {
        run.begin(stage);
        if !run.stage(stage)? {
            break;
        }
    }
    run.finish()?;
    Ok(run.outcome)
}

/// The index of a state of `path`, from `next` on, as far along it as strides, from `stride` on, find one that can be
/// reached straight from `last`; `next` itself always can.
fn furthest_straight(
    contact: &mut ContactField,
    last: &[DVec3],
    path: &[Configuration],
    [next, stride]: [usize; 2],
) -> usize {
    let (mut furthest, mut stride, mut grows) = (next, stride, true);
    while stride > 0 {
        let ahead = path.get(furthest + stride);
        if ahead.is_some_and(|ahead| contact.is_path_free(last, &ahead.positions)) {
            furthest += stride;
        } else {
            grows = false;
        }
        stride = if grows { 2 * stride } else { stride / 2 };
    }
    furthest
}

fn passing_iterations(model: &Model) -> usize {
    let by_triangles = PASSING_ITERATIONS_BY_TRIANGLES / model.faces.len().max(1);
    by_triangles.clamp(*PASSING_ITERATIONS.start(), *PASSING_ITERATIONS.end())
}

/// Tells `progress` of `state`, sought after the equilibrium at `time` was reached.
fn report(
    progress: Watcher<'_>,
    model: &Model,
    time: f64,
    state: &Configuration,
) -> Result<(), SolverError> {
    if progress(&Snapshot::new(time, &|| model.to_sheet(&state.positions))) {
        Ok(())
    } else {
        Err(SolverError::Cancelled { time })
    }
}

/// The stage-local times at which a stage records its state, in order, from the first after its start to its end.
fn recorded_times(options: &QuasiStaticOptions, stage: Stage) -> Vec<f64> {
    let frames = (options.frames / 2) as f64;
    let is_between_frames =
        |s: &f64| (s * frames - (s * frames).round()).abs() > SAME_TIME * frames;
    let extra = options.extra_times.iter().map(|t| t - stage.start_time());
    let mut times: Vec<f64> = extra
        .filter(|s| *s > 0.0 && *s < 1.0 && is_between_frames(s))
        .chain((1..=options.frames / 2).map(|k| k as f64 / frames))
        .collect();
    times.sort_by(f64::total_cmp);
    times.dedup_by(|later, earlier| *later - *earlier <= SAME_TIME);
    times
}

struct Run<'a> {
    model: &'a Model,
    schedule: &'a Schedule,
    options: &'a QuasiStaticOptions,
    progress: Watcher<'a>,
    newton: Newton<'a>,
    /// The last equilibrium, and the targets of the current load step.
    state: Configuration,
    targets: Vec<f64>,
    last_recorded: Vec<DVec3>,
    /// Two triangles that started in touch and crossed each other in the last state tried.
    crossed: Option<[u32; 2]>,
    outcome: QuasiStaticRun,
}

/// An attempted load step.
struct Trial {
    state: Configuration,
    settled: SearchOutcome,
    /// From the last equilibrium to this state, with contact only.
    path: Vec<Configuration>,
}

impl Run<'_> {
    /// Records the state in which the stage begins, unless the stage before ended in it.
    fn begin(&mut self, stage: Stage) {
        self.schedule.targets(stage, 0.0, &mut self.targets);
        let time = stage.start_time();
        if self.outcome.frames.last().is_none_or(|f| f.time != time) {
            self.record(time, &self.state.clone());
        }
    }

    /// Runs one stage; false where it did not reach its end.
    fn stage(&mut self, stage: Stage) -> Result<bool, SolverError> {
        let mut outcome = StageOutcome::new(stage);
        let mut history = History::new(0.0, self.state.clone());
        let goals = recorded_times(self.options, stage);
        let mut control = StepControl::new(self.options.frames);
        let closing = self.options.contact.and_then(|c| Closing::new(stage, c.gap, c.final_gap));
        let standard = self.standard_budget(goals.len().max(control.least_steps()));
        let (mut s, mut recorded) = (0.0, 0);
        // The last load step if it found no equilibrium, the outcome of its search, and the reason to stop there.
        let mut open = None;
        while let Some(&goal) = goals.get(recorded) {
            let (mut next, mut reaches) = control.next(s, goal);
            if let Some(closing) = closing.filter(|_| self.follows_targets()) {
                let latest = Closing::latest_end(s);
                (next, reaches) = (next.min(latest), reaches && next <= latest);
                self.close_to(closing.gap_at(next));
            }
            let is_short = control.is_short();
            let most = self.most_iterations(is_short, next == 1.0);
            let most = most.min(self.left(standard, outcome.iterations));
            let mut trial = self.load_step(stage, next, &history, most)?;
            let crosses = self.crosses_in_touch(&trial.state);
            trial.settled.converged &= !crosses;
            outcome.add(&trial.settled);
            let is_spent = self.left(standard, outcome.iterations) == 0;
            let is_late = self.options.budget.is_late();
            let may_pass = self.passes_through() && !crosses && !is_spent && !is_late;
            let reason = StopReason::of(is_late, is_spent);
            open = (!trial.settled.converged).then_some((next - s, trial.settled, reason));
            if open.is_some() && !may_pass {
                if is_spent || is_late || is_short {
                    break;
                }
                control.shorten(next - s);
                continue;
            }
            let pushes = |c: &ContactField| c.pushes();
            let is_pushed = self.newton.contact.as_ref().is_some_and(pushes);
            if open.is_none() {
                control.adapt(&trial.settled, is_pushed);
            }
            let [from, to] = [s, next].map(|s| stage.start_time() + s);
            self.note_snap(&mut outcome.snaps, [from, to], &trial);
            self.accept(from, to, &trial);
            if reaches || self.options.record_load_steps {
                self.record(to, &trial.state);
            }
            if trial.settled.iterations > HARD_ITERATIONS || open.is_some() {
                // Where the path is not smooth, what came before says nothing about what comes next.
                history = History::new(next, trial.state.clone());
            } else {
                history.push(next, trial.state.clone(), is_pushed);
            }
            (self.state, s, outcome.reached) = (trial.state, next, to);
            recorded += usize::from(reaches);
            report(self.progress, self.model, to, &self.state)?;
        }
        outcome.converged = open.is_none();
        if let Some((step, settled, reason)) = open {
            outcome.residual = settled.residual;
            // A sheet that passes through snaps may still tremble where its creases want it.
            if s < 1.0 || self.fold_angle_error(&self.state) > FOLDED_WITHIN {
                outcome.stop = Some(self.stop(&outcome, reason, step, &settled));
            }
        }
        let goes_on = outcome.stop.is_none();
        self.outcome.stages.push(outcome);
        Ok(goes_on)
    }

    /// Whether the creases are near the targets of the last load step, so that no layer keeps them from these.
    fn follows_targets(&self) -> bool {
        self.fold_angle_error(&self.state) <= FOLLOWING
    }

    /// Lets the layers come as close as `gap`.
    fn close_to(&mut self, gap: f64) {
        if let Some(contact) = &mut self.newton.contact {
            contact.close_to(gap);
        }
    }

    /// Whether facets that started in touch cross each other in `state`, in which case they stop the motion.
    fn crosses_in_touch(&mut self, state: &Configuration) -> bool {
        let contact = self.newton.contact.as_ref();
        self.crossed =
            contact.and_then(|c| c.crossing_in_touch(&self.state.positions, &state.positions));
        self.crossed.is_some()
    }

    /// The default number of iterations in a stage of at least `load_steps`.
    fn standard_budget(&self, load_steps: usize) -> usize {
        self.options.iterations_a_step.saturating_mul(load_steps)
    }

    /// The iterations left to a stage that has taken `taken`, if the default is `standard`.
    fn left(&self, standard: usize, taken: usize) -> usize {
        let earlier: usize = self.outcome.stages.iter().map(|s| s.iterations).sum();
        let standard = standard.saturating_sub(taken) as u64;
        let left = self.options.budget.left(standard, (earlier + taken) as u64);
        usize::try_from(left).unwrap_or(usize::MAX)
    }

    /// The reason for the end of `stage` in a load step of length `step`; `settled`: the outcome of its last attempt.
    fn stop(
        &self,
        stage: &StageOutcome,
        reason: StopReason,
        step: f64,
        settled: &SearchOutcome,
    ) -> Stop {
        let [without, _] = self.tolerances();
        let time = match reason {
            StopReason::NoEquilibrium => stage.last_equilibrium(),
            StopReason::OutOfIterations | StopReason::OutOfTime => stage.reached,
        };
        Stop { reason, time, step, residual: settled.residual, tolerance: without.force }
    }

    /// Whether load steps that find no equilibrium are kept.
    fn passes_through(&self) -> bool {
        self.options.snap_control.passes_through()
    }

    /// The iterations of one load step, the last one of its stage or not.
    fn most_iterations(&self, is_short: bool, is_last: bool) -> usize {
        if self.passes_through() {
            if is_last { ENDING_ITERATIONS } else { passing_iterations(self.model) }
        } else if is_short {
            SNAP_BUDGET * self.options.max_iterations
        } else {
            self.options.max_iterations
        }
    }

    /// Adds the load step `from` to `to` to the snaps, if the sheet snapped in it.
    fn note_snap(&self, snaps: &mut Vec<Snap>, [from, to]: [f64; 2], trial: &Trial) {
        let is_over = trial.settled.converged;
        let is_open = snaps.last().is_some_and(|snap| !snap.is_over);
        if is_over && !is_open && trial.settled.iterations <= self.options.max_iterations {
            return;
        }
        let [before, after] = [&self.state, &trial.state].map(|state| {
            self.model.energy_by_kind(&state.positions, &state.angles, &self.targets).total()
        });
        add_snap(snaps, Snap { from, to, energy_released: before - after, is_over });
    }

    /// The equilibrium at `s`, sought from the state extrapolated to it where contact allows, else from the last one,
    /// in `most_iterations` at most.
    fn load_step(
        &mut self,
        stage: Stage,
        s: f64,
        history: &History,
        most_iterations: usize,
    ) -> Result<Trial, SolverError> {
        self.schedule.targets(stage, s, &mut self.targets);
        let keeps_way = self.newton.contact.is_some();
        let mut path = Vec::new();
        let mut state = match history.extrapolate(self.model, s) {
            Some(ahead) if self.may_start_from(&ahead) => ahead,
            _ => self.state.clone(),
        };
        if keeps_way {
            path.extend([self.state.clone(), state.clone()]);
        }
        let (progress, model) = (self.progress, self.model);
        let reached = stage.start_time() + history.last_time();
        let mut visit = |state: &Configuration| {
            if keeps_way {
                path.push(state.clone());
            }
            report(progress, model, reached, state)
        };
        let allowance = self.options.budget.allowance(most_iterations as u64);
        let tolerances = self.tolerances();
        let settled =
            self.newton.settle(&mut state, &self.targets, tolerances, allowance, &mut visit)?;
        Ok(Trial { state, settled, path })
    }

    /// The tolerances without contact, and where layers push, but for rounding of their forces. A sheet that passes
    /// through snaps has the latter only.
    fn tolerances(&self) -> [Tolerance; 2] {
        let without = self.tolerance();
        let lenient = CONTACT_LENIENCE * self.options.tolerance * force_scale(self.model);
        let in_contact = Tolerance {
            force: without.force + lenient,
            step: CONTACT_STEP_TOLERANCE,
            remainder: without.remainder.max(CONTACT_REMAINDER),
            level: self.options.snap_control.level(),
        };
        [if self.passes_through() { in_contact } else { without }, in_contact]
    }

    fn tolerance(&self) -> Tolerance {
        let rounding = rounding_force(self.model, &self.state.positions);
        Tolerance {
            force: self.options.tolerance * force_scale(self.model) + rounding,
            step: STEP_TOLERANCE,
            remainder: REMAINDER * largest(&self.state.positions),
            level: 0.0,
        }
    }

    /// Whether the extrapolated state `ahead` is a good start: not much higher in energy than the last one at the new
    /// targets, and contact leaves the straight path to it free.
    fn may_start_from(&mut self, ahead: &Configuration) -> bool {
        let [stay, go] = [&self.state, ahead].map(|state| {
            let energy = &self.model.energy_by_kind(&state.positions, &state.angles, &self.targets);
            energy.total()
        });
        if go > USELESS_ENERGY * stay {
            return false;
        }
        let from = &self.state.positions;
        let displacement: Vec<DVec3> =
            ahead.positions.iter().zip(from).map(|(&b, &a)| b - a).collect();
        self.newton.limited(from, &displacement, 1.0) >= 1.0
    }

    /// Takes note of the contact in a new equilibrium.
    fn accept(&mut self, from: f64, to: f64, trial: &Trial) {
        self.record_path(from, to, trial);
        if let Some(contact) = &mut self.newton.contact {
            contact.accept(&trial.state.positions);
        }
    }

    /// If the straight path from the last frame to the new state is not free of contact, records states on the path
    /// the search took, at times between `from` and `to`.
    fn record_path(&mut self, from: f64, to: f64, trial: &Trial) {
        let Some(contact) = &mut self.newton.contact else {
            return;
        };
        let path = &trial.path;
        let mut last = &self.last_recorded;
        if contact.is_path_free(last, &trial.state.positions) {
            return;
        }
        // The path ends in the new state.
        let mut between: Vec<usize> = Vec::new();
        let (mut next, mut stride) = (0, 1);
        loop {
            let furthest = furthest_straight(contact, last, path, [next, stride]);
            if furthest + 1 >= path.len() {
                break;
            }
            between.push(furthest);
            last = &path[furthest].positions;
            (next, stride) = (furthest + 1, furthest - next + 1);
        }
        let parts = (between.len() + 1) as f64;
        for (index, at) in between.into_iter().enumerate() {
            let share = (index + 1) as f64 / parts;
            self.record(from + (to - from) * share, &path[at]);
        }
    }

    fn record(&mut self, time: f64, state: &Configuration) {
        self.last_recorded.clone_from(&state.positions);
        self.outcome.frames.push(Frame { time, positions: self.model.to_sheet(&state.positions) });
        let mut figures = FrameFigures {
            energy: self.model.energy_by_kind(&state.positions, &state.angles, &self.targets),
            fold_angle_error: self.fold_angle_error(state),
            ..FrameFigures::default()
        };
        if let Some(contact) = &mut self.newton.contact {
            contact.linearise(&state.positions);
            figures.contact_energy = contact.energy(&state.positions);
            (figures.contacts, figures.contact_force) = contact.load(&state.positions);
        }
        self.outcome.figures.push(figures);
    }

    /// |θ − θ*| of each crease, radians.
    fn fold_angle_errors(&self, state: &Configuration) -> Vec<f64> {
        let creases = self.model.hinges.iter().zip(&state.angles).zip(&self.targets);
        let creases = creases.filter(|((hinge, _), _)| hinge.kind == HingeKind::Crease);
        creases.map(|((_, angle), target)| (angle - target).abs()).collect()
    }

    fn fold_angle_error(&self, state: &Configuration) -> f64 {
        self.fold_angle_errors(state).into_iter().fold(0.0, f64::max)
    }

    fn mean_fold_angle_error(&self, state: &Configuration) -> f64 {
        let errors = self.fold_angle_errors(state);
        errors.iter().sum::<f64>() / errors.len().max(1) as f64
    }

    /// Lets go of the layers in the last state, if they push there and creases are off their targets. `None` too if the
    /// time of the budget is used up: how far the sheet would go is then unknown.
    fn release(&mut self) -> Result<Option<Release>, SolverError> {
        let is_over =
            self.outcome.stages.iter().all(|stage| stage.reached == stage.stage.start_time() + 1.0);
        let is_off = self.fold_angle_error(&self.state) > FOLDED_WITHIN;
        let pushes = self.newton.contact.as_ref().is_some_and(ContactField::pushes);
        if !(self.passes_through() && is_over && is_off && pushes) {
            return Ok(None);
        }
        let contact = self.newton.contact.take();
        let mut state = self.state.clone();
        let (progress, model) = (self.progress, self.model);
        let time = self.outcome.frames.last().map_or(0.0, |frame| frame.time);
        let mut visit = |state: &Configuration| report(progress, model, time, state);
        let allowance = self.options.budget.allowance(RELEASE_ITERATIONS);
        let tolerances = self.tolerances();
        let settled =
            self.newton.settle(&mut state, &self.targets, tolerances, allowance, &mut visit);
        self.newton.contact = contact;
        settled?;
        if self.options.budget.is_late() {
            return Ok(None);
        }
        let [with_contact, without_contact] =
            [&self.state, &state].map(|state| self.mean_fold_angle_error(state));
        Ok(Some(Release { with_contact, without_contact }))
    }

    /// Records the last equilibrium where it is no frame, and says whether contact stopped the motion.
    fn finish(&mut self) -> Result<(), SolverError> {
        let reached = self.outcome.stages.last().map(|stage| stage.reached);
        let recorded = self.outcome.frames.last().map(|frame| frame.time);
        if let (Some(reached), Some(recorded)) = (reached, recorded)
            && reached > recorded
        {
            self.record(reached, &self.state.clone());
        }
        self.outcome.release = self.release()?;
        self.outcome.factorisations = self.newton.factorisations;
        self.outcome.analyses = self.newton.analyses;
        self.outcome.effort = self.newton.effort;
        if let Some(contact) = &self.newton.contact {
            self.outcome.effort.searches = contact.searches();
            self.outcome.gap_reached = Some(contact.gap());
            let mut blocking = contact.hardest(&self.state.positions);
            blocking.extend(self.crossed.map(|faces| (faces, 0.0)));
            let slack = contact.fold_angle_slack();
            self.outcome.jam = find_jam(&self.outcome, slack, blocking);
        }
        Ok(())
    }
}
