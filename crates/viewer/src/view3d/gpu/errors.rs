//! Errors of the GPU, which are returned as messages instead of causing a panic.

use std::future::Future;
use std::pin::pin;
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Context, Poll, Waker};

use eframe::egui::mutex::RwLock;
use eframe::egui_wgpu::{RenderState, Renderer, wgpu};

/// The largest length of a message, characters.
const LONGEST: usize = 240;

/// Notices when a device is lost.
pub(in super::super) struct LossMonitor {
    device: wgpu::Device,
    /// Identifies the device, because devices of two instances may compare as equal.
    renderer: Arc<RwLock<Renderer>>,
    lost: Arc<Mutex<Option<String>>>,
}

impl LossMonitor {
    /// Monitors the device of `state`. A device has one monitor, the last.
    pub(in super::super) fn new(state: &RenderState) -> Self {
        let lost: Arc<Mutex<Option<String>>> = Arc::default();
        let told = Arc::clone(&lost);
        state.device.set_device_lost_callback(move |reason, message| {
            let mut told = told.lock().unwrap_or_else(PoisonError::into_inner);
            told.get_or_insert_with(|| line(&format!("device lost ({reason:?}) {message}")));
        });
        Self { device: state.device.clone(), renderer: Arc::clone(&state.renderer), lost }
    }

    /// Whether it monitors the device of `state`.
    pub(in super::super) fn monitors(&self, state: &RenderState) -> bool {
        Arc::ptr_eq(&self.renderer, &state.renderer)
    }

    /// Why the device was lost, if it was.
    pub(in super::super) fn loss(&self) -> Option<String> {
        // The callback runs when the device is polled, which takes no time. The result of polling does not matter here.
        let _ = self.device.poll(wgpu::PollType::Poll);
        let lost = self.lost.lock().unwrap_or_else(PoisonError::into_inner);
        lost.clone()
    }
}

/// Runs `work`; returns its result, or the first error that it causes on `device`.
///
/// # Errors
/// The message of the driver or of wgpu.
pub(super) fn catch_errors<T>(
    device: &wgpu::Device,
    work: impl FnOnce() -> T,
) -> Result<T, String> {
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let inner = device.push_error_scope(wgpu::ErrorFilter::Internal);
    let validation = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let done = work();
    let errors = [now(validation.pop()), now(inner.pop()), now(memory.pop())];
    match errors.into_iter().flatten().next() {
        Some(error) => Err(line(&error.to_string())),
        None => Ok(done),
    }
}

/// A message as one short line of ASCII words, because wgpu underlines code with characters that few fonts contain.
fn line(words: &str) -> String {
    let plain = words.split_whitespace().filter(|word| word.is_ascii());
    let line = plain.collect::<Vec<_>>().join(" ");
    line.chars().take(LONGEST).collect()
}

/// The result of a future that is ready at once, as those of error scopes are except in browsers.
fn now<T>(future: impl Future<Output = Option<T>>) -> Option<T> {
    let mut context = Context::from_waker(Waker::noop());
    match pin!(future).poll(&mut context) {
        Poll::Ready(answer) => answer,
        Poll::Pending => None,
    }
}
