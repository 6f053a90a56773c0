//! Every command of the window with its keys: one table that input is matched against and the help sheet shows.

use eframe::egui::{Context, Event, Id, Key, KeyboardShortcut, Memory, Modifiers, Popup};

/// What can be asked of the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Command {
    New,
    Open,
    Save,
    SaveAs,
    Quit,
    Undo,
    Redo,
    Run,
    Cancel,
    Interact,
    Record,
    Play,
    PreviousFrame,
    NextFrame,
    Start,
    Planar,
    Compact,
    Slower,
    Faster,
    Loop,
    ViewFront,
    ViewSide,
    ViewTop,
    ViewIsometric,
    Fit,
    Perspective,
    ColourPlain,
    ColourStrain,
    ColourBending,
    ColourUnit,
    ColourLayer,
    Creases,
    Profile,
    CompactBox,
    ClosedFormBox,
    PanelDesign,
    PanelPlots,
    PanelVerdict,
    PanelRecord,
    PanelText,
    Presentation,
    DarkLight,
    Help,
}

/// What commands are about, as the help sheet lists them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Group {
    File,
    Edit,
    Motion,
    Time,
    View,
    Colours,
    Window,
}

impl Group {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::File => "File",
            Self::Edit => "Edit",
            Self::Motion => "Run and record",
            Self::Time => "Time",
            Self::View => "View",
            Self::Colours => "Colours and overlays",
            Self::Window => "Window",
        }
    }
}

/// A command with its name and keys.
#[derive(Debug)]
pub(super) struct Shortcut {
    pub(super) command: Command,
    pub(super) name: &'static str,
    pub(super) group: Group,
    pub(super) keys: &'static [KeyboardShortcut],
}

const fn row(
    command: Command,
    name: &'static str,
    group: Group,
    keys: &'static [KeyboardShortcut],
) -> Shortcut {
    Shortcut {
        command,
        name,
        group,
        keys,
    }
}

const fn plain(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}

const fn shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::SHIFT, key)
}

/// Ctrl, or ⌘ on a Mac.
const fn ctrl(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND, key)
}

const CTRL_SHIFT: Modifiers = Modifiers {
    shift: true,
    ..Modifiers::COMMAND
};

const fn ctrl_shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(CTRL_SHIFT, key)
}

