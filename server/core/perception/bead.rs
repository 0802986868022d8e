//! The bead in the camera's picture, for the time when the tracker is lost.

use super::Percept;
use crate::geometry::{Point2, Vector2};
use crate::image::CameraFrame;

/// The bead is yellow: its red is this much above its blue. Table, walls and magnet are nearly gray.
const LEAST_YELLOW: i16 = 60;
/// A whole bead has some hundred pixels in the default camera's picture.
const LEAST_PX: usize = 8;

/// Whether the bead is in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BeadView {
    At(Point2<f64>),
    Missing {
        /// Whether the place where the bead was last is in the picture and not hidden.
        is_last_visible: bool,
    },
}

impl BeadView {
    /// Looks for the bead in a frame, whose percept is given. It was last at `last_m`.
    pub fn of(frame: &CameraFrame, percept: &Percept, last_m: Point2<f64>) -> Self {
        let picture = &frame.picture;
        let width = picture.width_px as usize;
        let (mut sum, mut count) = (Vector2::zeros(), 0_usize);
        for (at, pixel) in picture.rgba.chunks_exact(4).enumerate() {
            if i16::from(pixel[0]) - i16::from(pixel[2]) >= LEAST_YELLOW {
                sum += Vector2::new((at % width) as f64 + 0.5, (at / width) as f64 + 0.5);
                count += 1;
            }
        }
        let half = 0.5 * width as f64;
        let middle = Vector2::new(sum.x / count as f64 - half, half - sum.y / count as f64) / half;
        match frame.pinhole.table_from_image(middle) {
            Some(place) if count >= LEAST_PX => Self::At(place),
            _ => {
                let is_last_visible = percept.calibration.sees(last_m) && !percept.is_hidden(last_m);
                Self::Missing { is_last_visible }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::perception::test_frame;

    #[test]
    fn finds_a_yellow_disc_at_its_place_and_misses_one_outside() {
        let tool_m = Point2::new(0.05, -0.35);
        let mut frame = test_frame(tool_m, |place| place.x > 0.1);
        let percept = Percept::of(&frame, tool_m);
        let none = BeadView::of(&frame, &percept, tool_m);
        assert_eq!(none, BeadView::Missing { is_last_visible: true });
        let away = BeadView::of(&frame, &percept, Point2::new(0.3, -0.35));
        assert_eq!(away, BeadView::Missing { is_last_visible: false });
        let bead_m = Point2::new(0.02, -0.31);
        for at in 0..frame.picture.rgba.len() / 4 {
            let place = percept.calibration.table_from_image((at % 480) as f64 + 0.5, (at / 480) as f64 + 0.5);
            if (place - bead_m).norm() < 0.0025 {
                frame.picture.rgba[4 * at..4 * at + 3].copy_from_slice(&[240, 215, 110]);
            }
        }
        let BeadView::At(found) = BeadView::of(&frame, &percept, tool_m) else { panic!("the bead is in the picture") };
        assert!((found - bead_m).norm() < 2e-4, "{found}");
    }
}
