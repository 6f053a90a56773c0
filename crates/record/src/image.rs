//! A picture in memory.

use crate::RecordError;

/// The largest area of a picture: keeps the memory of one film below about half a gibibyte.
pub const MAX_PIXELS: u64 = 1 << 26;

/// Rows of sRGB pixels from the top down.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// `width` × `height` pixels, row by row.
    pub pixels: Vec<[u8; 3]>,
}

impl Image {
    /// The pixel in column `x`, row `y`.
    ///
    /// # Panics
    /// Where x or y lies outside the picture.
    pub fn pixel(&self, x: u32, y: u32) -> [u8; 3] {
        assert!(x < self.width && y < self.height, "({x}, {y}) is in the picture");
        self.pixels[(y * self.width + x) as usize]
    }
}

/// Refuses sizes that no picture has.
pub(crate) fn check_size([width, height]: [u32; 2]) -> Result<(), RecordError> {
    let side = 1..=u32::from(u16::MAX);
    let area = u64::from(width) * u64::from(height);
    if side.contains(&width) && side.contains(&height) && area <= MAX_PIXELS {
        return Ok(());
    }
    Err(RecordError::Size { width, height, limit: MAX_PIXELS })
}
