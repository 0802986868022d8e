//! Two pictures compared, for golden pictures.

use super::{Picture, PictureError};

/// A pixel differs when a channel differs by more than this many levels: drivers round differently.
const LEVELS: u8 = 8;

/// Where two pictures differ.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureDifference {
    /// Share of the pixels that differ.
    pub share: f64,
    /// The first picture, faint, with the pixels that differ in red.
    pub picture: Picture,
}

impl Picture {
    /// Compares it with another one of the same size.
    ///
    /// # Errors
    /// [`PictureError::Size`].
    pub fn difference(&self, other: &Self) -> Result<PictureDifference, PictureError> {
        let size = |picture: &Self| (picture.width_px, picture.height_px);
        if size(self) != size(other) {
            return Err(PictureError::Size { found: size(self), expected: size(other) });
        }
        let mut differing = 0_usize;
        let mut rgba = Vec::with_capacity(self.rgba.len());
        for (own, others) in self.rgba.chunks(4).zip(other.rgba.chunks(4)) {
            if own.iter().zip(others).any(|(a, b)| a.abs_diff(*b) > LEVELS) {
                differing += 1;
                rgba.extend([220, 0, 0, 255]);
            } else {
                let gray = own[..3].iter().map(|&level| u32::from(level)).sum::<u32>() / 3;
                let faint = (192 + gray / 4) as u8;
                rgba.extend([faint, faint, faint, 255]);
            }
        }
        let pixels = (self.rgba.len() / 4).max(1);
        Ok(PictureDifference { share: differing as f64 / pixels as f64, picture: Self { rgba, ..*self } })
    }

    /// Reads a PNG file with 8 bits per channel, with or without transparency.
    ///
    /// # Errors
    /// [`PictureError`].
    pub fn from_png(bytes: &[u8]) -> Result<Self, PictureError> {
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info()?;
        let size = reader.output_buffer_size().ok_or(PictureError::TooLarge)?;
        let mut pixels = vec![0; size];
        let info = reader.next_frame(&mut pixels)?;
        pixels.truncate(info.buffer_size());
        let rgba = match (info.color_type, info.bit_depth) {
            (png::ColorType::Rgba, png::BitDepth::Eight) => pixels,
            (png::ColorType::Rgb, png::BitDepth::Eight) => {
                pixels.chunks(3).flat_map(|rgb| [rgb[0], rgb[1], rgb[2], 255]).collect()
            }
            (color, depth) => return Err(PictureError::Kind { kind: format!("{color:?}, {depth:?} bits") }),
        };
        Ok(Self { width_px: info.width, height_px: info.height, rgba })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gray(levels: &[u8]) -> Picture {
        let rgba = levels.iter().flat_map(|&level| [level, level, level, 255]).collect();
        Picture { width_px: levels.len() as u32, height_px: 1, rgba }
    }

    #[test]
    fn only_visible_differences_count_and_they_are_red() {
        let found = gray(&[10, 100, 200, 250]).difference(&gray(&[18, 109, 200, 0])).unwrap();
        assert_eq!(found.share, 0.5);
        let red: Vec<bool> = found.picture.rgba.chunks(4).map(|pixel| pixel[..3] == [220, 0, 0]).collect();
        assert_eq!(red, [false, true, false, true]);
        let error = gray(&[0; 3]).difference(&gray(&[0; 2])).unwrap_err();
        assert_eq!(error.to_string(), "the picture has 3 × 1 pixels, the other one 2 × 1");
    }

    #[test]
    fn a_png_is_read_as_it_was_written() {
        let picture = gray(&[1, 2, 3]);
        assert_eq!(Picture::from_png(&picture.to_png().unwrap()).unwrap(), picture);
        assert!(Picture::from_png(b"no png").unwrap_err().to_string().starts_with("not a PNG"));
    }
}
