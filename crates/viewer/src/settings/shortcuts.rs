//! The commands of the window with their keys: one table, which keyboard input, menus and the help sheet read.

use eframe::egui::{Context, Event, Id, Key, KeyboardShortcut, Memory, Modifiers, Popup};

/// The groups in which menus and the help sheet list commands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Group {
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

/// A command with its name, group and keys.
#[derive(Debug)]
pub(super) struct Shortcut {
    pub(super) command: Command,
    pub(super) name: &'static str,
    pub(super) group: Group,
    pub(super) keys: &'static [KeyboardShortcut],
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

const CTRL_SHIFT: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };

const fn ctrl_shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(CTRL_SHIFT, key)
}

/// Defines the commands and the table of their names, groups and keys, the first key being the one that menus show.
macro_rules! commands {
    ($($group:ident { $($command:ident $name:literal $($key:expr),+;)+ })+) => {
        /// A command of the window.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub(crate) enum Command {
            $($($command,)+)+
        }

        /// Every command, by group.
        pub(super) const SHORTCUTS: &[Shortcut] = &[
            $($(Shortcut {
                command: Command::$command,
                name: $name,
                group: Group::$group,
                keys: &[$($key),+],
            },)+)+
        ];
    };
}

commands! {
    File {
        New "New scene" ctrl(Key::N);
        Open "Open…" ctrl(Key::O);
        Save "Save" ctrl(Key::S);
        SaveAs "Save as…" ctrl_shift(Key::S);
        Quit "Quit" ctrl(Key::Q);
    }
    Edit {
        Undo "Undo" ctrl(Key::Z);
        Redo "Redo" ctrl_shift(Key::Z), ctrl(Key::Y);
    }
    Motion {
        Run "Run" ctrl(Key::R), plain(Key::F5);
        Cancel "Cancel" plain(Key::Escape);
        Interact "Move the sheet by hand" plain(Key::H);
        Record "Record…" ctrl(Key::E);
    }
    Time {
        Play "Play or pause" plain(Key::Space);
        PreviousFrame "Previous frame" plain(Key::ArrowLeft), plain(Key::Comma);
        NextFrame "Next frame" plain(Key::ArrowRight), plain(Key::Period);
        Start "Deployed state" plain(Key::Home);
        Planar "Planar state" plain(Key::P);
        Compact "Compact state" plain(Key::End);
        Slower "Slower" plain(Key::Minus);
        Faster "Faster" plain(Key::Plus), plain(Key::Equals);
        Loop "Loop" plain(Key::L);
    }
    View {
        ViewFront "Front view" plain(Key::Num1);
        ViewSide "Side view" plain(Key::Num2);
        ViewTop "Top view" plain(Key::Num3);
        ViewIsometric "Isometric view" plain(Key::Num4);
        Fit "Fit to the window" plain(Key::F);
        Perspective "Perspective" plain(Key::V);
    }
    Colours {
        ColourPlain "Colour: plain" plain(Key::Num5);
        ColourStrain "Colour: strain" plain(Key::Num6);
        ColourBending "Colour: facet bending" plain(Key::Num7);
        ColourUnit "Colour: unit" plain(Key::Num8);
        ColourLayer "Colour: layer" plain(Key::Num9);
        Creases "Creases" plain(Key::C);
        Profile "Profile curve" plain(Key::G);
        CompactBox "Compact box" plain(Key::B);
        ClosedFormBox "Closed-form box" shift(Key::B);
    }
    Window {
        PanelDesign "Design panel" plain(Key::F2);
        PanelPlots "Plots" plain(Key::F3);
        PanelVerdict "Verdict" plain(Key::F4);
        PanelRecord "Record dialog" plain(Key::F6);
        PanelText "Scene as text" plain(Key::F7);
        Presentation "Larger, for presentations" plain(Key::F9);
        DarkLight "Dark or light" plain(Key::F10);
        Help "Shortcuts and help" plain(Key::F1), plain(Key::Questionmark);
    }
}

pub(crate) fn commands_of(group: Group) -> impl Iterator<Item = Command> {
    let shortcuts = SHORTCUTS.iter().filter(move |shortcut| shortcut.group == group);
    shortcuts.map(|shortcut| shortcut.command)
}

pub(crate) fn name_of(command: Command) -> &'static str {
    shortcut_of(command).map_or("", |shortcut| shortcut.name)
}

/// The keys of a command as the system writes them, such as `Ctrl+S`.
pub(crate) fn keys_of(ctx: &Context, command: Command) -> String {
    let keys = shortcut_of(command).and_then(|shortcut| shortcut.keys.first());
    keys.map_or_else(String::new, |&keys| written(ctx, keys))
}

