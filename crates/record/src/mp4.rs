//! The MP4 container of one H.264 track at constant rate (ISO/IEC 14496-12, -14 and -15).
//!
//! The index (moov) precedes the pictures (mdat), so that a film starts while it is still loading. No box carries a
//! time of day, so that the bytes depend on the film alone.

use std::io::Write;

use crate::RecordError;

/// Ticks of the clock a frame.
const TICKS: u32 = 1000;

/// The track before it is written.
#[derive(Debug, Default)]
pub(crate) struct Track {
    pub(crate) size: [u16; 2],
    pub(crate) fps: f64,
    /// The sequence and the picture parameter set, without start codes.
    pub(crate) sequence: Vec<u8>,
    pub(crate) parameters: Vec<u8>,
    /// The pictures one after the other, each NAL unit after its length in four bytes.
    pub(crate) data: Vec<u8>,
    /// The length of each picture.
    pub(crate) lengths: Vec<u32>,
    /// The pictures that do not depend on others, counted from 1.
    pub(crate) keys: Vec<u32>,
    pub(crate) provenance: String,
}

impl Track {
    /// Writes the whole file.
    ///
    /// # Errors
    /// [`RecordError::FileSize`] where 32-bit offsets do not reach, [`RecordError::Write`].
    pub(crate) fn write(&self, writer: &mut impl Write) -> Result<(), RecordError> {
        let kind = boxed(*b"ftyp", &[b"isom", &512_u32.to_be_bytes(), b"isomiso2avc1mp41"]);
        // The index is as long for any offset.
        let index_length = self.movie(0).len() as u64;
        let start = kind.len() as u64 + index_length + 8;
        let total = start + self.data.len() as u64;
        let too_large = |_| RecordError::FileSize {
            format: "MP4",
            bytes: total,
            limit: u64::from(u32::MAX),
            remedy: "make the picture smaller or the film shorter",
        };
        u32::try_from(total).map_err(too_large)?;
        writer.write_all(&kind)?;
        writer.write_all(&self.movie(start as u32))?;
        writer.write_all(&(self.data.len() as u32 + 8).to_be_bytes())?;
        writer.write_all(b"mdat")?;
        writer.write_all(&self.data)?;
        Ok(())
    }

    #[expect(clippy::cast_sign_loss, reason = "rates are positive")]
    fn movie(&self, offset: u32) -> Vec<u8> {
        let scale = (self.fps * f64::from(TICKS)).round().max(1.0) as u32;
        let duration = self.lengths.len() as u32 * TICKS;
        let header = boxed(
            *b"mvhd",
            &[
                &words(&[0, 0, 0, scale, duration, 0x1_0000]),
                &[1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0],
                &words(&MATRIX),
                &words(&[0, 0, 0, 0, 0, 0, 2]),
            ],
        );
        let track =
            boxed(*b"trak", &[&self.track_header(duration), &self.media(scale, duration, offset)]);
        boxed(*b"moov", &[&header, &track, &self.words_of_user()])
    }

    fn track_header(&self, duration: u32) -> Vec<u8> {
        let [width, height] = self.size.map(|side| u32::from(side) << 16);
        boxed(
            *b"tkhd",
            &[
                // Enabled and in the movie.
                &words(&[3, 0, 0, 1, 0, duration, 0, 0, 0, 0]),
                &words(&MATRIX),
                &words(&[width, height]),
            ],
        )
    }

    fn media(&self, scale: u32, duration: u32, offset: u32) -> Vec<u8> {
        // "und" in three letters of five bits.
        let header = boxed(*b"mdhd", &[&words(&[0, 0, 0, scale, duration, 0x55C4_0000])]);
        let handler = boxed(*b"hdlr", &[&words(&[0, 0]), b"vide", &words(&[0, 0, 0]), b"video\0"]);
        let location = boxed(*b"url ", &[&words(&[1])]);
        let references = boxed(*b"dref", &[&words(&[0, 1]), &location]);
        let info = boxed(
            *b"minf",
            &[
                &boxed(*b"vmhd", &[&words(&[1, 0, 0])]),
                &boxed(*b"dinf", &[&references]),
                &self.samples(offset),
            ],
        );
        boxed(*b"mdia", &[&header, &handler, &info])
    }

