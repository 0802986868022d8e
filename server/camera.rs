//! Draws images of a world state, without a window.
//!
//! Two kinds of image are drawn from the same state. [`Camera::capture`] draws the controllers' view: a pinhole
//! camera above the tool that looks straight down at dark walls and a bright floor. [`Camera::scene`] draws the arm
//! above the maze with light and shadows, for people. No other module uses the graphics library. This module does
//! not depend on physics or controllers.
//!
//! Brightness contract of the controllers' view, gray by Rec. 601: floor ≥ 200 including shadows, walls ≤ 50 (tops
//! and sides), everything outside the workspace ≤ 50, bead ≥ 200. The goal and the arm are not drawn. The magnet
//! (gray 165, neither floor nor wall) is drawn only if the mount has `sees_magnet`.
//!
//! | part | what it does |
//! |---|---|
//! | `error` | [`CameraError`] |
//! | `gpu` | finds an adapter, opens the device, turns device errors into [`CameraError`] |
//! | `target` | colour, depth and readback memory for one image size |
//! | `mesh`, `geometry_buffers` | triangles, and their copies on the device |
//! | `static_scene` | walls and floor as triangles for the controllers' view |
//! | `moved_walls` | what moving walls cover, for both |
//! | `diorama` | walls, floor and table for people |
//! | `robot` | the robot as simple solids, for the page too |
//! | `arm` | robot, gripper and magnet, where they are now |
//! | `optics` | projections |
//! | `pipeline` | code that all render passes share |
//! | `view`, `scene` | the two renderers |
//!
//! The interface uses metres in the frame `base` and `f64`; only data on the device is `f32`.

mod arm;
mod diorama;
mod error;
mod geometry_buffers;
mod gpu;
mod mesh;
mod moved_walls;
mod optics;
mod pipeline;
pub mod robot;
mod scene;
mod static_scene;
mod target;
mod view;

#[cfg(test)]
mod refusal_tests;
#[cfg(test)]
mod shader_tests;
#[cfg(test)]
mod test_support;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::geometry::{Band, Isometry3, Point2, Polygon, Rect};
use crate::image::{CameraFrame, CameraMount, Picture};

pub use error::CameraError;
pub use gpu::{AdapterChoice, Gpu};

pub const BEAD_RADIUS_M: f64 = 0.0025;

/// Largest width or height of an image. Larger images are refused even if the adapter allows them, because one
/// request could allocate gigabytes.
pub const MAX_PX: u32 = 4096;

/// Columns and rows of the controllers' view (specification §3).
pub const VIEW_PX: u32 = 480;

/// Limit of the camera's height, of its offset, and of the distance from the tool to any table point in view.
const MAX_M: f64 = 10.0;

/// Rendering quality of images for people. It does not affect the controllers' view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quality {
    /// Hard edges and hard shadows, for adapters that render on the CPU.
    Economy,
    /// Four samples per pixel and soft shadows.
    Fine,
}

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
    fn check(&self) -> Result<(), CameraError> {
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

/// A source of the controllers' view of a state: a [`Camera`], or recorded frames.
pub trait ImageSource {
    /// # Errors
    /// If the image cannot be taken. The source stays usable unless the error is [`CameraError::DeviceLost`].
    fn capture(&mut self, subject: &Subject) -> Result<CameraFrame, CameraError>;
}

/// Draws one static scene. Cameras share a [`Gpu`]; each has its own geometry and image memory. If the device is
/// lost, for example because its driver restarts, the camera continues on the replacement device.
#[derive(Debug)]
pub struct Camera {
    workspace: Rect,
    walls: Vec<Polygon>,
    wall_height_m: f64,
    view_px: u32,
    /// `None`: the adapter's default, [`Gpu::quality`].
    quality: Option<Quality>,
    renderers: Renderers,
}

/// Viewpoint of an image for people.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Viewpoint {
    /// From the user's side of the table, in perspective.
    User,
    /// From straight above, in parallel projection.
    Above,
}

/// Everything that is lost together with the device.
#[derive(Debug)]
struct Renderers {
    gpu: Arc<Gpu>,
    view: view::ViewRenderer,
    /// Created at first use: sessions and trials do not need it.
    scene: Option<scene::SceneRenderer>,
}

impl Renderers {
    fn new(gpu: &Arc<Gpu>, static_scene: &StaticScene, view_px: u32) -> Result<Self, CameraError> {
        let gpu = gpu.current()?;
        check_size(view_px, view_px, gpu.max_px())?;
        let view = view::ViewRenderer::new(&gpu, static_scene, view_px)?;
        Ok(Self { gpu, view, scene: None })
    }
}

