//! Memory for one image size: colour, depth and the readback buffer.

use std::sync::mpsc;
use std::time::Duration;

use super::CameraError;
use super::gpu::Gpu;

/// Linear 8-bit values: the image holds what the shader writes, without gamma correction.
pub(super) const COLOR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// Depth format of both views and of the shadow map.
pub(super) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
const PIXEL_BYTES: u32 = 4;
/// An image takes milliseconds; a device that needs this long is stuck.
const READ_TIMEOUT: Duration = Duration::from_secs(20);

/// Textures to draw into and a buffer to read them back. Created once per size and used for every frame.
#[derive(Debug)]
pub(super) struct Target {
    pub width_px: u32,
    pub height_px: u32,
    color: wgpu::Texture,
    color_view: wgpu::TextureView,
    /// Multisampled texture, averaged into `color`.
    samples_view: Option<wgpu::TextureView>,
    depth_view: wgpu::TextureView,
    readback: wgpu::Buffer,
    /// Bytes from one row of `readback` to the next; copies require a multiple of 256.
    row_bytes: u32,
}

impl Target {
    /// `samples` per pixel: 1 keeps edges hard, 4 smooths them.
    pub fn new(gpu: &Gpu, width_px: u32, height_px: u32, samples: u32) -> Result<Self, CameraError> {
        gpu.checked("image memory", || Self::build(gpu, width_px, height_px, samples))
    }

    fn build(gpu: &Gpu, width_px: u32, height_px: u32, samples: u32) -> Self {
        let texture = |label, format, sample_count, usage| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: width_px, height: height_px, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        };
        let drawn = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let color = texture("color", COLOR_FORMAT, 1, drawn | wgpu::TextureUsages::COPY_SRC);
        let samples_view = (samples > 1).then(|| texture("samples", COLOR_FORMAT, samples, drawn).create_view(&view()));
        let depth = texture("depth", DEPTH_FORMAT, samples, drawn);
        let row_bytes = (width_px * PIXEL_BYTES).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let readback = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size: u64::from(row_bytes) * u64::from(height_px),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        Self {
            width_px,
            height_px,
            color_view: color.create_view(&view()),
            color,
            samples_view,
            depth_view: depth.create_view(&view()),
            readback,
            row_bytes,
        }
    }

    /// Begins the pass that fills the image, cleared to `background` (RGBA, 0 to 1).
    pub fn begin<'a>(&self, encoder: &'a mut wgpu::CommandEncoder, background: [f64; 4]) -> wgpu::RenderPass<'a> {
        let [r, g, b, a] = background;
        let (view, resolve_target, store) = match &self.samples_view {
            Some(samples_view) => (samples_view, Some(&self.color_view), wgpu::StoreOp::Discard),
            None => (&self.color_view, None, wgpu::StoreOp::Store),
        };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a }), store },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth_view,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        })
    }

    /// Adds the copy to `encoder`, submits it and waits for the image: row-major RGBA, top row first,
    /// `width · height · 4` bytes.
    pub fn finish(&self, gpu: &Gpu, mut encoder: wgpu::CommandEncoder) -> Result<Vec<u8>, CameraError> {
        encoder.copy_texture_to_buffer(
            self.color.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.readback,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(self.row_bytes),
                    rows_per_image: None,
                },
            },
            self.color.size(),
        );
        let (sender, receiver) = mpsc::channel();
        let submission = gpu.checked("a frame", || {
            let submission = gpu.queue.submit([encoder.finish()]);
            self.readback.map_async(wgpu::MapMode::Read, .., move |result| {
                // The receiver is dropped only if the wait failed, which is reported there.
                let _ = sender.send(result);
            });
            submission
        })?;
        let waited =
            gpu.device.poll(wgpu::PollType::Wait { submission_index: Some(submission), timeout: Some(READ_TIMEOUT) });
        gpu.check_alive()?;
        let mapped = waited
            .map_err(|error| error.to_string())
            // Another camera that waits on the same device may run this callback, a little later.
            .and_then(|_| receiver.recv_timeout(READ_TIMEOUT).map_err(|error| error.to_string()))
            .and_then(|result| result.map_err(|error| error.to_string()))
            .and_then(|()| self.copy_out().map_err(|error| error.to_string()));
        // Also cancels a mapping that is still pending, so that the next frame can be requested.
        self.readback.unmap();
        mapped.or_else(|reason| {
            gpu.check_lost()?;
            Err(CameraError::Readback { reason })
        })
    }

    /// The mapped buffer without the padding at the end of its rows.
    fn copy_out(&self) -> Result<Vec<u8>, wgpu::MapRangeError> {
        let padded = self.readback.get_mapped_range(..)?;
        let packed_bytes = (self.width_px * PIXEL_BYTES) as usize;
        let mut rgba = Vec::with_capacity(packed_bytes * self.height_px as usize);
        for row in padded.chunks_exact(self.row_bytes as usize) {
            rgba.extend_from_slice(&row[..packed_bytes]);
        }
        Ok(rgba)
    }
}

fn view() -> wgpu::TextureViewDescriptor<'static> {
    wgpu::TextureViewDescriptor::default()
}