/// Keys as the system writes them; printable characters stand for themselves.
pub(super) fn written(ctx: &Context, keys: KeyboardShortcut) -> String {
    let sign = keys.logical_key.symbol_or_name();
    if keys.modifiers.is_none() && (sign.is_ascii() || keys.logical_key == Key::Minus) {
        sign.to_owned()
    } else {
        ctx.format_shortcut(&keys)
    }
}

fn shortcut_of(command: Command) -> Option<&'static Shortcut> {
    SHORTCUTS.iter().find(|shortcut| shortcut.command == command)
}

/// The commands whose keys were pressed since the last frame; their events are removed from the input.
///
/// A text field with the keyboard focus gets all keys without Ctrl or ⌘, and any other control gets space, Enter, Escape and
/// the arrow keys. `canvas` (the 3D view) gets only arrows, plus and minus. An open modal dialog gets all keys.
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

/// What has the keyboard focus.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Focus {
    None,
    Canvas,
    Control,
    Text,
}

fn command_of(event: &Event, focus: Focus) -> Option<Command> {
    let &Event::Key { key, pressed: true, repeat, modifiers, .. } = event else {
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

/// Whether the pressed keys are these; some characters may need shift, as `?` does on many keyboards.
fn matches(keys: KeyboardShortcut, key: Key, mut modifiers: Modifiers) -> bool {
    if matches!(key, Key::Plus | Key::Questionmark | Key::Equals) {
        modifiers.shift = keys.modifiers.shift;
    }
    keys.logical_key == key && modifiers.matches_exact(keys.modifiers)
}

/// Whether the control with the focus needs these keys itself.
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

/// Whether `key` is F1, F2 and so on, which types no text.
fn is_function_key(key: Key) -> bool {
    key.name().len() > 1 && key.name().starts_with('F')
}

#[cfg(test)]
mod tests {
    use eframe::egui::RawInput;

    use super::*;

    fn key(key: Key, modifiers: Modifiers) -> Event {
        Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers }
    }

    #[test]
    fn no_two_commands_share_keys_or_names() {
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
            // egui zooms the window with these.
            let zoom = [Key::Plus, Key::Minus, Key::Equals, Key::Num0];
            assert!(!(keys.modifiers.command && zoom.contains(&keys.logical_key)));
        }
        for (k, shortcut) in SHORTCUTS.iter().enumerate() {
            let above = &SHORTCUTS[..k];
            assert!(!shortcut.keys.is_empty() && !shortcut.name.is_empty());
            assert!(above.iter().all(|s| s.name != shortcut.name));
        }
    }

    #[test]
    fn keys_execute_their_command_and_others_stay_in_the_input() {
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
        assert_eq!(commands, [Command::Save, Command::Redo, Command::Help, Command::ClosedFormBox]);
        assert_eq!(left, 2);
    }

    #[test]
    fn a_text_field_gets_the_keys_that_type_and_a_control_those_that_move_it() {
        let found = |event: Event| {
            [Focus::None, Focus::Canvas, Focus::Control, Focus::Text]
                .map(|focus| command_of(&event, focus))
        };
        let (play, fit) = (Some(Command::Play), Some(Command::Fit));
        assert_eq!(found(key(Key::Space, Modifiers::NONE)), [play, play, None, None]);
        assert_eq!(found(key(Key::F, Modifiers::NONE)), [fit, fit, fit, None]);
        let next = Some(Command::NextFrame);
        assert_eq!(found(key(Key::ArrowRight, Modifiers::NONE)), [next, None, None, None]);
        assert_eq!(found(key(Key::F5, Modifiers::NONE)), [Some(Command::Run); 4]);
        assert_eq!(found(key(Key::Z, Modifiers::COMMAND)), [Some(Command::Undo); 4]);
    }

    #[test]
    fn a_key_held_down_repeats_only_commands_that_go_step_by_step() {
        let held = |key| Event::Key {
            key,
            physical_key: None,
            pressed: true,
            repeat: true,
            modifiers: Modifiers::NONE,
        };
        assert_eq!(command_of(&held(Key::Space), Focus::None), None);
        assert_eq!(command_of(&held(Key::ArrowRight), Focus::None), Some(Command::NextFrame));
    }

    #[test]
    fn keys_are_written_as_the_system_does() {
        let ctx = Context::default();
        assert!(["Ctrl+S", "⌘S", "Cmd+S"].contains(&&*keys_of(&ctx, Command::Save)));
        assert_eq!(keys_of(&ctx, Command::Faster), "+");
        assert_eq!(name_of(Command::Save), "Save");
    }
}
