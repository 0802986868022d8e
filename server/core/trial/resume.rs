//! Continuing from a state read from a file. The file is untrusted, so every number is checked.

use ciborium::Value;

use super::{Trial, TrialError, TrialState};

/// Limit for lengths, speeds and angles, in SI units.
const REAL_MOST: f64 = 100.0;
/// Limit for counters and cell numbers; far below overflow.
const COUNT_MOST: u64 = 1 << 30;
/// Limit for ticks; far below overflow.
const TICK_MOST: u64 = 1 << 53;

/// Fields that contain ticks or grow no faster.
const TICKS: [&str; 6] = ["tick", "since_tick", "reached_tick", "drift_until", "dropout_until", "version"];
/// Fields that may contain any number, or are checked elsewhere.
const ANY: [&str; 9] = ["rng", "seed", "seen", "known", "parameters", "pending", "refusal", "judged", "remaining"];

/// A state that no trial can reach.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("state: {field} is {value}, it must be {allowed}")]
pub struct StateError {
    /// Path of the invalid field.
    pub field: String,
    pub value: String,
    pub allowed: String,
}

impl Trial {
    /// Continues from an untrusted state; compare [`Self::restore`].
    ///
    /// # Errors
    /// A number in it is out of range, or it belongs to another map. The trial is then unchanged.
    pub fn resume(&mut self, state: TrialState) -> Result<(), TrialError> {
        state.world.parameters.check()?;
        Self::check_script(&state.world.script.pending, &self.arena.map)?;
        let (own, workspace) = (self.arena.map.workspace(), state.controller_state.known.workspace());
        if workspace != own {
            let (value, allowed) = (format!("{workspace:?}"), format!("the map's, {own:?}"));
            return Err(StateError { field: "mind.known.workspace".to_owned(), value, allowed }.into());
        }
        let version = state.controller_state.known.version();
        if version > TICK_MOST {
            let (value, allowed) = (version.to_string(), format!("0 to {TICK_MOST}"));
            return Err(StateError { field: "mind.known.version".to_owned(), value, allowed }.into());
        }
        // The generic form exposes all numbers without code for each type.
        let form = Value::serialized(&state).expect("plain data serialises");
        check(&form, "", "")?;
        let moments = std::iter::once(&state.world.plant.walls).chain(state.world.past.iter().map(|past| &past.walls));
        if let Some(motion) = moments.flatten().find(|motion| !motion.is_sound()) {
            let allowed =
                "a motion with wavelength and period above 0, and no more than the largest amplitude".to_owned();
            return Err(
                StateError { field: "world.plant.walls".to_owned(), value: format!("{motion:?}"), allowed }.into()
            );
        }
        self.restore(state);
        Ok(())
    }
}

/// Checks every number in `value`, whose path and field name are given.
fn check(value: &Value, path: &str, name: &str) -> Result<(), StateError> {
    let refused = |value: String, allowed: String| {
        Err(StateError { field: path.trim_start_matches('.').to_owned(), value, allowed })
    };
    match value {
        Value::Float(number) if number.is_nan() || number.abs() > REAL_MOST => {
            refused(number.to_string(), format!("-{REAL_MOST} to {REAL_MOST}"))
        }
        Value::Integer(number) => {
            let most = if TICKS.contains(&name) { TICK_MOST } else { COUNT_MOST };
            let number = i128::from(*number);
            if number.unsigned_abs() > u128::from(most) {
                return refused(number.to_string(), format!("-{most} to {most}"));
            }
            Ok(())
        }
        Value::Array(values) => {
            values.iter().enumerate().try_for_each(|(index, value)| check(value, &format!("{path}[{index}]"), name))
        }
        Value::Map(fields) => fields.iter().try_for_each(|(key, value)| match key.as_text().unwrap_or_default() {
            name if ANY.contains(&name) => Ok(()),
            name => check(value, &format!("{path}.{name}"), name),
        }),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point2;
    use crate::map::Map;
    use crate::perception::ObstacleMap;
    use crate::scenario::{ControllerName, Scenario};
    use crate::trial::Arena;

    fn trial(map: &str) -> Trial {
        let arena = Arena::of(Map::shipped(map).unwrap());
        let scenario = Scenario { controller: ControllerName::Errt, ..Scenario::idle(map, 1) };
        Trial::new(scenario, arena).unwrap()
    }

    /// Only a file can contain such a list of cells.
    fn with_version(known: &ObstacleMap, version: u64) -> ObstacleMap {
        let mut form = Value::serialized(known).unwrap();
        let fields = form.as_map_mut().unwrap();
        fields.iter_mut().find(|(key, _)| key.as_text() == Some("version")).unwrap().1 = version.into();
        form.deserialized().unwrap()
    }

    fn refusal(change: impl Fn(&mut TrialState)) -> String {
        let mut trial = trial("posts");
        let mut state = trial.snapshot();
        change(&mut state);
        let before = trial.state().world_hash();
        let error = trial.resume(state).unwrap_err().to_string();
        assert_eq!(trial.state().world_hash(), before);
        error
    }

    #[test]
    fn accepts_a_state_of_the_same_trial() {
        let mut trial = trial("posts");
        trial.resume(trial.snapshot()).unwrap();
    }

    #[test]
    fn rejects_unreachable_states_by_field() {
        // A bead this fast would need endless hops, since each is shorter than its radius.
        let error = refusal(|state| state.world.plant.bead.velocity_m_s.y = 1e300);
        assert!(error.starts_with("state: world.plant.bead.velocity_m_s[1] is 1000000000"), "{error}");
        let error = refusal(|state| state.world.goal_m = Some(Point2::new(f64::NAN, 0.0)));
        assert_eq!(error, "state: world.goal_m[0] is NaN, it must be -100 to 100");
        let error = refusal(|state| state.world.counters.steps = u32::MAX);
        assert!(error.starts_with("state: world.counters.steps is 4294967295"), "{error}");
        let error = refusal(|state| state.world.tick = u64::MAX);
        assert!(error.starts_with("state: world.tick is 18446744073709551615"), "{error}");
        let error = refusal(|state| state.world.parameters.tracker_noise_m = f64::INFINITY);
        assert!(error.starts_with("parameters: tracker_noise_m is inf"), "{error}");
        // Found by fuzzing: the counter would grow by one at the next image and overflow.
        let error =
            refusal(|state| state.controller_state.known = with_version(&state.controller_state.known, u64::MAX));
        assert!(error.starts_with("state: mind.known.version is 18446744073709551615"), "{error}");
        let error = refusal(|state| {
            state.controller_state.known = trial("attractor-example").snapshot().controller_state.known
        });
        assert!(error.starts_with("state: mind.known.workspace is Rect"), "{error}");
    }
}
