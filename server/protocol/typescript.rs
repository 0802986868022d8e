//! The page's types are these types: `web/src/net/protocol.gen.ts` and `web/src/net/protocol/` are generated, and compared
//! here.

mod arm;
mod forms;
mod parameters;

use std::collections::{BTreeMap, BTreeSet};

use ts_rs::{Config, TS};

use super::*;
use crate::session::EndFact;
use ferry_core::challenge::{Attempt, Difficulty, Loss, Mishap, Score};
use ferry_core::control::CONTROL_PERIOD_S;
use ferry_core::control::facts::{RefusalFact, TroubleFact};
use ferry_core::control::switching::Reason;
use ferry_core::control::transport::errt::MOST_EDGES;
use ferry_core::facts::{RefusalCode, Told};
use ferry_core::geometry::{Polygon, Rect};
use ferry_core::image::VIEW_PX;
use ferry_core::magnetics::curves::{PullCurve, PullQuery, ReachCurve, ReachQuery};
use ferry_core::magnetics::force::FARTHEST_M;
use ferry_core::magnetics::plane::{Plane, PlaneQuery};
use ferry_core::map::{MAX_SVG_BYTES, Map, WALL_HEIGHT_M};
use ferry_core::perception::{OBSERVATION_SIZE_PX, OBSTACLE_MEAN};
use ferry_core::plant::PositionerKind;
use ferry_core::scenario::{
    ControllerName, Disturbance, MOST_DRIFT_N, MOST_IMPULSE_N_S, MOST_SECONDS, MOST_STEPS, SCRIPT_LIMIT, Scenario,
    Scripted, When,
};
use ferry_core::session::SPEED_MAX;
use ferry_core::session::VoidFact;
use ferry_core::trial::{EventKind, GOAL_RADIUS_M, Happening, PhaseFact, RecordingFact, Resumption, StopCode};
use ferry_lab::evaluate::{Comparison, EvaluationQuery, PairedMean, PaperRow, Row, Setting, Variation};
use ferry_lab::learn::{Ending, FusionName, RecipeName, Settings, Trail, TrainingQuery};
use ferry_lab::recovery::{Basin, BasinDifference, CellRow, Kind, Outcome};
use ferry_ur::controller::{Connected, Standing as RobotStanding, Stop as ProtectiveStop};
use ferry_ur::refusals::Refused;
use ferry_ur::twin::{ApartFact, DoubtFact, DriveFact, TwinStanding, TwinTrouble};

const HEADER: &str =
    "// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.\n\n";

fn declaration<T: TS>(config: &Config) -> String {
    let docs = T::docs().unwrap_or_default();
    format!("{docs}export {}\n", T::decl(config))
}

/// The server's limits and periods that the page shows or uses.
fn constants() -> String {
    [
        constant("PROTOCOL_VERSION", PROTOCOL_VERSION, "Version of the messages."),
        constant("BINARY_CAMERA_JPEG", BINARY_CAMERA_JPEG, "First byte of a binary message with a camera image."),
        constant("BINARY_OBSERVATION", BINARY_OBSERVATION, "First byte of a binary message with an observation."),
        constant("BINARY_COURSE", BINARY_COURSE, "First byte of a binary message with a part of the course."),
        constant("CONTROL_PERIOD_S", CONTROL_PERIOD_S, "Simulated time between control steps."),
        constant("SPEED_MAX", SPEED_MAX, "Maximum speed of playback."),
        constant("GOAL_RADIUS_M", GOAL_RADIUS_M, "A goal is reached within this distance."),
        constant("OBSTACLE_MEAN", OBSTACLE_MEAN, "Parts of the image with a lower mean brightness are obstacles."),
        constant("SCRIPT_LIMIT", SCRIPT_LIMIT, "Maximum number of entries in a script."),
        constant("MOST_STEPS", MOST_STEPS, "Last control step at which a scripted disturbance may begin."),
        constant("MOST_IMPULSE_N_S", MOST_IMPULSE_N_S, "Strongest kick."),
        constant("MOST_DRIFT_N", MOST_DRIFT_N, "Strongest push."),
        constant("MOST_SECONDS", MOST_SECONDS, "Longest push, and longest dropout of the tracker."),
        constant("MOST_EDGES", MOST_EDGES, "Maximum number of edges of ERRT's tree that are sent."),
        constant("LEAST_FLOW_SPACING_M", FLOW_SPACING_M.start(), "Smallest spacing of a flow field."),
        constant("MOST_FLOW_SPACING_M", FLOW_SPACING_M.end(), "Largest spacing of a flow field."),
        constant("FARTHEST_CAPTURE_M", FARTHEST_M, "Capture radii are computed up to this distance."),
        constant("WALL_HEIGHT_M", WALL_HEIGHT_M, "Height of the walls."),
        constant("CAMERA_PX", VIEW_PX, "Width and height of the camera image."),
        constant("OBSERVATION_PX", OBSERVATION_SIZE_PX, "Width and height of the observation."),
        constant("MAX_SVG_BYTES", MAX_SVG_BYTES, "Largest drawing of a map."),
        controller_labels(),
        shipped_maps(),
    ]
    .join("\n")
}

