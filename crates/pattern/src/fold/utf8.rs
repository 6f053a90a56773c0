//! Text that must be UTF-8, read as a stream.

use std::io::{self, Read};
use std::str;

/// Passes bytes on and fails at the first that are not UTF-8.
///
/// The JSON reader checks only the strings it keeps.
#[derive(Debug)]
pub(super) struct Utf8Reader<R> {
    inner: R,
    /// The beginning of a character that the last read cut off.
    cut: Vec<u8>,
    /// The number of bytes read so far that are valid.
    valid: u64,
}

impl<R: Read> Utf8Reader<R> {
    pub(super) fn new(inner: R) -> Self {
        Self { inner, cut: Vec::new(), valid: 0 }
    }

    fn take_in(&mut self, bytes: &[u8]) -> io::Result<()> {
        // A cut character is completed byte by byte, so that the rest is checked where it lies.
        let mut rest = bytes;
        while let (false, Some((&next, after))) = (self.cut.is_empty(), rest.split_first()) {
            self.cut.push(next);
            rest = after;
            match str::from_utf8(&self.cut) {
                Ok(_) => {
                    self.valid += self.cut.len() as u64;
                    self.cut.clear();
                }
                Err(e) if e.error_len().is_some() => return Err(self.failure(0)),
                Err(_) => {}
            }
        }
        match str::from_utf8(rest) {
            Ok(_) => self.valid += rest.len() as u64,
            Err(e) if e.error_len().is_some() => return Err(self.failure(e.valid_up_to())),
            Err(e) => {
                self.valid += e.valid_up_to() as u64;
                self.cut.extend_from_slice(&rest[e.valid_up_to()..]);
            }
        }
        Ok(())
    }

    fn failure(&self, further: usize) -> io::Error {
        let byte = self.valid + further as u64;
        let message = format!("the bytes from {byte} on are not UTF-8");
        io::Error::new(io::ErrorKind::InvalidData, message)
    }
}

impl<R: Read> Read for Utf8Reader<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.read(buffer)?;
        if count == 0 && !buffer.is_empty() && !self.cut.is_empty() {
            return Err(self.failure(0));
        }
        self.take_in(&buffer[..count])?;
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gives `step` bytes at a time.
    struct Slow<'a>(&'a [u8], usize);

    impl Read for Slow<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let count = self.1.min(buffer.len());
            self.0.read(&mut buffer[..count])
        }
    }

    #[test]
    fn text_is_accepted_wherever_it_is_cut_exactly_if_it_is_utf8() {
        let texts: [&[u8]; 6] =
            ["aé€😀b".as_bytes(), b"plain", b"", b"a\xffb", b"cut \xe2\x82", b"\xc3("];
        for text in texts {
            for step in 1..=8 {
                let mut out = Vec::new();
                let read = Utf8Reader::new(Slow(text, step)).read_to_end(&mut out);
                assert_eq!(read.is_ok(), str::from_utf8(text).is_ok(), "{text:?} by {step}");
                assert!(read.is_err() || out == text);
            }
        }
    }
}
