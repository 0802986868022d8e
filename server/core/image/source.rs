//! What is photographed, and who can take the picture.

use std::sync::Arc;

use super::{CameraError, CameraFrame, CameraMount, Picture};
use crate::geometry::{Band, Isometry3, Point2, Polygon, Rect};

/// Columns and rows of the controllers' view (specification §3).
pub const VIEW_PX: u32 = 480;

/// Limit of the camera's height, of its offset, and of the distance from the tool to any table point in view.
const MAX_M: f64 = 10.0;

/// Checks that an image can be taken with this mount above walls of height `wall_height_m`.
///
/// # Errors
/// [`CameraError::Parameter`], [`CameraError::BelowWalls`] or [`CameraError::Horizon`].
pub fn check_mount(mount: &CameraMount, wall_height_m: f64) -> Result<(), CameraError> {
    let CameraMount { height_m, offset_m, tilt_rad, field_of_view_rad, .. } = *mount;
    let upright = |tilt_rad: f64| tilt_rad.abs() < std::f64::consts::FRAC_PI_2;
    let near = |offset_m: f64| offset_m.abs() <= MAX_M;
    let fields = [
        ("height_m", height_m, height_m > 0.0 && height_m <= MAX_M, "above 0 and at most 10 m"),
        ("offset_m[0]", offset_m[0], near(offset_m[0]), "at most 10 m to either side"),
        ("offset_m[1]", offset_m[1], near(offset_m[1]), "at most 10 m to either side"),
        ("tilt_rad[0]", tilt_rad[0], upright(tilt_rad[0]), "less than a right angle to either side"),
        ("tilt_rad[1]", tilt_rad[1], upright(tilt_rad[1]), "less than a right angle to either side"),
        (
            "field_of_view_rad",
            field_of_view_rad,
            field_of_view_rad > 1e-3 && field_of_view_rad < std::f64::consts::PI,
            "above .001 and less than pi",
        ),
    ];
    if let Some((name, value, _, expected)) = fields.into_iter().find(|(_, _, good, _)| !good) {
        return Err(CameraError::Parameter { name, value, expected });
    }
    if height_m <= wall_height_m {
        return Err(CameraError::BelowWalls { height_m, wall_height_m });
    }
    let seen = mount.over(Point2::origin(), 0.0).table_corners_m();
    match seen.filter(|corners| corners.iter().all(|corner| corner.coords.norm() <= MAX_M)) {
        Some(_) => Ok(()),
        None => Err(CameraError::Horizon { tilt_rad, field_of_view_rad }),
    }
}

/// The static scene. Walls are prisms on these polygons. In the controllers' view, everything outside the
/// workspace is also drawn as wall.
#[derive(Clone, Copy, Debug)]
pub struct StaticScene<'a> {
    /// The area where the bead may be.
    pub workspace: &'a Rect,
    /// Ground plan of the walls.
    pub walls: &'a [Polygon],
    /// Height above the table.
    pub wall_height_m: f64,
}

/// The moving parts of a state.
#[derive(Clone, Debug, PartialEq)]
pub struct Subject {
    /// Copied into the frame.
    pub tick: u64,
    /// Tool point: the centre of the block's lower face.
    pub tool_m: [f64; 3],
    /// How far block, gripper and camera are turned about the vertical.
    pub turn_rad: f64,
    pub bead_m: [f64; 3],
    /// The goal on the table; not drawn in the controllers' view.
    pub goal_m: Option<[f64; 2]>,
    /// `base_from_link` for the Denavit–Hartenberg frames 1 to 6; the last is the flange. `None` for the planar
    /// stage, which has no arm.
    pub link_frames: Option<[Isometry3<f64>; 6]>,
    /// Edge lengths of the magnet along x, y and z of `base`, if it is not turned.
    pub block_size_m: [f64; 3],
    pub mount: CameraMount,
    /// What the walls cover beyond their drawn place; `None` if they are rigid.
    pub moved_walls: Option<Arc<[Band]>>,
}

impl Subject {
    /// Refuses a state with numbers that are not finite. The device would draw them as a plausible image.
    pub fn check(&self) -> Result<(), CameraError> {
        let finite = |numbers: &[f64]| numbers.iter().all(|number| number.is_finite());
        let frames_finite = self.link_frames.iter().flatten().all(|base_from_link| {
            finite(base_from_link.translation.vector.as_slice()) && finite(base_from_link.rotation.coords.as_slice())
        });
        let fields = [
            ("tool_m", finite(&self.tool_m)),
            ("turn_rad", self.turn_rad.is_finite()),
            ("bead_m", finite(&self.bead_m)),
            ("goal_m", self.goal_m.is_none_or(|goal_m| finite(&goal_m))),
            ("block_size_m", finite(&self.block_size_m)),
            ("link_frames", frames_finite),
        ];
        match fields.into_iter().find(|(_, good)| !good) {
            Some((what, _)) => Err(CameraError::Subject { what }),
            None => Ok(()),
        }
    }
}

/// A source of the controllers' view of a state: a camera, or recorded frames.
pub trait ImageSource {
    /// # Errors
    /// If the image cannot be taken. The source stays usable unless the error is [`CameraError::DeviceLost`].
    fn capture(&mut self, subject: &Subject) -> Result<CameraFrame, CameraError>;
}

/// Sees an empty floor everywhere, without a graphics device.
#[derive(Clone, Debug)]
pub struct EmptyFloor(Picture);

impl Default for EmptyFloor {
    fn default() -> Self {
        let rgba = vec![230; 4 * (VIEW_PX * VIEW_PX) as usize];
        Self(Picture { width_px: VIEW_PX, height_px: VIEW_PX, rgba })
    }
}

impl ImageSource for EmptyFloor {
    fn capture(&mut self, subject: &Subject) -> Result<CameraFrame, CameraError> {
        subject.check()?;
        let [x_m, y_m, _] = subject.tool_m;
        let pinhole = subject.mount.over(Point2::new(x_m, y_m), subject.turn_rad);
        Ok(CameraFrame { picture: self.0.clone(), tick: subject.tick, pinhole })
    }
}
