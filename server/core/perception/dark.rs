//! The dark pixels of an image as a summed-area table (Crow 1984, SIGGRAPH): the dark pixels in a rectangle are counted
//! with four look-ups.

use crate::image::GrayImage;

/// Pixels at or below this gray level are obstacles. It is half-way between walls (at most 50) and floor (at least 200)
/// of the controllers' view, so that noise in either direction has no effect.
pub const OBSTACLE_LEVEL: u8 = 125;

/// A rectangle of whole pixels; rows count from the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelRect {
    pub column_px: usize,
    pub row_px: usize,
    pub width_px: usize,
    pub height_px: usize,
}

impl PixelRect {
    /// Number of pixels.
    pub fn area_px(&self) -> usize {
        self.width_px * self.height_px
    }
}

/// The dark pixels of an image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DarkPixels {
    width_px: usize,
    height_px: usize,
    /// Number of dark pixels above and left of each pixel corner, `height_px + 1` rows of `width_px + 1`.
    sums: Vec<u32>,
}

impl DarkPixels {
    /// The pixels of `gray` at or below `threshold`.
    pub fn of(gray: &GrayImage, threshold: u8) -> Self {
        Self::where_(gray, |level| level <= threshold)
    }

    /// The pixels of `gray` that count as dark.
    pub fn where_(gray: &GrayImage, is_dark: impl Fn(u8) -> bool) -> Self {
        let (width_px, height_px) = (gray.width_px, gray.height_px);
        let stride = width_px + 1;
        let mut sums = vec![0; stride * (height_px + 1)];
        if width_px > 0 {
            for (row, pixels) in gray.pixels.chunks_exact(width_px).enumerate().take(height_px) {
                let (above, below) = sums.split_at_mut(stride * (row + 1));
                let above = &above[stride * row + 1..];
                let mut in_row = 0;
                for ((sum, above), &level) in below[1..stride].iter_mut().zip(above).zip(pixels) {
                    in_row += u32::from(is_dark(level));
                    *sum = above + in_row;
                }
            }
        }
        Self { width_px, height_px, sums }
    }

    /// Columns of the image.
    pub fn width_px(&self) -> usize {
        self.width_px
    }

    /// Rows of the image.
    pub fn height_px(&self) -> usize {
        self.height_px
    }

    /// Number of dark pixels in `rect`, which must be inside the image.
    pub fn count(&self, rect: &PixelRect) -> usize {
        self.between([rect.column_px, rect.column_px + rect.width_px], [rect.row_px, rect.row_px + rect.height_px])
    }

    /// 1 for each dark pixel and 0 for any other, row by row.
    pub(super) fn flags(&self) -> Vec<u8> {
        let stride = self.width_px + 1;
        let mut flags = vec![0; self.width_px * self.height_px];
        for (row, flags) in flags.chunks_exact_mut(self.width_px.max(1)).enumerate() {
            let (above, below) = self.sums[row * stride..(row + 2) * stride].split_at(stride);
            let left = above.iter().zip(below);
            let right = above[1..].iter().zip(&below[1..]);
            for (flag, ((a, b), (c, d))) in flags.iter_mut().zip(left.zip(right)) {
                *flag = (d - c - (b - a)) as u8;
            }
        }
        flags
    }

    /// Number of dark pixels in half-open ranges of columns and rows.
    pub(super) fn between(&self, [left, right]: [usize; 2], [top, bottom]: [usize; 2]) -> usize {
        let (top, bottom) = (top * (self.width_px + 1), bottom * (self.width_px + 1));
        let [a, b, c, d] = [bottom + right, bottom + left, top + right, top + left].map(|at| self.sums[at] as usize);
        a + d - b - c
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn counts_of_rectangles_match_a_count_of_pixels(
            (width_px, height_px, pixels) in (1..12usize, 1..12usize).prop_flat_map(|(w, h)| {
                (Just(w), Just(h), prop::collection::vec(any::<u8>(), w * h))
            }),
            threshold: u8,
        ) {
            let gray = GrayImage { width_px, height_px, pixels };
            let dark = DarkPixels::of(&gray, threshold);
            let flags: Vec<u8> = gray.pixels.iter().map(|&level| u8::from(level <= threshold)).collect();
            prop_assert_eq!(dark.flags(), flags);
            for (left, top) in (0..width_px).flat_map(|left| (0..height_px).map(move |top| (left, top))) {
                for (right, bottom) in (left..=width_px).flat_map(|r| (top..=height_px).map(move |b| (r, b))) {
                    let rect = PixelRect {
                        column_px: left, row_px: top, width_px: right - left, height_px: bottom - top
                    };
                    let is_dark = |x: usize, y: usize| gray.pixels[y * width_px + x] <= threshold;
                    let expected: usize = (top..bottom).map(|y| (left..right).filter(|&x| is_dark(x, y)).count()).sum();
                    prop_assert_eq!(dark.count(&rect), expected);
                }
            }
        }
    }
}
