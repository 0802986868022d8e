//! The entities logged for Rerun. Timelines: `recording_time` and `tick` continue across resets, so that trials do not
//! overlap; `sim_time` is the trial's own time.
//!
//! The plan view is in the map's units, millimetres with y down, because Rerun draws 2-D views that way.

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use re_log_types::TimeCell;
use re_sdk_types::AsComponents;
use re_sdk_types::archetypes::{
    BarChart, Boxes2D, Clear, EncodedImage, LineStrips2D, LineStrips3D, Points2D, Points3D, Scalars, SeriesLines,
    StateChange, TextLog,
};

use super::blueprint::layout;
use super::drawing::{GOAL, TREE, WALL, color, plan_mm};
use super::samples::{Samples, recording_time_s};
use super::stream::Stream;
use super::{Opening, RecordingError, Sample, trouble};
use ferry_core::control::switching::Mode;
use ferry_core::control::transport::Carrier;
use ferry_core::control::transport::errt::{Errt, Tree};
use ferry_core::geometry::{Band, Point2, Polygon};
use ferry_core::map::WALL_HEIGHT_M;
use ferry_core::perception::ObstacleMap;
use ferry_core::policy::Judgement;
use ferry_core::robot::ur5::SERVO_PERIOD_S;
use ferry_core::trial::{Arena, Event, EventKind, GOAL_RADIUS_M, Moment, Phase, Sight};

const JPEG_QUALITY: u8 = 85;

/// Position of a recording on its timelines. The next part continues from it.
#[derive(Debug, Default)]
pub(super) struct TimelinePosition {
    /// Tick of the recording minus tick of the current trial.
    offset: i64,
    last: i64,
    /// Number of trials so far.
    trials: u32,
}

impl TimelinePosition {
    /// Counts a tick that is not necessarily sampled.
    pub(super) fn advance(&mut self) {
        self.last += 1;
    }

    /// Begins a trial, or continues at one of its ticks. Other than the state that follows the last tick, it begins one
    /// tick later, so that two states never have the same time.
    fn begin(&mut self, tick: u64, is_new: bool) {
        let is_first = self.trials == 0;
        let follows = !is_new && self.offset + tick as i64 == self.last;
        self.offset = self.last + i64::from(!is_first && !follows) - tick as i64;
        self.trials += u32::from(is_new || is_first);
    }
}

/// What a trial has not observed or computed yet when it begins, and curves, which end with their trial.
const EMPTY_AT_FIRST: [&str; 7] =
    ["camera", "observation", "quantiles", "action_values", "tracking_error_mm", "forces", "joints_rad"];

/// Writes to one file.
pub(super) struct Writer {
    stream: Stream,
    samples: Samples,
    image_every: Duration,
    imaged: Option<Instant>,
    /// The last logged values of data that changes rarely.
    goal_m: Option<Point2<f64>>,
    mode: Option<Mode>,
    phase: Option<Phase>,
    plans: Option<u32>,
    /// Of the current trial.
    arena: Option<Arc<Arena>>,
    walls_are_moved: bool,
}