fn controller_labels() -> String {
    let lines = ControllerName::ALL.map(|name| format!("  {}: '{}',\n", name.as_str(), name.label()));
    format!(
        "/** Name of each controller in sentences. */\nexport const CONTROLLER_LABELS = {{\n{}}} as const;\n\n\
         /** Controllers that the page offers. */\nexport const CONTROLLERS = [{}] as const;\n",
        lines.concat(),
        ControllerName::OFFERED.map(|name| format!("'{}'", name.as_str())).join(", ")
    )
}

fn shipped_maps() -> String {
    let names = Map::shipped_names().into_iter().map(|name| format!("'{name}'")).collect::<Vec<_>>();
    format!(
        "/** Maps that every server has. */\nexport const SHIPPED_MAPS: readonly string[] = [{}];\n",
        names.join(", ")
    )
}

fn constant(name: &str, value: impl std::fmt::Display, about: &str) -> String {
    format!("/** {about} */\nexport const {name} = {value};\n")
}

struct Declaration {
    name: String,
    text: String,
}

fn declared<T: TS>() -> Declaration {
    let config = &Config::new().with_large_int("number");
    Declaration { name: T::ident(config), text: declaration::<T>(config) }
}

macro_rules! declared {
    ($($name:ty),* $(,)?) => { vec![$(declared::<$name>()),*] };
}

