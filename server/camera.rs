//! The camera: from a state of the world to an image, without a window.
//!
//! Two pictures are drawn from the same state. [`Camera::capture`] is what the controllers see: a
//! pinhole above the tool that looks straight down on dark walls and a bright floor, drawn so that
//! every pixel keeps the brightness contract below. [`Camera::scene`] is for people: the arm over
//! the maze, with light and shadows. Nothing else in the crate knows the graphics library, and this
//! module knows neither physics nor controllers.
//!
//! Brightness contract of the controllers' view, gray by Rec. 601: floor ≥ 200 with shadows
//! included, walls ≤ 50 (tops and sides), everything outside the workspace ≤ 50, bead ≥ 200. No
//! goal and no arm are in it, and the magnet (gray 165, neither) only where the mount asks for it.
//!
//! | part | what it does |
//! |---|---|
//! | `error` | [`CameraError`], everything that can go wrong |
//! | `gpu` | finds an adapter, opens the device, turns what it says into errors |
//! | `target` | colour, depth and readback memory of one picture size |
//! | `mesh`, `geometry_buffers` | triangles, and their copies on the device |
//! | `static_scene` | walls and floor as triangles for the controllers' view |
//! | `diorama` | walls, floor and table for people |
//! | `arm` | robot, gripper and magnet as a list of simple solids |
//! | `optics` | projections |
//! | `pipeline` | what the drawing passes have in common |
//! | `view`, `scene` | the two renderers |
//!
//! Metres in `base` and `f64` at the border; `f32` only on the device.

mod arm;
mod diorama;
mod error;
mod geometry_buffers;
mod gpu;
mod mesh;
mod optics;
mod pipeline;
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

use crate::geometry::{Isometry3, Point2, Polygon, Rect};
use crate::image::{CameraFrame, CameraMount, Picture};

pub use error::CameraError;
pub use gpu::{AdapterChoice, Gpu};

/// Radius of the bead.
pub const BEAD_RADIUS_M: f64 = 0.0025;

/// Largest width or height of an image that is drawn, whatever the adapter allows: beyond it a
/// single request could claim gigabytes.
pub const MOST_PX: u32 = 4096;

/// Columns and rows of the controllers' view (specification §3).
pub const VIEW_PX: u32 = 480;

/// Largest height and offset of a camera that is accepted, and how far from its tool it may see table.
const MOST_M: f64 = 10.0;

/// How much work goes into pictures for people. The controllers' view is the same at either.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quality {
    /// Hard edges and shadows, for adapters that render on the processor.
    Economy,
    /// Four samples a pixel and soft shadows.
    Fine,
}

/// Refuses a mount that no image can be made with, over walls of `wall_height_m`.
///
/// # Errors
/// [`CameraError::Parameter`], [`CameraError::BelowWalls`] or [`CameraError::Horizon`].
pub fn check_mount(mount: &CameraMount, wall_height_m: f64) -> Result<(), CameraError> {
    let CameraMount { height_m, offset_m, tilt_rad, field_of_view_rad, .. } = *mount;
    let upright = |tilt_rad: f64| tilt_rad.abs() < std::f64::consts::FRAC_PI_2;
    let near = |offset_m: f64| offset_m.abs() <= MOST_M;
    let fields = [
        ("height_m", height_m, height_m > 0.0 && height_m <= MOST_M, "above 0 and at most 10 m"),
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
    let seen = mount.over(Point2::origin()).table_corners_m();
    match seen.filter(|corners| corners.iter().all(|corner| corner.coords.norm() <= MOST_M)) {
        Some(_) => Ok(()),
        None => Err(CameraError::Horizon { tilt_rad, field_of_view_rad }),
    }
}

/// The static geometry. Walls are prisms on these polygons; in the controllers' view everything
/// outside the workspace is wall besides.
#[derive(Clone, Copy, Debug)]
pub struct StaticScene<'a> {
    /// Where the bead may be.
    pub workspace: &'a Rect,
    /// Ground plan of the walls.
    pub walls: &'a [Polygon],
    /// Height of the walls above the table.
    pub wall_height_m: f64,
}

/// What moves.
#[derive(Clone, Copy, Debug)]
pub struct Subject {
    /// Tick of the state, copied into the frame.
    pub tick: u64,
    /// Tool point, the centre of the block's lower face.
    pub tool_m: [f64; 3],
    /// Centre of the bead.
    pub bead_m: [f64; 3],
    /// The goal on the table; only [`Camera::scene`] shows it.
    pub goal_m: Option<[f64; 2]>,
    /// `base_from_link` for the Denavit–Hartenberg frames 1 to 6, the last is the flange; none where
    /// there is no arm.
    pub link_frames: Option<[Isometry3<f64>; 6]>,
    /// Edges of the magnet along x, y and z of `base`.
    pub block_size_m: [f64; 3],
    /// How the controllers' camera sits on the tool.
    pub mount: CameraMount,
}

