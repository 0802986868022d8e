// The scene for people: one light with shadows, light from sky and table, a little shine.

struct Scene {
    clip_from_base: mat4x4<f32>,
    light_from_base: mat4x4<f32>,
    // The fourth is 1 for soft shadows and 0 for hard ones.
    toward_light: vec4<f32>,
    // Homogeneous: a direction where the view is parallel.
    eye_m: vec4<f32>,
}

@group(0) @binding(0) var<uniform> scene: Scene;
// Depth of what stands still as the light sees it, and of what moves.
@group(0) @binding(1) var still_shadow: texture_depth_2d;
@group(0) @binding(2) var moving_shadow: texture_depth_2d;
@group(0) @binding(3) var shadow_sampler: sampler_comparison;

struct Corner {
    @location(0) position_m: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) color: vec4<f32>,
    // The upper three rows of base_from_solid.
    @location(3) row_x: vec4<f32>,
    @location(4) row_y: vec4<f32>,
    @location(5) row_z: vec4<f32>,
    @location(6) tint: vec4<f32>,
}

struct Pixel {
    @builtin(position) clip: vec4<f32>,
    @location(0) base_m: vec3<f32>,
    @location(1) normal: vec3<f32>,
    // Linear red, green, blue; 1 lit, 0 shining by itself.
    @location(2) color: vec4<f32>,
}

const SUN: vec3<f32> = vec3(0.80, 0.77, 0.71);
const SKY: vec3<f32> = vec3(0.36, 0.39, 0.43);
const GROUND: vec3<f32> = vec3(0.20, 0.18, 0.17);
const SHINE: f32 = 0.16;
const GAMMA: f32 = 2.2;

fn in_base(corner: Corner) -> vec3<f32> {
    let at = vec4(corner.position_m, 1.0);
    return vec3(dot(corner.row_x, at), dot(corner.row_y, at), dot(corner.row_z, at));
}

// Depth as the light sees it.
@vertex
fn shadow(corner: Corner) -> @builtin(position) vec4<f32> {
    return scene.light_from_base * vec4(in_base(corner), 1.0);
}

@vertex
fn vertex(corner: Corner) -> Pixel {
    let n = corner.normal;
    var pixel: Pixel;
    pixel.base_m = in_base(corner);
    pixel.clip = scene.clip_from_base * vec4(pixel.base_m, 1.0);
    // Right for rotations and for stretches along the solid's own axes, which is all there is.
    pixel.normal = vec3(
        dot(corner.row_x.xyz, n),
        dot(corner.row_y.xyz, n),
        dot(corner.row_z.xyz, n),
    );
    let color = corner.color * corner.tint;
    pixel.color = vec4(pow(color.rgb, vec3(GAMMA)), color.a);
    return pixel;
}

// Share of the light that passes one map.
fn passes(map: texture_depth_2d, uv: vec2<f32>, depth: f32) -> f32 {
    if (scene.toward_light.w == 0.0) {
        return textureSampleCompareLevel(map, shadow_sampler, uv, depth);
    }
    let texel = 1.0 / vec2<f32>(textureDimensions(map));
    var sum = 0.0;
    for (var i = 0; i < 4; i++) {
        let offset = vec2(f32(i & 1) - 0.5, f32(i >> 1) - 0.5) * 1.5 * texel;
        sum += textureSampleCompareLevel(map, shadow_sampler, uv + offset, depth);
    }
    return 0.25 * sum;
}

// Share of the light that arrives: 0 in shadow, 1 outside.
fn sunlit(base_m: vec3<f32>, normal: vec3<f32>) -> f32 {
    // Off the surface, so that it does not shade itself.
    let at = scene.light_from_base * vec4(base_m + normal * 0.0015, 1.0);
    let uv = vec2(0.5 + 0.5 * at.x, 0.5 - 0.5 * at.y);
    return min(passes(still_shadow, uv, at.z), passes(moving_shadow, uv, at.z));
}

@fragment
fn fragment(pixel: Pixel) -> @location(0) vec4<f32> {
    let normal = normalize(pixel.normal);
    let toward_light = scene.toward_light.xyz;
    let sun = sunlit(pixel.base_m, normal) * max(dot(normal, toward_light), 0.0);
    let around = mix(GROUND, SKY, 0.5 + 0.5 * normal.z);
    let toward_eye = normalize(scene.eye_m.xyz - pixel.base_m * scene.eye_m.w);
    let halfway = normalize(toward_light + toward_eye);
    let shine = SHINE * sun * pow(max(dot(normal, halfway), 0.0), 40.0);
    let lit = pixel.color.rgb * (around + sun * SUN) + vec3(shine);
    let linear = mix(pixel.color.rgb, lit, pixel.color.a);
    return vec4(pow(min(linear, vec3(1.0)), vec3(1.0 / GAMMA)), 1.0);
}
