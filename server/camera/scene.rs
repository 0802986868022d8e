//! Images for people: the whole table in perspective or from above, with one light and shadows.
//!
//! Only moving parts cast shadows. The walls are low; their shadows are part of the mesh.

use bytemuck::{Pod, Zeroable};
use nalgebra::Matrix4;

use super::geometry_buffers::{Batch, GeometryBuffers, Part, Solid};
use super::gpu::Gpu;
use super::mesh::{self, Color};
use super::pipeline::{self, Pass, bind, pipeline};
use super::target::{DEPTH_FORMAT, Target};
use super::{BEAD_RADIUS_M, CameraError, Quality, StaticScene, Subject, Viewpoint, arm, diorama, moved_walls, optics};
use ferry_core::geometry::{Point3, Rect, Vector3};
use ferry_core::image::Picture;

pub(super) const SHADER: &str = include_str!("../../shaders/scene.wgsl");

/// From the middle of the table toward the scene camera: from the user's side, above, a little to the right.
const TOWARD_EYE: [f64; 3] = [0.36, -1.0, 0.78];
/// Across the shorter side of the image.
const FIELD_OF_VIEW_RAD: f64 = 0.95;
/// From the middle of the table toward the light, which is above the user's left shoulder.
const TOWARD_LIGHT: [f64; 3] = [-0.24, -0.70, 1.0];
/// The elbow is usually inside this area, and below `ELBOW_TOP_M`.
const ELBOW: Rect = Rect { x_min_m: -0.16, x_max_m: 0.16, y_min_m: -0.10, y_max_m: 0.08 };
const ELBOW_TOP_M: f64 = 0.56;
/// The wrists are usually inside this area.
const WRISTS: Rect = Rect { x_min_m: -0.42, x_max_m: 0.42, y_min_m: -0.45, y_max_m: -0.10 };
/// Usual upper limit of the wrists and of everything else that holds the tool.
const WRISTS_TOP_M: f64 = 0.40;
/// Free share of the image's height and width on every side.
const MARGIN: f64 = 0.03;
/// Margin around the workspace in the plan view: the border and a little of the table.
const PLAN_MARGIN_M: f64 = 0.015;

/// Emissive colours: they mark positions rather than show real materials.
const BEAD: Color = [255, 196, 20, 255];
const BEAD_HALO: Color = [244, 140, 0, 0];
const GOAL: Color = [24, 150, 84, 0];
/// Radius of the goal ring: in the paper, the goal is reached within this distance.
const GOAL_RADIUS_M: f64 = 0.02;
/// Radius of the ring around the bead, which is itself only a few pixels large.
const HALO_RADIUS_M: f64 = 0.010;
/// Height of rings above the floor.
const RING_LIFT_M: f64 = 4e-4;
/// Inner radius of a ring, relative to its outer radius.
const RING_INNER: f64 = 0.7;

/// Uniforms of `scene.wgsl`, with the same layout.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct Scene {
    /// Column-major.
    pub clip_from_base: [[f32; 4]; 4],
    /// Column-major; to the shadow map's clip space.
    pub light_from_base: [[f32; 4]; 4],
    /// Unit vector; the fourth component is 0.
    pub toward_light: [f32; 4],
    /// Homogeneous position of the scene camera. In a parallel view the fourth component is 0 and the rest is the
    /// direction to the camera.
    pub eye_m: [f32; 4],
}

/// The rendering cost of a [`Quality`].
struct Effort {
    samples: u32,
    shadow_px: u32,
    /// Entry point of the fragment stage.
    fragment: &'static str,
}

impl Quality {
    fn effort(self) -> Effort {
        match self {
            Self::Economy => Effort { samples: 1, shadow_px: 1024, fragment: "hard" },
            Self::Fine => Effort { samples: 4, shadow_px: 1536, fragment: "soft" },
        }
    }
}

/// Draws images of one static scene for people.
#[derive(Debug)]
pub(super) struct SceneRenderer {
    /// Points that must be inside the image.
    bounds: Vec<Point3<f64>>,
    workspace: Rect,
    wall_height_m: f64,
    light_from_base: Matrix4<f64>,
    picture: wgpu::RenderPipeline,
    picture_bindings: wgpu::BindGroup,
    backdrop: wgpu::RenderPipeline,
    shadow: wgpu::RenderPipeline,
    shadow_bindings: wgpu::BindGroup,
    /// Redrawn for each frame.
    shadow_map: wgpu::TextureView,
    uniforms: wgpu::Buffer,
    geometry: GeometryBuffers,
    samples: u32,
    /// For the most recent image size.
    target: Option<Target>,
}

