//! Triangle meshes, and the basic solids.

use std::f64::consts::TAU;

use bytemuck::{Pod, Zeroable};

use ferry_core::geometry::{Point3, Vector3};

/// Red, green, blue as in an image file; alpha is how the scene lights it: 255 fully lit, 0 emissive.
pub(super) type Color = [u8; 4];

/// A vertex, as both shaders read it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(super) struct Vertex {
    /// In `base` for the static scene, otherwise in the solid's unit frame.
    pub position_m: [f32; 3],
    /// Outward unit vector.
    pub normal: [f32; 3],
    pub color: Color,
}

impl Vertex {
    /// Memory layout for the pipelines; locations as in the shaders.
    pub const LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
        array_stride: size_of::<Self>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4],
    };
}

#[derive(Clone, Debug, Default)]
pub(super) struct Mesh {
    pub vertices: Vec<Vertex>,
    /// Indices into `vertices`, three per triangle.
    pub indices: Vec<u32>,
}

impl Mesh {
    /// Adds a vertex and returns its index.
    pub fn vertex(&mut self, position: Point3<f64>, normal: Vector3<f64>, color: Color) -> u32 {
        self.vertices.push(Vertex {
            position_m: position.coords.cast::<f32>().into(),
            normal: normal.cast::<f32>().into(),
            color,
        });
        (self.vertices.len() - 1) as u32
    }

    /// Adds a flat quadrilateral; `corners` go around it in order.
    pub fn quad(&mut self, corners: [Point3<f64>; 4], normal: Vector3<f64>, color: Color) {
        let [a, b, c, d] = corners.map(|corner| self.vertex(corner, normal, color));
        self.indices.extend([a, b, c, a, c, d]);
    }

    /// Adds an axis-aligned box between two opposite corners.
    pub fn cuboid(&mut self, low: Point3<f64>, high: Point3<f64>, color: Color) {
        let size = high - low;
        for axis in 0..3 {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            for side in [0.0, 1.0] {
                let corner = |at_u: f64, at_v: f64| {
                    let mut position = low;
                    position[axis] += side * size[axis];
                    position[u] += at_u * size[u];
                    position[v] += at_v * size[v];
                    position
                };
                let mut normal = Vector3::zeros();
                normal[axis] = 2.0 * side - 1.0;
                let corners = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
                self.quad(corners, normal, color);
            }
        }
    }

    /// Adds a grid of `rows × columns` cells. `at(row, column)` returns a corner and its normal.
    fn grid(&mut self, rows: u32, columns: u32, color: Color, at: impl Fn(u32, u32) -> (Point3<f64>, Vector3<f64>)) {
        let first = self.vertices.len() as u32;
        for row in 0..=rows {
            for column in 0..=columns {
                let (position, normal) = at(row, column);
                self.vertex(position, normal, color);
            }
        }
        let stride = columns + 1;
        for row in 0..rows {
            for column in 0..columns {
                let a = first + row * stride + column;
                let (b, c, d) = (a + 1, a + stride + 1, a + stride);
                self.indices.extend([a, b, c, a, c, d]);
            }
        }
    }
}

/// The unit vector at step `step` of `steps` around a circle in the xy plane.
fn around(step: u32, steps: u32) -> Vector3<f64> {
    let angle = TAU * f64::from(step) / f64::from(steps);
    Vector3::new(angle.cos(), angle.sin(), 0.0)
}

/// White: the colour of a part comes from its instance.
const PLAIN: Color = [255; 4];

/// A cube of side 1 around the origin.
pub(super) fn unit_cube() -> Mesh {
    let mut mesh = Mesh::default();
    let half = Vector3::repeat(0.5);
    mesh.cuboid(Point3::origin() - half, Point3::origin() + half, PLAIN);
    mesh
}

/// A sphere of radius 1 around the origin.
pub(super) fn unit_sphere(columns: u32) -> Mesh {
    let rows = columns / 2;
    let mut mesh = Mesh::default();
    mesh.grid(rows, columns, PLAIN, |row, column| {
        let polar = 0.5 * TAU * f64::from(row) / f64::from(rows);
        let normal = around(column, columns) * polar.sin() + Vector3::z() * polar.cos();
        (Point3::from(normal), normal)
    });
    mesh
}

/// A cylinder of radius 1 from z = 0 to z = 1, closed at both ends.
pub(super) fn unit_cylinder(columns: u32) -> Mesh {
    let mut mesh = Mesh::default();
    mesh.grid(1, columns, PLAIN, |row, column| {
        let normal = around(column, columns);
        (Point3::from(normal + Vector3::z() * f64::from(row)), normal)
    });
    for (z, normal) in [(0.0, -Vector3::z()), (1.0, Vector3::z())] {
        mesh.grid(1, columns, PLAIN, |row, column| {
            let rim = around(column, columns) * f64::from(row);
            (Point3::from(rim + Vector3::z() * z), normal)
        });
    }
    mesh
}

/// A lid of radius 1 from z = 0 to its slightly domed top at z = 1: half of the superellipsoid r⁴ + z⁴ = 1.
pub(super) fn unit_lid(columns: u32) -> Mesh {
    let rows = 6;
    let mut mesh = Mesh::default();
    mesh.grid(rows, columns, PLAIN, |row, column| {
        let (z, radius) = (0.25 * TAU * f64::from(row) / f64::from(rows)).sin_cos();
        let (z, radius) = (z.sqrt(), radius.max(0.0).sqrt());
        let out = around(column, columns);
        let normal = (out * radius.powi(3) + Vector3::z() * z.powi(3)).normalize();
        (Point3::from(out * radius + Vector3::z() * z), normal)
    });
    mesh
}

/// A disc of radius 1 at z = 0, facing up.
pub(super) fn unit_disc(columns: u32) -> Mesh {
    let mut mesh = Mesh::default();
    mesh.grid(1, columns, PLAIN, |row, column| {
        let rim = around(column, columns) * f64::from(row);
        (Point3::from(rim), Vector3::z())
    });
    mesh
}

/// A flat ring at z = 0 from radius `inner` to radius 1, facing up.
pub(super) fn unit_ring(columns: u32, inner: f64) -> Mesh {
    let mut mesh = Mesh::default();
    mesh.grid(1, columns, PLAIN, |row, column| {
        let radius = if row == 0 { inner } else { 1.0 };
        (Point3::from(around(column, columns) * radius), Vector3::z())
    });
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solids_are_closed_and_their_normals_point_outward() {
        for (name, mesh, center) in [
            ("cube", unit_cube(), [0.0, 0.0, 0.0]),
            ("sphere", unit_sphere(16), [0.0, 0.0, 0.0]),
            ("cylinder", unit_cylinder(16), [0.0, 0.0, 0.5]),
            ("lid", unit_lid(16), [0.0, 0.0, 0.0]),
        ] {
            for vertex in &mesh.vertices {
                let outward: f32 =
                    (0..3).map(|axis| vertex.normal[axis] * (vertex.position_m[axis] - center[axis])).sum();
                assert!(outward > 0.0, "{name}: {vertex:?}");
            }
            assert!(mesh.indices.len().is_multiple_of(3));
            let max = *mesh.indices.iter().max().unwrap() as usize;
            assert!(max < mesh.vertices.len(), "{name}");
        }
    }
}
