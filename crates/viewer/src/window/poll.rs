//! What came back from the background since the last frame.

use std::sync::Arc;

use eframe::egui::Context;
use foldmotion_study::{Draft, Opened, Scene};

use super::act::Act;
use super::{Viewer, moving_part};
use crate::design::Fault;
use crate::document::Document;
use crate::work::{Finished, Job, Resolved, WorkError, judge, preview};

/// Sheets with more vertices are not folded at once after every edit.
const LARGEST_PREVIEW: usize = 20_000;

impl Viewer {
    pub(super) fn poll(&mut self, ctx: &Context) {
        self.ask();
        let answers: Vec<Resolved> = self.resolved.drafts.take().collect();
        for answer in answers {
            self.take_resolved(answer);
        }
        self.take_preview();
        self.take_run();
        self.take_opened();
        self.take_judged();
        self.take_recording();
        self.watch_hold();
        if self.jobs.run.is_some() || self.jobs.hold.is_some() {
            // The clock of rates and progress goes on though nothing else does.
            ctx.request_repaint_after(std::time::Duration::from_millis(250));
        }
    }

    /// Asks for what becomes of the scene, where its text is new.
    fn ask(&mut self) {
        let revision = self.document.revision();
        if self.shown.file.is_some() || self.resolved.asked.is_some_and(|(of, _)| of == revision) {
            return;
        }
        if let Some(error) = self.document.parse_error() {
            self.resolved.faults = vec![Fault::new(error.key(), error)];
            self.resolved.study = None;
            self.resolved.asked = Some((revision, 0));
            return;
        }
        let number = self.resolved.drafts.ask(self.document.source());
        self.resolved.asked = Some((revision, number));
        self.resolved.study = None;
    }

    fn take_resolved(&mut self, answer: Resolved) {
        let asked = self.resolved.asked.map_or(0, |(_, number)| number);
        match answer {
            Resolved::Draft(number, Ok(draft)) if number == asked => {
                let scene = moving_part(self.document.scene());
                let is_new = self
                    .resolved
                    .draft
                    .as_ref()
                    .is_none_or(|(_, of, _)| *of != scene);
                self.resolved.draft = Some((number, scene.clone(), Arc::clone(&draft)));
                self.resolved.faults.clear();
                if is_new {
                    // What is in the hand is the sheet before.
                    self.jobs.hold = None;
                    self.show_exact(scene, &draft);
                }
            }
            Resolved::Study(number, Ok(study)) if number == asked => {
                self.resolved.faults.clear();
                self.resolved.study = Some(study);
                self.fold_at_once();
            }
            Resolved::Draft(number, Err(error)) | Resolved::Study(number, Err(error))
                if number == asked =>
            {
                let fault = Fault::new(error.key(), &error);
                if !self.resolved.faults.contains(&fault) {
                    self.resolved.faults.push(fault);
                }
            }
            _ => {}
        }
    }

    /// Shows the exact states of a new draft where one of them is due; between them the motion before stays until the next
    /// preview comes.
    fn show_exact(&mut self, scene: Scene, draft: &Draft) {
        let t = self.playback.time;
        let is_of_size = |act: &Act| act.motion().sheet.faces.len() == draft.sheet().faces.len();
        let stays = self
            .shown
            .draft
            .as_ref()
            .is_some_and(|(_, act)| is_of_size(act));
        if stays && t.fract() != 0.0 && self.settings.view.folds_at_once {
            return;
        }
        let act = Arc::new(Act::exact(draft, self.shown.key()));
        self.change_act(|shown| shown.draft = Some((scene, act)));
    }

    /// Starts a preview of the scene as it stands.
    pub(super) fn fold_at_once(&mut self) {
        let Some(study) = self.resolved.study.clone() else {
            return;
        };
        let Some((_, scene, draft)) = &self.resolved.draft else {
            return;
        };
        let is_run = self.shown.run.as_ref().is_some_and(|(of, _)| of == scene);
        let is_small = study.subject.sheet().vertices.len() <= LARGEST_PREVIEW;
        if !self.settings.view.folds_at_once || is_run || !is_small {
            return;
        }
        let job = preview(study, self.wake.clone());
        self.jobs.preview = Some((scene.clone(), Arc::clone(draft), job));
    }

    fn take_preview(&mut self) {
        let Some((scene, draft, preview)) = self.jobs.preview.take_if_done() else {
            return;
        };
        match preview {
            Ok(preview) => {
                let key = self.shown.key();
                let act = Act::preview(&draft, preview, &scene, key);
                self.change_act(|shown| shown.draft = Some((scene, Arc::new(act))));
            }
            Err(WorkError::Stopped) => {}
            Err(error) => self.say(format!("the preview failed: {error}"), false),
        }
    }

    fn take_run(&mut self) {
        let Some((_, run)) = &self.jobs.run else {
            return;
        };
        self.jobs.best_rate = self.jobs.best_rate.max(run.live().rate());
        if !run.is_done() {
            return;
        }
        let Some((scene, run)) = self.jobs.run.take() else {
            return;
        };
        self.timings.rate("run", self.jobs.best_rate as f64);
        match run.take() {
            Some(Ok(finished)) => self.finish_run(scene, &finished),
            Some(Err(WorkError::Stopped)) => self.say("the run was stopped", true),
            Some(Err(error)) => {
                self.resolved.faults.push(Fault::new(error.key(), &error));
                self.say(format!("the run failed: {error}"), false);
            }
            None => {}
        }
    }

