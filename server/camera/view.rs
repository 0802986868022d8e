//! The controllers' view: one pass with flat colours; shadows are part of the mesh.

use bytemuck::{Pod, Zeroable};
use nalgebra::{Matrix4, Vector3};

use super::geometry_buffers::{GeometryBuffers, Part, Solid};
use super::gpu::Gpu;
use super::mesh::{self, Color, Mesh};
use super::pipeline::{self, Pass, bind, pipeline};
use super::static_scene::{self, SHADOW_LIFT_M, SHADOW_PER_HEIGHT, controllers};
use super::target::Target;
use super::{BEAD_RADIUS_M, CameraError, StaticScene, Subject, arm, moved_walls, optics};
use ferry_core::geometry::Point2;
use ferry_core::image::{CameraFrame, Picture};

pub(super) const SHADER: &str = include_str!("../../shaders/view.wgsl");

/// One sample per pixel, so that no pixel is a mixture of wall and floor.
const SAMPLES: u32 = 1;
/// Static scene, bead, bead shadow, and magnet and gripper if they are visible.
const MAX_PARTS: u64 = 3 + 16;

/// Uniforms of `view.wgsl`, with the same layout.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct View {
    /// Column-major.
    pub clip_from_base: [[f32; 4]; 4],
}

/// Draws the controllers' view of one static scene.
#[derive(Debug)]
pub(super) struct ViewRenderer {
    size_px: u32,
    pipeline: wgpu::RenderPipeline,
    uniforms: wgpu::Buffer,
    bindings: wgpu::BindGroup,
    geometry: GeometryBuffers,
    wall_height_m: f64,
    target: Target,
}

impl ViewRenderer {
    /// `stage` and the size must already be checked.
    pub fn new(gpu: &Gpu, static_scene: &StaticScene, size_px: u32) -> Result<Self, CameraError> {
        let target = Target::new(gpu, size_px, size_px, SAMPLES)?;
        gpu.checked("the controllers' view", || {
            let module = pipeline::module(gpu, "view", SHADER);
            let uniforms = pipeline::uniforms::<View>(gpu, "view");
            let pipeline = pipeline(
                gpu,
                &Pass {
                    module: &module,
                    vertex: "vertex",
                    fragment: Some("fragment"),
                    samples: SAMPLES,
                    depth_bias: Default::default(),
                },
            );
            let bindings = bind(gpu, &pipeline, &[uniforms.as_entire_binding()]);
            let meshes = [
                static_scene::controllers_mesh(static_scene),
                Mesh::default(),
                shaded_bead(),
                mesh::unit_disc(24),
                mesh::unit_cube(),
                mesh::unit_ring(8, 0.5),
                mesh::unit_cylinder(24),
            ];
            Self {
                size_px,
                pipeline,
                uniforms,
                bindings,
                geometry: GeometryBuffers::new(gpu, &meshes, MAX_PARTS),
                wall_height_m: static_scene.wall_height_m,
                target,
            }
        })
    }

    /// `subject` must already be checked.
    pub fn draw(&mut self, gpu: &Gpu, subject: &Subject) -> Result<CameraFrame, CameraError> {
        let [x_m, y_m, _] = subject.tool_m;
        let pinhole = subject.mount.over(Point2::new(x_m, y_m), subject.turn_rad);
        let clip_from_base = optics::pinhole(&pinhole);
        let encoder = gpu.checked("the controllers' view", || {
            let view = View { clip_from_base: clip_from_base.cast::<f32>().into() };
            gpu.queue.write_buffer(&self.uniforms, 0, bytemuck::bytes_of(&view));
            let batches = self.geometry.place(gpu, &parts(subject));
            let moved = subject.moved_walls.as_deref();
            let moved = moved.map(|bands| moved_walls::controllers_mesh(bands, self.wall_height_m, &pinhole));
            self.geometry.load_frame_mesh(gpu, moved.as_ref());
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let mut pass = self.target.begin(&mut encoder, background());
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &self.bindings, &[]);
            // Walls that have moved hide what lies behind them, so they come first.
            self.geometry.draw_frame_mesh(&mut pass);
            self.geometry.draw(&mut pass, &batches);
            drop(pass);
            encoder
        })?;
        let rgba = self.target.finish(gpu, encoder)?;
        let picture = Picture { width_px: self.size_px, height_px: self.size_px, rgba };
        Ok(CameraFrame { picture, tick: subject.tick, pinhole })
    }
}

/// The colour of walls: everything outside the drawn geometry counts as wall.
fn background() -> [f64; 4] {
    controllers::WALL_TOP.map(|level| f64::from(level) / 255.0)
}

fn parts(subject: &Subject) -> Vec<Part> {
    let bead_m = Vector3::from(subject.bead_m);
    let [away_x, away_y] = SHADOW_PER_HEIGHT;
    let shadow_m = Vector3::new(
        bead_m.x + away_x * bead_m.z,
        bead_m.y + away_y * bead_m.z,
        // Above the walls' shadows; at the same height the two would flicker.
        2.0 * SHADOW_LIFT_M,
    );
    let round = |solid, at_m: Vector3<f64>, color| Part {
        solid,
        base_from_solid: Matrix4::new_translation(&at_m) * Matrix4::new_scaling(BEAD_RADIUS_M),
        color,
    };
    let mut parts = vec![
        Part::in_base(Solid::StaticScene),
        round(Solid::Disc, shadow_m, controllers::SHADOW),
        round(Solid::Sphere, bead_m, [255; 4]),
    ];
    if subject.mount.sees_magnet {
        parts.extend(arm::tool_parts(subject).into_iter().map(|part| Part { color: controllers::MAGNET, ..part }));
    }
    parts
}

/// A ball with its shading baked into the vertex colours. The light never moves relative to it.
fn shaded_bead() -> Mesh {
    let [away_x, away_y] = SHADOW_PER_HEIGHT;
    let toward_light = Vector3::new(-away_x, -away_y, 1.0).normalize();
    let mut ball = mesh::unit_sphere(24);
    for vertex in &mut ball.vertices {
        let normal = Vector3::from(vertex.normal).cast::<f64>();
        vertex.color = bead_color(normal.dot(&toward_light));
    }
    ball
}

/// The bead's colour where `cosine` is the cosine between its normal and the light. A surface that faces the light
/// gets a highlight.
fn bead_color(cosine: f64) -> Color {
    let shade = controllers::BEAD_SHADE + (1.0 - controllers::BEAD_SHADE) * cosine.max(0.0);
    let shine = cosine.max(0.0).powi(12);
    let mut color = controllers::BEAD;
    for level in &mut color[..3] {
        let lit = f64::from(*level) * shade;
        *level = (lit + (255.0 - lit) * shine).round() as u8;
    }
    color
}
