//! The view, driven without a window.

use eframe::egui::{Key, Modifiers, PointerButton, Pos2, Vec2, pos2};
use eframe::egui_wgpu::RenderState;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use foldmotion_pattern::{Case, Facing};
use foldmotion_record::{Image, View};
use glam::{DVec2, DVec3};

use super::gpu::tests::{Subject, device, keep};
use super::*;

/// What the view shows of its sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum TestColours {
    Plain,
    Strain,
    Units,
    Layers,
    Overlays,
}

/// A view and its last response.
struct Window {
    view: View3d,
    subject: Subject,
    positions: Vec<DVec3>,
    state_key: u64,
    render_state: Option<RenderState>,
    can_pull: bool,
    colours: TestColours,
    /// The last pull, vertex and triangle.
    pull: Option<VertexPull>,
    vertex: Option<u32>,
    face: Option<u32>,
}

impl Window {
    fn new(subject: Subject, positions: Vec<DVec3>) -> Self {
        Self {
            view: View3d::default(),
            subject,
            positions,
            state_key: 1,
            render_state: None,
            can_pull: false,
            colours: TestColours::Plain,
            pull: None,
            vertex: None,
            face: None,
        }
    }

    /// Shows another state and fits the view to it.
    fn take(&mut self, positions: Vec<DVec3>) {
        self.view.fit(positions.clone());
        self.positions = positions;
        self.state_key += 1;
    }

    fn show(&mut self, ui: &mut Ui) {
        let mut picture = self.subject.picture(&self.positions, self.state_key);
        picture.can_pull = self.can_pull;
        picture.background = ui.visuals().extreme_bg_color;
        let values: Vec<f64> = (0..picture.sheet.faces.len()).map(|k| k as f64).collect();
        let range = [0.0, values.len() as f64];
        let (low, high) = (DVec3::new(-2.2, 0.0, 0.0), DVec3::new(2.2, 8.0, 2.2));
        let edges = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| axis * (high - low));
        let colour = ui.visuals().hyperlink_color;
        let overlay = |shape, width| Overlay { shape, colour, width };
        let path = [low, 0.5 * (low + high), high];
        let overlays = [
            overlay(Shape::Box(low, edges), 1.5),
            overlay(Shape::Path(&path), 2.0),
            overlay(Shape::Dots(&path), 8.0),
        ];
        picture.colours = match self.colours {
            TestColours::Strain => Colours::Values { values: &values, range, key: 0 },
            TestColours::Units => Colours::Units,
            TestColours::Layers => Colours::Layers,
            TestColours::Plain | TestColours::Overlays => Colours::Plain,
        };
        if self.colours == TestColours::Overlays {
            picture.overlays = &overlays;
            picture.flash = &[3, 40, 41, 42];
            picture.pull = Some(VertexPull { vertex: 30, target: high });
        }
        let seen = self.view.show(ui, self.render_state.as_ref(), &picture);
        (self.vertex, self.face) = (seen.vertex, seen.face);
        self.pull = seen.pull.or(self.pull);
    }
}

fn flat() -> Window {
    let subject = Subject::new(Case::E, 1.0, 3, 2);
    let flat = subject.units.sheet.planar();
    Window::new(subject, flat)
}

fn harness(window: Window) -> Harness<'static, Window> {
    Harness::builder()
        .with_size(Vec2::new(400.0, 300.0))
        .build_ui_state(|ui, window: &mut Window| window.show(ui), window)
}

/// The position of `point` on the screen.
fn on_screen(harness: &Harness<'_, Window>, point: DVec3) -> Pos2 {
    let rect = harness.get_by_label("3D view").rect();
    let orbit = harness.state().view.orbit();
    let size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
    let projection = Projection::new(&orbit, size, projection::Sphere::around([]));
    let at = projection.project(point);
    rect.min + Vec2::new(at.x as f32, at.y as f32)
}

fn drag(harness: &mut Harness<'_, Window>, button: PointerButton, from: Pos2, to: Pos2) {
    let press = |pos, pressed| egui::Event::PointerButton {
        pos,
        button,
        pressed,
        modifiers: Modifiers::NONE,
    };
    harness.hover_at(from);
    harness.step();
    harness.event(press(from, true));
    harness.step();
    for part in [0.3, 0.6, 1.0] {
        harness.hover_at(from.lerp(to, part));
        harness.step();
    }
    harness.event(press(to, false));
    harness.run();
}