impl SceneRenderer {
    /// `stage` must already be checked.
    pub fn new(gpu: &Gpu, static_scene: &StaticScene, quality: Quality) -> Result<Self, CameraError> {
        gpu.checked("the scene", || Self::build(gpu, static_scene, quality))
    }

    fn build(gpu: &Gpu, static_scene: &StaticScene, quality: Quality) -> Self {
        let Effort { samples, shadow_px, fragment } = quality.effort();
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("shadow map"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare: Some(wgpu::CompareFunction::LessEqual),
            ..Default::default()
        });
        let shadow_map = shadow_map(gpu, shadow_px);
        let uniforms = pipeline::uniforms::<Scene>(gpu, "scene");
        let module = pipeline::module(gpu, "scene", SHADER);
        let shadow = pipeline(
            gpu,
            &Pass {
                module: &module,
                vertex: "shadow",
                fragment: None,
                samples: 1,
                // Prevents surfaces at an angle to the light from shading themselves.
                depth_bias: wgpu::DepthBiasState { constant: 2, slope_scale: 2.0, clamp: 0.0 },
            },
        );
        let picture = pipeline(
            gpu,
            &Pass {
                module: &module,
                vertex: "vertex",
                fragment: Some(fragment),
                samples,
                depth_bias: Default::default(),
            },
        );
        let backdrop = pipeline(
            gpu,
            &Pass {
                module: &module,
                vertex: "backdrop",
                fragment: Some("gradient"),
                samples,
                depth_bias: Default::default(),
            },
        );
        let picture_resources = [
            uniforms.as_entire_binding(),
            wgpu::BindingResource::TextureView(&shadow_map),
            wgpu::BindingResource::Sampler(&sampler),
        ];
        // One mesh per solid, in the order of `Solid`. The disc mesh is thick here: it is the lid of a joint.
        let meshes = [
            diorama::mesh(static_scene),
            diorama::edges_mesh(static_scene),
            mesh::unit_sphere(24),
            mesh::unit_lid(40),
            mesh::unit_cube(),
            mesh::unit_ring(64, RING_INNER),
            mesh::unit_cylinder(40),
        ];
        let bounds = bounds(static_scene.workspace);
        Self {
            light_from_base: optics::parallel_around(&bounds, toward_light()),
            bounds,
            workspace: *static_scene.workspace,
            wall_height_m: static_scene.wall_height_m,
            picture_bindings: bind(gpu, &picture, &picture_resources),
            shadow_bindings: bind(gpu, &shadow, &picture_resources[..1]),
            picture,
            backdrop,
            shadow,
            shadow_map,
            geometry: GeometryBuffers::new(gpu, &meshes, arm::MAX_PARTS + 8),
            uniforms,
            samples,
            target: None,
        }
    }

    fn cast_shadows(&self, encoder: &mut wgpu::CommandEncoder, batches: &[Batch]) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow map"),
            color_attachments: &[],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.shadow_map,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&self.shadow);
        pass.set_bind_group(0, &self.shadow_bindings, &[]);
        self.geometry.draw(&mut pass, batches);
    }

    /// `subject` and the size must already be checked.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        subject: &Subject,
        viewpoint: Viewpoint,
        width_px: u32,
        height_px: u32,
    ) -> Result<Picture, CameraError> {
        // The old target is freed before one of a new size is allocated.
        let target = match self.target.take() {
            Some(kept) if (kept.width_px, kept.height_px) == (width_px, height_px) => kept,
            _ => Target::new(gpu, width_px, height_px, self.samples)?,
        };
        let aspect = f64::from(width_px) / f64::from(height_px);
        let projection = match viewpoint {
            Viewpoint::User => {
                optics::perspective_around(&self.bounds, Vector3::from(TOWARD_EYE), FIELD_OF_VIEW_RAD, MARGIN, aspect)
            }
            Viewpoint::Above => optics::parallel_down(&self.workspace, PLAN_MARGIN_M, aspect),
        };
        let scene = Scene {
            clip_from_base: projection.clip_from_base.cast::<f32>().into(),
            light_from_base: self.light_from_base.cast::<f32>().into(),
            toward_light: toward_light().cast::<f32>().push(0.0).into(),
            eye_m: projection.eye_m.cast::<f32>().into(),
        };
        let encoder = gpu.checked("the scene", || {
            gpu.queue.write_buffer(&self.uniforms, 0, bytemuck::bytes_of(&scene));
            let batches = self.geometry.place(gpu, &parts(subject, viewpoint));
            let moved = subject.moved_walls.as_deref();
            let moved = moved.map(|bands| moved_walls::people_mesh(bands, self.wall_height_m, &self.workspace));
            self.geometry.load_frame_mesh(gpu, moved.as_ref());
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            // The static scene and the walls' edges cast no shadows; the last batch is the backdrop.
            let backdrop = batches.len() - 1;
            let first_caster = if moved.is_some() { 1 } else { 2 };
            self.cast_shadows(&mut encoder, &batches[first_caster..backdrop]);
            let mut pass = target.begin(&mut encoder, [0.0; 4]);
            pass.set_pipeline(&self.picture);
            pass.set_bind_group(0, &self.picture_bindings, &[]);
            self.geometry.draw(&mut pass, &batches[..backdrop]);
            self.geometry.draw_frame_mesh(&mut pass);
            // Drawn last, so that covered pixels cost nothing.
            pass.set_pipeline(&self.backdrop);
            self.geometry.draw(&mut pass, &batches[backdrop..]);
            drop(pass);
            encoder
        })?;
        let rgba = target.finish(gpu, encoder)?;
        self.target = Some(target);
        Ok(Picture { width_px, height_px, rgba })
    }
}

