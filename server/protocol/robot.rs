//! The clients of the robot server, and the robot that the arm mirrors, for the page.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use ferry_ur::Standing;

/// Who is connected to the robot server, what moves the arm, and what was refused.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct RobotStanding {
    pub clients: Vec<RobotClient>,
    /// The program that runs.
    pub program: Option<String>,
    /// URScript's name of the motion, while there is one.
    pub command: Option<String>,
    /// Why the arm is in a protective stop.
    pub stop: Option<String>,
    /// Newest last, at most 20.
    pub refused: Vec<RobotRefusal>,
}

/// A connection.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
pub struct RobotClient {
    /// Address and port.
    pub from: String,
    /// `dashboard`, `URScript` or `RTDE`.
    pub speech: String,
}

/// What was refused, and why.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
pub struct RobotRefusal {
    #[ts(type = "number")]
    pub tick: u64,
    pub what: String,
    pub why: String,
}

/// A robot outside of Ferry (`ferry drive`), whose arm the simulated one mirrors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct TwinStanding {
    pub address: String,
    /// Whether Ferry may move it (`--enable-motion`).
    pub allows_motion: bool,
    /// Why it is not connected; `null` if it is.
    pub trouble: Option<String>,
    /// What its dashboard says that it is; `null` if it does not say.
    pub model: Option<String>,
    /// Why places on the table may be others than Ferry's; `null` if there is no reason to think so.
    pub doubt: Option<String>,
    /// As it reports it: 7 while it runs.
    pub robot_mode: i32,
    /// As it reports it: 1 normal, 2 reduced, 3 protective stop.
    pub safety_mode: i32,
    /// Whether the button is held and the robot begins to follow, or follows.
    pub is_held: bool,
    /// Whether it follows Ferry's controllers.
    pub is_driven: bool,
    /// Why it does not follow, or no longer.
    pub stopped: Option<String>,
}

impl From<&ferry_ur::TwinStanding> for TwinStanding {
    fn from(standing: &ferry_ur::TwinStanding) -> Self {
        Self {
            address: standing.address.to_string(),
            allows_motion: standing.allows_motion,
            trouble: standing.trouble.clone(),
            model: standing.model.clone(),
            doubt: standing.doubt.clone(),
            robot_mode: standing.robot_mode,
            safety_mode: standing.safety_mode,
            is_held: standing.is_held,
            is_driven: standing.is_driven,
            stopped: standing.stopped.clone(),
        }
    }
}

impl From<&Standing> for RobotStanding {
    fn from(standing: &Standing) -> Self {
        let client =
            |one: &ferry_ur::controller::Connected| RobotClient { from: one.from.clone(), speech: one.port.to_owned() };
        let refused = |one: &ferry_ur::refusals::Refused| RobotRefusal {
            tick: one.tick,
            what: one.what.clone(),
            why: one.why.clone(),
        };
        Self {
            clients: standing.clients.iter().map(client).collect(),
            program: standing.program.clone(),
            command: standing.command.map(str::to_owned),
            stop: standing.stop.clone(),
            refused: standing.refused.iter().map(refused).collect(),
        }
    }
}
