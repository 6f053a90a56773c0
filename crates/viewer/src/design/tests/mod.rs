//! The panel driven headless: controls found by their names, the scene as they leave it.

mod canvas;
mod controls;
mod pictures;
mod scenes;
mod test_panel;
