//! The compression of the streams of a PDF.

use miniz_oxide::deflate::compress_to_vec_zlib;

/// How hard streams are compressed, of 10.
const EFFORT: u8 = 8;

/// `bytes` as a zlib stream (filter `FlateDecode`).
pub(super) fn deflated(bytes: &[u8]) -> Vec<u8> {
    compress_to_vec_zlib(bytes, EFFORT)
}
