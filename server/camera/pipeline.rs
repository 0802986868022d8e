//! Code that all render passes share.

use super::geometry_buffers::Instance;
use super::gpu::Gpu;
use super::mesh::Vertex;
use super::target::{COLOR_FORMAT, DEPTH_FORMAT};

/// The differences between passes.
pub(super) struct Pass<'a> {
    pub module: &'a wgpu::ShaderModule,
    /// Entry point of the vertex stage; also the label.
    pub vertex: &'a str,
    /// Entry point of the fragment stage; `None` if only depth is drawn.
    pub fragment: Option<&'a str>,
    /// Samples per pixel.
    pub samples: u32,
    pub depth_bias: wgpu::DepthBiasState,
}

/// A pipeline over [`Vertex`] and [`Instance`] with depth test. The bindings are derived from the shader. Both sides
/// of a triangle are drawn, so the winding does not matter.
pub(super) fn pipeline(gpu: &Gpu, pass: &Pass) -> wgpu::RenderPipeline {
    let targets = [Some(COLOR_FORMAT.into())];
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(pass.vertex),
        layout: None,
        vertex: wgpu::VertexState {
            module: pass.module,
            entry_point: Some(pass.vertex),
            compilation_options: Default::default(),
            buffers: &[Some(Vertex::LAYOUT), Some(Instance::LAYOUT)],
        },
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::LessEqual),
            stencil: Default::default(),
            bias: pass.depth_bias,
        }),
        multisample: wgpu::MultisampleState { count: pass.samples, ..Default::default() },
        fragment: pass.fragment.map(|entry_point| wgpu::FragmentState {
            module: pass.module,
            entry_point: Some(entry_point),
            compilation_options: Default::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}

pub(super) fn module(gpu: &Gpu, label: &str, source: &str) -> wgpu::ShaderModule {
    gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(label),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    })
}

pub(super) fn uniforms<T>(gpu: &Gpu, label: &str) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: size_of::<T>() as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// Binds `resources` to group 0 of a pipeline, numbered from 0.
pub(super) fn bind(gpu: &Gpu, pipeline: &wgpu::RenderPipeline, resources: &[wgpu::BindingResource]) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &entries,
    })
}