    fn finish_run(&mut self, scene: Scene, finished: &Finished) {
        let outcome = finished.report.outcome.line();
        let seconds = finished.folded.duration().as_secs_f64();
        let words = format!("{outcome}, {seconds:.2} s");
        let key = self.shown.key();
        let act = Act::run(finished, key);
        self.change_act(|shown| shown.run = Some((scene, Arc::new(act))));
        if self.shown.follows_run {
            self.playback.go_to(2.0);
            self.shown.follows_run = false;
        }
        self.say(words, finished.report.status() == 0);
    }

    fn take_opened(&mut self) {
        let Some((path, opened)) = self.jobs.opening.take_if_done() else {
            return;
        };
        match opened {
            Ok(Opened::Motion(motion)) => {
                self.settings.recent.add(&path);
                self.jobs.stop();
                self.jobs.judging = Some(judge(Arc::clone(&motion), self.wake.clone()));
                let key = self.shown.key();
                self.shown.fits = true;
                let act = Arc::new(Act::file(motion, None, key));
                self.change_act(|shown| shown.file = Some(act));
            }
            Ok(Opened::Scene(_)) => match Document::open(&path) {
                Ok(document) => {
                    self.settings.recent.add(&path);
                    self.take_document(document);
                }
                Err(error) => self.say(error.to_string(), false),
            },
            Err(error) => self.say(error.to_string(), false),
        }
    }

    /// Goes on with another scene.
    pub(super) fn take_document(&mut self, document: Document) {
        // What cannot be read can only be mended as text.
        self.mends_text = document.parse_error().is_some();
        self.document = document;
        self.keep_unsaved();
        self.resolved.asked = None;
        self.resolved.draft = None;
        self.resolved.study = None;
        self.resolved.faults.clear();
        self.jobs.stop();
        self.record_panel.folder = None;
        let next_key = self.shown.next_key;
        self.shown = super::Shown {
            fits: true,
            next_key,
            ..super::Shown::default()
        };
        self.playback.go_to(self.playback.range[0]);
    }

    fn take_judged(&mut self) {
        let Some(job) = self.jobs.judging.take_if(|job| job.is_done()) else {
            return;
        };
        let act = self.shown.file.clone();
        let Some(motion) = act.as_ref().and_then(|act| act.opened()) else {
            return;
        };
        match job.take() {
            Some(Ok(judged)) => {
                let key = self.shown.key();
                let act = Act::file(Arc::clone(motion), Some(judged), key);
                self.shown.file = Some(Arc::new(act));
            }
            Some(Err(WorkError::Stopped)) | None => {}
            Some(Err(error)) => self.say(format!("it could not be judged: {error}"), false),
        }
    }

    fn take_recording(&mut self) {
        let Some((folder, files)) = self.jobs.recording.take_if_done() else {
            return;
        };
        match files {
            Ok(files) => {
                let words = format!("recorded {} in {}", files.join(", "), folder.display());
                self.say(words, true);
            }
            Err(WorkError::Stopped) => self.say("recording was stopped", true),
            Err(error) => self.say(format!("recording failed: {error}"), false),
        }
    }

    fn watch_hold(&mut self) {
        let Some(hold) = &self.jobs.hold else { return };
        self.jobs.best_rate = self.jobs.best_rate.max(hold.live().rate());
        if let Some(error) = hold.take_error() {
            self.jobs.hold = None;
            self.say(format!("the sheet was let go: {error}"), false);
        }
    }

    /// Takes another motion; the view is fitted to it where that is due, and else goes with the sheet where the other
    /// motion is shown elsewhere.
    fn change_act(&mut self, change: impl FnOnce(&mut super::Shown)) {
        let before = self.act();
        change(&mut self.shown);
        let Some(act) = self.act() else { return };
        self.playback.set_range(act.range());
        if self.shown.fits {
            self.view3d.fit(act.reach());
            // Exact states lie elsewhere than the motion that follows them.
            self.shown.fits = act.is_exact();
        } else if let Some(before) = before.filter(|before| before.key != act.key) {
            let t = self.playback.time;
            if let (Some(from), Some(to)) = (before.middle(t), act.middle(t)) {
                self.view3d.follow_by(to - from);
            }
        }
    }
}

impl super::Shown {
    /// A key that no motion had yet.
    pub(super) fn key(&mut self) -> u64 {
        self.next_key += 1;
        self.next_key
    }
}

impl super::Jobs {
    /// Stops everything that belongs to the scene at hand.
    pub(super) fn stop(&mut self) {
        self.preview = None;
        self.run = None;
        self.hold = None;
        self.judging = None;
    }
}

/// A job with what is remembered beside it.
trait TakeIfDone {
    type Done;
    /// The result, once it is there; nothing is left then.
    fn take_if_done(&mut self) -> Option<Self::Done>;
}

impl<A, T> TakeIfDone for Option<(A, Job<T>)> {
    type Done = (A, Result<T, WorkError>);
    fn take_if_done(&mut self) -> Option<Self::Done> {
        let (beside, job) = self.take_if(|(_, job)| job.is_done())?;
        Some((beside, job.take()?))
    }
}

impl<A, B, T> TakeIfDone for Option<(A, B, Job<T>)> {
    type Done = (A, B, Result<T, WorkError>);
    fn take_if_done(&mut self) -> Option<Self::Done> {
        let (a, b, job) = self.take_if(|(_, _, job)| job.is_done())?;
        Some((a, b, job.take()?))
    }
}
