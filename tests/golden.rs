//! Golden pictures: each view at each quality, on Vulkan and on OpenGL.
//!
//! `FERRY_GENERATE=1 cargo test --release golden` renews them; look at each change. `tests/golden/README.md`
//! names the adapter that drew them. A missing picture or adapter fails the test.

use std::path::PathBuf;
use std::sync::Arc;

use ferry_camera::{AdapterChoice, Camera, Gpu, Quality};
use ferry_core::geometry::{Point2, Point3};
use ferry_core::image::{CameraMount, Picture, Subject};
use ferry_core::plant::{BEAD_RADIUS_M, Plant, Positioner, PositionerKind, ToolOrientation, WallMotion};
use ferry_core::scenario::Parameters;
use ferry_core::trial::Arena;

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
    Subject { mount, ..subject.clone() }
}

/// Walls that move: waves of 10 mm along the colon.
fn moving(subject: &Subject) -> Subject {
    let arena = Arena::shipped("colon").unwrap();
    let parameters = Parameters { peristalsis_amplitude_m: 0.01, ..Parameters::default() };
    let motion = WallMotion::in_full(&parameters.plant().peristalsis, 0);
    let [x_m, y_m, _] = subject.bead_m;
    let bands = arena.surroundings(0).bands(motion.as_ref(), 300, Point2::new(x_m, y_m));
    Subject { moved_walls: bands.map(Arc::from), ..subject.clone() }
}

const VIEWS: [(&str, Quality, Draw); 9] = [
    ("camera", Quality::Economy, |camera, subject| camera.capture(subject).unwrap().picture),
    ("camera-tilted", Quality::Economy, |camera, subject| camera.capture(&beside(subject)).unwrap().picture),
    ("scene-economy", Quality::Economy, |camera, subject| camera.scene(subject, 640, 360).unwrap()),
    ("scene-fine", Quality::Fine, |camera, subject| camera.scene(subject, 640, 360).unwrap()),
    ("plan-economy", Quality::Economy, |camera, subject| camera.plan(subject, 640, 360).unwrap()),
    ("plan-fine", Quality::Fine, |camera, subject| camera.plan(subject, 640, 360).unwrap()),
    ("camera-moving", Quality::Economy, |camera, subject| camera.capture(&moving(subject)).unwrap().picture),
    ("scene-moving", Quality::Fine, |camera, subject| camera.scene(&moving(subject), 640, 360).unwrap()),
    ("plan-moving", Quality::Economy, |camera, subject| camera.plan(&moving(subject), 640, 360).unwrap()),
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
        turn_rad: 0.0,
        bead_m: [0.06, -0.475, BEAD_RADIUS_M],
        goal_m: Some([-0.19, -0.48]),
        link_frames: arm.link_frames(),
        block_size_m: Plant::new(Parameters::default().plant()).block_size_m(),
        mount: CameraMount::default(),
        moved_walls: None,
    }
}

fn camera(gpu: &Arc<Gpu>, quality: Quality) -> Camera {
    let arena = Arena::shipped("colon").unwrap();
    assert!(arena.map.is_free(Point2::new(0.06, -0.475)));
    Camera::of(gpu, arena.static_scene()).unwrap().with_quality(quality)
}

fn read(name: &str) -> Picture {
    let path = golden(name);
    let bytes = std::fs::read(&path).unwrap_or_else(|error| {
        panic!("{}: {error}; FERRY_GENERATE=1 cargo test --release golden draws it", path.display())
    });
    Picture::from_png(&bytes).unwrap()
}

fn compare_all(choice: AdapterChoice) {
    let gpu = Gpu::open(choice).expect("golden pictures need this adapter");
    for (name, quality, draw) in VIEWS {
        let mut camera = camera(&gpu, quality);
        let frame = draw(&mut camera, &subject());
        assert!(draw(&mut camera, &subject()) == frame, "{name} differs the second time on {}", gpu.adapter_name());
        let share = frame.difference(&read(name)).unwrap().share;
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
