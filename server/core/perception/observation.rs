//! The network's observation: 2×84×84 (paper, §IV-A; specification §7).

use crate::geometry::{Point2, Rect};
use crate::image::GrayImage;

/// Side of each channel.
pub const OBSERVATION_SIZE_PX: usize = 84;

/// Two channels of 84×84 bytes, row-major; 0 to 255 represents 0 to 1.
///
/// Channel 0 is the gray image, area-averaged. Channel 1 has the goal in rows 0–41 and the tool in rows 42–83. In each
/// block the left 42 columns are x and the right 42 are y, scaled over the workspace.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Observation {
    /// `[2][84][84]`, flat.
    pub bytes: Vec<u8>,
}

impl Observation {
    /// Creates the observation. Without a goal, its block is zero.
    pub fn new(gray: &GrayImage, goal: Option<Point2<f64>>, tool: Point2<f64>, workspace: &Rect) -> Self {
        const SIZE: usize = OBSERVATION_SIZE_PX;
        let mut bytes = area_average(gray, SIZE);
        bytes.resize(2 * SIZE * SIZE, 0);
        let mut observation = Self { bytes };
        let blocks =
            [goal.map(|goal| Self::scaled(goal, workspace)).unwrap_or_default(), Self::scaled(tool, workspace)];
        observation.set_places(blocks);
        observation
    }

    /// A place as in the second channel: x and y over the workspace, 0 to 255.
    pub fn scaled(place: Point2<f64>, workspace: &Rect) -> [u8; 2] {
        let size_m = workspace.size_m();
        let level =
            |value: f64, min: f64, extent: f64| (((value - min) / extent).clamp(0.0, 1.0) * 255.0).round() as u8;
        [level(place.x, workspace.x_min_m, size_m.x), level(place.y, workspace.y_min_m, size_m.y)]
    }

    /// Fills the second channel with goal and tool.
    fn set_places(&mut self, blocks: [[u8; 2]; 2]) {
        const SIZE: usize = OBSERVATION_SIZE_PX;
        for (i, byte) in self.bytes[SIZE * SIZE..].iter_mut().enumerate() {
            let (row, column) = (i / SIZE, i % SIZE);
            *byte = blocks[row / (SIZE / 2)][column / (SIZE / 2)];
        }
    }

    /// The four numbers of the second channel, 0 to 1: goal x and y, tool x and y.
    pub fn places(&self) -> [f32; 4] {
        const SIZE: usize = OBSERVATION_SIZE_PX;
        let at = |row: usize, column: usize| f32::from(self.bytes[SIZE * SIZE + row * SIZE + column]) / 255.0;
        [at(0, 0), at(0, SIZE / 2), at(SIZE / 2, 0), at(SIZE / 2, SIZE / 2)]
    }

    /// Channel 0 or 1 as an image.
    pub fn channel(&self, index: usize) -> GrayImage {
        let area = OBSERVATION_SIZE_PX * OBSERVATION_SIZE_PX;
        GrayImage {
            width_px: OBSERVATION_SIZE_PX,
            height_px: OBSERVATION_SIZE_PX,
            pixels: self.bytes[index * area..(index + 1) * area].to_vec(),
        }
    }

    /// Both channels side by side.
    pub fn side_by_side(&self) -> GrayImage {
        let (left, right) = (self.channel(0), self.channel(1));
        let rows = left.pixels.chunks(OBSERVATION_SIZE_PX).zip(right.pixels.chunks(OBSERVATION_SIZE_PX));
        GrayImage {
            width_px: 2 * OBSERVATION_SIZE_PX,
            height_px: OBSERVATION_SIZE_PX,
            pixels: rows.flat_map(|(a, b)| a.iter().chain(b).copied()).collect(),
        }
    }
}

/// The source pixels that a target pixel covers, with the share of each.
fn coverage(source: usize, target: usize) -> Vec<Vec<(usize, f32)>> {
    let ratio = source as f64 / target as f64;
    (0..target)
        .map(|t| {
            let (from, to) = (t as f64 * ratio, (t + 1) as f64 * ratio);
            (from as usize..(to.ceil() as usize).min(source))
                .map(|s| (s, ((to.min((s + 1) as f64) - from.max(s as f64)) / ratio) as f32))
                .collect()
        })
        .collect()
}

/// Exact mean of the area of each target pixel: columns first, then rows.
fn area_average(gray: &GrayImage, target: usize) -> Vec<u8> {
    let columns = coverage(gray.width_px, target);
    let rows = coverage(gray.height_px, target);
    let narrow: Vec<f32> = gray
        .pixels
        .chunks_exact(gray.width_px)
        .flat_map(|row| columns.iter().map(|cover| cover.iter().map(|&(s, w)| f32::from(row[s]) * w).sum::<f32>()))
        .collect();
    let mut out = Vec::with_capacity(target * target);
    for cover in &rows {
        for column in 0..target {
            let mean: f32 = cover.iter().map(|&(s, w)| narrow[s * target + column] * w).sum();
            out.push(mean.round() as u8);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    const WORKSPACE: Rect = Rect { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };

    #[test]
    fn the_mean_and_the_position_of_an_edge_are_kept() {
        let pixels = (0..480 * 480).map(|i| if i % 480 < 100 { 0 } else { 252 }).collect();
        let gray = GrayImage { width_px: 480, height_px: 480, pixels };
        let observation = Observation::new(&gray, None, Point2::new(0.0, -0.3), &WORKSPACE);
        // 100 px / (480/84 px) = 17.5 columns are dark: the 18th is half dark.
        let row = &observation.bytes[..84];
        assert_eq!((row[16], row[17], row[18]), (0, 126, 252));
    }

    #[test]
    fn the_second_channel_has_the_goal_above_the_tool() {
        let gray = GrayImage { width_px: 480, height_px: 480, pixels: vec![0; 480 * 480] };
        let goal = Point2::new(0.28, -0.54);
        let tool = Point2::new(-0.3, -0.21);
        let channel = Observation::new(&gray, Some(goal), tool, &WORKSPACE).channel(1).pixels;
        let at = |row: usize, column: usize| channel[row * 84 + column];
        assert_eq!([at(0, 0), at(41, 83), at(42, 0), at(83, 83)], [255, 0, 0, 255]);
        let places = Observation::new(&gray, Some(goal), tool, &WORKSPACE).places();
        assert_eq!(places, [1.0, 0.0, 0.0, 1.0]);
    }
}
