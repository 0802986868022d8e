//! `web/src/net/arm.gen.ts`: the arm and the magnet as the page draws them.

use serde_json::{Value, json};

use super::{constant, keep};
use ferry_camera::robot::{Material, RobotSolid, solids};
use ferry_core::magnetics::dipole::BLOCK_REMANENCE_T;
use ferry_core::magnetics::force;
use ferry_core::plant::{BlockOrientation, TOOL_LENGTH_M};
use ferry_core::robot::ur5::DH;

/// To 12 digits, and without a point where it is whole.
fn number(value: f64) -> Value {
    let rounded: f64 = format!("{value:.11e}").parse().unwrap();
    if rounded.fract() == 0.0 { json!(rounded as i64) } else { json!(rounded) }
}

fn list<const N: usize>(values: [f64; N]) -> String {
    format!("[{}]", values.map(|value| number(value).to_string()).join(", "))
}

fn solid(solid: &RobotSolid) -> String {
    let RobotSolid { frame, is_lid, material, origin_m, along, places_m, radius_m } = *solid;
    let shape = if is_lid { "lid" } else { "tube" };
    let material = match material {
        Material::Metal => "metal",
        Material::Lid => "lid",
        Material::Seam => "seam",
        Material::Foot => "foot",
    };
    format!(
        "  {{ frame: {frame}, shape: '{shape}', material: '{material}', origin_m: {}, along: {}, places_m: {}, radius_m: \
         {} }},\n",
        list(origin_m),
        list(along),
        list(places_m),
        number(radius_m),
    )
}

fn dh() -> String {
    let row = |row: &ferry_core::robot::ur5::DhRow| {
        let (half_sin, half_cos) = row.half_twist;
        let quarter_turns = (2.0 * half_sin.atan2(half_cos) / std::f64::consts::FRAC_PI_2).round();
        format!("  {},\n", list([row.d_m, row.a_m, quarter_turns]))
    };
    DH.iter().map(row).collect()
}

fn block(orientation: BlockOrientation) -> String {
    let block = force::block(orientation, BLOCK_REMANENCE_T);
    let along = block.polarization_t.iamax();
    let size_m = list((block.half_size_m * 2.0).into());
    format!("  {}: {{ size_m: {size_m}, along: {along} }},\n", json!(orientation).as_str().unwrap())
}

#[test]
fn the_pages_arm_is_generated_from_the_servers() {
    let blocks: String = [BlockOrientation::A, BlockOrientation::B, BlockOrientation::C].map(block).concat();
    let solids: String = solids().iter().map(solid).collect();
    let text = [
        "// Generated from server/core/robot/ur5.rs, server/camera/robot.rs and server/core/magnetics/force.rs;\n\
         // `FERRY_GENERATE=1 cargo test --release protocol` renews it.\n\n"
            .to_owned(),
        format!(
            "/**\n * Rows of the Denavit-Hartenberg table from the base to the flange, classic convention:\n * `[d_m, a_m, \
             alpha_quarter_turns]`.\n */\nexport const DH = [\n{}] as const;\n\n",
            dh()
        ),
        constant("TOOL_LENGTH_M", TOOL_LENGTH_M, "From the flange to the tool point.") + "\n",
        format!(
            "/** The block as it hangs on the tool, and the axis from its south pole to its north pole. */\nexport const \
             BLOCKS = {{\n{blocks}}} as const;\n\n"
        ),
        format!(
            "/** Round solids between two places on a line, fixed to a frame: 0 is the base, 6 the flange. A lid has its \
             rim at the first place. */\nexport const ARM_SOLIDS = [\n{solids}] as const;\n"
        ),
    ];
    keep("web/src/net/arm.gen.ts", &text.concat());
}
