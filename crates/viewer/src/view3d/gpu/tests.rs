//! Tests of the shader, and of its pictures against those of films.
//!
//! Tests that need a GPU are ignored unless FOLDMOTION_GPU_TESTS=yes is set when they are built; Mesa's software Vulkan
//! is enough.

use eframe::egui_wgpu::wgpu::naga;
use eframe::egui_wgpu::{RendererOptions, wgpu};
use egui_kittest::wgpu::{create_render_state, default_wgpu_setup};
use foldmotion_pattern::{Case, LayerOrder, Unit, UnitSheet};
use foldmotion_record::{Image, Layers, Style, View as Direction, picture as film_picture, png};
use glam::{DVec2, DVec3};

use super::super::prepared::PreparedSheet;
use super::super::projection::Projection;
use super::pipelines::{CORNERS, CREASES, PAINTS, SEGMENTS, SOURCE};
use super::*;
use crate::view3d::picture::{Overlay, Shape};
use crate::view3d::{Colours, OrbitCamera, VertexPull};

const SIZE: [u32; 2] = [480, 360];

fn module() -> naga::Module {
    naga::front::wgsl::parse_str(SOURCE).unwrap_or_else(|e| panic!("{}", e.emit_to_string(SOURCE)))
}

#[test]
fn the_shader_is_valid_for_devices_without_extras() {
    let flags = naga::valid::ValidationFlags::all();
    let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty());
    validator.validate(&module()).unwrap();
    let broken = SOURCE.replace("view.scale.z", "view.scale.q");
    assert!(naga::front::wgsl::parse_str(&broken).is_err());
}

#[test]
fn the_view_has_the_size_of_the_shader_and_passes_read_what_buffers_hold() {
    let module = module();
    let (_, view) =
        (module.types.iter()).find(|(_, ty)| ty.name.as_deref() == Some("View")).unwrap();
    let naga::TypeInner::Struct { span, .. } = view.inner else {
        panic!("View is a struct");
    };
    assert_eq!(span as usize, 4 * VIEW_FLOATS);
    let read = |name: &str| {
        let entry = module.entry_points.iter().find(|e| e.name == name).unwrap();
        let located =
            |a: &&naga::FunctionArgument| matches!(a.binding, Some(naga::Binding::Location { .. }));
        let mut layouter = naga::proc::Layouter::default();
        layouter.update(module.to_ctx()).unwrap();
        let size = |a: &naga::FunctionArgument| module.types[a.ty].inner.size(module.to_ctx());
        let arguments = entry.function.arguments.iter().filter(located);
        arguments.map(size).collect::<Vec<u32>>()
    };
    let held = |buffers: &[&[wgpu::VertexAttribute]]| {
        let attributes = buffers.iter().flat_map(|b| b.iter());
        attributes.map(|a| a.format.size() as u32).collect::<Vec<u32>>()
    };
    assert_eq!(read("face_vertex"), held(&[&CORNERS, &PAINTS]));
    assert_eq!(read("crease_vertex"), held(&[&CREASES]));
    assert_eq!(read("overlay_vertex"), held(&[&SEGMENTS]));
    assert_eq!(read("hidden_vertex"), held(&[&SEGMENTS]));
}

/// A sheet of units with everything that a picture borrows.
pub(in super::super) struct Subject {
    pub(in super::super) units: UnitSheet,
    pub(in super::super) order: LayerOrder,
    pub(in super::super) layers: Layers,
    pub(in super::super) style: Style,
}

impl Subject {
    pub(in super::super) fn new(case: Case, width: f64, rows: usize, columns: usize) -> Self {
        let unit = Unit::new(case, width, 1.0, (case == Case::SII).then_some(0.7), None).unwrap();
        let units = UnitSheet::new(unit, rows, columns).unwrap();
        let order = units.compact_order();
        let layers = Layers::new(&units.sheet, &order, &units.compact());
        Self { units, order, layers, style: Style::default() }
    }

    pub(in super::super) fn picture<'a>(
        &'a self,
        positions: &'a [DVec3],
        state_key: u64,
    ) -> Picture<'a> {
        Picture {
            sheet: &self.units.sheet,
            sheet_key: 1,
            positions,
            state_key,
            layers: Some(&self.layers),
            colours: Colours::Plain,
            creases: CreaseClasses::default(),
            style: &self.style,
            background: Color32::WHITE,
            overlays: &[],
            flash: &[],
            pulse: 1.0,
            pull: None,
            can_pull: false,
        }
    }
}

pub(in super::super) fn device() -> RenderState {
    create_render_state(default_wgpu_setup(), RendererOptions::PREDICTABLE)
}

