//! Addresses of the page.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// What `/s/NAME/VIEW` shows instead of the laboratory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum View {
    Draw,
    Train,
    Recordings,
    Evaluate,
}
