//! Images, camera frames and gray images, their encodings, and the pinhole camera model.

mod comparison;
mod error;
mod pinhole;
mod source;

use rand::{Rng, RngExt};
use rand_distr::StandardNormal;
use serde::{Deserialize, Serialize};

pub use comparison::PictureDifference;
pub use error::CameraError;
pub use pinhole::{CameraMount, Pinhole};
pub use source::{EmptyFloor, ImageSource, StaticScene, Subject, VIEW_PX, check_mount};

/// An image of RGBA8 pixels.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Picture {
    pub width_px: u32,
    pub height_px: u32,
    /// Row-major RGBA, four bytes per pixel, top row first.
    pub rgba: Vec<u8>,
}

/// An image of the controllers' camera (square), with its time and camera.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraFrame {
    pub picture: Picture,
    /// Tick at which it was taken.
    pub tick: u64,
    pub pinhole: Pinhole,
}

/// An 8-bit gray image.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct GrayImage {
    pub width_px: usize,
    pub height_px: usize,
    /// Row-major, top row first.
    pub pixels: Vec<u8>,
}

/// Why an image could not be encoded.
#[derive(Debug, thiserror::Error)]
pub enum EncodeError {
    /// Error of the PNG encoder.
    #[error("png: {0}")]
    Png(#[from] png::EncodingError),
    /// Error of the JPEG encoder.
    #[error("jpeg: {0}")]
    Jpeg(#[from] jpeg_encoder::EncodingError),
}

/// Why a picture cannot be read or compared.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    #[error("not a PNG: {0}")]
    Png(#[from] png::DecodingError),
    #[error("the PNG is too large")]
    TooLarge,
    #[error("the PNG has {kind}, it must have 8 bits per channel, RGB or RGBA")]
    Kind { kind: String },
    #[error("the picture has {} × {} pixels, the other one {} × {}", .found.0, .found.1, .expected.0, .expected.1)]
    Size { found: (u32, u32), expected: (u32, u32) },
}

impl Picture {
    /// Gray by Rec. 601 luma, rounded to the nearest level.
    pub fn to_gray(&self) -> GrayImage {
        let pixels = self
            .rgba
            .chunks_exact(4)
            .map(|p| {
                // 8-bit fixed point of .299, .587, .114: the weights add up to 65536.
                let luma = 19595 * u32::from(p[0]) + 38470 * u32::from(p[1]) + 7471 * u32::from(p[2]);
                ((luma + 32768) >> 16) as u8
            })
            .collect();
        GrayImage { width_px: self.width_px as usize, height_px: self.height_px as usize, pixels }
    }

    /// Adds noise of this standard deviation to the brightness of each pixel.
    pub fn add_noise(&mut self, deviation_levels: f64, rng: &mut impl Rng) {
        for pixel in self.rgba.chunks_exact_mut(4) {
            let noise: f32 = rng.sample(StandardNormal);
            let noise = (f64::from(noise) * deviation_levels).round() as i16;
            for channel in &mut pixel[..3] {
                *channel = (i16::from(*channel) + noise).clamp(0, 255) as u8;
            }
        }
    }

    /// Encodes the image as PNG.
    pub fn to_png(&self) -> Result<Vec<u8>, EncodeError> {
        encode_png(self.width_px, self.height_px, png::ColorType::Rgba, &self.rgba)
    }

    /// Encodes the image as JPEG; `quality` from 1 to 100.
    pub fn to_jpeg(&self, quality: u8) -> Result<Vec<u8>, EncodeError> {
        let mut out = Vec::with_capacity(64 * 1024);
        jpeg_encoder::Encoder::new(&mut out, quality).encode(
            &self.rgba,
            self.width_px as u16,
            self.height_px as u16,
            jpeg_encoder::ColorType::Rgba,
        )?;
        Ok(out)
    }
}

impl GrayImage {
    /// Encodes the image as gray PNG.
    pub fn to_png(&self) -> Result<Vec<u8>, EncodeError> {
        encode_png(self.width_px as u32, self.height_px as u32, png::ColorType::Grayscale, &self.pixels)
    }
}

fn encode_png(width: u32, height: u32, color: png::ColorType, data: &[u8]) -> Result<Vec<u8>, EncodeError> {
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, width, height);
    encoder.set_color(color);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(data)?;
    Ok(out)
}
