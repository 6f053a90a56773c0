//! The size of an SVG: from user units to lengths.

use std::str::FromStr as _;

use glam::{DAffine2, DVec2};
use roxmltree::Node;
use svgtypes::{Align, AspectRatio, ViewBox};

use super::super::{ImportError, LengthUnit};
use super::LineNumbers;
use super::values::{MM_A_UNIT, length, parsed, wrong};

/// From user units to the sheet's.
pub(super) struct Viewport {
    pub(super) transform: DAffine2,
    /// How long a user unit is, the smaller of both directions.
    pub(super) scale: f64,
    pub(super) unit: LengthUnit,
    /// Two opposite corners of the page, in the sheet's units; `None` if the file does not say how large it is.
    pub(super) page: Option<[DVec2; 2]>,
}

/// The viewport of the outermost `svg`.
pub(super) fn outer(root: Node<'_, '_>, numbering: &LineNumbers) -> Result<Viewport, ImportError> {
    let size = [side(root, numbering, "width")?, side(root, numbering, "height")?];
    let is_physical = size.iter().flatten().any(|(_, physical)| *physical);
    let unit = if is_physical { LengthUnit::Millimetre } else { LengthUnit::Unit };
    let lengths = size.map(|side| {
        let (length, physical) = side?;
        Some(match (is_physical, physical) {
            (true, false) => length * MM_A_UNIT,
            _ => length,
        })
    });
    let view = view_box(root, numbering)?;
    let mut scale = match &view {
        Some(view) => fit(root, numbering, lengths, view)?.unwrap_or(DVec2::ONE),
        None if is_physical => DVec2::splat(MM_A_UNIT),
        None => DVec2::ONE,
    };
    if !is_physical {
        // Without a physical size, user units are as good as pixels; only their proportion is kept.
        scale /= scale.x;
    }
    let page = match (view, size) {
        (Some(view), _) => {
            let low = DVec2::new(view.x, view.y);
            Some([low, low + DVec2::new(view.w, view.h)].map(|corner| corner * scale))
        }
        (None, [Some((width, _)), Some((height, _))]) if !is_physical => {
            Some([DVec2::ZERO, DVec2::new(width, height)])
        }
        _ => None,
    };
    let transform = DAffine2::from_scale(scale);
    Ok(Viewport { transform, scale: scale.min_element(), unit, page })
}

/// From the user units in a nested `svg` to those around it.
pub(super) fn nested(node: Node<'_, '_>, numbering: &LineNumbers) -> Result<DAffine2, ImportError> {
    let at = DVec2::new(length(node, numbering, "x")?, length(node, numbering, "y")?);
    let shift_to_corner = DAffine2::from_translation(at);
    let size = [side(node, numbering, "width")?, side(node, numbering, "height")?];
    let lengths = size.map(|side| {
        let (length, physical) = side?;
        Some(if physical { length / MM_A_UNIT } else { length })
    });
    let Some(view) = view_box(node, numbering)? else {
        return Ok(shift_to_corner);
    };
    let ([Some(width), Some(height)], Some(scale)) =
        (lengths, fit(node, numbering, lengths, &view)?)
    else {
        let text = node.attribute("viewBox").unwrap_or_default();
        let need = "a nested svg with a viewBox needs width and height in numbers";
        return Err(wrong(node, numbering, "viewBox", text, need));
    };
    let (free, align) = (
        DVec2::new(width, height) - scale * DVec2::new(view.w, view.h),
        aspect_ratio(node, numbering)?.align,
    );
    let share = match align {
        Align::None | Align::XMinYMin => DVec2::ZERO,
        Align::XMidYMin => DVec2::new(0.5, 0.0),
        Align::XMaxYMin => DVec2::new(1.0, 0.0),
        Align::XMinYMid => DVec2::new(0.0, 0.5),
        Align::XMidYMid => DVec2::new(0.5, 0.5),
        Align::XMaxYMid => DVec2::new(1.0, 0.5),
        Align::XMinYMax => DVec2::new(0.0, 1.0),
        Align::XMidYMax => DVec2::new(0.5, 1.0),
        Align::XMaxYMax => DVec2::ONE,
    };
    let origin = DAffine2::from_translation(-DVec2::new(view.x, view.y));
    let shift = DAffine2::from_translation(free * share);
    Ok(shift_to_corner * shift * DAffine2::from_scale(scale) * origin)
}

/// A side of the viewport and whether it is in mm; `None` if it is omitted or depends on the surroundings.
fn side(
    node: Node<'_, '_>,
    numbering: &LineNumbers,
    name: &'static str,
) -> Result<Option<(f64, bool)>, ImportError> {
    let text = node.attribute(name).filter(|text| text.trim() != "auto");
    let Some((text, found)) = text.and_then(|text| Some((text, parsed(text)?))) else {
        return Ok(None);
    };
    match found {
        Ok((length, physical)) if length > 0.0 => Ok(Some((length, physical))),
        _ => Err(wrong(node, numbering, name, text, "a positive length is needed")),
    }
}

fn view_box(node: Node<'_, '_>, numbering: &LineNumbers) -> Result<Option<ViewBox>, ImportError> {
    let Some(text) = node.attribute("viewBox") else {
        return Ok(None);
    };
    let view = ViewBox::from_str(text).ok();
    let is_finite = |v: &ViewBox| [v.x, v.y, v.w, v.h].iter().all(|n| n.is_finite());
    let need = "four finite numbers are needed, the last two positive";
    match view.filter(is_finite) {
        Some(view) => Ok(Some(view)),
        None => Err(wrong(node, numbering, "viewBox", text, need)),
    }
}

fn aspect_ratio(node: Node<'_, '_>, numbering: &LineNumbers) -> Result<AspectRatio, ImportError> {
    let name = "preserveAspectRatio";
    match node.attribute(name) {
        None => Ok(AspectRatio::default()),
        Some(text) => AspectRatio::from_str(text)
            .map_err(|_| wrong(node, numbering, name, text, "an alignment of SVG 1.1 is needed")),
    }
}

/// The factors by which a view box fits a viewport; `None` if the viewport has no size.
fn fit(
    node: Node<'_, '_>,
    numbering: &LineNumbers,
    lengths: [Option<f64>; 2],
    view: &ViewBox,
) -> Result<Option<DVec2>, ImportError> {
    let ratio = aspect_ratio(node, numbering)?;
    let [x, y] = [lengths[0].map(|w| w / view.w), lengths[1].map(|h| h / view.h)];
    Ok(match (x, y) {
        (None, None) => None,
        (Some(one), None) | (None, Some(one)) => Some(DVec2::splat(one)),
        (Some(x), Some(y)) if ratio.align == Align::None => Some(DVec2::new(x, y)),
        (Some(x), Some(y)) if ratio.slice => Some(DVec2::splat(x.max(y))),
        (Some(x), Some(y)) => Some(DVec2::splat(x.min(y))),
    })
}