/// Draws `picture` and returns its pixels.
fn drawn(gpu: &mut Gpu, picture: &Picture<'_>, orbit: &OrbitCamera) -> Image {
    let prepared = PreparedSheet::new(picture);
    let size = DVec2::from(SIZE.map(f64::from));
    let lines = segments(picture);
    let sphere = prepared.sphere.with(lines.iter().flat_map(|line| line.ends));
    let projection = Projection::new(orbit, size, sphere);
    let view = FrameView {
        projection: &projection,
        prepared: &prepared,
        size: SIZE,
        pixels_per_point: 1.0,
    };
    gpu.show(picture, &view).unwrap();
    read(gpu)
}

/// The picture that was drawn last.
fn read(gpu: &Gpu) -> Image {
    let [width, height] = SIZE;
    let row = (4 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(row * height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let picture = gpu.target.as_ref().unwrap().picture();
    encoder.copy_texture_to_buffer(
        picture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(row),
                rows_per_image: None,
            },
        },
        picture.size(),
    );
    gpu.queue.submit([encoder.finish()]);
    buffer.map_async(wgpu::MapMode::Read, .., |done| done.unwrap());
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
    let bytes = buffer.get_mapped_range(..).unwrap();
    let rows = bytes.chunks(row as usize).map(|r| &r[..4 * width as usize]);
    let pixels = rows.flat_map(|r| r.chunks(4).map(|p| [p[0], p[1], p[2]]));
    Image { width, height, pixels: pixels.collect() }
}

/// Saves a picture in the folder FOLDMOTION_PICTURES, if it is set, to be looked at.
pub(in super::super) fn keep(image: &Image, name: &str) {
    if let Ok(folder) = std::env::var("FOLDMOTION_PICTURES") {
        let path = std::path::Path::new(&folder).join(format!("{name}.png"));
        std::fs::write(path, png(image).unwrap()).unwrap();
    }
}

/// What a pixel of a picture without lines shows: front, back or background.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Class {
    Front,
    Back,
    Background,
}

fn class([r, _, b]: [u8; 3]) -> Class {
    match r.cmp(&b) {
        std::cmp::Ordering::Greater => Class::Front,
        std::cmp::Ordering::Less => Class::Back,
        std::cmp::Ordering::Equal => Class::Background,
    }
}

/// The fraction of the pixels of `a` and `b` that `differ`.
fn part(a: &Image, b: &Image, differ: impl Fn([u8; 3], [u8; 3]) -> bool) -> f64 {
    let pairs = a.pixels.iter().zip(&b.pixels);
    let count = pairs.filter(|&(&p, &q)| differ(p, q)).count();
    count as f64 / a.pixels.len() as f64
}

const CASES: [(Case, f64); 4] = [(Case::E, 1.0), (Case::T, 0.8), (Case::S, 1.6), (Case::SII, 1.7)];

/// Views of the compact state from all sides, also from below.
fn views() -> Vec<Direction> {
    let mut views = Direction::NAMES.map(|(_, view)| view).to_vec();
    for (azimuth, elevation) in [(130.0, 25.0), (-60.0, -35.0), (20.0, 70.0)] {
        views.push(Direction::Around { azimuth, elevation });
    }
    views
}

fn fitted(view: Direction, positions: &[DVec3]) -> OrbitCamera {
    let mut orbit = OrbitCamera::default();
    orbit.set_view(view, DVec3::ZERO);
    orbit.fit(positions.iter().copied(), DVec2::from(SIZE.map(f64::from)));
    orbit
}

/// The fraction of pixels of the wrong class in pictures without lines, and of a clearly different colour in pictures
/// with lines.
fn apart(
    gpu: &mut Gpu,
    subject: &mut Subject,
    positions: &[DVec3],
    key: u64,
    name: &str,
) -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    for (k, view) in views().into_iter().enumerate() {
        let orbit = fitted(view, positions);
        let camera = orbit.camera(SIZE).unwrap();
        for (j, line_width) in [0.0, 1.8].into_iter().enumerate() {
            subject.style.line_width = line_width;
            let (sheet, style) = (&subject.units.sheet, &subject.style);
            let film =
                film_picture(sheet, positions, &subject.order, &camera, style, SIZE).unwrap();
            let mut picture = subject.picture(positions, key);
            if line_width == 0.0 {
                // A line of width 0 is still drawn as a hairline.
                picture.creases = CreaseClasses::NONE;
            }
            let window = drawn(gpu, &picture, &orbit);
            let differ = |p: [u8; 3], q: [u8; 3]| match j {
                0 => class(p) != class(q),
                _ => (0..3).map(|c| i32::from(p[c].abs_diff(q[c]))).sum::<i32>() > 150,
            };
            worst[j] = worst[j].max(part(&film, &window, differ));
            if j == 1 {
                keep(&window, &format!("{name}-{k}"));
                keep(&film, &format!("{name}-{k}-film"));
            }
        }
    }
    worst
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn the_compact_state_shows_the_layers_that_films_show_from_all_around() {
    let mut gpu = Gpu::new(&device()).unwrap();
    for (key, (case, width)) in (1..).zip(CASES) {
        let mut subject = Subject::new(case, width, 4, 3);
        let positions = subject.units.compact();
        gpu.drawn.sheet_key = None;
        let [faces, lines] = apart(&mut gpu, &mut subject, &positions, key, case.name());
        println!("{case:?}: {faces:.5} of another side, {lines:.5} of another colour");
        assert!(faces < 3e-3, "{case:?}: {faces}");
        assert!(lines < 1.2e-2, "{case:?}: {lines}");
        let crossing = crossing(&positions);
        let [faces, _] = apart(&mut gpu, &mut subject, &crossing, 10 + key, "crossing");
        println!("{case:?}: {faces:.5} where layers cross");
        assert!(faces < 1e-2, "{case:?}: {faces}");
    }
}