fn toward_light() -> Vector3<f64> {
    Vector3::from(TOWARD_LIGHT).normalize()
}

fn shadow_map(gpu: &Gpu, side_px: u32) -> wgpu::TextureView {
    let map = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("shadow map"),
        size: wgpu::Extent3d { width: side_px, height: side_px, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: DEPTH_FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    map.create_view(&Default::default())
}

/// All parts of the image, with equal solids next to each other. The static scene is first, then the edges of walls at
/// rest, and the backdrop last; they cast no shadows.
fn parts(subject: &Subject, viewpoint: Viewpoint) -> Vec<Part> {
    let [bead_x_m, bead_y_m, _] = subject.bead_m;
    let mut parts = match viewpoint {
        Viewpoint::User => arm::parts(subject),
        Viewpoint::Above => vec![arm::block(subject)],
    };
    parts.push(Part::in_base(Solid::StaticScene));
    if subject.moved_walls.is_none() {
        parts.push(Part::in_base(Solid::WallEdges));
    }
    parts.push(Part {
        solid: Solid::Sphere,
        base_from_solid: Matrix4::new_translation(&subject.bead_m.into()) * Matrix4::new_scaling(BEAD_RADIUS_M),
        color: BEAD,
    });
    parts.push(ring([bead_x_m, bead_y_m], HALO_RADIUS_M, BEAD_HALO));
    parts.extend(subject.goal_m.map(|goal_m| ring(goal_m, GOAL_RADIUS_M, GOAL)));
    parts.sort_by_key(|part| part.solid);
    parts.push(Part { solid: Solid::Disc, base_from_solid: Matrix4::identity(), color: [255; 4] });
    parts
}

fn ring([x_m, y_m]: [f64; 2], radius_m: f64, color: Color) -> Part {
    let at_m = Vector3::new(x_m, y_m, RING_LIFT_M);
    Part {
        solid: Solid::Ring,
        base_from_solid: Matrix4::new_translation(&at_m) * Matrix4::new_scaling(radius_m),
        color,
    }
}

/// Points that must be inside the image: corners of the table, of the tool's area and of the arm's space.
fn bounds(workspace: &Rect) -> Vec<Point3<f64>> {
    let table = diorama::table(workspace);
    let areas =
        [(table, -diorama::TABLE_THICKNESS_M), (table, WRISTS_TOP_M), (WRISTS, WRISTS_TOP_M), (ELBOW, ELBOW_TOP_M)];
    let corners = |(area, z_m): (Rect, f64)| {
        let ends_x_m = [area.x_min_m, area.x_max_m];
        ends_x_m.into_iter().flat_map(move |x_m| [area.y_min_m, area.y_max_m].map(|y_m| Point3::new(x_m, y_m, z_m)))
    };
    areas.into_iter().flat_map(corners).collect()
}
