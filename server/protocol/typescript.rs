//! The page's types are these types: `web/src/protocol.gen.ts` is generated, and compared here.

use ts_rs::{Config, TS};

use super::*;
use crate::evaluate::{Cell, Comparison, EvaluationQuery, PairedMean, PaperRow, Row};
use crate::magnetics::curves::{PullCurve, PullQuery, ReachCurve, ReachQuery};
use crate::plant::{BeadMotion, BlockOrientation, ToolOrientation};
use crate::scenario::{AttractorLaw, RlPolicy, SwitchingLaw, When};

const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/web/src/protocol.gen.ts");

fn declaration<T: TS>(config: &Config) -> String {
    let docs = T::docs().unwrap_or_default();
    format!("{docs}export {}\n", T::decl(config))
}

fn generated() -> String {
    let c = &Config::new().with_large_int("number");
    let parts = [
        "// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.\n"
            .to_owned(),
        format!("export const PROTOCOL_VERSION = {PROTOCOL_VERSION};"),
        format!("export const BINARY_CAMERA_JPEG = {BINARY_CAMERA_JPEG};"),
        format!("export const BINARY_OBSERVATION = {BINARY_OBSERVATION};\n"),
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
