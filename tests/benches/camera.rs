//! Pictures, with readback, on whatever adapter is found.

use std::hint::black_box;
use std::sync::Arc;

use criterion::Criterion;
use ferry_camera::{AdapterChoice, Camera, Gpu, Quality};
use ferry_core::geometry::{Point2, Point3};
use ferry_core::image::{CameraMount, Subject};
use ferry_core::plant::{BEAD_RADIUS_M, Positioner, PositionerKind, ToolOrientation, WallMotion};
use ferry_core::scenario::Parameters;
use ferry_core::trial::Arena;

pub fn benches(c: &mut Criterion) {
    let gpu = Gpu::open(AdapterChoice::Auto).expect("a graphics adapter is needed");
    println!("rendered by {}", gpu.adapter_name());
    let arena = Arena::shipped("colon").unwrap();
    let mut group = c.benchmark_group("camera");
    let mut at = 0;
    let mut next = || {
        at = (at + 1) % 40;
        let tool_m = Point3::new(-0.2 + 0.01 * f64::from(at), -0.48, 0.1);
        let home = Positioner::home(PositionerKind::Arm, tool_m);
        let arm = Positioner::at(tool_m, ToolOrientation::Vertical, &home).unwrap();
        Subject {
            tick: 0,
            tool_m: tool_m.coords.into(),
            turn_rad: 0.0,
            bead_m: [tool_m.x - 0.015, tool_m.y, BEAD_RADIUS_M],
            goal_m: Some([0.19, -0.28]),
            link_frames: arm.link_frames(),
            block_size_m: [0.05, 0.025, 0.01],
            mount: CameraMount::default(),
            moved_walls: None,
        }
    };
    let mut camera = Camera::of(&gpu, arena.static_scene()).unwrap();
    group.bench_function("controllers' view, 480×480", |b| b.iter(|| black_box(camera.capture(&next()).unwrap())));
    // The same with walls that move, their shape at each frame included.
    let parameters = Parameters { peristalsis_amplitude_m: 0.01, ..Parameters::default() };
    let motion = WallMotion::in_full(&parameters.plant().peristalsis, 0);
    let mut tick = 0;
    group.bench_function("controllers' view, 480×480, moving walls", |b| {
        b.iter(|| {
            let subject = next();
            tick += 31;
            let bead_m = Point2::new(subject.bead_m[0], subject.bead_m[1]);
            let bands = arena.surroundings(0).bands(motion.as_ref(), tick, bead_m);
            black_box(camera.capture(&Subject { moved_walls: bands.map(Arc::from), ..subject }).unwrap())
        });
    });
    for (name, quality) in [("economy", Quality::Economy), ("fine", Quality::Fine)] {
        let mut camera = Camera::of(&gpu, arena.static_scene()).unwrap().with_quality(quality);
        group.bench_function(format!("scene, 640×360, {name}"), |b| {
            b.iter(|| black_box(camera.scene(&next(), 640, 360).unwrap()));
        });
    }
    group.finish();
}
