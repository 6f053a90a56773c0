//! Why there is no window.

use thiserror::Error;

/// What works without a window.
const WITHOUT: &str = "without a window there is foldmotion run, record, check, pattern and paper";

/// Errors of the window. Each names what to install, and what works without it.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ViewerError {
    /// No X11 or Wayland server to show a window.
    #[error(
        "no display: neither DISPLAY nor WAYLAND_DISPLAY is set, or nothing answers there ({reason}); start it in a desktop session, with \
         ssh -X, or under Xvfb (package xvfb: xvfb-run -a foldmotion view); {WITHOUT}"
    )]
    NoDisplay {
        /// What was found.
        reason: String,
    },
    /// A library that windows need is not there.
    #[error(
        "a system library that windows need is missing ({reason}); on Debian and Ubuntu: apt install libx11-6 libx11-xcb1 \
         libxcursor1 libxi6 libxkbcommon-x11-0 (on Wayland libwayland-client0 libxkbcommon0); {WITHOUT}"
    )]
    NoLibrary {
        /// Which.
        reason: String,
    },
    /// Neither Vulkan, Metal, Direct3D nor OpenGL.
    #[error(
        "no graphics adapter: {reason}; install the driver of your graphics card, or Mesa's software Vulkan (Debian, \
         Ubuntu, Fedora: mesa-vulkan-drivers; Arch: vulkan-swrast); {WITHOUT}"
    )]
    NoAdapter {
        /// What the graphics library said.
        reason: String,
    },
    /// The window ended with an error.
    #[error(
        "the window failed: {reason}; unsaved scenes are offered again at the next start; {WITHOUT}"
    )]
    Window {
        /// What it said.
        reason: String,
    },
}

impl ViewerError {
    /// What ended the window, sorted.
    pub(crate) fn of(error: &eframe::Error) -> Self {
        let reason = error.to_string();
        match error {
            eframe::Error::Wgpu(_) => Self::NoAdapter { reason },
            eframe::Error::WinitEventLoop(_) => Self::NoDisplay { reason },
            _ => Self::Window { reason },
        }
    }

    /// What a panic within the window library says.
    pub(crate) fn of_panic(reason: String) -> Self {
        if reason.contains("could not be loaded") || reason.contains(".so") {
            Self::NoLibrary { reason }
        } else {
            Self::Window { reason }
        }
    }
}
