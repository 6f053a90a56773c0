//! Tests that drive the panel without a window: they find controls by name and check the scene.

mod canvas;
mod controls;
mod pictures;
mod scenes;
mod test_panel;
