//! The commands that the window sends to the system.

use std::sync::{Arc, Mutex};

use eframe::egui::{Context, FullOutput, Plugin, ViewportCommand, ViewportId};

/// Records the commands.
#[derive(Debug, Clone, Default)]
pub(crate) struct System(Arc<Mutex<Vec<ViewportCommand>>>);

impl System {
    /// The last title that was set.
    pub(crate) fn title(&self) -> String {
        let asked = self.0.lock().unwrap();
        let mut titles = asked.iter().filter_map(|command| match command {
            ViewportCommand::Title(title) => Some(title.clone()),
            _ => None,
        });
        titles.next_back().unwrap_or_default()
    }

    /// Whether the command was sent since the last call.
    pub(crate) fn was_asked_for(&self, command: &ViewportCommand) -> bool {
        let mut asked = self.0.lock().unwrap();
        let before = asked.len();
        asked.retain(|other| other != command);
        asked.len() < before
    }
}

impl Plugin for System {
    fn debug_name(&self) -> &'static str {
        "system"
    }

    fn output_hook(&mut self, _: &Context, output: &mut FullOutput) {
        if let Some(root) = output.viewport_output.get(&ViewportId::ROOT) {
            self.0.lock().unwrap().extend(root.commands.iter().cloned());
        }
    }
}