    fn samples(&self, offset: u32) -> Vec<u8> {
        let count = self.lengths.len() as u32;
        let description = boxed(*b"stsd", &[&words(&[0, 1]), &self.description()]);
        let durations = boxed(*b"stts", &[&words(&[0, 1, count, TICKS])]);
        let keys = boxed(*b"stss", &[&words(&[0, self.keys.len() as u32]), &words(&self.keys)]);
        let chunks = boxed(*b"stsc", &[&words(&[0, 1, 1, count, 1])]);
        let lengths = boxed(*b"stsz", &[&words(&[0, 0, count]), &words(&self.lengths)]);
        let offsets = boxed(*b"stco", &[&words(&[0, 1, offset])]);
        let parts = [description, durations, keys, chunks, lengths, offsets];
        boxed(*b"stbl", &parts.each_ref().map(Vec::as_slice))
    }

    fn description(&self) -> Vec<u8> {
        let [width, height] = self.size.map(u16::to_be_bytes);
        // Version, profile, compatibility, level; lengths of four bytes; one set of each kind.
        let profile = self.sequence.get(1..4).unwrap_or_default();
        let configuration = boxed(
            *b"avcC",
            &[
                &[1],
                profile,
                &[0xFF, 0xE1],
                &(self.sequence.len() as u16).to_be_bytes(),
                &self.sequence,
                &[1],
                &(self.parameters.len() as u16).to_be_bytes(),
                &self.parameters,
            ],
        );
        // BT.709 primaries, transfer and matrix, video range.
        let colour = boxed(*b"colr", &[b"nclx", &[0, 1, 0, 1, 0, 1, 0]]);
        let aspect = boxed(*b"pasp", &[&words(&[1, 1])]);
        boxed(
            *b"avc1",
            &[
                &[0, 0, 0, 0, 0, 0, 0, 1],
                &[0; 16],
                &width,
                &height,
                // 72 pixels an inch, one frame a sample, no name of a compressor, 24 bits.
                &words(&[0x48_0000, 0x48_0000, 0]),
                &[0, 1],
                &[0; 32],
                &[0, 0x18, 0xFF, 0xFF],
                &configuration,
                &colour,
                &aspect,
            ],
        )
    }

    /// The provenance as the comment that players and `ffprobe` show.
    fn words_of_user(&self) -> Vec<u8> {
        if self.provenance.is_empty() {
            return Vec::new();
        }
        let data = boxed(*b"data", &[&words(&[1, 0]), self.provenance.as_bytes()]);
        let list = boxed(*b"ilst", &[&boxed(*b"\xA9cmt", &[&data])]);
        let handler = boxed(*b"hdlr", &[&words(&[0, 0]), b"mdirappl", &words(&[0, 0]), &[0]]);
        let meta = boxed(*b"meta", &[&words(&[0]), &handler, &list]);
        boxed(*b"udta", &[&meta])
    }
}

/// Pictures are upright.
const MATRIX: [u32; 9] = [0x1_0000, 0, 0, 0, 0x1_0000, 0, 0, 0, 0x4000_0000];

fn words(values: &[u32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_be_bytes()).collect()
}

fn boxed(kind: [u8; 4], parts: &[&[u8]]) -> Vec<u8> {
    let length = 8 + parts.iter().map(|part| part.len()).sum::<usize>();
    let mut bytes = Vec::with_capacity(length);
    bytes.extend((length as u32).to_be_bytes());
    bytes.extend(kind);
    for part in parts {
        bytes.extend(*part);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_nest_without_gaps_and_the_offset_points_at_the_first_picture() {
        let track = Track {
            size: [16, 16],
            fps: 30.0,
            sequence: vec![0x67, 66, 192, 30],
            parameters: vec![0x68, 1],
            data: vec![9, 8, 7, 6, 5],
            lengths: vec![3, 2],
            keys: vec![1],
            provenance: "scene".to_owned(),
        };
        let mut bytes = Vec::new();
        track.write(&mut bytes).unwrap();
        let (mut at, mut kinds) = (0, Vec::new());
        while at < bytes.len() {
            let length = u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
            kinds.push(bytes[at + 4..at + 8].to_vec());
            at += length;
        }
        assert_eq!(at, bytes.len());
        assert_eq!(kinds, [b"ftyp", b"moov", b"mdat"]);
        let stco = bytes.windows(4).position(|w| w == b"stco").unwrap() + 12;
        let offset = u32::from_be_bytes(bytes[stco..stco + 4].try_into().unwrap());
        assert_eq!(bytes[offset as usize..], track.data);
    }
}
