//! The page's types are these types: `web/src/net/protocol.gen.ts` is generated, and compared here.

use ts_rs::{Config, TS};

use super::*;
use crate::control::CONTROL_PERIOD_S;
use crate::control::transport::errt::MOST_EDGES;
use crate::evaluate::{Comparison, PairedMean, Row};
use crate::geometry::{Polygon, Rect};
use crate::map::MAX_SVG_BYTES;
use crate::perception::OBSTACLE_MEAN;
use crate::plant::{BeadMotion, BlockOrientation, PositionerKind, ToolOrientation};
use crate::scenario::{
    AttractorLaw, ControllerName, Disturbance, MOST_DRIFT_N, MOST_IMPULSE_N_S, MOST_SECONDS, MOST_STEPS, Parameters,
    RlPolicy, SCRIPT_LIMIT, Scenario, Scripted, SwitchingLaw, When,
};
use crate::session::SPEED_MAX;
use crate::trial::{EventKind, GOAL_RADIUS_M};

const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/web/src/net/protocol.gen.ts");

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
        format!("export const PROTOCOL_VERSION = {PROTOCOL_VERSION};"),
        format!("export const BINARY_CAMERA_JPEG = {BINARY_CAMERA_JPEG};"),
        format!("export const BINARY_OBSERVATION = {BINARY_OBSERVATION};\n"),
        constants(),
        declaration::<Polygon>(c),
        declaration::<Rect>(c),
        declaration::<ControllerName>(c),
        declaration::<PositionerKind>(c),
        declaration::<BlockOrientation>(c),
        declaration::<ToolOrientation>(c),
        declaration::<BeadMotion>(c),
        declaration::<SwitchingLaw>(c),
        declaration::<AttractorLaw>(c),
        declaration::<RlPolicy>(c),
        declaration::<Parameters>(c),
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

#[test]
fn the_pages_types_are_generated_from_these() {
    let generated = generated();
    if std::env::var_os("FERRY_GENERATE").is_some() {
        std::fs::write(PATH, &generated).unwrap();
    }
    let found = std::fs::read_to_string(PATH).unwrap_or_default();
    assert!(found == generated, "{PATH} is out of date; FERRY_GENERATE=1 cargo test --release protocol renews it");
}
