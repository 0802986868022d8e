// The scene for people: one light with shadows, ambient light from sky and table, weak highlights, a backdrop.

struct Scene {
    clip_from_base: mat4x4<f32>,
    light_from_base: mat4x4<f32>,
    // A direction: the fourth component is 0.
    toward_light: vec4<f32>,
    // Homogeneous: a direction when the projection is parallel.
    eye_m: vec4<f32>,
}

@group(0) @binding(0) var<uniform> scene: Scene;
// Depth of the shadow casters, seen from the light.
@group(0) @binding(1) var shadow_map: texture_depth_2d;
@group(0) @binding(2) var shadow_sampler: sampler_comparison;

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
    // Linear red, green, blue; then 1 for lit, 0 for emissive.
    @location(2) color: vec4<f32>,
}

const SUN: vec3<f32> = vec3(0.80, 0.77, 0.71);
const SKY: vec3<f32> = vec3(0.39, 0.40, 0.42);
const GROUND: vec3<f32> = vec3(0.20, 0.18, 0.17);
const SHINE: f32 = 0.20;
// Strength of grazing light from the sky. It makes tissue look moist and curved surfaces look curved.
const SHEEN: f32 = 0.30;
// Colours of the backdrop, from the middle of the picture outward.
const NEAR_COLOR: vec3<f32> = vec3(0.93, 0.945, 0.96);
const FAR_COLOR: vec3<f32> = vec3(0.70, 0.75, 0.81);

fn in_base(corner: Corner) -> vec3<f32> {
    let at = vec4(corner.position_m, 1.0);
    return vec3(dot(corner.row_x, at), dot(corner.row_y, at), dot(corner.row_z, at));
}

// Depth seen from the light.
@vertex
fn shadow(corner: Corner) -> @builtin(position) vec4<f32> {
    return scene.light_from_base * vec4(in_base(corner), 1.0);
}

@vertex
fn vertex(corner: Corner) -> Pixel {
    var pixel: Pixel;
    pixel.base_m = in_base(corner);
    pixel.clip = scene.clip_from_base * vec4(pixel.base_m, 1.0);
    // Correct for rotations and for scaling along the solid's axes; no other transforms occur.
    let stretch = corner.row_x.xyz * corner.row_x.xyz + corner.row_y.xyz * corner.row_y.xyz
        + corner.row_z.xyz * corner.row_z.xyz;
    let n = corner.normal / max(stretch, vec3(1e-12));
    pixel.normal = vec3(
        dot(corner.row_x.xyz, n),
        dot(corner.row_y.xyz, n),
        dot(corner.row_z.xyz, n),
    );
    let color = corner.color * corner.tint;
    // A gamma of 2 costs software renderers less than 2.2.
    pixel.color = vec4(color.rgb * color.rgb, color.a);
    return pixel;
}

// Position of `base_m` in the shadow map: column, row and depth.
fn in_light(base_m: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    // Moved off the surface, so that the surface does not shadow itself.
    let at = scene.light_from_base * vec4(base_m + normal * 0.0015, 1.0);
    // Nothing outside the shadow map is in shadow.
    return vec3(0.5 + 0.5 * at.x, 0.5 - 0.5 * at.y, min(at.z, 1.0));
}

// Colour of a surface that receives the share `arriving` of the light.
fn lit(pixel: Pixel, normal: vec3<f32>, arriving: f32) -> vec4<f32> {
    let toward_light = scene.toward_light.xyz;
    let sun = arriving * max(dot(normal, toward_light), 0.0);
    let around = mix(GROUND, SKY, 0.5 + 0.5 * normal.z);
    let toward_eye = normalize(scene.eye_m.xyz - pixel.base_m * scene.eye_m.w);
    let halfway = normalize(toward_light + toward_eye);
    let facing = max(dot(normal, halfway), 0.0);
    let facing_8 = raised_4(facing * facing);
    let glancing = 1.0 - abs(dot(normal, toward_eye));
    let shine = SHINE * sun * raised_4(facing_8);
    let lit = pixel.color.rgb * (around + sun * SUN) + shine + SHEEN * raised_4(glancing) * SKY;
    let linear = mix(pixel.color.rgb, lit, pixel.color.a);
    return vec4(sqrt(min(linear, vec3(1.0))), 1.0);
}

fn raised_4(x: f32) -> f32 {
    return x * x * x * x;
}

// Separate entry points: a software renderer executes both sides of a branch.
@fragment
fn hard(pixel: Pixel) -> @location(0) vec4<f32> {
    let normal = normalize(pixel.normal);
    let at = in_light(pixel.base_m, normal);
    return lit(pixel, normal, textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy, at.z));
}

@fragment
fn soft(pixel: Pixel) -> @location(0) vec4<f32> {
    let normal = normalize(pixel.normal);
    let at = in_light(pixel.base_m, normal);
    let reach = 0.9 / vec2<f32>(textureDimensions(shadow_map));
    var arriving = 0.0;
    for (var i = 0; i < 4; i++) {
        let offset = vec2(f32(i & 1) * 2.0 - 1.0, f32(i >> 1) * 2.0 - 1.0) * reach;
        arriving += 0.25 * textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + offset, at.z);
    }
    return lit(pixel, normal, arriving);
}

struct BackdropPixel {
    @builtin(position) clip: vec4<f32>,
    // −1 to 1 across the picture; +y points up.
    @location(0) at: vec2<f32>,
}

// A disc of radius 1, scaled to the whole picture, behind everything else.
@vertex
fn backdrop(corner: Corner) -> BackdropPixel {
    var pixel: BackdropPixel;
    pixel.at = corner.position_m.xy * 1.5;
    pixel.clip = vec4(pixel.at, 1.0, 1.0);
    return pixel;
}

@fragment
fn gradient(pixel: BackdropPixel) -> @location(0) vec4<f32> {
    let from_middle = pixel.at - vec2(0.0, 0.25);
    let far = min(dot(from_middle, from_middle) * 0.45, 1.0);
    return vec4(mix(NEAR_COLOR, FAR_COLOR, far), 1.0);
}
