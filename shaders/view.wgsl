// The controllers' view: flat colours through a pinhole. Light is already in the colours, so that the palette alone
// guarantees the brightness of walls and floor.

struct View {
    clip_from_base: mat4x4<f32>,
}

@group(0) @binding(0) var<uniform> view: View;

struct Corner {
    @location(0) position_m: vec3<f32>,
    @location(2) color: vec4<f32>,
    // The upper three rows of base_from_solid.
    @location(3) row_x: vec4<f32>,
    @location(4) row_y: vec4<f32>,
    @location(5) row_z: vec4<f32>,
    @location(6) tint: vec4<f32>,
}

struct Pixel {
    @builtin(position) clip: vec4<f32>,
    @location(0) color: vec3<f32>,
}

@vertex
fn vertex(corner: Corner) -> Pixel {
    let at = vec4(corner.position_m, 1.0);
    let base_m = vec3(dot(corner.row_x, at), dot(corner.row_y, at), dot(corner.row_z, at));
    var pixel: Pixel;
    pixel.clip = view.clip_from_base * vec4(base_m, 1.0);
    pixel.color = corner.color.rgb * corner.tint.rgb;
    return pixel;
}

@fragment
fn fragment(pixel: Pixel) -> @location(0) vec4<f32> {
    return vec4(pixel.color, 1.0);
}
