//! The page's types are these types: `web/src/net/protocol.gen.ts` is generated, and compared here.

mod arm;
mod parameters;

use ts_rs::{Config, TS};

use super::*;
use crate::camera::VIEW_PX;
use crate::control::CONTROL_PERIOD_S;
use crate::control::transport::errt::MOST_EDGES;
use crate::evaluate::{Comparison, PairedMean, Row};
use crate::geometry::{Polygon, Rect};
use crate::magnetics::force::FARTHEST_M;
use crate::map::{MAX_SVG_BYTES, WALL_HEIGHT_M};
use crate::perception::{OBSERVATION_SIZE_PX, OBSTACLE_MEAN};
use crate::plant::PositionerKind;
use crate::scenario::{
    ControllerName, Disturbance, MOST_DRIFT_N, MOST_IMPULSE_N_S, MOST_SECONDS, MOST_STEPS, SCRIPT_LIMIT, Scenario,
    Scripted, When,
};
use crate::session::SPEED_MAX;
use crate::trial::{EventKind, GOAL_RADIUS_M};

fn declaration<T: TS>(config: &Config) -> String {
    let docs = T::docs().unwrap_or_default();
    format!("{docs}export {}\n", T::decl(config))
}

/// What the page says of the server's limits and periods.
fn constants() -> String {
    [
        constant("CONTROL_PERIOD_S", CONTROL_PERIOD_S, "A control step is due at the first tick at or after each."),
        constant("SPEED_MAX", SPEED_MAX, "Fastest that time runs."),
        constant("GOAL_RADIUS_M", GOAL_RADIUS_M, "A goal is reached within it."),
        constant("OBSTACLE_MEAN", OBSTACLE_MEAN, "Darker places are obstacles."),
        constant("SCRIPT_LIMIT", SCRIPT_LIMIT, "Entries of a script."),
        constant("MOST_STEPS", MOST_STEPS, "Last control step that a script may wait for."),
        constant("MOST_IMPULSE_N_S", MOST_IMPULSE_N_S, "Strongest kick."),
        constant("MOST_DRIFT_N", MOST_DRIFT_N, "Strongest push."),
        constant("MOST_SECONDS", MOST_SECONDS, "Longest push, and longest blindness of the tracker."),
        constant("MOST_EDGES", MOST_EDGES, "Edges of a tree that are sent."),
        constant("LEAST_FLOW_SPACING_M", FLOW_SPACING_M.start(), "Least spacing of a flow field."),
        constant("MOST_FLOW_SPACING_M", FLOW_SPACING_M.end(), "Greatest spacing of a flow field."),
        constant("FARTHEST_CAPTURE_M", FARTHEST_M, "A capture that ends here ends nowhere."),
        constant("WALL_HEIGHT_M", WALL_HEIGHT_M, "Height of the walls."),
        constant("CAMERA_PX", VIEW_PX, "Columns and rows of the camera image."),
        constant("OBSERVATION_PX", OBSERVATION_SIZE_PX, "Columns and rows of the observation."),
        constant("MAX_SVG_BYTES", MAX_SVG_BYTES, "Largest drawing of a map."),
    ]
    .concat()
}

fn constant(name: &str, value: impl std::fmt::Display, about: &str) -> String {
    format!("/** {about} */\nexport const {name} = {value};\n\n")
}

fn generated() -> String {
    let c = &Config::new().with_large_int("number");
    let parts = [
        "// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.\n"
            .to_owned(),
        "import type { Orientation, Parameters, ToolOrientation } from './parameters.gen';\n\
         export type { Orientation, Parameters, ToolOrientation };\n"
            .to_owned(),
        format!("export const PROTOCOL_VERSION = {PROTOCOL_VERSION};"),
        format!("export const BINARY_CAMERA_JPEG = {BINARY_CAMERA_JPEG};"),
        format!("export const BINARY_OBSERVATION = {BINARY_OBSERVATION};\n"),
        constants(),
        declaration::<Polygon>(c),
        declaration::<Rect>(c),
        declaration::<ControllerName>(c),
        declaration::<PositionerKind>(c),
        declaration::<Disturbance>(c),
        declaration::<When>(c),
        declaration::<Scripted>(c),
        declaration::<Scenario>(c),
        declaration::<ClientMessage>(c),
        declaration::<Role>(c),
        declaration::<ServerMessage>(c),
        declaration::<Hello>(c),
        declaration::<SceneMessage>(c),
        declaration::<StateMessage>(c),
        declaration::<EventKind>(c),
        declaration::<EventMessage>(c),
        declaration::<SensedObstacle>(c),
        declaration::<OverlayMessage>(c),
        declaration::<BlocksLayer>(c),
        declaration::<PlanLayer>(c),
        declaration::<SeenMessage>(c),
        declaration::<Branch>(c),
        declaration::<ComparisonMessage>(c),
        declaration::<MomentMessage>(c),
        declaration::<ErrorMessage>(c),
        declaration::<PullQuery>(c),
        declaration::<PullCurve>(c),
        declaration::<ReachQuery>(c),
        declaration::<ReachCurve>(c),
        declaration::<PlaneQuery>(c),
        declaration::<Plane>(c),
        declaration::<WorkspaceQuery>(c),
        declaration::<WorkspaceMap>(c),
        declaration::<JudgementLayer>(c),
        declaration::<ValueQuery>(c),
        declaration::<ValueCell>(c),
        declaration::<ValueMap>(c),
        declaration::<FlowQuery>(c),
        declaration::<FlowField>(c),
        declaration::<RecordingFile>(c),
        declaration::<RecordingList>(c),
        declaration::<EvaluationQuery>(c),
        declaration::<Cell>(c),
        declaration::<EvaluationStage>(c),
        declaration::<PaperRow>(c),
        declaration::<EvaluationCell>(c),
        declaration::<EvaluationSummary>(c),
        declaration::<Row>(c),
        declaration::<PairedMean>(c),
        declaration::<Comparison>(c),
        declaration::<EvaluationFailure>(c),
        declaration::<EvaluationReport>(c),
        declaration::<Evaluations>(c),
    ];
    parts.join("\n")
}

/// Writes a generated file when `FERRY_GENERATE` is set, and compares it otherwise.
fn keep(path: &str, generated: &str) {
    let whole = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    if std::env::var_os("FERRY_GENERATE").is_some() {
        std::fs::create_dir_all(whole.parent().unwrap()).unwrap();
        std::fs::write(&whole, generated).unwrap();
    }
    let found = std::fs::read_to_string(&whole).unwrap_or_default();
    assert!(found == generated, "{path} is out of date; FERRY_GENERATE=1 cargo test --release protocol renews it");
}

#[test]
fn the_pages_types_are_generated_from_these() {
    keep("web/src/net/protocol.gen.ts", &generated());
}