/// Every command, by group.
pub(super) const SHORTCUTS: &[Shortcut] = &[
    row(Command::New, "New scene", Group::File, &[ctrl(Key::N)]),
    row(Command::Open, "Open…", Group::File, &[ctrl(Key::O)]),
    row(Command::Save, "Save", Group::File, &[ctrl(Key::S)]),
    row(
        Command::SaveAs,
        "Save as…",
        Group::File,
        &[ctrl_shift(Key::S)],
    ),
    row(Command::Quit, "Quit", Group::File, &[ctrl(Key::Q)]),
    row(Command::Undo, "Undo", Group::Edit, &[ctrl(Key::Z)]),
    row(
        Command::Redo,
        "Redo",
        Group::Edit,
        &[ctrl_shift(Key::Z), ctrl(Key::Y)],
    ),
    row(
        Command::Run,
        "Run",
        Group::Motion,
        &[ctrl(Key::R), plain(Key::F5)],
    ),
    row(
        Command::Cancel,
        "Cancel the run",
        Group::Motion,
        &[plain(Key::Escape)],
    ),
    row(
        Command::Interact,
        "Take the sheet in the hand",
        Group::Motion,
        &[plain(Key::H)],
    ),
    row(Command::Record, "Record…", Group::Motion, &[ctrl(Key::E)]),
    row(
        Command::Play,
        "Play or pause",
        Group::Time,
        &[plain(Key::Space)],
    ),
    row(
        Command::PreviousFrame,
        "Previous frame",
        Group::Time,
        &[plain(Key::ArrowLeft), plain(Key::Comma)],
    ),
    row(
        Command::NextFrame,
        "Next frame",
        Group::Time,
        &[plain(Key::ArrowRight), plain(Key::Period)],
    ),
    row(
        Command::Start,
        "Deployed state",
        Group::Time,
        &[plain(Key::Home)],
    ),
    row(
        Command::Planar,
        "Planar state",
        Group::Time,
        &[plain(Key::P)],
    ),
    row(
        Command::Compact,
        "Compact state",
        Group::Time,
        &[plain(Key::End)],
    ),
    row(Command::Slower, "Slower", Group::Time, &[plain(Key::Minus)]),
    row(
        Command::Faster,
        "Faster",
        Group::Time,
        &[plain(Key::Plus), plain(Key::Equals)],
    ),
    row(Command::Loop, "Loop", Group::Time, &[plain(Key::L)]),
    row(
        Command::ViewFront,
        "From the front",
        Group::View,
        &[plain(Key::Num1)],
    ),
    row(
        Command::ViewSide,
        "From the side",
        Group::View,
        &[plain(Key::Num2)],
    ),
    row(
        Command::ViewTop,
        "From the top",
        Group::View,
        &[plain(Key::Num3)],
    ),
    row(
        Command::ViewIsometric,
        "Isometric",
        Group::View,
        &[plain(Key::Num4)],
    ),
    row(
        Command::Fit,
        "Fit to the window",
        Group::View,
        &[plain(Key::F)],
    ),
    row(
        Command::Perspective,
        "Perspective",
        Group::View,
        &[plain(Key::V)],
    ),
    row(
        Command::ColourPlain,
        "Colour: plain",
        Group::Colours,
        &[plain(Key::Num5)],
    ),
    row(
        Command::ColourStrain,
        "Colour: strain",
        Group::Colours,
        &[plain(Key::Num6)],
    ),
    row(
        Command::ColourBending,
        "Colour: facet bending",
        Group::Colours,
        &[plain(Key::Num7)],
    ),
    row(
        Command::ColourUnit,
        "Colour: unit",
        Group::Colours,
        &[plain(Key::Num8)],
    ),
    row(
        Command::ColourLayer,
        "Colour: layer",
        Group::Colours,
        &[plain(Key::Num9)],
    ),
    row(
        Command::Creases,
        "Creases",
        Group::Colours,
        &[plain(Key::C)],
    ),
    row(
        Command::Profile,
        "Profile curve",
        Group::Colours,
        &[plain(Key::G)],
    ),
    row(
        Command::CompactBox,
        "Compact box",
        Group::Colours,
        &[plain(Key::B)],
    ),
    row(
        Command::ClosedFormBox,
        "Closed-form box",
        Group::Colours,
        &[shift(Key::B)],
    ),
    row(
        Command::PanelDesign,
        "Design panel",
        Group::Window,
        &[plain(Key::F2)],
    ),
    row(
        Command::PanelPlots,
        "Plots",
        Group::Window,
        &[plain(Key::F3)],
    ),
    row(
        Command::PanelVerdict,
        "Verdict",
        Group::Window,
        &[plain(Key::F4)],
    ),
    row(
        Command::PanelRecord,
        "Record panel",
        Group::Window,
        &[plain(Key::F6)],
    ),
    row(
        Command::PanelText,
        "Scene as text",
        Group::Window,
        &[plain(Key::F7)],
    ),
    row(
        Command::Presentation,
        "Larger, for presentation",
        Group::Window,
        &[plain(Key::F9)],
    ),
    row(
        Command::DarkLight,
        "Dark or light",
        Group::Window,
        &[plain(Key::F10)],
    ),
    row(
        Command::Help,
        "Short-cuts and help",
        Group::Window,
        &[plain(Key::F1), plain(Key::Questionmark)],
    ),
];

/// The name of a command in menus.
pub(crate) fn name_of(command: Command) -> &'static str {
    shortcut_of(command).map_or("", |shortcut| shortcut.name)
}

/// The keys of a command as the system writes them, such as `Ctrl+S`.
pub(crate) fn keys_of(ctx: &Context, command: Command) -> String {
    let keys = shortcut_of(command).and_then(|shortcut| shortcut.keys.first());
    keys.map_or_else(String::new, |&keys| written(ctx, keys))
}

