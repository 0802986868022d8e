//! Triangles on the device, and the placement of solids in a frame.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use nalgebra::Matrix4;
use wgpu::util::DeviceExt;

use super::gpu::Gpu;
use super::mesh::{Color, Mesh};

/// The meshes of a renderer, in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Solid {
    /// All static parts.
    StaticScene,
    /// The edges of walls at rest; the controllers' view has them in the static scene.
    WallEdges,
    Sphere,
    Disc,
    Cube,
    Ring,
    Cylinder,
}

/// One placed copy of a solid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub solid: Solid,
    /// Affine, from the solid's unit frame to `base`. It may scale only along the solid's own axes, and round solids
    /// equally across; otherwise the normals would be wrong.
    pub base_from_solid: Matrix4<f64>,
    /// Multiplies the solid's colour.
    pub color: Color,
}

impl Part {
    /// A solid that is already in `base`.
    pub fn in_base(solid: Solid) -> Self {
        Self { solid, base_from_solid: Matrix4::identity(), color: [255; 4] }
    }
}

/// A [`Part`] as the shaders read it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(super) struct Instance {
    /// The upper three rows of `base_from_solid`.
    pub base_from_solid: [[f32; 4]; 3],
    pub color: Color,
}

impl Instance {
    /// Memory layout for the pipelines; locations as in the shaders.
    pub const LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
        array_stride: size_of::<Self>() as u64,
        step_mode: wgpu::VertexStepMode::Instance,
        attributes: &wgpu::vertex_attr_array![
            3 => Float32x4, 4 => Float32x4, 5 => Float32x4, 6 => Unorm8x4
        ],
    };
}

impl From<&Part> for Instance {
    fn from(part: &Part) -> Self {
        let row = |row| std::array::from_fn(|column| part.base_from_solid[(row, column)] as f32);
        Self { base_from_solid: [row(0), row(1), row(2)], color: part.color }
    }
}

/// Copies of one solid that are drawn together.
#[derive(Clone, Debug)]
pub(super) struct Batch {
    indices: Range<u32>,
    instances: Range<u32>,
}

/// All meshes of a renderer in one pair of buffers, and the instances of the current frame.
#[derive(Debug)]
pub(super) struct GeometryBuffers {
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    /// The range of `indices` of each mesh.
    meshes: Vec<Range<u32>>,
    instances: wgpu::Buffer,
    /// A mesh of the current frame, in `base`.
    frame: FrameMesh,
}

/// A mesh that changes from frame to frame, in buffers that grow with it.
#[derive(Debug, Default)]
struct FrameMesh {
    buffers: Option<[wgpu::Buffer; 2]>,
    index_count: u32,
}

impl FrameMesh {
    fn load(&mut self, gpu: &Gpu, mesh: &Mesh) {
        self.index_count = mesh.indices.len() as u32;
        if self.index_count == 0 {
            return;
        }
        let contents: [&[u8]; 2] = [bytemuck::cast_slice(&mesh.vertices), bytemuck::cast_slice(&mesh.indices)];
        let fits = |buffers: &[wgpu::Buffer; 2]| {
            buffers.iter().zip(contents).all(|(buffer, bytes)| buffer.size() >= bytes.len() as u64)
        };
        if !self.buffers.as_ref().is_some_and(fits) {
            let kinds = [wgpu::BufferUsages::VERTEX, wgpu::BufferUsages::INDEX];
            self.buffers = Some(std::array::from_fn(|kind| {
                gpu.device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some("mesh of the frame"),
                    size: (contents[kind].len() as u64).next_power_of_two(),
                    usage: kinds[kind] | wgpu::BufferUsages::COPY_DST,
                    mapped_at_creation: false,
                })
            }));
        }
        for (buffer, bytes) in self.buffers.iter().flatten().zip(contents) {
            gpu.queue.write_buffer(buffer, 0, bytes);
        }
    }
}

impl GeometryBuffers {
    /// Uploads `meshes`, one for each [`Solid`] in order. A renderer that uses only the first few passes only those.
    /// A frame may place at most `max_parts`.
    pub fn new(gpu: &Gpu, meshes: &[Mesh], max_parts: u64) -> Self {
        let mut all = Mesh::default();
        let mut ranges = Vec::with_capacity(meshes.len());
        for mesh in meshes {
            let (vertex, index) = (all.vertices.len() as u32, all.indices.len() as u32);
            all.vertices.extend_from_slice(&mesh.vertices);
            all.indices.extend(mesh.indices.iter().map(|at| vertex + at));
            ranges.push(index..all.indices.len() as u32);
        }
        let filled = |label, contents, usage| {
            let descriptor = wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage };
            gpu.device.create_buffer_init(&descriptor)
        };
        Self {
            vertices: filled("vertices", bytemuck::cast_slice(&all.vertices), wgpu::BufferUsages::VERTEX),
            indices: filled("indices", bytemuck::cast_slice(&all.indices), wgpu::BufferUsages::INDEX),
            meshes: ranges,
            instances: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("instances"),
                size: max_parts * size_of::<Instance>() as u64,
                usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            frame: FrameMesh::default(),
        }
    }

    /// Sets the mesh that [`Self::draw_frame_mesh`] draws in the next submitted frame.
    pub fn load_frame_mesh(&mut self, gpu: &Gpu, mesh: Option<&Mesh>) {
        match mesh {
            Some(mesh) => self.frame.load(gpu, mesh),
            None => self.frame.index_count = 0,
        }
    }

    /// Draws the mesh of the frame, placed like the first part: the static scene.
    pub fn draw_frame_mesh(&self, pass: &mut wgpu::RenderPass) {
        let Some([vertices, indices]) = self.frame.buffers.as_ref().filter(|_| self.frame.index_count > 0) else {
            return;
        };
        pass.set_vertex_buffer(0, vertices.slice(..));
        pass.set_vertex_buffer(1, self.instances.slice(..));
        pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.frame.index_count, 0, 0..1);
    }

    /// Places `parts` for the next submitted frame. Consecutive equal solids are drawn together.
    pub fn place(&self, gpu: &Gpu, parts: &[Part]) -> Vec<Batch> {
        let instances: Vec<Instance> = parts.iter().map(Instance::from).collect();
        gpu.queue.write_buffer(&self.instances, 0, bytemuck::cast_slice(&instances));
        let mut batches = Vec::new();
        let mut first = 0;
        for run in parts.chunk_by(|a, b| a.solid == b.solid) {
            let next = first + run.len() as u32;
            batches.push(Batch { indices: self.meshes[run[0].solid as usize].clone(), instances: first..next });
            first = next;
        }
        batches
    }

    /// Draws batches of [`Self::place`], in order.
    pub fn draw(&self, pass: &mut wgpu::RenderPass, batches: &[Batch]) {
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_vertex_buffer(1, self.instances.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        for batch in batches {
            pass.draw_indexed(batch.indices.clone(), 0, batch.instances.clone());
        }
    }
}