#[test]
fn without_a_gpu_the_view_is_drawn_and_named() {
    let mut harness = harness(flat());
    harness.run();
    harness.get_by_label("3D view");
    assert!(harness.state().view.error().is_none() && harness.state().view.drawn() == 0);
}

#[test]
fn the_first_picture_shows_the_whole_sheet() {
    let mut harness = harness(flat());
    harness.run();
    let rect = harness.get_by_label("3D view").rect();
    for &point in &harness.state().positions {
        assert!(rect.contains(on_screen(&harness, point)));
    }
}

#[test]
fn the_vertex_and_the_facet_under_the_pointer_are_found() {
    let mut window = flat();
    window.view.look(View::Top);
    let mut harness = harness(window);
    harness.run();
    let place = harness.state().positions[4];
    let at = on_screen(&harness, place);
    harness.hover_at(at + Vec2::new(3.0, -2.0));
    harness.run();
    assert_eq!(harness.state().vertex, Some(4));
    let sheet = &harness.state().subject.units.sheet;
    let face = sheet.faces[5];
    let middle = face.map(|v| harness.state().positions[v as usize]).iter().sum::<DVec3>() / 3.0;
    harness.hover_at(on_screen(&harness, middle));
    harness.run();
    assert_eq!(harness.state().face, Some(5));
    harness.hover_at(pos2(1.0, 1.0));
    harness.run();
    assert_eq!([harness.state().vertex, harness.state().face], [None; 2]);
}

#[test]
fn a_vertex_hidden_by_the_sheet_is_not_picked() {
    let subject = Subject::new(Case::S, 1.6, 3, 2);
    let compact = subject.units.compact();
    let mut harness = harness(Window::new(subject, compact));
    harness.run();
    let hidden = hidden_vertices(harness.state());
    assert!(hidden.len() > 3, "{hidden:?}");
    for vertex in hidden {
        let at = on_screen(&harness, harness.state().positions[vertex as usize]);
        harness.hover_at(at);
        harness.step();
        harness.step();
        assert_ne!(harness.state().vertex, Some(vertex));
    }
}

/// Vertices clearly behind a triangle, found by rays towards the viewer.
fn hidden_vertices(window: &Window) -> Vec<u32> {
    let [_, _, toward] = window.view.orbit().axes();
    let sheet = &window.subject.units.sheet;
    let hides = |face: &[u32; 3], point: DVec3| {
        let [a, b, c] = face.map(|v| window.positions[v as usize]);
        let n = (b - a).cross(c - a);
        let distance = n.dot(a - point) / n.dot(toward);
        let hit = point + distance * toward;
        let inside = |p: DVec3, q: DVec3| (q - p).cross(hit - p).dot(n) > 0.02;
        distance > 0.1 && inside(a, b) && inside(b, c) && inside(c, a)
    };
    let is_hidden = |&vertex: &u32| {
        let point = window.positions[vertex as usize];
        sheet.faces.iter().any(|face| hides(face, point))
    };
    (0..window.positions.len() as u32).filter(is_hidden).collect()
}

#[test]
fn drags_turn_and_move_and_the_wheel_zooms_about_the_pointer() {
    let mut harness = harness(flat());
    harness.run();
    let before = harness.state().view.orbit();
    let (from, to) = (pos2(200.0, 150.0), pos2(250.0, 170.0));
    drag(&mut harness, PointerButton::Primary, from, to);
    let turned = harness.state().view.orbit();
    assert!(turned.azimuth < before.azimuth && turned.elevation > before.elevation);
    assert_eq!(turned.width, before.width);
    let point = harness.state().view.pivot;
    let was = on_screen(&harness, point);
    drag(&mut harness, PointerButton::Secondary, from, to);
    let moved = on_screen(&harness, point) - was;
    assert!((moved - (to - from)).length() < 1e-2, "{moved}");
    let at = on_screen(&harness, point);
    harness.hover_at(at);
    harness.step();
    harness.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: Vec2::new(0.0, 60.0),
        source: egui::MouseWheelSource::Unknown,
        phase: egui::TouchPhase::Move,
        modifiers: Modifiers::NONE,
    });
    harness.run();
    let width = harness.state().view.orbit().width;
    assert!(width < 0.9 * turned.width, "{width} of {}, at {at}", turned.width);
    assert!((on_screen(&harness, point) - at).length() < 1e-2);
}

