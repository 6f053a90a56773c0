//! Starting the window from the command line.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use eframe::egui::{IconData, ViewportBuilder};

use crate::error::{ViewerError, panic_message};
use crate::options::ViewOptions;
use crate::window::Viewer;

/// Opens the window; returns when it is closed.
///
/// # Errors
/// [`ViewerError`]: no display, no library, no graphics adapter, or the window failed.
pub fn view(options: ViewOptions) -> Result<(), ViewerError> {
    let started = Instant::now();
    require_display()?;
    let viewport = ViewportBuilder::default()
        .with_app_id("foldmotion")
        .with_inner_size([1360.0, 860.0])
        .with_min_inner_size([640.0, 420.0])
        .with_icon(icon());
    let native = eframe::NativeOptions {
        viewport,
        renderer: eframe::Renderer::Wgpu,
        ..eframe::NativeOptions::default()
    };
    let window = AssertUnwindSafe(|| {
        eframe::run_native(
            "foldmotion",
            native,
            Box::new(move |creation| Ok(Box::new(Viewer::new(creation, options, started)))),
        )
    });
    // Window libraries panic if a shared library is missing.
    match catch_unwind(window) {
        Ok(Ok(())) => Ok(()),
        Ok(Err(error)) => Err(ViewerError::of(&error)),
        Err(panic) => Err(ViewerError::of_panic(panic_message(panic.as_ref()))),
    }
}

/// # Errors
/// [`ViewerError::NoDisplay`] if no display server is named in the environment.
#[cfg(all(unix, not(target_os = "macos")))]
fn require_display() -> Result<(), ViewerError> {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    if is_set("DISPLAY") || is_set("WAYLAND_DISPLAY") || is_set("WAYLAND_SOCKET") {
        return Ok(());
    }
    Err(ViewerError::NoDisplay { reason: "none is named".to_owned() })
}

#[cfg(not(all(unix, not(target_os = "macos"))))]
fn require_display() -> Result<(), ViewerError> {
    Ok(())
}

/// The icon: a light and a dark facet on a transparent background.
fn icon() -> IconData {
    const SIDE: u32 = 64;
    let colour = |x: f32, y: f32| -> [u8; 4] {
        let ridge = 0.5 + 0.18 * (y - 0.5);
        let slope = if x < ridge { x / ridge } else { (1.0 - x) / (1.0 - ridge) };
        let top = 0.62 - 0.44 * slope;
        match (y > top && y < top + 0.42, x < ridge) {
            (true, true) => [255, 246, 226, 255],
            (true, false) => [148, 172, 192, 255],
            _ => [0, 0, 0, 0],
        }
    };
    let centre = |k: u32| (k as f32 + 0.5) / SIDE as f32;
    let rgba = (0..SIDE * SIDE).flat_map(|k| colour(centre(k % SIDE), centre(k / SIDE)));
    IconData { rgba: rgba.collect(), width: SIDE, height: SIDE }
}
