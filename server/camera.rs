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
//! goal, no magnet and no arm are in it.
//!
//! | part | what it does |
//! |---|---|
//! | `error` | [`CameraError`], everything that can go wrong |
//! | `gpu` | finds an adapter, opens the device, turns what it says into errors |
//! | `target` | colour, depth and readback memory of one picture size |
//! | `mesh`, `geometry_buffers` | triangles, and their copies on the device |
//! | `stage` | walls, floor and table as triangles; the palettes of both views |
//! | `arm` | robot, gripper and magnet as a list of simple solids |
//! | `optics` | projections |
//! | `pipeline` | what the drawing passes have in common |
//! | `view`, `scene` | the two renderers |
//!
//! Metres in `base` and `f64` at the border; `f32` only on the device.

mod arm;
mod error;
mod geometry_buffers;
mod gpu;
mod mesh;
mod optics;
mod pipeline;
mod scene;
mod stage;
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

use crate::geometry::{Isometry3, Polygon, Rect};
use crate::image::CameraFrame;

pub use error::CameraError;
pub use gpu::{AdapterChoice, Gpu};

/// Radius of the bead.
pub const BEAD_RADIUS_M: f64 = 0.0025;

/// Largest width or height of an image that is drawn, whatever the adapter allows: beyond it a
/// single request could claim gigabytes.
pub const MOST_PX: u32 = 4096;

/// Largest height or table span that is accepted.
const MOST_M: f64 = 10.0;

/// How much work goes into pictures for people. The controllers' view is the same at either.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ts_rs::TS)]
#[serde(rename_all = "snake_case")]
pub enum Quality {
    /// Hard edges and shadows, for adapters that render on the processor.
    Economy,
    /// Four samples a pixel and soft shadows.
    Fine,
}

/// The pinhole that the controllers see through.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ts_rs::TS)]
pub struct CameraParameters {
    /// Height of the optical centre above the table.
    pub height_m: f64,
    /// Width of table (z = 0) across the image.
    pub table_span_m: f64,
    /// Columns and rows of the square image.
    pub size_px: u32,
}

impl Default for CameraParameters {
    fn default() -> Self {
        Self { height_m: 0.30, table_span_m: 0.20, size_px: 480 }
    }
}

impl CameraParameters {
    /// Refuses values that no image can be made of, for walls of `wall_height_m`.
    ///
    /// # Errors
    /// [`CameraError::Parameter`], [`CameraError::BelowWalls`] or [`CameraError::Size`]. A camera
    /// applies its adapter's own limit on the size besides.
    pub fn check(&self, wall_height_m: f64) -> Result<(), CameraError> {
        let lengths = [("height_m", self.height_m), ("table_span_m", self.table_span_m)];
        for (name, value) in lengths {
            if !(value > 0.0 && value <= MOST_M) {
                let expected = "above 0 and at most 10 m";
                return Err(CameraError::Parameter { name, value, expected });
            }
        }
        if self.height_m <= wall_height_m {
            return Err(CameraError::BelowWalls { height_m: self.height_m, wall_height_m });
        }
        check_size(self.size_px, self.size_px, MOST_PX)
    }
}

/// The static geometry. Walls are prisms on these polygons; in the controllers' view everything
/// outside the workspace is wall besides.
#[derive(Clone, Copy, Debug)]
pub struct Stage<'a> {
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
    parameters: CameraParameters,
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
    fn new(gpu: &Arc<Gpu>, stage: &Stage, parameters: &CameraParameters) -> Result<Self, CameraError> {
        let gpu = gpu.living()?;
        check_size(parameters.size_px, parameters.size_px, gpu.most_px())?;
        let view = view::ViewRenderer::new(&gpu, stage, *parameters)?;
        Ok(Self { gpu, view, scene: None })
    }
}

