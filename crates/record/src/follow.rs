//! The frame of a film that follows a sheet whose size changes.
//!
//! The fixed picture shows all of the motion. Where the sheet is small in it, a part of that picture is shown instead,
//! so large that the sheet fills [`FAIR`] of it; where the sheet is large, the picture stays whole. So most films have
//! one scale, and a roll that opens to many times its size is seen throughout.
//!
//! Frames move smoothly: each side of the frame is first moved out as far as it is anywhere within twice a window, and
//! then averaged over the window twice. An average of bounds that all hold here holds here too, so the sheet never
//! leaves the frame.

use glam::DVec2;

/// The part of the picture's room that the sheet fills at least, along the side that it fills more; less while it
/// grows, shrinks or moves fast.
const FAIR: f64 = 0.6;

/// Half a window of averages, seconds of the film.
const WINDOW: f64 = 0.08;

/// The least part of the fixed picture that is shown: a sheet that is a point in one state stays one.
const LEAST: f64 = 1e-3;

/// A part of the fixed picture, in pixels of it from its middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Frame {
    /// The middle of what is shown.
    pub(crate) middle: DVec2,
    /// What is shown of each side, above 0 and at most 1.
    pub(crate) part: f64,
}

impl Frame {
    /// The frame around `middle` of half sides `half`, moved into the whole picture and as wide as it for its height.
    /// `room`: half of the whole picture's sides without its margin.
    fn around(middle: DVec2, half: DVec2, room: DVec2) -> Self {
        let part = (half / room).max_element().clamp(LEAST, 1.0);
        let free = (1.0 - part) * room;
        Self { middle: middle.clamp(-free, free), part }
    }
}

/// The frame of each shot of a film, which shows the sheet within `boxes`: the least and the largest pixel from the
/// middle of the fixed picture.
///
/// `room`: half of the fixed picture's sides without its margin, in which all boxes lie; above 0.
pub(crate) fn frames(boxes: &[[DVec2; 2]], room: DVec2, fps: f64) -> Vec<Frame> {
    let fair = |&[low, high]: &[DVec2; 2]| {
        let frame = Frame::around(0.5 * (low + high), 0.5 * (high - low) / FAIR, room);
        let half = frame.part * room;
        [frame.middle - half, frame.middle + half]
    };
    let fair: Vec<[DVec2; 2]> = boxes.iter().map(fair).collect();
    #[expect(clippy::cast_sign_loss, reason = "rates are positive")]
    let window = (WINDOW * fps).round() as usize;
    let wide = over(&fair, 2 * window, |near| {
        let bounds = near.iter().copied();
        bounds.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
    });
    let mean = |near: &[[DVec2; 2]]| {
        let [low, high] = [0, 1].map(|k| near.iter().map(|bounds| bounds[k]).sum::<DVec2>());
        Some([low, high].map(|sum| sum / near.len() as f64))
    };
    let smooth = over(&over(&wide, window, mean), window, mean);
    let framed =
        |[low, high]: [DVec2; 2]| Frame::around(0.5 * (low + high), 0.5 * (high - low), room);
    smooth.into_iter().map(framed).collect()
}

/// What `value` makes of the bounds within `reach` of each.
fn over(
    bounds: &[[DVec2; 2]],
    reach: usize,
    value: impl Fn(&[[DVec2; 2]]) -> Option<[DVec2; 2]>,
) -> Vec<[DVec2; 2]> {
    let near = |k: usize| &bounds[k.saturating_sub(reach)..(k + reach + 1).min(bounds.len())];
    (0..bounds.len()).filter_map(|k| value(near(k))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOM: DVec2 = DVec2::new(400.0, 300.0);

    /// A box that grows from a fortieth of the room to all of it and wanders.
    fn growing(count: u32) -> Vec<[DVec2; 2]> {
        let part = |k: u32| f64::from(k) / f64::from(count - 1);
        let half = |k: u32| (0.025 + 0.975 * part(k).powi(3)) * ROOM * DVec2::new(1.0, 0.7);
        let middle = |k: u32| (1.0 - part(k)) * DVec2::new(-40.0, 20.0);
        (0..count).map(|k| [middle(k) - half(k), middle(k) + half(k)]).collect()
    }

    #[test]
    fn the_sheet_stays_inside_and_fills_a_fair_part_without_jumps() {
        let boxes = growing(90);
        let frames = frames(&boxes, ROOM, 30.0);
        assert_eq!(frames.len(), boxes.len());
        for (frame, [low, high]) in frames.iter().zip(&boxes) {
            let half = frame.part * ROOM + 1e-9;
            assert!((*low - frame.middle).cmpge(-half).all());
            assert!((*high - frame.middle).cmple(half).all());
            let fills = (0.5 * (*high - *low) / half).max_element();
            assert!(fills > 0.45, "{fills}");
        }
        for pair in frames.windows(2) {
            let zoom = pair[1].part / pair[0].part;
            assert!((0.99..1.08).contains(&zoom), "{zoom}");
            let moved = (pair[1].middle - pair[0].middle).abs() / (pair[0].part * ROOM);
            assert!(moved.max_element() < 0.05, "{moved}");
        }
    }

    #[test]
    fn a_frame_that_followed_at_once_would_jump_and_one_that_never_did_would_show_a_speck() {
        let mut boxes = vec![[-ROOM, ROOM]; 60];
        boxes[..30].fill([DVec2::splat(-10.0), DVec2::splat(10.0)]);
        let steps = |fps: f64| {
            let frames = frames(&boxes, ROOM, fps);
            let steps = frames.windows(2).map(|pair| pair[1].part - pair[0].part);
            steps.fold(0.0, f64::max)
        };
        assert!(steps(1.0) > 0.9, "no window at one shot a second");
        assert!(steps(30.0) < 0.2, "{}", steps(30.0));
        let part = frames(&boxes, ROOM, 30.0)[0].part;
        assert!((part - 10.0 / (FAIR * ROOM.y)).abs() < 1e-12, "{part}");
    }

    #[test]
    fn a_sheet_that_keeps_its_size_is_seen_in_the_whole_picture() {
        let boxes = [[-ROOM, ROOM * 0.9], [-0.61 * ROOM, 0.61 * ROOM]];
        let whole = Frame { middle: DVec2::ZERO, part: 1.0 };
        assert_eq!(frames(&boxes, ROOM, 30.0), [whole; 2]);
    }

    #[test]
    fn a_point_is_framed() {
        let [frame] = frames(&[[DVec2::ONE; 2]], ROOM, 30.0)[..] else {
            panic!("one shot");
        };
        assert!((frame.part - LEAST).abs() < 1e-12);
    }
}
