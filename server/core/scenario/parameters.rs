//! All parameters that the operator can change, with their ranges.

pub mod descriptor;
mod policy;
mod presets;
#[cfg(feature = "schema")]
mod schema;
mod set;
mod table;

use serde::{Deserialize, Serialize};

use crate::image::CameraMount;
use crate::plant::{Peristalsis, PlantParameters};

pub use descriptor::{Bound, Group, Kind, Number, Parameter, Unit};
pub use policy::{AddedPolicy, RlPolicy};
pub use presets::{Preset, PresetKind};
pub use set::SetError;
pub use table::Hashed;
pub use table::Parameters;

/// Which switching law runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SwitchingLaw {
    /// Sub-controller 1 keeps control until the bead is within `fetch_radius_m`.
    Hysteresis,
    /// The paper's equation unchanged: one threshold in both directions.
    Literal,
}

/// Which attractor law runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AttractorLaw {
    /// The paper's law unchanged. It can get stuck behind a flat face.
    Literal,
    /// With contouring, a star-shaped basis and clearance.
    Improved,
}

/// A parameter outside its range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{field} is {value}, it must be {allowed}")]
pub struct ParameterError {
    pub field: &'static str,
    pub value: f64,
    pub allowed: String,
}

impl Parameter {
    /// Refuses a value outside the range. Another parameter may lower the upper end to `most`.
    fn check_range(&self, value: f64, most: f64) -> Result<(), ParameterError> {
        let Kind::Number(Number { unit, range: [least, own_most], bound, .. }) = self.kind else { return Ok(()) };
        if (least..=most.min(own_most)).contains(&value) {
            return Ok(());
        }
        let mut allowed = descriptor::range_text([least, most.min(own_most)], unit);
        if let Some(bound) = bound.filter(|_| most < own_most) {
            allowed += &format!(" ({bound})");
        }
        Err(ParameterError { field: self.name, value, allowed })
    }
}

impl Parameters {
    /// Checks every range. The error names the first invalid field.
    pub fn check(&self) -> Result<(), ParameterError> {
        let values = self.numbers();
        let of = |name| Self::ALL.iter().zip(&values).find(|(one, _)| one.name == name).and_then(|(_, value)| *value);
        for (parameter, value) in Self::ALL.iter().zip(&values) {
            let (Kind::Number(number), Some(value)) = (parameter.kind, *value) else { continue };
            let bound = number.bound.and_then(|bound| Some(bound.most(of(bound.other())?)));
            parameter.check_range(value, bound.unwrap_or(f64::INFINITY))?;
        }
        Ok(())
    }

    /// The camera's mount on the tool.
    pub fn camera_mount(&self) -> CameraMount {
        CameraMount {
            height_m: self.camera_height_m,
            offset_m: [self.camera_offset_x_m, self.camera_offset_y_m],
            tilt_rad: [self.camera_tilt_x_rad, self.camera_tilt_y_rad],
            field_of_view_rad: self.camera_field_of_view_rad,
            sees_magnet: self.camera_sees_magnet,
        }
    }

    /// The part that the plant uses.
    pub fn plant(&self) -> PlantParameters {
        PlantParameters {
            block_orientation: self.block_orientation,
            bead_motion: self.bead_motion,
            friction: self.friction,
            rolling_resistance: self.rolling_resistance,
            drag_n_s_m: self.drag_n_s_m,
            flow_m_s: self.flow_m_s,
            peristalsis: Peristalsis {
                contraction: self.peristalsis_contraction,
                amplitude_m: self.peristalsis_amplitude_m,
                wavelength_m: self.peristalsis_wavelength_m,
                period_s: self.peristalsis_period_s,
                pause_s: self.peristalsis_pause_s,
                irregularity: self.peristalsis_irregularity,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use serde_json::Value;

    use super::*;

    #[test]
    fn defaults_are_in_range_and_a_value_out_of_range_is_named() {
        Parameters::default().check().unwrap();
        let bad = Parameters { friction: -0.1, ..Parameters::default() };
        assert_eq!(bad.check().unwrap_err().to_string(), "friction is -0.1, it must be 0 to 1");
        let nan = Parameters { tool_height_m: f64::NAN, ..Parameters::default() };
        assert_eq!(nan.check().unwrap_err().field, "tool_height_m");
        let narrow = Parameters { threshold_m: 0.05, fetch_radius_m: 0.06, ..Parameters::default() };
        let expected = "fetch_radius_m is 0.06, it must be 0.002 to 0.05 m (at most threshold_m)";
        assert_eq!(narrow.check().unwrap_err().to_string(), expected);
        let greedy = Parameters { errt_goal_probability: 0.75, ..Parameters::default() };
        let expected = "errt_waypoint_probability is 0.6, it must be 0 to 0.25 (at most 1 together with \
                        errt_goal_probability)";
        assert_eq!(greedy.check().unwrap_err().to_string(), expected);
    }

    #[test]
    fn the_table_describes_the_fields() {
        let Value::Object(defaults) = serde_json::to_value(Parameters::default()).unwrap() else { panic!() };
        assert_eq!(defaults.len(), Parameters::ALL.len());
        for Parameter { name, kind, .. } in Parameters::ALL {
            match kind {
                Kind::Number(number) => {
                    assert_eq!(defaults[*name].is_u64(), number.whole, "{name}");
                    let known = |other| Parameters::ALL.iter().any(|one| one.name == other);
                    assert!(number.bound.is_none_or(|bound| known(bound.other())), "{name}");
                }
                Kind::Flag => assert!(defaults[*name].is_boolean(), "{name}"),
                Kind::Choice(options) => {
                    // The error names every allowed value, in backquotes.
                    let other = serde_json::json!({ *name: "?" });
                    let refusal = serde_json::from_value::<Parameters>(other).unwrap_err().to_string();
                    let read: BTreeSet<_> = refusal.split('`').skip(3).step_by(2).collect();
                    assert_eq!(read, options.iter().map(|(value, _)| *value).collect(), "{name}: {refusal}");
                }
                Kind::Policy => {
                    assert!(RlPolicy::OPTIONS.iter().all(|(value, _)| value.parse::<RlPolicy>().is_ok()), "{name}");
                }
            }
        }
    }

    #[test]
    fn shown_ranges_are_whole_steps_inside_the_range() {
        for Parameter { name, kind, .. } in Parameters::ALL {
            let Kind::Number(number) = kind else { continue };
            let [least, most] = number.shown_range().map(|shown| shown / number.unit.scale);
            assert!(least >= number.range[0] - 1e-12 && most <= number.range[1] + 1e-12, "{name}: {least} to {most}");
            assert!(least < most, "{name}");
        }
        let shown = |name| match Parameters::ALL.iter().find(|one| one.name == name).unwrap().kind {
            Kind::Number(number) => number.shown_range(),
            other => panic!("{other}"),
        };
        assert_eq!(shown("attractor_gain"), [1.05, 10.0]);
        assert_eq!(shown("camera_tilt_x_rad"), [-22.9, 22.9]);
    }
}