impl Camera {
    /// Prepares to draw `stage`; later changes of the stage need a new camera.
    ///
    /// # Errors
    /// [`CameraError::Parameter`], [`CameraError::BelowWalls`], [`CameraError::Size`] or
    /// [`CameraError::Stage`] for bad input, [`CameraError::Rejected`] or
    /// [`CameraError::DeviceLost`] when the device fails.
    pub fn new(gpu: Arc<Gpu>, stage: &Stage, parameters: &CameraParameters) -> Result<Self, CameraError> {
        stage::check(stage)?;
        parameters.check(stage.wall_height_m)?;
        Ok(Self {
            workspace: *stage.workspace,
            walls: stage.walls.to_vec(),
            wall_height_m: stage.wall_height_m,
            parameters: *parameters,
            quality: None,
            renderers: Renderers::new(&gpu, stage, parameters)?,
        })
    }

    /// The same camera at a quality of its own, whatever its adapter can afford.
    #[must_use]
    pub fn with_quality(mut self, quality: Quality) -> Self {
        self.quality = Some(quality);
        self.renderers.scene = None;
        self
    }

    /// The controllers' view, square: image up is +y, and the centre of pixel (u, v) shows the table
    /// at `x = tool_x + (u + ½ − W/2)·span/W`, `y = tool_y − (v + ½ − W/2)·span/W`.
    ///
    /// # Errors
    /// [`CameraError::Subject`] for a state that is not finite, [`CameraError::Rejected`],
    /// [`CameraError::Readback`] or [`CameraError::DeviceLost`] when the device fails.
    pub fn capture(&mut self, subject: &Subject) -> Result<CameraFrame, CameraError> {
        subject.check()?;
        self.draw(|Self { renderers: Renderers { gpu, view, .. }, .. }| view.draw(gpu, subject))
    }

    /// The whole table with arm, magnet, walls, bead and goal, in perspective from the user's side.
    /// The frame's `camera_m` is the eye; its `table_span_m` is the width seen at the distance of
    /// the middle of the picture.
    ///
    /// # Errors
    /// As [`Camera::capture`], and [`CameraError::Size`] for an image without pixels or one beyond
    /// [`MOST_PX`].
    pub fn scene(&mut self, subject: &Subject, width_px: u32, height_px: u32) -> Result<CameraFrame, CameraError> {
        self.for_people(subject, Viewpoint::User, width_px, height_px)
    }

    /// The workspace from straight above, +y up, without perspective: walls, block, bead and goal, but no
    /// arm, which would hide them. The frame's `table_span_m` is the width seen.
    ///
    /// # Errors
    /// As [`Camera::scene`].
    pub fn plan(&mut self, subject: &Subject, width_px: u32, height_px: u32) -> Result<CameraFrame, CameraError> {
        self.for_people(subject, Viewpoint::Above, width_px, height_px)
    }

    fn for_people(
        &mut self,
        subject: &Subject,
        viewpoint: Viewpoint,
        width_px: u32,
        height_px: u32,
    ) -> Result<CameraFrame, CameraError> {
        subject.check()?;
        check_size(width_px, height_px, self.renderers.gpu.most_px())?;
        self.draw(|Self { workspace, walls, wall_height_m, quality, renderers, .. }| {
            let Renderers { gpu, scene, .. } = renderers;
            let scene = match scene {
                Some(scene) => scene,
                None => {
                    let stage = Stage { workspace, walls, wall_height_m: *wall_height_m };
                    scene.insert(scene::SceneRenderer::new(gpu, &stage, quality.unwrap_or(gpu.quality()))?)
                }
            };
            scene.draw(gpu, subject, viewpoint, width_px, height_px)
        })
    }

    /// Draws, and draws once more on another device if this one is lost.
    fn draw(
        &mut self,
        mut picture: impl FnMut(&mut Self) -> Result<CameraFrame, CameraError>,
    ) -> Result<CameraFrame, CameraError> {
        match picture(self) {
            Err(CameraError::DeviceLost { reason }) => {
                tracing::warn!(reason, "the graphics device was lost and is opened anew");
                let stage = Stage { workspace: &self.workspace, walls: &self.walls, wall_height_m: self.wall_height_m };
                self.renderers = Renderers::new(&self.renderers.gpu, &stage, &self.parameters)?;
                picture(self)
            }
            drawn => drawn,
        }
    }
}

impl Eye for Camera {
    fn capture(&mut self, subject: &Subject) -> Result<CameraFrame, CameraError> {
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
