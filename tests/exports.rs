//! Other programs read the exported models of the arm, and their kinematics are Ferry's.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use ferry_core::plant::Positioner;
use ferry_core::robot::{Joints, forward};
use nalgebra::{Isometry3, Matrix4};
use rand::{RngExt, SeedableRng};
use serde_json::Value;

use crate::support::ferry;
use crate::support::tool;

const NAMES: [&str; 6] =
    ["shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint", "wrist_1_joint", "wrist_2_joint", "wrist_3_joint"];

/// What another program makes of the model and these joint angles.
fn read(format: &str, model: &Path, poses: &[Joints]) -> Value {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/read_arm.py");
    let mut reader = Command::new(tool("python"))
        .args([script, format])
        .arg(model)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    reader.stdin.take().unwrap().write_all(&serde_json::to_vec(poses).unwrap()).unwrap();
    let output = reader.wait_with_output().unwrap();
    assert!(output.status.success());
    serde_json::from_slice(&output.stdout).unwrap()
}

fn export(format: &str) -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("arm.xml");
    assert!(ferry(&["export", format, "--out", path.to_str().unwrap()]).status().unwrap().success());
    (folder, path)
}

/// Largest difference of an entry of the 4 by 4 matrices, over all poses and both frames.
fn difference(poses: &[Joints], found: &Value) -> f64 {
    let frames: Vec<[Vec<f64>; 2]> = serde_json::from_value(found["frames"].clone()).unwrap();
    assert_eq!(frames.len(), poses.len());
    let apart =
        |expected: &Isometry3<f64>, found: &[f64]| (expected.to_homogeneous() - Matrix4::from_row_slice(found)).amax();
    let of_pose = |(joints, [flange, magnet]): (&Joints, &[Vec<f64>; 2])| {
        let tool = Positioner::Arm(*joints).base_from_tool();
        apart(&forward::flange(joints), flange).max(apart(&tool, magnet))
    };
    poses.iter().zip(&frames).map(of_pose).fold(0.0, f64::max)
}

#[test]
fn other_programs_find_the_same_poses_in_the_exported_models() {
    let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(28);
    let mut joint = || rng.random_range(-std::f64::consts::TAU..std::f64::consts::TAU);
    let poses: Vec<Joints> = (0..1000).map(|_| std::array::from_fn(|_| joint())).collect();
    for format in ["urdf", "mjcf"] {
        let (_folder, model) = export(format);
        let found = read(format, &model, &poses);
        assert_eq!(found["joints"], serde_json::json!(NAMES), "{format}");
        let difference = difference(&poses, &found);
        println!("{format}: {difference:e}");
        assert!(difference < 1e-9, "{format}: {difference:e}");
        // The links of the manufacturer's table, and 50 × 25 × 10 mm of magnet. The gripper has none.
        let mass_kg = found["mass_kg"].as_f64().unwrap();
        assert!((mass_kg - 17.0489 - 0.09375).abs() < 1e-6, "{format}: {mass_kg}");
        if format == "urdf" {
            assert_eq!(found["valid"], true);
            continue;
        }
        assert_eq!(found["contacts"], 0, "the arm at rest touches itself");
        assert!(found["sunk_rad"].as_f64().unwrap() < 1e-3, "{}", found["sunk_rad"]);
        assert!(found["missed_rad"].as_f64().unwrap() < 1e-3, "{}", found["missed_rad"]);
    }
}

#[test]
fn the_magnet_of_a_model_hangs_as_the_parameters_say() {
    let text = |more: &[&str]| {
        let printed = ferry(&["export", "urdf"]).args(more).output().unwrap();
        String::from_utf8(printed.stdout).unwrap()
    };
    assert!(text(&[]).contains(r#"<box size="0.05 0.025 0.01"/>"#));
    assert!(text(&["--set", "block_orientation=B"]).contains(r#"<box size="0.01 0.05 0.025"/>"#));
    let refused = ferry(&["export", "stl"]).output().unwrap();
    assert!(!refused.status.success());
    assert!(String::from_utf8_lossy(&refused.stderr).contains("'stl'"));
}
