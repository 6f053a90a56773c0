//! The panel driven headless: controls found by their names, the scene as they leave it.

mod bench;
mod canvas;
mod controls;
mod pictures;
mod scenes;
