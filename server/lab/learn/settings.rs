//! The settings that a client may change, once. [`Settings`], its range check, the API's description and the page's form
//! come from this table; so do the ranges of a [`Recipe`] with the same names.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use ferry_core::policy::Fusion;
use ferry_core::scenario::descriptor::{FormField, Kind, Numeric, Outside, PLAIN, number, whole};

/// How image, tool and goal come together in the network.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum FusionName {
    /// As a second channel of the image, as in the paper.
    Early,
    /// After the image's features.
    Late,
}

impl From<FusionName> for Fusion {
    fn from(name: FusionName) -> Self {
        match name {
            FusionName::Early => Self::Early,
            FusionName::Late => Self::Late,
        }
    }
}

impl Numeric for FusionName {}

macro_rules! kind {
    (bool) => {
        Kind::Flag
    };
    (FusionName) => {
        Kind::Choice(&[("late", "Late"), ("early", "Early")])
    };
    (f64 $least:tt $most:tt $step:tt) => {
        number(PLAIN, [$least as f64, $most as f64], $step)
    };
    (u32 $least:tt $most:tt $step:tt) => {
        whole(PLAIN, [$least as f64, $most as f64], $step)
    };
}

macro_rules! settings {
    ($($name:ident: $type:ident $(in $least:tt to $most:tt by $step:tt)?, $label:literal, $help:literal;)*) => {
        /// Settings that differ from the recipe, named as in `ferry train --set`. A missing one is the recipe's.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS, ToSchema)]
        #[serde(deny_unknown_fields, default)]
        #[schema(as = TrainingSettings)]
        #[ts(rename = "TrainingSettings")]
        pub struct Settings {
            $(#[doc = $help] $(#[schema(minimum = $least, maximum = $most)])? pub $name: Option<$type>,)*
        }

        impl Settings {
            /// All settings, in the order of the fields.
            pub const ALL: &'static [FormField] = &[$(FormField {
                name: stringify!($name),
                label: $label,
                help: $help,
                kind: kind!($type $($least $most $step)?),
            },)*];

            /// # Errors
            /// The first one that is out of range.
            pub fn check(&self) -> Result<(), Outside> {
                FormField::check(Self::ALL, &[$(self.$name.and_then(|value| value.number()),)*])
            }
        }
    };
}

settings! {
    updates: u32 in 1 to 20000 by 500.0,
        "Updates", "How often the network is corrected: more updates take longer and end better.";
    learning_rate: f64 in 0 to 0.1 by 0.0001,
        "Learning rate", "How far each update moves the network in the first half: too small is slow, too large forgets.";
    discount: f64 in 0 to 1 by 0.01,
        "Discount", "How much a reward counts one step later: near 1, the goal is felt from far away.";
    exploration: f64 in 0 to 1 by 0.01,
        "Exploration", "The share of steps in a random direction, so that the robot finds new routes.";
    noisy: bool,
        "Noisy layers", "Noise inside the network makes it try other steps where it is not sure.";
    progress_reward: f64 in 0 to 1 by 0.05,
        "Progress reward", "Reward for each step that shortens the path to the goal: it shows the direction early.";
    step_penalty: f64 in 0 to 1 by 0.05,
        "Step penalty", "Subtracted at each step, so that short paths are worth more.";
    n_step: u32 in 1 to 20 by 1.0,
        "Steps of a return", "How many real rewards are added up before the network’s own estimate takes over.";
    fusion: FusionName,
        "Fusion", "Where the network joins image and goal: early is that of the paper, late learns faster.";
}
