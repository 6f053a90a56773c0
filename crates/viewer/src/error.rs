//! Errors of the window.

use thiserror::Error;

/// What still works without a window, as every error says.
const WITHOUT: &str = "foldmotion run, record, check, pattern and paper work without a window";

/// Why the window could not be opened or had to close. Each message says what to install and what works without it.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ViewerError {
    /// No X11 or Wayland server to show a window.
    #[error(
        "no display: DISPLAY and WAYLAND_DISPLAY are not set, or no server answers ({reason}); start the window in a desktop \
         session, with ssh -X, or under Xvfb (package xvfb: xvfb-run -a foldmotion view); {WITHOUT}"
    )]
    NoDisplay {
        /// What was found in the environment, or the message of the window library.
        reason: String,
    },
    /// A shared library that windows need is missing.
    #[error(
        "a system library that windows need is missing ({reason}); on Debian and Ubuntu: apt install libx11-6 libx11-xcb1 \
         libxcursor1 libxi6 libxkbcommon-x11-0 (on Wayland libwayland-client0 libxkbcommon0); {WITHOUT}"
    )]
    NoLibrary {
        /// The message of the window library, which names the library.
        reason: String,
    },
    /// No graphics adapter for Vulkan, Metal, Direct3D or OpenGL.
    #[error(
        "no graphics adapter: {reason}; install the driver of your graphics card, or Mesa's software Vulkan (Debian, \
         Ubuntu, Fedora: mesa-vulkan-drivers; Arch: vulkan-swrast); {WITHOUT}"
    )]
    NoAdapter {
        /// The message of the graphics library.
        reason: String,
    },
    /// The window closed with an error.
    #[error(
        "the window failed: {reason}; unsaved scenes are offered again at the next start; {WITHOUT}"
    )]
    Window {
        /// The message of the error or panic.
        reason: String,
    },
}

impl ViewerError {
    /// The error that closed the window, by its kind.
    pub(crate) fn of(error: &eframe::Error) -> Self {
        let reason = error.to_string();
        match error {
            eframe::Error::Wgpu(_) => Self::NoAdapter { reason },
            eframe::Error::WinitEventLoop(_) => Self::NoDisplay { reason },
            _ => Self::Window { reason },
        }
    }

    /// The error that a panic inside the window library stands for.
    pub(crate) fn of_panic(reason: String) -> Self {
        if reason.contains("could not be loaded") || reason.contains(".so") {
            Self::NoLibrary { reason }
        } else {
            Self::Window { reason }
        }
    }
}

/// The message of a panic.
pub(crate) fn panic_message(payload: &(dyn std::any::Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().map(|s| (*s).to_owned());
    text.or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "no message".to_owned())
}