#[test]
fn a_pulled_vertex_follows_the_pointer_in_the_plane_of_the_screen_and_the_camera_stays() {
    let mut window = flat();
    window.can_pull = true;
    let mut harness = harness(window);
    harness.run();
    let orbit = harness.state().view.orbit();
    let place = harness.state().positions[4];
    let from = on_screen(&harness, place);
    let to = from + Vec2::new(40.0, -25.0);
    drag(&mut harness, PointerButton::Primary, from, to);
    let pull = harness.state().pull.unwrap();
    assert_eq!(harness.state().view.orbit(), orbit);
    assert_eq!(pull.vertex, 4);
    assert!((on_screen(&harness, pull.target) - to).length() < 1e-2);
    assert!(orbit.axes()[2].dot(pull.target - place).abs() < 1e-9);
    // A drag that does not start at a vertex turns the view.
    drag(&mut harness, PointerButton::Primary, pos2(20.0, 20.0), pos2(60.0, 30.0));
    assert_ne!(harness.state().view.orbit(), orbit);
}

#[test]
fn arrow_keys_turn_the_view_that_has_the_focus() {
    let mut harness = harness(flat());
    harness.run();
    let before = harness.state().view.orbit();
    harness.key_press(Key::ArrowLeft);
    harness.run();
    assert_eq!(harness.state().view.orbit(), before, "it has no focus yet");
    harness.get_by_label("3D view").focus();
    harness.run();
    harness.key_press(Key::ArrowLeft);
    harness.run();
    assert!((before.azimuth - harness.state().view.orbit().azimuth - 5.0).abs() < 1e-9);
}

#[test]
fn a_transition_to_a_standard_view_ends_and_then_nothing_moves() {
    let mut harness = harness(flat());
    harness.run();
    harness.state_mut().view.look(View::Front);
    let frames = harness.run();
    assert!(frames > 1);
    let orbit = harness.state().view.orbit;
    assert_eq!([orbit.azimuth, orbit.elevation], [-90.0, 0.0]);
    assert_eq!(harness.run(), 1);
}

#[test]
fn missing_or_infinite_positions_leave_the_view_empty() {
    for positions in [vec![], vec![DVec3::ZERO], vec![DVec3::NAN; 1000]] {
        let mut window = flat();
        let count = window.positions.len();
        window.positions = positions;
        window.positions.truncate(count);
        let mut harness = harness(window);
        harness.run();
        assert_eq!(harness.state().face, None);
    }
}

/// A view that is drawn by the GPU.
fn with_gpu(mut window: Window, size: [f32; 2], is_dark: bool) -> Harness<'static, Window> {
    let state = device();
    window.render_state = Some(state.clone());
    let theme = if is_dark { egui::Theme::Dark } else { egui::Theme::Light };
    Harness::builder()
        .with_size(Vec2::from(size))
        .with_theme(theme)
        .renderer(egui_kittest::wgpu::WgpuTestRenderer::from_render_state(state))
        .build_ui_state(|ui, window: &mut Window| window.show(ui), window)
}

fn render(harness: &mut Harness<'_, Window>, name: &str) {
    harness.run();
    let image = harness.render().unwrap();
    let image = Image {
        width: image.width(),
        height: image.height(),
        pixels: image.pixels().map(|p| [p[0], p[1], p[2]]).collect(),
    };
    keep(&image, name);
}

