//! What is logged, entity by entity. Timelines: `tick` counts on through resets, `sim_time` is the
//! trial's own time.

use rerun::archetypes::{EncodedImage, LineStrips3D, Points3D, Scalars, TextLog};
use rerun::components::Color;
use rerun::{RecordingStream, RecordingStreamError};

use super::{Message, Sample, level};
use crate::geometry::Polygon;
use crate::map::WALL_HEIGHT_M;
use crate::plant::BEAD_RADIUS_M;
use crate::robot::ur5::SERVO_PERIOD_S;
use crate::session::Scenery;
use crate::trial::{Event, GOAL_RADIUS_M};

const JPEG_QUALITY: u8 = 85;

/// Writes to a stream.
pub(super) struct Writer {
    stream: RecordingStream,
    /// What the recording's timeline is ahead of the present trial's ticks.
    offset: i64,
    last: i64,
}

impl Writer {
    pub(super) fn new(stream: RecordingStream) -> Self {
        Self { stream, offset: 0, last: 0 }
    }

    pub(super) fn write(&mut self, message: Message) -> Result<(), RecordingStreamError> {
        match message {
            Message::Begin { scenery, tick } => self.begin(&scenery, tick),
            Message::Sample(sample) => self.sample(&sample),
            Message::Note(event) => self.event(&event),
        }
    }

    pub(super) fn close(self) -> Result<(), String> {
        self.stream.flush_blocking().map_err(|error| error.to_string())?;
        self.stream.disconnect();
        Ok(())
    }

    fn begin(&mut self, scenery: &Scenery, tick: u64) -> Result<(), RecordingStreamError> {
        // A trial that begins at a later tick, after going back, follows on without a gap.
        self.offset = self.last - tick as i64;
        self.at(tick, tick as f64 * SERVO_PERIOD_S);
        let walls = scenery.arena.map.walls().iter().chain(scenery.arena.map.free()).flat_map(Polygon::rings);
        let strips = walls.map(|ring| {
            let closed = ring.iter().chain(ring.first());
            closed.map(|&[x, y]| [x as f32, y as f32, WALL_HEIGHT_M as f32]).collect::<Vec<_>>()
        });
        self.stream.log("world/walls", &LineStrips3D::new(strips).with_colors([Color::from_rgb(190, 90, 80)]))?;
        let scenario = &scenery.scenario;
        let text =
            format!("trial: map {}, controller {}, seed {}", scenario.map, scenario.controller.as_str(), scenario.seed);
        self.stream.log("log", &TextLog::new(text).with_level("INFO"))
    }

    fn at(&mut self, tick: u64, sim_time_s: f64) {
        self.last = self.last.max(self.offset + tick as i64);
        self.stream.set_time_sequence("tick", self.offset + tick as i64);
        self.stream.set_duration_secs("sim_time", sim_time_s);
    }

    fn event(&self, event: &Event) -> Result<(), RecordingStreamError> {
        self.stream.log("log", &TextLog::new(event.text.as_str()).with_level(level(event.kind)))
    }

    fn sample(&mut self, sample: &Sample) -> Result<(), RecordingStreamError> {
        let moment = &sample.moment;
        self.at(moment.tick, moment.sim_time_s());
        let stream = &self.stream;
        if let Some(frames) = moment.positioner.link_frames() {
            let joints = frames.map(|frame| frame.translation.vector);
            let arm = std::iter::once(nalgebra::Vector3::zeros()).chain(joints).chain([moment.tool_m.coords]);
            let arm: Vec<[f32; 3]> = arm.map(|p| p.cast::<f32>().into()).collect();
            let strip = LineStrips3D::new([arm]);
            stream.log("world/arm", &strip.with_radii([0.02]).with_colors([Color::from_rgb(120, 160, 210)]))?;
        }
        stream.log("world/tool", &point(moment.tool_m.coords, 0.006, [60, 60, 70]))?;
        stream.log("world/bead", &point(moment.bead_m.coords, BEAD_RADIUS_M, [250, 200, 60]))?;
        match moment.goal_m {
            Some(goal) => {
                let place = nalgebra::Vector3::new(goal.x, goal.y, 0.0);
                stream.log("world/goal", &point(place, GOAL_RADIUS_M, [80, 200, 120]))?;
            }
            None => stream.log("world/goal", &rerun::Clear::flat())?,
        }
        let error = moment.tracking_error_m();
        for (entity, value) in [
            ("tracking_error/x_m", error.x),
            ("tracking_error/y_m", error.y),
            ("tracking_error/norm_m", error.norm()),
            ("mode", f64::from(moment.switching.mode.index())),
            ("magnet/lift_ratio", moment.load.lift_ratio()),
            ("hand/force_n", moment.hand_force_n),
        ] {
            stream.log(entity, &Scalars::new([value]))?;
        }
        if let Some(joints_rad) = moment.positioner.joints_rad() {
            stream.log("joints_rad", &Scalars::new(joints_rad))?;
        }
        if let Some(jpeg) = sample.frame.as_ref().and_then(|frame| frame.picture.to_jpeg(JPEG_QUALITY).ok()) {
            stream.log("camera", &EncodedImage::from_file_contents(jpeg))?;
        }
        sample.events.iter().try_for_each(|event| self.event(event))
    }
}

fn point(place: nalgebra::Vector3<f64>, radius_m: f64, rgb: [u8; 3]) -> Points3D {
    let position: [f32; 3] = place.cast::<f32>().into();
    Points3D::new([position]).with_radii([radius_m as f32]).with_colors([Color::from_rgb(rgb[0], rgb[1], rgb[2])])
}