/// Positions displaced by up to 3e-3 in each coordinate, so that layers intersect as they do in a motion without
/// contact.
fn crossing(positions: &[DVec3]) -> Vec<DVec3> {
    let moved = |(k, &p): (usize, &DVec3)| {
        let part = |n: usize| (k * 7919 + n * 104_729) % 1000;
        let [x, y, z] = [1, 2, 3].map(|n| part(n) as f64 / 500.0 - 1.0);
        p + 3e-3 * DVec3::new(x, y, z)
    };
    positions.iter().enumerate().map(moved).collect()
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn a_dot_is_drawn_at_its_projection_also_in_perspective() {
    let mut gpu = Gpu::new(&device()).unwrap();
    let subject = Subject::new(Case::S, 1.6, 3, 2);
    let compact = subject.units.compact();
    for perspective in [false, true] {
        let mut orbit = fitted(Direction::Iso, &compact);
        orbit.perspective = perspective;
        for &place in compact.iter().step_by(9) {
            let places = [place];
            let dots = red(Shape::Dots(&places), 5.0);
            let mut picture = subject.picture(&compact, 1);
            picture.overlays = &dots;
            let sphere = PreparedSheet::new(&picture).sphere;
            let at =
                Projection::new(&orbit, DVec2::from(SIZE.map(f64::from)), sphere).project(place);
            let image = drawn(&mut gpu, &picture, &orbit);
            assert_eq!(image.pixels[at_pixel(at)], [255, 0, 0], "{place} at {at}");
        }
    }
}

/// The index of the pixel that contains `at`.
#[expect(clippy::cast_sign_loss, reason = "points in the picture are positive")]
fn at_pixel(at: DVec3) -> usize {
    at.y as usize * SIZE[0] as usize + at.x as usize
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn without_the_order_of_layers_the_same_comparison_fails() {
    let mut gpu = Gpu::new(&device()).unwrap();
    let mut subject = Subject::new(Case::E, 1.0, 4, 3);
    subject.layers.before.fill([0; 2]);
    let positions = subject.units.compact();
    let [faces, _] = apart(&mut gpu, &mut subject, &positions, 1, "unordered");
    assert!(faces > 1e-2, "{faces}");
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn paper_has_the_colours_of_films_on_both_sides() {
    let mut gpu = Gpu::new(&device()).unwrap();
    let mut subject = Subject::new(Case::S, 1.6, 2, 2);
    subject.style.line_width = 0.0;
    let flat = subject.units.sheet.planar();
    for (key, view) in (1..).zip([
        Direction::Top,
        Direction::Iso,
        Direction::Around { azimuth: 10.0, elevation: -50.0 },
    ]) {
        let orbit = fitted(view, &flat);
        let camera = orbit.camera(SIZE).unwrap();
        let (sheet, style) = (&subject.units.sheet, &subject.style);
        let film = film_picture(sheet, &flat, &subject.order, &camera, style, SIZE).unwrap();
        let mut picture = subject.picture(&flat, key);
        picture.creases = CreaseClasses::NONE;
        let window = drawn(&mut gpu, &picture, &orbit);
        let middle = |image: &Image| image.pixel(SIZE[0] / 2, SIZE[1] / 2);
        let [a, b] = [&film, &window].map(middle);
        assert!((0..3).all(|c| a[c].abs_diff(b[c]) <= 1), "{view:?}: {a:?} {b:?}");
    }
}

fn red(shape: Shape<'_>, width: f32) -> [Overlay<'_>; 1] {
    [Overlay { shape, colour: Color32::from_rgb(255, 0, 0), width }]
}

/// The darkness of the middle row of pixels, summed up.
fn darkness(image: &Image) -> f64 {
    let row = SIZE[1] / 2;
    let pixels = (0..SIZE[0]).map(|x| image.pixel(x, row));
    let light = pixels.map(|p| f64::from(p[1]) / 255.0);
    light.map(|l| 1.0 - l).sum()
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn lines_have_the_same_width_at_any_zoom() {
    let mut gpu = Gpu::new(&device()).unwrap();
    let mut subject = Subject::new(Case::E, 1.0, 1, 1);
    subject.style = Style {
        front: [255; 3],
        back: [255; 3],
        border: [0; 3],
        line_width: 6.0,
        ..Style::default()
    };
    let flat = subject.units.sheet.planar();
    let mut picture = subject.picture(&flat, 1);
    // Only the border is drawn, its left side in the middle of the view.
    picture.creases = CreaseClasses { border: true, ..CreaseClasses::NONE };
    let mut orbit = fitted(Direction::Top, &flat);
    let left = flat.iter().map(|p| p.x).fold(f64::INFINITY, f64::min);
    orbit.centre.x = left;
    let mut widths = Vec::new();
    for zoom in [4.0, 20.0, 500.0] {
        let mut near = orbit;
        near.width /= zoom;
        let image = drawn(&mut gpu, &picture, &near);
        keep(&image, &format!("line-{zoom}"));
        // Paper does not reflect all light, so it adds to the darkness to the right of the line.
        let paper = image.pixel(SIZE[0] - 2, SIZE[1] / 2)[1];
        let dark = darkness(&image) - f64::from(255 - paper) / 255.0 * f64::from(SIZE[0] / 2 - 3);
        widths.push(dark);
    }
    println!("{widths:?}");
    for width in &widths {
        assert!((width - 6.0).abs() < 0.35, "{widths:?}");
    }
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn overlays_are_dimmed_behind_the_sheet_and_dots_and_pulls_are_not() {
    let mut gpu = Gpu::new(&device()).unwrap();
    let subject = Subject::new(Case::E, 1.0, 2, 2);
    let flat = subject.units.sheet.planar();
    let orbit = fitted(Direction::Top, &flat);
    let mut picture = subject.picture(&flat, 1);
    picture.creases = CreaseClasses::NONE;
    let plain = drawn(&mut gpu, &picture, &orbit);
    let middle = orbit.centre;
    let line = |z: f64| [-0.5, 0.5].map(|x| middle + DVec3::new(x, 0.0, z));
    let colour = |gpu: &mut Gpu, overlays: &[Overlay<'_>], pull| {
        let picture = Picture { overlays, pull, ..picture };
        drawn(gpu, &picture, &orbit).pixel(SIZE[0] / 2, SIZE[1] / 2)
    };
    let [above, below] = [1.0, -1.0].map(line);
    let before = colour(&mut gpu, &red(Shape::Path(&above), 5.0), None);
    assert_eq!(before, [255, 0, 0]);
    let behind = colour(&mut gpu, &red(Shape::Path(&below), 5.0), None);
    let paper = plain.pixel(SIZE[0] / 2, SIZE[1] / 2);
    assert!(behind[1] < paper[1] && behind[1] > 100, "{behind:?} on {paper:?}");
    let dots = [middle + DVec3::new(0.0, 0.0, -1.0)];
    let dot = red(Shape::Dots(&dots), 9.0);
    assert_eq!(colour(&mut gpu, &dot, None), [255, 0, 0]);
    let pull = VertexPull { vertex: 0, target: dots[0] };
    assert_eq!(colour(&mut gpu, &[], Some(pull)), subject.style.mark);
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn flashing_triangles_go_from_the_colour_of_paper_to_that_of_marks() {
    let mut gpu = Gpu::new(&device()).unwrap();
    let subject = Subject::new(Case::E, 1.0, 2, 2);
    let flat = subject.units.sheet.planar();
    let orbit = fitted(Direction::Top, &flat);
    let flash: Vec<u32> = (0..subject.units.sheet.faces.len() as u32).collect();
    let mut picture = subject.picture(&flat, 1);
    picture.creases = CreaseClasses::NONE;
    picture.flash = &flash;
    let mut at = |pulse| {
        picture.pulse = pulse;
        drawn(&mut gpu, &picture, &orbit).pixel(SIZE[0] / 2, SIZE[1] / 2)
    };
    let (paper, marked) = (at(0.0), at(1.0));
    assert!(class(paper) == Class::Front && marked[1] < 60 && marked[0] > 150, "{marked:?}");
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn an_error_of_the_driver_is_returned() {
    let state = device();
    let catch_errors = catch_errors(&state.device, || {
        state.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("too large"),
            size: 1 << 60,
            usage: wgpu::BufferUsages::VERTEX,
            mapped_at_creation: false,
        })
    });
    assert!(catch_errors.unwrap_err().contains("too large"));
}
