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

use ferry_core::geometry::{Polygon, Rect};

use ferry_core::image::{CameraError, CameraFrame, ImageSource, Picture, StaticScene, Subject, VIEW_PX, check_mount};
pub use gpu::{AdapterChoice, Gpu};

pub const BEAD_RADIUS_M: f64 = 0.0025;

/// Largest width or height of an image. Larger images are refused even if the adapter allows them, because one
/// request could allocate gigabytes.
pub const MAX_PX: u32 = 4096;

/// Rendering quality of images for people. It does not affect the controllers' view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quality {
    /// Hard edges and hard shadows, for adapters that render on the CPU.
    Economy,
    /// Four samples per pixel and soft shadows.
    Fine,
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

    /// The camera of trials in a scene.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn of(gpu: &Arc<Gpu>, static_scene: StaticScene) -> Result<Self, CameraError> {
        Self::new(gpu.clone(), &static_scene, VIEW_PX)
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
