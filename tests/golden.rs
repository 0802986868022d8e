//! Golden pictures: each view at each quality, on Vulkan and on OpenGL.
//!
//! `FERRY_GENERATE=1 cargo test --release golden` renews them; look at each change. `tests/golden/README.md`
//! names the adapter that drew them. A missing picture or adapter fails the test.

use std::path::PathBuf;
use std::sync::Arc;

use ferry::camera::{AdapterChoice, Camera, Gpu, Quality, Subject};
use ferry::geometry::{Point2, Point3};
use ferry::image::{CameraMount, Picture};
use ferry::plant::{BEAD_RADIUS_M, Plant, Positioner, PositionerKind, ToolOrientation};
use ferry::scenario::Parameters;
use ferry::trial::Arena;

/// A pixel counts as different when a channel differs by more than this many levels.
const TOLERANCE: u8 = 8;
/// Maximum share of different pixels.
const MOST_DIFFERENT: f64 = 0.001;

type Draw = fn(&mut Camera, &Subject) -> Picture;

/// A camera beside the tool that looks at it, with the magnet in front.
fn beside(subject: &Subject) -> Subject {
    let mount = CameraMount {
        offset_m: [0.0, 0.08],
        tilt_rad: [0.05, -0.25],
        field_of_view_rad: 0.8,
        sees_magnet: true,
        ..CameraMount::default()
    };
    Subject { mount, ..*subject }
}

const VIEWS: [(&str, Quality, Draw); 6] = [
    ("camera", Quality::Economy, |camera, subject| camera.capture(subject).unwrap().picture),
    ("camera-tilted", Quality::Economy, |camera, subject| camera.capture(&beside(subject)).unwrap().picture),
    ("scene-economy", Quality::Economy, |camera, subject| camera.scene(subject, 640, 360).unwrap()),
    ("scene-fine", Quality::Fine, |camera, subject| camera.scene(subject, 640, 360).unwrap()),
    ("plan-economy", Quality::Economy, |camera, subject| camera.plan(subject, 640, 360).unwrap()),
    ("plan-fine", Quality::Fine, |camera, subject| camera.plan(subject, 640, 360).unwrap()),
];

fn golden(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("tests/golden/{name}.png"))
}

fn subject() -> Subject {
    let tool_m = Point3::new(0.08, -0.46, 0.1);
    let home = Positioner::home(PositionerKind::Arm, tool_m);
    let arm = Positioner::at(tool_m, ToolOrientation::Vertical, &home).unwrap();
    Subject {
        tick: 0,
        tool_m: tool_m.coords.into(),
        bead_m: [0.06, -0.475, BEAD_RADIUS_M],
        goal_m: Some([-0.19, -0.48]),
        link_frames: arm.link_frames(),
        block_size_m: Plant::new(Parameters::default().plant()).block_size_m(),
        mount: CameraMount::default(),
    }
}

fn camera(gpu: &Arc<Gpu>, quality: Quality) -> Camera {
    let arena = Arena::open("colon").unwrap();
    assert!(arena.map.is_free(Point2::new(0.06, -0.475)));
    arena.camera(gpu).unwrap().with_quality(quality)
}

fn read(name: &str) -> (u32, u32, Vec<u8>) {
    let path = golden(name);
    let file = std::fs::File::open(&path).unwrap_or_else(|error| {
        panic!("{}: {error}; FERRY_GENERATE=1 cargo test --release golden draws it", path.display())
    });
    let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().unwrap();
    let mut rgba = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut rgba).unwrap();
    rgba.truncate(info.buffer_size());
    (info.width, info.height, rgba)
}

fn compare_all(choice: AdapterChoice) {
    let gpu = Gpu::open(choice).expect("golden pictures need this adapter");
    for (name, quality, draw) in VIEWS {
        let mut camera = camera(&gpu, quality);
        let frame = draw(&mut camera, &subject());
        assert!(draw(&mut camera, &subject()) == frame, "{name} differs the second time on {}", gpu.adapter_name());
        let (width, height, expected) = read(name);
        assert_eq!((width, height), (frame.width_px, frame.height_px), "{name}");
        let differs = |(a, b): &(&[u8], &[u8])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > TOLERANCE);
        let count = frame.rgba.chunks(4).zip(expected.chunks(4)).filter(differs).count();
        let share = count as f64 / f64::from(width * height);
        if share > MOST_DIFFERENT {
            std::fs::create_dir_all("test-output").unwrap();
            let path = format!("test-output/{name}.png");
            std::fs::write(&path, frame.to_png().unwrap()).unwrap();
            panic!("{name}: {:.2} % of the pixels differ on {}; see {path}", share * 100.0, gpu.adapter_name());
        }
    }
}

#[test]
fn pictures_match_the_golden_ones_on_vulkan() {
    if std::env::var_os("FERRY_GENERATE").is_some() {
        let gpu = Gpu::open(AdapterChoice::Vulkan).unwrap();
        for (name, quality, draw) in VIEWS {
            let frame = draw(&mut camera(&gpu, quality), &subject());
            std::fs::write(golden(name), frame.to_png().unwrap()).unwrap();
        }
    }
    compare_all(AdapterChoice::Vulkan);
}

#[test]
fn pictures_match_the_golden_ones_on_opengl() {
    compare_all(AdapterChoice::Gl);
}