impl Camera {
    /// Prepares to draw `stage`. The controllers' view gets `view_px` columns and rows. If the static scene changes,
    /// a new camera is needed.
    ///
    /// # Errors
    /// [`CameraError::Size`] or [`CameraError::StaticScene`] for bad input, [`CameraError::Rejected`] or
    /// [`CameraError::DeviceLost`] when the device fails.
    pub fn new(gpu: Arc<Gpu>, static_scene: &StaticScene, view_px: u32) -> Result<Self, CameraError> {
        static_scene::check(static_scene)?;
        Ok(Self {
            workspace: *static_scene.workspace,
            walls: static_scene.walls.to_vec(),
            wall_height_m: static_scene.wall_height_m,
            view_px,
            quality: None,
            renderers: Renderers::new(&gpu, static_scene, view_px)?,
        })
    }

    /// Overrides the adapter's default quality.
    #[must_use]
    pub fn with_quality(mut self, quality: Quality) -> Self {
        self.quality = Some(quality);
        self.renderers.scene = None;
        self
    }

    /// The controllers' view, a square image with +y up. The centre of pixel (u, v) of a W × W image is the point
    /// (2u + 1 − W, W − 2v − 1)/W of the frame's pinhole.
    ///
    /// # Errors
    /// [`CameraError::Subject`] if the state is not finite, the errors of [`check_mount`], and
    /// [`CameraError::Rejected`], [`CameraError::Readback`] or [`CameraError::DeviceLost`] if the device fails.
    pub fn capture(&mut self, subject: &Subject) -> Result<CameraFrame, CameraError> {
        subject.check()?;
        check_mount(&subject.mount, self.wall_height_m)?;
        self.draw(|Self { renderers: Renderers { gpu, view, .. }, .. }| view.draw(gpu, subject))
    }

    /// The whole table with arm, magnet, walls, bead and goal, in perspective from the user's side.
    ///
    /// # Errors
    /// Those of [`Camera::capture`], and [`CameraError::Size`] if a side is 0 or more than [`MAX_PX`].
    pub fn scene(&mut self, subject: &Subject, width_px: u32, height_px: u32) -> Result<Picture, CameraError> {
        self.for_people(subject, Viewpoint::User, width_px, height_px)
    }

    /// The workspace from straight above, +y up, in parallel projection: walls, block, bead and goal. The arm is not
    /// drawn because it would cover them.
    ///
    /// # Errors
    /// Those of [`Camera::scene`].
    pub fn plan(&mut self, subject: &Subject, width_px: u32, height_px: u32) -> Result<Picture, CameraError> {
        self.for_people(subject, Viewpoint::Above, width_px, height_px)
    }

    fn for_people(
        &mut self,
        subject: &Subject,
        viewpoint: Viewpoint,
        width_px: u32,
        height_px: u32,
    ) -> Result<Picture, CameraError> {
        subject.check()?;
        check_size(width_px, height_px, self.renderers.gpu.max_px())?;
        self.draw(|Self { workspace, walls, wall_height_m, quality, renderers, .. }| {
            let Renderers { gpu, scene, .. } = renderers;
            let scene = match scene {
                Some(scene) => scene,
                None => {
                    let static_scene = StaticScene { workspace, walls, wall_height_m: *wall_height_m };
                    scene.insert(scene::SceneRenderer::new(gpu, &static_scene, quality.unwrap_or(gpu.quality()))?)
                }
            };
            scene.draw(gpu, subject, viewpoint, width_px, height_px)
        })
    }

    /// Draws an image. If the device is lost, opens another one and tries once more.
    fn draw<T>(&mut self, mut picture: impl FnMut(&mut Self) -> Result<T, CameraError>) -> Result<T, CameraError> {
        match picture(self) {
            Err(CameraError::DeviceLost { reason }) => {
                tracing::warn!(reason, "the graphics device was lost; opening another one");
                let static_scene =
                    StaticScene { workspace: &self.workspace, walls: &self.walls, wall_height_m: self.wall_height_m };
                self.renderers = Renderers::new(&self.renderers.gpu, &static_scene, self.view_px)?;
                picture(self)
            }
            drawn => drawn,
        }
    }
}

impl ImageSource for Camera {
    fn capture(&mut self, subject: &Subject) -> Result<CameraFrame, CameraError> {
        fault_point!("render");
        #[cfg(test)]
        if crate::faults::strikes("hang") {
            std::thread::sleep(std::time::Duration::from_secs(14));
        }
        Camera::capture(self, subject)
    }
}

/// Refuses an image with a side of 0 or of more than `max_px` pixels.
fn check_size(width_px: u32, height_px: u32, max_px: u32) -> Result<(), CameraError> {
    let allowed = 1..=max_px;
    if allowed.contains(&width_px) && allowed.contains(&height_px) {
        return Ok(());
    }
    Err(CameraError::Size { width_px, height_px, max_px })
}
