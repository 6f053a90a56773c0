//! One pixel: the mean, in linear light, of its samples.
//!
//! Samples on the same triangles mostly see the same one of them, so they are decided together where bounds allow it.

use glam::{DVec2, Vec3};

use crate::screen_face::ScreenFace;
use crate::shade::{Inks, Paint, encoded};
use crate::square::{Mask, SAMPLES};
use crate::surface::{Candidate, Layer};
use crate::{Style, Surface};

/// The colours of samples: the surface with the colour of each triangle.
pub(crate) struct Canvas<'a> {
    pub(crate) surface: &'a Surface<'a>,
    pub(crate) inks: Inks,
    /// The colour of each triangle, in linear light.
    pub(crate) faces: Vec<Vec3>,
    pub(crate) colors: Vec<[u8; 3]>,
}

impl<'a> Canvas<'a> {
    /// `paints`: of each triangle; all show their paper where the list is empty.
    pub(crate) fn new(surface: &'a Surface<'a>, style: &Style, paints: &[Paint]) -> Self {
        let inks = style.inks();
        let colour = |(index, face): (usize, &ScreenFace)| match paints.get(index) {
            Some(Paint::Mark) => inks.marked(face.normal),
            Some(Paint::Value(light)) => Inks::valued(*light, face.normal),
            _ => inks.paper(face.normal),
        };
        let faces: Vec<Vec3> = surface.faces().iter().enumerate().map(colour).collect();
        Self { surface, inks, colors: faces.iter().map(|&light| encoded(light)).collect(), faces }
    }

    /// The colour of the line of `edge`.
    pub(crate) fn line(&self, edge: u32) -> Vec3 {
        let edges = &self.surface.paper().sheet.edges;
        self.inks.line(edges[edge as usize].assignment)
    }
}

/// Lists kept from pixel to pixel.
#[derive(Default)]
pub(crate) struct Pixel {
    layers: Vec<Layer>,
    /// The candidates at one sample.
    found: Vec<Candidate>,
    /// The edges whose lines are drawn on a triangle, and at which samples.
    lines: Vec<(u32, Mask)>,
}

impl Pixel {
    /// The light of the pixel around `centre`, in which the triangles of `list` may show.
    pub(crate) fn light(&mut self, canvas: &Canvas<'_>, list: &[u32], centre: DVec2) -> Vec3 {
        let surface = canvas.surface;
        self.layers.clear();
        for &face in list {
            surface.find_layer(face, centre, &mut self.layers);
        }
        let (mut rest, mut shared) = (0, 0);
        for layer in &self.layers {
            shared |= rest & layer.shown();
            rest |= layer.shown();
        }
        let mut sum = canvas.inks.background * rest.count_zeros() as f32;
        if shared == 0 {
            // Neighbours beside each other: nothing hides anything.
            for index in 0..self.layers.len() {
                let Layer { face, .. } = self.layers[index];
                let seen = self.layers[index].shown();
                sum += self.sum(canvas, face, surface.lines(face), seen, centre);
            }
            return sum / SAMPLES as f32;
        }
        while rest != 0 {
            let first = rest.trailing_zeros() as usize;
            let Some((face, seen)) = self.front(surface, first) else {
                break;
            };
            sum += self.sum(canvas, face, surface.lines(face), seen & rest, centre);
            rest &= !seen;
        }
        sum / SAMPLES as f32
    }

    /// The light of the pixel around `centre`, which `face` fills, with the lines of `edges`.
    pub(crate) fn filled(
        &mut self,
        canvas: &Canvas<'_>,
        face: u32,
        edges: &[u32],
        centre: DVec2,
    ) -> Vec3 {
        self.sum(canvas, face, edges, Mask::MAX, centre) / SAMPLES as f32
    }

    /// The triangle that is seen at sample `k`, and samples at which it is certainly seen too.
    fn front(&mut self, surface: &Surface<'_>, k: usize) -> Option<(u32, Mask)> {
        self.found.clear();
        let candidates = self.layers.iter().filter_map(|layer| layer.candidate(k));
        self.found.extend(candidates);
        let face = surface.front_of(&mut self.found)?.face;
        let front = self.layers.iter().find(|layer| layer.face == face)?;
        let mut seen = front.shown();
        for other in &self.layers {
            let both = seen & other.shown();
            if other.face != face && both != 0 {
                seen &= !both | surface.before(front, other, both);
            }
        }
        Some((face, seen | 1 << k))
    }

    /// The sum of the light of those samples in `seen` of the pixel around `centre`, where `face` with the lines of
    /// `edges` is seen.
    fn sum(
        &mut self,
        canvas: &Canvas<'_>,
        face: u32,
        edges: &[u32],
        seen: Mask,
        centre: DVec2,
    ) -> Vec3 {
        canvas.surface.find_lines(edges, centre, &mut self.lines);
        let mut paper = seen;
        let mut sum = Vec3::ZERO;
        for &(edge, line) in &self.lines {
            sum += canvas.line(edge) * (line & seen).count_ones() as f32;
            paper &= !line;
        }
        sum + canvas.faces[face as usize] * paper.count_ones() as f32
    }
}