/// Keys as the system writes them; signs as signs.
pub(super) fn written(ctx: &Context, keys: KeyboardShortcut) -> String {
    let sign = keys.logical_key.symbol_or_name();
    if keys.modifiers.is_none() && (sign.is_ascii() || keys.logical_key == Key::Minus) {
        sign.to_owned()
    } else {
        ctx.format_shortcut(&keys)
    }
}

fn shortcut_of(command: Command) -> Option<&'static Shortcut> {
    SHORTCUTS
        .iter()
        .find(|shortcut| shortcut.command == command)
}

/// The commands whose keys were pressed since the last frame; their keys are taken out of the input.
///
/// Keys without Ctrl or ⌘ are left to a text field that is being typed into, and space, enter and arrows to whatever has
/// the focus; a `canvas` keeps arrows, plus and minus only. While a modal is open, all keys are its own.
pub(crate) fn pressed(ctx: &Context, canvas: Option<Id>) -> Vec<Command> {
    if ctx.memory(|memory| memory.top_modal_layer().is_some()) {
        return Vec::new();
    }
    let focus = match ctx.memory(Memory::focused) {
        // Escape closes a menu before it cancels a run.
        None if Popup::is_any_open(ctx) => Focus::Control,
        None => Focus::None,
        Some(_) if ctx.text_edit_focused() => Focus::Text,
        focused if focused == canvas => Focus::Canvas,
        Some(_) => Focus::Control,
    };
    let mut commands = Vec::new();
    ctx.input_mut(|input| {
        input.events.retain(|event| match command_of(event, focus) {
            Some(command) => {
                commands.push(command);
                false
            }
            None => true,
        });
    });
    commands
}

/// What the keyboard speaks to.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Focus {
    None,
    Canvas,
    Control,
    Text,
}

fn command_of(event: &Event, focus: Focus) -> Option<Command> {
    let &Event::Key {
        key,
        pressed: true,
        repeat,
        modifiers,
        ..
    } = event
    else {
        return None;
    };
    let shortcut = SHORTCUTS.iter().find(|shortcut| {
        let mut keys = shortcut.keys.iter();
        keys.any(|&keys| matches(keys, key, modifiers) && !is_kept(keys, focus))
    })?;
    let repeats = matches!(
        shortcut.command,
        Command::Undo | Command::Redo | Command::PreviousFrame | Command::NextFrame
    );
    (repeats || !repeat).then_some(shortcut.command)
}

/// Whether these keys were pressed; signs may need shift, as `?` does on many keyboards.
fn matches(keys: KeyboardShortcut, key: Key, mut modifiers: Modifiers) -> bool {
    if matches!(key, Key::Plus | Key::Questionmark | Key::Equals) {
        modifiers.shift = keys.modifiers.shift;
    }
    keys.logical_key == key && modifiers.matches_exact(keys.modifiers)
}

/// Whether what has the focus needs these keys itself.
fn is_kept(keys: KeyboardShortcut, focus: Focus) -> bool {
    let is_arrow = matches!(keys.logical_key, Key::ArrowLeft | Key::ArrowRight);
    let zooms = matches!(keys.logical_key, Key::Plus | Key::Equals | Key::Minus);
    let presses = matches!(keys.logical_key, Key::Space | Key::Enter | Key::Escape);
    match focus {
        Focus::None => false,
        Focus::Canvas => is_arrow || zooms,
        Focus::Control => is_arrow || presses,
        Focus::Text => !keys.modifiers.command && !is_function_key(keys.logical_key),
    }
}

/// Keys that type nothing.
fn is_function_key(key: Key) -> bool {
    key.name().len() > 1 && key.name().starts_with('F')
}

#[cfg(test)]
mod tests {
    use eframe::egui::RawInput;

    use super::*;

    fn key(key: Key, modifiers: Modifiers) -> Event {
        Event::Key {
            key,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers,
        }
    }

