//! Collecting the results of background jobs in each frame.

use std::sync::Arc;

use eframe::egui::Context;
use foldmotion_study::{Draft, OpenedFile, Scene};

use super::shown_motion::ShownMotion;
use super::{Pending, Viewer, motion_keys};
use crate::design::SceneError;
use crate::document::Document;
use crate::work::{FinishedRun, Resolved, WorkError, check_motion, preview};

/// Sheets with more vertices get no preview.
const LARGEST_PREVIEW: usize = 20_000;

impl Viewer {
    pub(super) fn poll(&mut self, ctx: &Context) {
        self.resolve_scene();
        let answers: Vec<Resolved> = self.resolved.resolver.take().collect();
        for answer in answers {
            self.take_resolved(answer);
        }
        self.take_preview();
        self.take_run();
        self.take_opened();
        self.take_checked();
        self.take_recording();
        self.watch_interaction();
        if self.jobs.run.is_some() || self.jobs.interaction.is_some() {
            // Rates and progress change with time, even if nothing else does.
            ctx.request_repaint_after(std::time::Duration::from_millis(250));
        }
    }

    /// Submits the scene to the resolver if its text has changed.
    fn resolve_scene(&mut self) {
        let revision = self.document.revision();
        if self.display.file.is_some()
            || self.resolved.requested.is_some_and(|(of, _)| of == revision)
        {
            return;
        }
        if let Some(error) = self.document.parse_error() {
            self.resolved.errors = vec![SceneError::new(error.key(), error)];
            self.resolved.study = None;
            self.resolved.requested = Some((revision, 0));
            return;
        }
        let number = self.resolved.resolver.submit(self.document.source());
        self.resolved.requested = Some((revision, number));
        self.resolved.study = None;
    }

    fn take_resolved(&mut self, answer: Resolved) {
        let asked = self.resolved.requested.map_or(0, |(_, number)| number);
        match answer {
            Resolved::Draft(number, Ok(draft)) if number == asked => {
                let scene = motion_keys(self.document.scene());
                let previous = self.resolved.draft.as_ref();
                let is_new = previous.is_none_or(|(_, of, _)| *of != scene);
                self.resolved.draft = Some((number, scene.clone(), Arc::clone(&draft)));
                self.resolved.errors.clear();
                if is_new {
                    // The sheet that is moved by hand is that of the previous draft.
                    self.jobs.interaction = None;
                    self.show_exact(scene, &draft);
                }
            }
            Resolved::Study(number, Ok(study)) if number == asked => {
                self.resolved.errors.clear();
                self.resolved.study = Some(study);
                self.start_preview();
            }
            Resolved::Draft(number, Err(error)) | Resolved::Study(number, Err(error))
                if number == asked =>
            {
                let error = SceneError::new(error.key(), &error);
                if !self.resolved.errors.contains(&error) {
                    self.resolved.errors.push(error);
                }
            }
            _ => {}
        }
    }

    /// Shows the exact states of a new draft if the motion time is at one of them or the sheet has changed. Otherwise
    /// the previous motion stays until the next preview is ready.
    fn show_exact(&mut self, scene: Scene, draft: &Draft) {
        let t = self.playback.time;
        let is_of_size =
            |shown: &ShownMotion| shown.motion().sheet.faces.len() == draft.sheet().faces.len();
        let draft_shown = self.display.draft.as_ref();
        let stays = draft_shown.is_some_and(|(_, shown)| is_of_size(shown));
        if stays && t.fract() != 0.0 && self.settings.view.folds_at_once {
            return;
        }
        let shown = Arc::new(ShownMotion::exact(draft, self.display.key()));
        self.change_motion(|display| display.draft = Some((scene, shown)));
    }

    pub(super) fn start_preview(&mut self) {
        let Some(study) = self.resolved.study.clone() else {
            return;
        };
        let Some((_, scene, draft)) = &self.resolved.draft else {
            return;
        };
        let is_run = self.display.run.as_ref().is_some_and(|(of, _)| of == scene);
        let is_small = study.subject.sheet().vertices.len() <= LARGEST_PREVIEW;
        if !self.settings.view.folds_at_once || is_run || !is_small {
            return;
        }
        let job = preview(study, self.repaint.clone());
        self.jobs.preview = Some(((scene.clone(), Arc::clone(draft)), job));
    }

    fn take_preview(&mut self) {
        let Some(((scene, draft), preview)) = take_done(&mut self.jobs.preview) else {
            return;
        };
        match preview {
            Ok(preview) => {
                let key = self.display.key();
                let shown = ShownMotion::preview(&draft, preview, &scene, key);
                self.change_motion(|display| display.draft = Some((scene, Arc::new(shown))));
            }
            Err(WorkError::Stopped) => {}
            Err(error) => self.notify(format!("The preview failed: {error}"), false),
        }
    }

    fn take_run(&mut self) {
        let Some(((_, states), _)) = &self.jobs.run else {
            return;
        };
        self.jobs.best_rate = self.jobs.best_rate.max(states.rate());
        let Some(((scene, _), finished)) = take_done(&mut self.jobs.run) else {
            return;
        };
        self.timings.rate("run", self.jobs.best_rate as f64);
        match finished {
            Ok(finished) => self.finish_run(scene, &finished),
            Err(WorkError::Stopped) => self.notify("The run was stopped.", true),
            Err(error) => {
                let scene_error = SceneError::new(error.key(), &error);
                self.resolved.errors.push(scene_error);
                self.notify(format!("The run failed: {error}"), false);
            }
        }
    }

