//! Samples taken many times a second, collected and written in columns: this costs a tenth of writing row by row.

use re_sdk_types::SerializedComponentColumn;
use re_sdk_types::archetypes::{LineStrips3D, Points2D, Points3D, Scalars};

use super::drawing::{ARM, BEAD, TOOL, color, plan_mm};
use super::stream::{Store, Stream, TimeColumn};
use super::{RecordingError, trouble};
use ferry_core::plant::BEAD_RADIUS_M;
use ferry_core::robot::ur5::SERVO_PERIOD_S;
use ferry_core::trial::Moment;

/// Number of the arm's joints, logged in two groups of three.
const JOINTS: usize = 6;

/// Time since the recording began.
pub(super) fn recording_time_s(tick: i64) -> f64 {
    tick as f64 * SERVO_PERIOD_S
}

/// Samples that wait to be written. Either all of them have an arm, or none has.
#[derive(Default)]
pub(super) struct Samples {
    ticks: Vec<i64>,
    times_s: Vec<f64>,
    arms: Vec<Vec<[f32; 3]>>,
    joints_rad: Vec<[f64; JOINTS]>,
    tools: Vec<[f32; 3]>,
    beads: Vec<[f32; 3]>,
    plans_mm: Vec<[f32; 2]>,
    errors_mm: Vec<f64>,
    forces: Vec<f64>,
}

impl Samples {
    /// Writes the data that all samples share, once per file.
    pub(super) fn introduce(store: &mut Store) {
        let arm = LineStrips3D::update_fields().with_radii([0.02]).with_colors([color(ARM)]);
        store.log_static("world/arm", &arm);
        let dot =
            |radius_m: f64, rgb| Points3D::update_fields().with_radii([radius_m as f32]).with_colors([color(rgb)]);
        store.log_static("world/tool", &dot(0.006, TOOL));
        store.log_static("world/bead", &dot(BEAD_RADIUS_M, BEAD));
        let plan = Points2D::update_fields()
            .with_radii([6.0, (BEAD_RADIUS_M * 1e3) as f32])
            .with_colors([color(TOOL), color(BEAD)]);
        store.log_static("workspace/tool_and_bead", &plan);
    }

    /// Adds a moment at a tick of the recording.
    pub(super) fn add(&mut self, tick: i64, moment: &Moment) {
        let place = |place: nalgebra::Vector3<f64>| -> [f32; 3] { place.cast::<f32>().into() };
        self.ticks.push(tick);
        self.times_s.push(moment.sim_time_s());
        if let Some(frames) = moment.positioner.link_frames() {
            let joints = frames.map(|frame| frame.translation.vector);
            let points = std::iter::once(nalgebra::Vector3::zeros()).chain(joints).chain([moment.tool_m.coords]);
            self.arms.push(points.map(place).collect());
        }
        self.joints_rad.extend(moment.positioner.joints_rad());
        self.tools.push(place(moment.tool_m.coords));
        self.beads.push(place(moment.bead_m.coords));
        self.plans_mm.extend([plan_mm(moment.tool_m.xy()), plan_mm(moment.bead_m.xy())]);
        let error_mm = moment.tracking_error_m() * 1e3;
        self.errors_mm.extend([error_mm.x, error_mm.y, error_mm.norm()]);
        self.forces.extend([moment.load.lift_ratio(), moment.hand_force_n]);
    }

    /// Writes and clears the samples.
    pub(super) fn write(&mut self, stream: &mut Stream) -> Result<(), RecordingError> {
        let Self { ticks, times_s, arms, joints_rad, tools, beads, plans_mm, errors_mm, forces } = std::mem::take(self);
        if ticks.is_empty() {
            return Ok(());
        }
        let times = [
            TimeColumn::new_sequence("tick", ticks.iter().copied()),
            TimeColumn::new_duration_secs("recording_time", ticks.iter().copied().map(recording_time_s)),
            TimeColumn::new_duration_secs("sim_time", times_s),
        ];
        let mut send = |entity: &str, columns: Vec<SerializedComponentColumn>| stream.columns(entity, &times, columns);
        let count = ticks.len();
        let one = std::iter::repeat_n(1, count);
        let points = |points: Vec<[f32; 3]>| {
            let columns = Points3D::update_fields().with_positions(points).columns(one.clone());
            columns.map(Iterator::collect).map_err(trouble)
        };
        let scalars = |values: Vec<f64>| {
            let each = values.len() / count;
            let columns = Scalars::update_fields().with_scalars(values).columns(std::iter::repeat_n(each, count));
            columns.map(Iterator::collect).map_err(trouble)
        };
        if arms.len() == count {
            let columns = LineStrips3D::update_fields().with_strips(arms).columns(one.clone()).map_err(trouble)?;
            send("world/arm", columns.collect())?;
        }
        if joints_rad.len() == count {
            send("joints_rad", scalars(joints_rad.into_flattened())?)?;
        }
        send("world/tool", points(tools)?)?;
        send("world/bead", points(beads)?)?;
        let plan = Points2D::update_fields().with_positions(plans_mm).columns(std::iter::repeat_n(2, count));
        send("workspace/tool_and_bead", plan.map_err(trouble)?.collect())?;
        send("tracking_error_mm", scalars(errors_mm)?)?;
        send("forces", scalars(forces)?)
    }
}