impl Subject {
    /// Refuses a state that holds anything but finite numbers: on the device they would turn into a
    /// picture that looks right.
    fn check(&self) -> Result<(), CameraError> {
        let finite = |numbers: &[f64]| numbers.iter().all(|number| number.is_finite());
        let frames_finite = self.link_frames.iter().flatten().all(|base_from_link| {
            finite(base_from_link.translation.vector.as_slice()) && finite(base_from_link.rotation.coords.as_slice())
        });
        let fields = [
            ("tool_m", finite(&self.tool_m)),
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

/// Anything that yields the controllers' view of a state. Recorded frames can stand in for a camera.
pub trait Eye {
    /// The controllers' view of `subject`.
    ///
    /// # Errors
    /// Whatever kept the image from being taken; the eye stays usable unless the error is
    /// [`CameraError::DeviceLost`].
    fn capture(&mut self, subject: &Subject) -> Result<CameraFrame, CameraError>;
}

/// Draws one stage. Cameras share a [`Gpu`]; each keeps its own geometry and image memory. When the device
/// is lost, as when its driver restarts, the camera goes on with the one that takes its place.
#[derive(Debug)]
pub struct Camera {
    workspace: Rect,
    walls: Vec<Polygon>,
    wall_height_m: f64,
    view_px: u32,
    /// Asked for; otherwise what the adapter can afford.
    quality: Option<Quality>,
    renderers: Renderers,
}

/// From where a picture for people is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Viewpoint {
    /// The user's side of the table, in perspective.
    User,
    /// Straight above, parallel.
    Above,
}

/// All that is lost with a device.
#[derive(Debug)]
struct Renderers {
    gpu: Arc<Gpu>,
    view: view::ViewRenderer,
    /// Made when it is first asked for: sessions and trials never do.
    scene: Option<scene::SceneRenderer>,
}

impl Renderers {
    fn new(gpu: &Arc<Gpu>, static_scene: &StaticScene, view_px: u32) -> Result<Self, CameraError> {
        let gpu = gpu.living()?;
        check_size(view_px, view_px, gpu.most_px())?;
        let view = view::ViewRenderer::new(&gpu, static_scene, view_px)?;
        Ok(Self { gpu, view, scene: None })
    }
}

impl Camera {
    /// Prepares to draw `stage`, the controllers' view with `view_px` columns and rows; later changes of
    /// the stage need a new camera.
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

    /// The same camera at a quality of its own, whatever its adapter can afford.
    #[must_use]
    pub fn with_quality(mut self, quality: Quality) -> Self {
        self.quality = Some(quality);
        self.renderers.scene = None;
        self
    }

    /// The controllers' view, square: image up is +y, and the centre of pixel (u, v) of W × W is the place
    /// (2u + 1 − W, W − 2v − 1)/W of the frame's pinhole.
    ///
    /// # Errors
    /// [`CameraError::Subject`] for a state that is not finite, those of [`check_mount`],
    /// [`CameraError::Rejected`], [`CameraError::Readback`] or [`CameraError::DeviceLost`] when the device
    /// fails.
    pub fn capture(&mut self, subject: &Subject) -> Result<CameraFrame, CameraError> {
        subject.check()?;
        check_mount(&subject.mount, self.wall_height_m)?;
        self.draw(|Self { renderers: Renderers { gpu, view, .. }, .. }| view.draw(gpu, subject))
    }

    /// The whole table with arm, magnet, walls, bead and goal, in perspective from the user's side.
    ///
    /// # Errors
    /// As [`Camera::capture`], and [`CameraError::Size`] for an image without pixels or one beyond
    /// [`MOST_PX`].
    pub fn scene(&mut self, subject: &Subject, width_px: u32, height_px: u32) -> Result<Picture, CameraError> {
        self.for_people(subject, Viewpoint::User, width_px, height_px)
    }

    /// The workspace from straight above, +y up, without perspective: walls, block, bead and goal, but no
    /// arm, which would hide them.
    ///
    /// # Errors
    /// As [`Camera::scene`].
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
        check_size(width_px, height_px, self.renderers.gpu.most_px())?;
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

    /// Draws, and draws once more on another device if this one is lost.
    fn draw<T>(&mut self, mut picture: impl FnMut(&mut Self) -> Result<T, CameraError>) -> Result<T, CameraError> {
        match picture(self) {
            Err(CameraError::DeviceLost { reason }) => {
                tracing::warn!(reason, "the graphics device was lost and is opened anew");
                let static_scene =
                    StaticScene { workspace: &self.workspace, walls: &self.walls, wall_height_m: self.wall_height_m };
                self.renderers = Renderers::new(&self.renderers.gpu, &static_scene, self.view_px)?;
                picture(self)
            }
            drawn => drawn,
        }
    }
}

impl Eye for Camera {
    fn capture(&mut self, subject: &Subject) -> Result<CameraFrame, CameraError> {
        fault_point!("render");
        #[cfg(test)]
        if crate::faults::strikes("hang") {
            std::thread::sleep(std::time::Duration::from_secs(14));
        }
        Camera::capture(self, subject)
    }
}

/// Refuses an image without pixels, or with a side beyond `most_px`.
fn check_size(width_px: u32, height_px: u32, most_px: u32) -> Result<(), CameraError> {
    let allowed = 1..=most_px;
    if allowed.contains(&width_px) && allowed.contains(&height_px) {
        return Ok(());
    }
    Err(CameraError::Size { width_px, height_px, most_px })
}