    #[test]
    fn no_two_commands_share_keys_and_each_stands_once() {
        let all: Vec<_> = SHORTCUTS.iter().flat_map(|s| s.keys).collect();
        for (k, keys) in all.iter().enumerate() {
            assert!(!all[..k].contains(keys), "{keys:?}");
            let event = key(keys.logical_key, keys.modifiers);
            let found = SHORTCUTS.iter().filter(|s| {
                s.keys.iter().any(|other| {
                    let Event::Key { key, modifiers, .. } = event else {
                        return false;
                    };
                    matches(*other, key, modifiers)
                })
            });
            assert_eq!(found.count(), 1, "{keys:?}");
            // The window enlarges by these itself.
            let zoom = [Key::Plus, Key::Minus, Key::Equals, Key::Num0];
            assert!(!(keys.modifiers.command && zoom.contains(&keys.logical_key)));
        }
        for (k, shortcut) in SHORTCUTS.iter().enumerate() {
            let above = &SHORTCUTS[..k];
            assert!(!shortcut.keys.is_empty() && !shortcut.name.is_empty());
            assert!(
                above
                    .iter()
                    .all(|s| s.command != shortcut.command && s.name != shortcut.name)
            );
        }
        // The last of the enum: every one before it stands in the table.
        assert_eq!(SHORTCUTS.len(), Command::Help as usize + 1);
    }

    #[test]
    fn keys_find_their_command_and_others_stay_in_the_input() {
        let ctx = Context::default();
        let mut commands = Vec::new();
        let mut left = 0;
        let input = RawInput {
            events: vec![
                key(Key::S, Modifiers::COMMAND),
                key(Key::Z, CTRL_SHIFT),
                key(Key::A, Modifiers::NONE),
                key(Key::Questionmark, Modifiers::SHIFT),
                key(Key::B, Modifiers::SHIFT),
                key(Key::B, Modifiers::ALT),
            ],
            ..RawInput::default()
        };
        let output = ctx.run_ui(input, |ui| {
            commands.extend(pressed(ui.ctx(), None));
            left = ui.input(|input| input.events.len());
        });
        output.drop_without_applying_deltas();
        assert_eq!(
            commands,
            [
                Command::Save,
                Command::Redo,
                Command::Help,
                Command::ClosedFormBox
            ]
        );
        assert_eq!(left, 2);
    }

    #[test]
    fn a_text_field_keeps_what_it_can_type_and_a_control_what_moves_it() {
        let found = |event: Event| {
            [Focus::None, Focus::Canvas, Focus::Control, Focus::Text]
                .map(|focus| command_of(&event, focus))
        };
        let (play, fit) = (Some(Command::Play), Some(Command::Fit));
        assert_eq!(
            found(key(Key::Space, Modifiers::NONE)),
            [play, play, None, None]
        );
        assert_eq!(found(key(Key::F, Modifiers::NONE)), [fit, fit, fit, None]);
        let next = Some(Command::NextFrame);
        assert_eq!(
            found(key(Key::ArrowRight, Modifiers::NONE)),
            [next, None, None, None]
        );
        assert_eq!(
            found(key(Key::F5, Modifiers::NONE)),
            [Some(Command::Run); 4]
        );
        assert_eq!(
            found(key(Key::Z, Modifiers::COMMAND)),
            [Some(Command::Undo); 4]
        );
    }

    #[test]
    fn a_key_held_down_repeats_only_what_goes_step_by_step() {
        let held = |key| Event::Key {
            key,
            physical_key: None,
            pressed: true,
            repeat: true,
            modifiers: Modifiers::NONE,
        };
        assert_eq!(command_of(&held(Key::Space), Focus::None), None);
        assert_eq!(
            command_of(&held(Key::ArrowRight), Focus::None),
            Some(Command::NextFrame)
        );
    }

    #[test]
    fn keys_are_written_as_the_system_does() {
        let ctx = Context::default();
        assert!(["Ctrl+S", "⌘S", "Cmd+S"].contains(&&*keys_of(&ctx, Command::Save)));
        assert_eq!(keys_of(&ctx, Command::Faster), "+");
        assert_eq!(name_of(Command::Save), "Save");
    }
}