impl Writer {
    /// Creates a file. `recording` is the same for all parts, `name` is this part's.
    pub(super) fn create(
        path: &Path,
        recording: &str,
        name: &str,
        image_every: Duration,
    ) -> Result<Self, RecordingError> {
        let mut stream = Stream::create(path, recording, name, layout().map_err(trouble)?)?;
        let store = stream.store();
        let names = |names: &[&'static str]| SeriesLines::new().with_names(names.iter().copied());
        store.log_static("tracking_error_mm", &names(&["in x", "in y", "distance"]));
        store.log_static("action_values", &names(&["+x", "-x", "+y", "-y"]));
        store.log_static("forces", &names(&["lift ratio", "hand, N"]));
        let joints = ["shoulder pan", "shoulder lift", "elbow", "wrist 1", "wrist 2", "wrist 3"];
        store.log_static("joints_rad", &names(&joints));
        Samples::introduce(store);
        let samples = Samples::default();
        Ok(Self {
            stream,
            samples,
            image_every,
            imaged: None,
            goal_m: None,
            mode: None,
            phase: None,
            plans: None,
            arena: None,
            walls_are_moved: false,
        })
    }

    /// Passes what was collected to Rerun.
    pub(super) fn flush(&mut self) -> Result<(), RecordingError> {
        self.samples.write(&mut self.stream)?;
        self.stream.flush()
    }

    /// Whether the file is still writable.
    pub(super) fn check(&self) -> Result<(), RecordingError> {
        self.stream.check()
    }

    pub(super) fn close(mut self) -> Result<(), RecordingError> {
        self.flush()?;
        self.stream.close()
    }

    pub(super) fn begin(&mut self, opening: &Opening, timeline: &mut TimelinePosition) -> Result<(), RecordingError> {
        self.flush()?;
        let is_new = opening.is_new;
        timeline.begin(opening.tick, is_new);
        self.at(opening.tick, opening.tick as f64 * SERVO_PERIOD_S, timeline);
        (self.mode, self.phase, self.plans) = (None, None, None);
        self.arena = Some(opening.arena.clone());
        if is_new && timeline.trials > 1 {
            EMPTY_AT_FIRST.iter().for_each(|entity| self.log(entity, &Clear::flat()));
            self.log("workspace/planner", &Clear::recursive());
        }
        let map = &opening.arena.map;
        let rings = || map.walls().iter().chain(map.free()).flat_map(Polygon::rings);
        let closed = |ring: &[[f64; 2]]| ring.iter().chain(ring.first()).copied().collect::<Vec<_>>();
        let at = |height_m: f64| {
            rings().map(move |ring| {
                closed(ring).iter().map(|&[x, y]| [x as f32, y as f32, height_m as f32]).collect::<Vec<_>>()
            })
        };
        let walls = LineStrips3D::new(at(0.0).chain(at(WALL_HEIGHT_M))).with_colors([color(WALL)]);
        self.log("world/walls", &walls);
        let plan =
            rings().map(|ring| closed(ring).into_iter().map(|[x, y]| plan_mm(Point2::new(x, y))).collect::<Vec<_>>());
        self.log("workspace/walls", &LineStrips2D::new(plan).with_colors([color(WALL)]));
        self.goal(opening.goal_m);
        let scenario = &opening.scenario;
        let number = timeline.trials;
        let controller = scenario.controller.as_str();
        self.log("trial", &StateChange::new().with_state([format!("{number}: {}, {controller}", map.name())]));
        let how = if opening.logged.state.is_none() { "begins" } else { "continues" };
        let text = format!("trial {number} {how}: map {}, controller {controller}, seed {}", map.name(), scenario.seed);
        self.log("log", &TextLog::new(text).with_level("INFO"));
        Ok(())
    }

    pub(super) fn event(&mut self, event: &Event) {
        self.log("log", &TextLog::new(event.text()).with_level(level(event.kind())));
    }

    pub(super) fn sample(&mut self, sample: &Sample, timeline: &mut TimelinePosition) -> Result<(), RecordingError> {
        let moment = &sample.moment;
        self.at(moment.tick, moment.sim_time_s(), timeline);
        self.samples.add(timeline.last, moment);
        self.changes(moment);
        if let Some(sight) = &sample.sight {
            self.moved_walls(moment);
            self.images(sight)?;
            self.evaluation(sight);
        }
        sample.events.iter().for_each(|event| self.event(event));
        Ok(())
    }

    fn at(&mut self, tick: u64, sim_time_s: f64, timeline: &mut TimelinePosition) {
        let here = timeline.offset + tick as i64;
        timeline.last = timeline.last.max(here);
        let duration = |time_s: f64| TimeCell::from_duration_nanos((time_s * 1e9).round() as i64);
        let store = self.stream.store();
        store.set_time("tick", TimeCell::from_sequence(here));
        store.set_time("recording_time", duration(recording_time_s(here)));
        store.set_time("sim_time", duration(sim_time_s));
    }

    fn log(&mut self, entity: &str, what: &impl AsComponents) {
        self.stream.store().log(entity, what);
    }

    fn goal(&mut self, goal_m: Option<Point2<f64>>) {
        self.goal_m = goal_m;
        let Some(goal) = goal_m else {
            self.log("world/goal", &Clear::flat());
            self.log("workspace/goal", &Clear::flat());
            return;
        };
        self.log("world/goal", &point(nalgebra::Vector3::new(goal.x, goal.y, 0.0), GOAL_RADIUS_M, GOAL));
        let radius_mm = (GOAL_RADIUS_M * 1e3) as f32;
        self.log("workspace/goal", &Points2D::new([plan_mm(goal)]).with_radii([radius_mm]).with_colors([color(GOAL)]));
    }

    /// Logs data that changes rarely, if it has changed.
    fn changes(&mut self, moment: &Moment) {
        if moment.goal_m != self.goal_m {
            self.goal(moment.goal_m);
        }
        let mode = moment.switching.mode;
        if self.mode.replace(mode) != Some(mode) {
            let name = match mode {
                Mode::Approach => "1: fetch",
                Mode::Transport => "2: carry",
            };
            self.log("mode", &StateChange::new().with_state([name]));
        }
        if self.phase.replace(moment.phase) != Some(moment.phase) {
            self.log("phase", &StateChange::new().with_state([moment.phase.to_string()]));
        }
    }

    /// Logs walls that are not at their drawn place.
    fn moved_walls(&mut self, moment: &Moment) {
        let around = self.arena.as_ref().map(|arena| arena.surroundings(0));
        let bands = around.and_then(|around| around.bands(moment.walls.as_ref(), moment.tick, moment.bead_m.xy()));
        let Some(bands) = bands else {
            if std::mem::take(&mut self.walls_are_moved) {
                self.log("world/walls/moved", &Clear::flat());
                self.log("workspace/walls/moved", &Clear::flat());
            }
            return;
        };
        self.walls_are_moved = true;
        let outlines = Band::outlines(&bands);
        let edges = || outlines.iter().map(|ring| ring.iter().chain(ring.first()));
        let height_m = WALL_HEIGHT_M as f32;
        let solid = edges().map(|edge| edge.map(|&[x, y]| [x as f32, y as f32, height_m]).collect::<Vec<_>>());
        self.log("world/walls/moved", &LineStrips3D::new(solid).with_colors([color(WALL)]));
        let plan = edges().map(|edge| edge.map(|&place| plan_mm(place.into())).collect::<Vec<_>>());
        self.log("workspace/walls/moved", &LineStrips2D::new(plan).with_colors([color(WALL)]));
    }

    fn images(&mut self, sight: &Sight) -> Result<(), RecordingError> {
        if self.imaged.is_some_and(|last| last.elapsed() < self.image_every) {
            return Ok(());
        }
        self.imaged = Some(Instant::now());
        let jpeg = sight.frame.picture.to_jpeg(JPEG_QUALITY).map_err(trouble)?;
        self.log("camera", &EncodedImage::from_file_contents(jpeg));
        let png = sight.observation().side_by_side().to_png().map_err(trouble)?;
        self.log("observation", &EncodedImage::from_file_contents(png));
        Ok(())
    }

    /// Logs the controller's evaluation of the image.
    fn evaluation(&mut self, sight: &Sight) {
        match &sight.carrier {
            Carrier::Rl(rl) => {
                if let Some(decision) = rl.decision() {
                    self.judgement(&decision.judgement);
                }
            }
            Carrier::Errt(errt) => {
                if self.plans.replace(errt.plans()) != Some(errt.plans()) {
                    self.plan(errt, &sight.known);
                }
            }
            Carrier::Attractor(_) => {
                if self.plans.take().is_some() {
                    self.log("workspace/planner", &Clear::recursive());
                }
            }
            Carrier::Replanner(_) | Carrier::You(_) | Carrier::Program(_) | Carrier::Robot(_) => {}
        }
    }

    fn judgement(&mut self, judgement: &Judgement) {
        let quantiles: Vec<f32> = judgement.quantiles.concat();
        self.log("quantiles", &BarChart::new(quantiles));
        self.log("action_values", &Scalars::new(judgement.values().map(f64::from)));
    }

    fn plan(&mut self, errt: &Errt, known: &ObstacleMap) {
        let edges = errt.planner().tree().into_iter().flat_map(Tree::edges);
        let edges: Vec<[[f32; 2]; 2]> = edges.map(|edge| edge.map(plan_mm)).collect();
        self.log("workspace/planner/tree", &LineStrips2D::new(edges).with_colors([color(TREE)]));
        let path: Vec<[f32; 2]> =
            errt.path().map(|path| path.points.iter().map(|&p| plan_mm(p)).collect()).unwrap_or_default();
        self.log("workspace/planner/way", &LineStrips2D::new([path]).with_colors([color(GOAL)]));
        let corners = known.rectangles().into_iter().map(|rect| {
            // y is reversed: the largest y is the minimum.
            let min = plan_mm(Point2::new(rect.x_min_m, rect.y_max_m));
            let max = plan_mm(Point2::new(rect.x_max_m, rect.y_min_m));
            (min, [max[0] - min[0], max[1] - min[1]])
        });
        let (mins, sizes): (Vec<_>, Vec<_>) = corners.unzip();
        let seen = Boxes2D::from_mins_and_sizes(mins, sizes).with_colors([color(WALL)]);
        self.log("workspace/planner/seen", &seen);
    }
}

fn point(place: nalgebra::Vector3<f64>, radius_m: f64, rgb: [u8; 3]) -> Points3D {
    let position: [f32; 3] = place.cast::<f32>().into();
    Points3D::new([position]).with_radii([radius_m as f32]).with_colors([color(rgb)])
}

/// Severity of an event in Rerun's text log.
fn level(kind: EventKind) -> &'static str {
    match kind {
        EventKind::LiftOff | EventKind::Stopped => "ERROR",
        EventKind::Disturbance | EventKind::Refused => "WARN",
        _ => "INFO",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trials_follow_each_other_on_the_time_line() {
        let mut timeline = TimelinePosition::default();
        let mut begin = |tick: u64, is_new: bool, ticks: u32| {
            timeline.begin(tick, is_new);
            let first = timeline.offset + tick as i64;
            timeline.last = first;
            (0..ticks).for_each(|_| timeline.advance());
            (timeline.trials, first, timeline.last)
        };
        assert_eq!(begin(0, true, 0), (1, 0, 0));
        assert_eq!(begin(0, true, 7), (2, 1, 8), "a reset before the first tick");
        assert_eq!(begin(7, false, 3), (2, 8, 11), "the next part");
        assert_eq!(begin(0, true, 5), (3, 12, 17), "a reset");
        assert_eq!(begin(2, false, 5), (3, 18, 23), "back to an earlier tick");
        assert_eq!(begin(40, false, 1), (3, 24, 25), "after lost ticks");
        let mut later = TimelinePosition::default();
        later.begin(40, false);
        assert_eq!((later.trials, later.offset), (1, -40), "a recording of a running trial");
        assert!((recording_time_s(125) - 1.0).abs() < 1e-12);
    }
}