    fn finish_run(&mut self, scene: Scene, finished: &FinishedRun) {
        let outcome = finished.report.outcome.line();
        let seconds = finished.folded.duration().as_secs_f64();
        let words = format!("{outcome}, {seconds:.2} s");
        let key = self.display.key();
        let shown = ShownMotion::run(finished, key);
        self.change_motion(|display| display.run = Some((scene, Arc::new(shown))));
        if self.display.follows_run {
            self.playback.go_to(2.0);
            self.display.follows_run = false;
        }
        self.notify(words, finished.report.status() == 0);
    }

    fn take_opened(&mut self) {
        let Some((path, opened)) = take_done(&mut self.jobs.opening) else {
            return;
        };
        match opened {
            Ok(OpenedFile::Motion(motion)) => {
                self.settings.recent.add(&path);
                self.jobs.stop();
                let job = check_motion(Arc::clone(&motion), self.repaint.clone());
                self.jobs.checking = Some((Arc::clone(&motion), job));
                let key = self.display.key();
                self.display.fits = true;
                let shown = Arc::new(ShownMotion::file(motion, None, key));
                self.change_motion(|display| display.file = Some(shown));
            }
            Ok(OpenedFile::Scene(_)) => match Document::open(&path) {
                Ok(document) => {
                    self.settings.recent.add(&path);
                    self.take_document(document);
                }
                Err(error) => self.notify(error.to_string(), false),
            },
            Err(error) => self.notify(error.to_string(), false),
        }
    }

    pub(super) fn take_document(&mut self, document: Document) {
        // A text with a syntax error can only be corrected as text.
        self.must_fix_text = document.parse_error().is_some();
        self.document = document;
        self.keep_unsaved();
        self.resolved.requested = None;
        self.resolved.draft = None;
        self.resolved.study = None;
        self.resolved.errors.clear();
        self.jobs.stop();
        self.record_panel.folder = None;
        let next_key = self.display.next_key;
        self.display = super::Display { fits: true, next_key, ..super::Display::default() };
        self.playback.go_to(self.playback.range[0]);
    }

    fn take_checked(&mut self) {
        let Some((motion, checked)) = take_done(&mut self.jobs.checking) else {
            return;
        };
        match checked {
            Ok(checked) => {
                let shown = ShownMotion::file(motion, Some(checked), self.display.key());
                self.display.file = Some(Arc::new(shown));
            }
            Err(WorkError::Stopped) => {}
            Err(error) => {
                self.notify(format!("The motion could not be checked: {error}"), false);
            }
        }
    }

    fn take_recording(&mut self) {
        let Some((folder, files)) = take_done(&mut self.jobs.recording) else {
            return;
        };
        match files {
            Ok(files) => {
                let words = format!("Recorded {} in {}", files.join(", "), folder.display());
                self.notify(words, true);
            }
            Err(WorkError::Stopped) => self.notify("The recording was stopped.", true),
            Err(error) => self.notify(format!("The recording failed: {error}"), false),
        }
    }

    fn watch_interaction(&mut self) {
        let Some(interaction) = &self.jobs.interaction else {
            return;
        };
        self.jobs.best_rate = self.jobs.best_rate.max(interaction.states().rate());
        if let Some(error) = interaction.take_error() {
            self.jobs.interaction = None;
            self.notify(format!("Moving the sheet by hand ended: {error}"), false);
        }
    }

    /// Changes the shown motion. The view is fitted to it if that is pending; otherwise it moves with the sheet if that
    /// is now shown elsewhere.
    fn change_motion(&mut self, change: impl FnOnce(&mut super::Display)) {
        let before = self.shown_motion();
        change(&mut self.display);
        let Some(shown) = self.shown_motion() else {
            return;
        };
        self.playback.set_range(shown.range());
        if self.display.fits {
            self.view3d.fit(shown.reach());
            // Exact states lie elsewhere than the motion that follows them.
            self.display.fits = shown.is_exact();
        } else if let Some(before) = before.filter(|before| before.key != shown.key) {
            let t = self.playback.time;
            if let (Some(from), Some(to)) = (before.middle(t), shown.middle(t)) {
                self.view3d.translate(to - from);
            }
        }
    }
}

impl super::Display {
    /// A key that no motion has had yet.
    pub(super) fn key(&mut self) -> u64 {
        self.next_key += 1;
        self.next_key
    }
}

impl super::Jobs {
    /// Stops all jobs of the current scene.
    pub(super) fn stop(&mut self) {
        self.preview = None;
        self.run = None;
        self.interaction = None;
        self.checking = None;
    }
}

/// The result of a job, with the data stored beside it, once the job is done; the slot is then empty.
fn take_done<A, T>(slot: &mut Pending<A, T>) -> Option<(A, Result<T, WorkError>)> {
    let (data, job) = slot.take_if(|(_, job)| job.is_done())?;
    Some((data, job.take()?))
}