/// The types of each generated file.
fn modules() -> [(&'static str, Vec<Declaration>); 20] {
    [
        ("experiment", declared![Polygon, Rect, ControllerName, PositionerKind, Disturbance, When, Scripted, Scenario]),
        (
            "messages",
            declared![
                ClientMessage,
                Role,
                ServerMessage,
                Hello,
                EventKind,
                EventMessage,
                SessionError,
                CatalogMessage,
                TrainingPointsMessage,
                DoneMessage,
                RefusedMessage
            ],
        ),
        (
            "facts",
            declared![
                Told<Reason>,
                PhaseFact,
                StopCode,
                TroubleFact,
                VoidFact,
                RefusalFact,
                Reason,
                Happening,
                Resumption,
                RefusalCode,
                RecordingFact,
                EndFact
            ],
        ),
        ("session", declared![View, SceneMessage, KeptRun, CaseSummary, StateMessage]),
        ("layers", declared![SensedObstacle, OverlayMessage, BlocksLayer, PlanLayer, SeenMessage, JudgementLayer]),
        ("comparison", declared![Branch, ComparisonMessage, MomentMessage]),
        (
            "fields",
            declared![
                PullQuery,
                PullCurve,
                ReachQuery,
                ReachCurve,
                PlaneQuery,
                Plane,
                WorkspaceQuery,
                WorkspaceMap,
                FlowQuery,
                FlowField,
            ],
        ),
        ("values", declared![ValueQuery, ValueCell, ValueMap]),
        ("jobs", declared![JobStage, JobKind, JobLane, JobSummary, JobPace]),
        (
            "evaluations",
            declared![
                Variation,
                EvaluationQuery,
                Cell,
                PaperRow,
                Setting,
                EvaluationCell,
                EvaluationSummary,
                Evaluations
            ],
        ),
        (
            "recoveries",
            declared![
                Kind,
                Outcome,
                RecoveryQuery,
                RecoverySummary,
                CellRow,
                Basin,
                BasinDifference,
                RecoveryReport,
                Recoveries,
                RecoveryTrial,
                RecoveryTrials,
            ],
        ),
        ("report", declared![Row, PairedMean, Comparison, EvaluationFailure, EvaluationReport]),
        ("recordings", declared![RecordingFile, RecordingContent, RecordingList, RecordingTitle]),
        ("maps", declared![NarrowPlace, MapFacts, MapReport, MapCheck]),
        (
            "trainings",
            declared![
                RecipeName,
                FusionName,
                Settings,
                TrainingQuery,
                TrainingStage,
                Examination,
                TrainingPoint,
                TrainingSummary,
                TrainingReport,
                Trainings,
                TrainingCells,
                Ending,
                Trail,
                TrainingFrame,
            ],
        ),
        (
            "challenges",
            declared![
                Difficulty,
                Period,
                Score,
                BoardEntry,
                ChallengeSummary,
                Challenges,
                ChallengeReport,
                Mishap,
                MishapMessage,
                TraceMessage,
                GhostMessage,
                Ghosts,
                Loss,
                Attempt,
                AttemptReport,
                AttemptQuery,
                AttemptAnswer,
                AttemptStanding,
            ],
        ),
        ("lumen", declared![WallRing, Lumen]),
        ("programs", declared![ProgramStanding, Programs]),
        (
            "robot",
            declared![
                Connected,
                ProtectiveStop,
                Refused,
                RobotStanding,
                ApartFact,
                DoubtFact,
                DriveFact,
                TwinTrouble,
                TwinStanding
            ],
        ),
        ("policies", declared![PolicyOrigin, PolicySummary, Policies, PolicyName]),
    ]
}

/// Type imports of one file. `origins` has the file of each type.
fn imports(file: &str, text: &str, origins: &BTreeMap<String, String>) -> String {
    let is_code = |line: &&str| !line.trim_start().starts_with(['*', '/']);
    let mut used: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for word in text.lines().filter(is_code).flat_map(|line| line.split(|c: char| !c.is_alphanumeric())) {
        if let Some(origin) = origins.get(word).filter(|origin| *origin != file) {
            used.entry(origin).or_default().insert(word);
        }
    }
    used.into_iter()
        .map(|(origin, names)| {
            let names: Vec<_> = names.into_iter().collect();
            format!("import type {{ {} }} from '{origin}';\n", names.join(", "))
        })
        .collect()
}

/// Writes a generated file when `FERRY_GENERATE` is set, and compares it otherwise.
fn keep(path: &str, generated: &str) {
    let whole = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/..")).join(path);
    if std::env::var_os("FERRY_GENERATE").is_some() {
        std::fs::create_dir_all(whole.parent().unwrap()).unwrap();
        std::fs::write(&whole, generated).unwrap();
    }
    let found = std::fs::read_to_string(&whole).unwrap_or_default();
    assert!(found == generated, "{path} is out of date; FERRY_GENERATE=1 cargo test --release protocol renews it");
}

#[test]
fn the_pages_types_are_generated_from_these() {
    let modules = modules();
    let mut origins: BTreeMap<_, _> = ["Orientation", "Parameters", "ToolOrientation"]
        .map(|name| (name.to_owned(), "../parameters.gen".to_owned()))
        .into();
    for (module, declarations) in &modules {
        origins.extend(declarations.iter().map(|one| (one.name.clone(), format!("./{module}.gen"))));
    }
    let mut index = format!("{HEADER}export * from './parameters.gen';\n");
    for (module, declarations) in &modules {
        let texts: Vec<_> = declarations.iter().map(|one| one.text.as_str()).collect();
        let text = texts.join("\n");
        let imports = imports(&format!("./{module}.gen"), &text, &origins);
        let gap = if imports.is_empty() { "" } else { "\n" };
        keep(&format!("web/src/net/protocol/{module}.gen.ts"), &[HEADER, &imports, gap, &text].concat());
        index += &format!("export * from './protocol/{module}.gen';\n");
    }
    keep("web/src/net/protocol.gen.ts", &format!("{index}\n{}", constants()));
}