type Change = fn(&mut Window);

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn an_idle_frame_draws_nothing_and_every_change_draws_once() {
    let mut harness = with_gpu(flat(), [400.0, 300.0], true);
    harness.run();
    assert_eq!(harness.state().view.error(), None);
    let mut drawn = harness.state().view.drawn();
    assert!(drawn > 0);
    harness.run_steps(5);
    assert_eq!(harness.state().view.drawn(), drawn);
    let changes: [(&str, Change); 4] = [
        ("state", |w| w.state_key += 1),
        ("camera", |w| w.view.orbit.azimuth += 3.0),
        ("style", |w| w.subject.style.line_width = 3.0),
        ("colours", |w| w.colours = TestColours::Units),
    ];
    for (what, change) in changes {
        change(harness.state_mut());
        harness.run_steps(3);
        drawn += 1;
        assert_eq!(harness.state().view.drawn(), drawn, "{what}");
    }
    harness.set_size(Vec2::new(300.0, 200.0));
    harness.run_steps(3);
    assert_eq!(harness.state().view.drawn(), drawn + 1, "size");
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn a_lost_device_is_reported_and_another_one_draws_again() {
    let mut window = flat();
    let state = device();
    window.render_state = Some(state.clone());
    let mut harness = harness(window);
    harness.run();
    assert_eq!(harness.state().view.error(), None);
    state.device.destroy();
    // The loss is reported once pending work is done.
    let wait = eframe::egui_wgpu::wgpu::PollType::wait_indefinitely();
    let _ = state.device.poll(wait);
    harness.state_mut().view.look(View::Top);
    harness.run();
    let error = harness.state().view.error();
    assert!(error.is_some_and(|error| error.contains("lost")));
    harness.get_by_label("3D view");
    harness.state_mut().render_state = Some(device());
    harness.run();
    assert_eq!(harness.state().view.error(), None);
    assert!(harness.state().view.drawn() > 0);
}

/// A shelter with seven rows and five columns.
fn shelter() -> Window {
    let subject = Subject::new(Case::S, 1.6, 7, 5);
    let arch: Vec<DVec2> = (0..=7)
        .map(|k| {
            let (sin, cos) = (std::f64::consts::PI * f64::from(k) / 7.0).sin_cos();
            DVec2::new(-2.247 * cos, 2.247 * sin)
        })
        .collect();
    let deployed = subject.units.deployed(&arch, Facing::Left).unwrap();
    Window::new(subject, deployed)
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn every_state_colour_and_look_is_drawn() {
    for (theme, is_dark) in [("dark", true), ("light", false)] {
        let mut harness = with_gpu(shelter(), [800.0, 560.0], is_dark);
        let mut drawn = 0;
        let mut look = |harness: &mut Harness<'static, Window>, name: &str| {
            render(harness, &format!("{name}-{theme}"));
            assert_eq!(harness.state().view.error(), None, "{name}");
            assert!(harness.state().view.drawn() > drawn, "{name}");
            drawn = harness.state().view.drawn();
        };
        look(&mut harness, "deployed");
        harness.state_mut().colours = TestColours::Strain;
        look(&mut harness, "strain");
        harness.state_mut().colours = TestColours::Units;
        look(&mut harness, "units");
        let half = half_folded(harness.state());
        harness.state_mut().colours = TestColours::Overlays;
        harness.state_mut().take(half);
        look(&mut harness, "half");
        let compact = harness.state().subject.units.compact();
        harness.state_mut().colours = TestColours::Plain;
        harness.state_mut().take(compact);
        look(&mut harness, "compact");
        harness.state_mut().colours = TestColours::Layers;
        look(&mut harness, "layers");
        harness.state_mut().view.set_perspective(true);
        look(&mut harness, "perspective");
        harness.state_mut().render_state = None;
        render(&mut harness, &format!("plain-{theme}"));
    }
}

/// A state between deployed and compact along straight lines. No engine produces it, but its layers come together.
fn half_folded(window: &Window) -> Vec<DVec3> {
    let pairs = window.positions.iter().zip(window.subject.units.compact());
    pairs.map(|(a, b)| a.lerp(b, 0.6)).collect()
}

/// Prints the time of a frame with a new state: of the processor alone, and until it is drawn.
#[test]
#[ignore = "measures and proves nothing: run it alone, with FOLDMOTION_GPU_TESTS=yes"]
fn how_long_a_frame_takes() {
    let wait = || eframe::egui_wgpu::wgpu::PollType::wait_indefinitely();
    for (rows, columns) in [(7, 5), (35, 5), (100, 5)] {
        let subject = Subject::new(Case::S, 1.6, rows, columns);
        let flat = subject.units.sheet.planar();
        let (vertices, faces) = (flat.len(), subject.units.sheet.faces.len());
        let mut harness = with_gpu(Window::new(subject, flat), [1016.0, 716.0], true);
        harness.run();
        let state = harness.state().render_state.clone();
        let device = state.unwrap().device;
        let [mut shown, mut drawn, mut idle] = [const { Vec::new() }; 3];
        for _ in 0..20 {
            harness.state_mut().state_key += 1;
            let start = std::time::Instant::now();
            harness.step();
            shown.push(start.elapsed().as_secs_f64() * 1e3);
            device.poll(wait()).unwrap();
            drawn.push(start.elapsed().as_secs_f64() * 1e3);
            let start = std::time::Instant::now();
            harness.step();
            idle.push(start.elapsed().as_secs_f64() * 1e3);
        }
        let median = |times: &mut Vec<f64>| {
            times.sort_by(f64::total_cmp);
            times[times.len() / 2]
        };
        let [shown, drawn, idle] = [&mut shown, &mut drawn, &mut idle].map(median);
        println!(
            "{rows}x{columns}, {vertices} vertices, {faces} triangles: frame {shown:.2} ms on the processor, {drawn:.2} ms until drawn, idle {idle:.2} ms"
        );
    }
}
