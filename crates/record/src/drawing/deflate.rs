//! The compression of the streams of a PDF.

use miniz_oxide::deflate::compress_to_vec_zlib;

/// The compression level of streams, 0 to 10.
const EFFORT: u8 = 8;

/// `bytes` as a zlib stream (filter `FlateDecode`).
pub(super) fn deflated(bytes: &[u8]) -> Vec<u8> {
    compress_to_vec_zlib(bytes, EFFORT)
}
