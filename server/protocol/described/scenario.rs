//! Scenarios, disturbances and events.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use crate::geometry::{self, Point2};
use crate::plant;
use crate::protocol::numbers::Numbers2;
use crate::scenario::{self, Parameters};
use crate::trial;

describe! {
    geometry::Polygon as Polygon;
    geometry::Rect as Rect;
    plant::PositionerKind as PositionerKind;
    scenario::ControllerName as ControllerName;
    scenario::Disturbance as Disturbance;
    scenario::When as When;
    scenario::Scripted as Scripted;
    scenario::Scenario as Scenario;
    trial::EventKind as EventKind;
}

/// A filled polygon with holes, in metres.
///
/// `exterior` runs counter-clockwise and each hole clockwise; no ring repeats its first point.
#[derive(Serialize, Deserialize, TS, ToSchema)]
#[serde(remote = "crate::geometry::Polygon")]
pub struct Polygon {
    /// Outer ring, `[x_m, y_m]` for each vertex.
    #[schema(value_type = Vec<Numbers2>)]
    pub exterior: Vec<[f64; 2]>,
    /// Inner rings.
    #[schema(value_type = Vec<Vec<Numbers2>>)]
    pub holes: Vec<Vec<[f64; 2]>>,
}

/// An axis-aligned rectangle, in metres.
#[derive(Serialize, Deserialize, TS, ToSchema)]
#[serde(remote = "crate::geometry::Rect")]
pub struct Rect {
    /// Smallest x.
    pub x_min_m: f64,
    /// Largest x.
    pub x_max_m: f64,
    /// Smallest y.
    pub y_min_m: f64,
    /// Largest y.
    pub y_max_m: f64,
}

#[derive(Serialize, Deserialize, TS, ToSchema)]
#[serde(remote = "crate::plant::PositionerKind")]
#[serde(rename_all = "snake_case")]
pub enum PositionerKind {
    /// The UR5.
    Arm,
    /// Three linear axes that reach everywhere and never tilt.
    PlanarStage,
}

/// Sub-controller 2, by name.
#[derive(Serialize, Deserialize, TS, ToSchema)]
#[serde(remote = "crate::scenario::ControllerName")]
#[serde(rename_all = "snake_case")]
pub enum ControllerName {
    /// A trained Rainbow-IQN policy (paper, §IV-A).
    Rl,
    /// Execution-extended rapidly exploring random trees (paper, §IV-C).
    Errt,
    /// Attractor dynamics (paper, §IV-B).
    Attractor,
    /// The shortest path over what the camera has observed: a reference for evaluations, not from the paper.
    Replanner,
    /// A person: the tool goes where the hand at the page points.
    You,
    /// A program outside of Ferry, which is asked before each control step.
    Program,
    /// A program for a UR5, which commands the joints; nothing else moves the arm.
    Robot,
}

#[derive(Serialize, Deserialize, TS, ToSchema)]
#[serde(remote = "crate::scenario::Disturbance")]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Disturbance {
    /// The bead is lifted and put down here, or at the nearest place where it fits.
    Displace {
        x_m: f64,
        y_m: f64,
    },
    Impulse {
        x_n_s: f64,
        y_n_s: f64,
    },
    /// A steady push.
    Drift {
        x_n: f64,
        y_n: f64,
        for_s: f64,
    },
    /// The tracker is blind.
    Dropout {
        for_s: f64,
    },
}

/// When a scripted disturbance is applied. Those that wait for the bead are applied in the order of the script.
#[derive(Serialize, Deserialize, TS, ToSchema)]
#[serde(remote = "crate::scenario::When")]
#[serde(rename_all = "snake_case")]
pub enum When {
    /// Before this tick.
    Tick(#[ts(type = "number")] u64),
    /// At this control step, 1 to 600, of the first goal that reaches it.
    Step(u32),
    /// When the bead's x passes this one, in either direction.
    #[serde(rename = "passes_x_m")]
    PassesXM(f64),
    /// When the bead comes within a distance of a place.
    Near {
        x_m: f64,
        y_m: f64,
        /// 1 mm to 1 m.
        within_m: f64,
    },
}

/// A disturbance with its time.
#[derive(Serialize, Deserialize, TS, ToSchema)]
#[serde(remote = "crate::scenario::Scripted")]
#[serde(deny_unknown_fields)]
pub struct Scripted {
    pub at: scenario::When,
    pub disturbance: scenario::Disturbance,
}

/// A trial before its first tick.
#[derive(Serialize, Deserialize, TS, ToSchema)]
#[serde(remote = "crate::scenario::Scenario")]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// Name of the map, or path of an SVG.
    pub map: String,
    /// Sub-controller 2.
    pub controller: scenario::ControllerName,
    /// The positioner; if omitted, the one that the map is made for.
    #[serde(default)]
    pub positioner: Option<plant::PositionerKind>,
    /// Seed of everything random in the trial.
    #[ts(type = "number")]
    pub seed: u64,
    /// Parameters at the start.
    #[serde(default)]
    pub parameters: Parameters,
    /// Bead at the start, with the tool above it; if omitted, a random free point.
    #[serde(default)]
    #[ts(type = "[number, number] | null")]
    #[schema(value_type = Option<Numbers2>)]
    pub start_m: Option<Point2<f64>>,
    /// Goal at the start; if omitted, the arm holds.
    #[serde(default)]
    #[ts(type = "[number, number] | null")]
    #[schema(value_type = Option<Numbers2>)]
    pub goal_m: Option<Point2<f64>>,
    /// Number of random displacements of the bead during transport.
    #[serde(default)]
    pub disturbances: u32,
    /// Scripted disturbances, at most [`SCRIPT_LIMIT`].
    #[serde(default)]
    pub script: Vec<scenario::Scripted>,
}

/// Kinds of event, for the timeline.
#[derive(Serialize, Deserialize, TS, ToSchema)]
#[serde(remote = "crate::trial::EventKind")]
#[serde(rename_all = "snake_case")]
pub enum EventKind {
    /// The switching law changed the active sub-controller.
    Switch,
    /// The bead was taken, moved or released.
    Disturbance,
    /// The goal was placed or removed.
    Goal,
    /// The tool came within 2 cm of the goal.
    Reached,
    /// The bead came within 2 cm of the goal, too.
    Delivered,
    /// The bead jumped to the magnet.
    LiftOff,
    /// A controller or a limit refused a step.
    Refused,
    /// A limit of steps or time was exceeded.
    Stopped,
    /// Something about the session itself.
    Session,
}
