//! Named sets of parameters: how good the sensors are, how the camera sits on the tool, how the bead moves, and how the
//! walls move.

use serde_json::Value;

use super::Parameters;

/// What presets choose between.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PresetKind {
    Sensors,
    CameraMount,
    Robot,
    Walls,
}

impl PresetKind {
    pub const ALL: [Self; 4] = [Self::Sensors, Self::CameraMount, Self::Robot, Self::Walls];

    /// The name on the page.
    pub fn label(self) -> &'static str {
        match self {
            Self::Sensors => "Sensors",
            Self::CameraMount => "Camera mount",
            Self::Robot => "Robot",
            Self::Walls => "Walls",
        }
    }
}

/// A set of parameters with a name. What it does not name, but another preset of its kind does, has its default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Preset {
    /// The name in `--set preset=NAME`.
    pub name: &'static str,
    pub kind: PresetKind,
    /// The name on the page.
    pub label: &'static str,
    pub help: &'static str,
    /// As for `--set`.
    settings: &'static [&'static str],
}

impl Preset {
    pub const ALL: &'static [Self] = &[
        Self {
            name: "laboratory",
            kind: PresetKind::Sensors,
            label: "Laboratory",
            help: "A calibrated tracker that sees the bead everywhere, and a camera without noise: the defaults.",
            settings: &[],
        },
        Self {
            name: "poor",
            kind: PresetKind::Sensors,
            label: "Poor sensors",
            help: "A tracker with noise, bias, drift, losses and latency, which the arm can hide the bead from, and a late \
                   camera with noise.",
            settings: &[
                "camera_noise_levels=10",
                "camera_latency_ticks=12",
                "tracker_noise_m=0.003",
                "tracker_latency_ticks=12",
                "tracker_dropout=0.2",
                "tracker_bias_x_m=0.003",
                "tracker_bias_y_m=-0.002",
                "tracker_drift_m=0.003",
                "tracker_is_hidden_by_arm=true",
            ],
        },
        Self {
            name: "ideal",
            kind: PresetKind::CameraMount,
            label: "Ideal",
            help: "Over the tool, looking straight down through the magnet, which is not in the picture: the default.",
            settings: &[],
        },
        Self {
            name: "realistic",
            kind: PresetKind::CameraMount,
            label: "Realistic",
            help: "Beside the tool and leaning toward it, with magnet and gripper in the picture. It sees the tool's next \
                   step, and not what is behind the magnet.",
            settings: &[
                "camera_offset_x_m=0.12",
                "camera_tilt_x_rad=-0.38",
                "camera_field_of_view_rad=0.72",
                "camera_sees_magnet=true",
            ],
        },
        Self {
            name: "smooth",
            kind: PresetKind::Robot,
            label: "Smooth",
            help: "The bead slides and trails the magnet by 14 mm: the default.",
            settings: &[],
        },
        Self {
            name: "paper",
            kind: PresetKind::Robot,
            label: "The paper's robot",
            help: "A calibration, not a measurement: with this friction the bead sticks and slips, and the mean and largest \
                   tracking errors along x come near the paper's .02 and .08 m.",
            settings: &["friction=0.41"],
        },
        Self {
            name: "rigid",
            kind: PresetKind::Walls,
            label: "Rigid",
            help: "The walls do not move: the default.",
            settings: &[],
        },
        Self {
            name: "peristalsis",
            kind: PresetKind::Walls,
            label: "Peristalsis",
            help: "Waves of 6 mm travel along the lumen at 2 cm/s.",
            settings: &["peristalsis_amplitude_m=0.006"],
        },
        Self {
            name: "strong",
            kind: PresetKind::Walls,
            label: "Strong peristalsis",
            help: "Waves of up to 14 mm, some stronger than others, with pauses, and a fluid that flows with them.",
            settings: &[
                "peristalsis_amplitude_m=0.014",
                "peristalsis_pause_s=3",
                "peristalsis_irregularity=0.5",
                "flow_m_s=0.01",
            ],
        },
        Self {
            name: "segments",
            kind: PresetKind::Walls,
            label: "Segments",
            help: "Segments of 8 cm contract in place by 12 mm, every second one in turn.",
            settings: &[
                "peristalsis_amplitude_m=0.012",
                "peristalsis_wavelength_m=0.08",
                "peristalsis_contraction=segmental",
            ],
        },
    ];

    /// The changes that it makes, each as `NAME=VALUE`; those of other presets of its kind are set to their defaults.
    pub fn changes(&self) -> Vec<String> {
        // Plain data always serialises.
        let defaults = serde_json::to_value(Parameters::default()).unwrap_or_default();
        let name_of = |change: &'static str| change.split_once('=').map_or(change, |(name, _)| name);
        let own = |name: &str| self.settings.iter().find(|change| name_of(change) == name);
        let mut changes: Vec<String> = Vec::new();
        let alike = Self::ALL.iter().filter(|preset| preset.kind == self.kind);
        for name in alike.flat_map(|preset| preset.settings).map(|change| name_of(change)) {
            let change = own(name).map_or_else(|| format!("{name}={}", text(&defaults[name])), ToString::to_string);
            if !changes.contains(&change) {
                changes.push(change);
            }
        }
        changes
    }

    /// A preset by name.
    pub fn named(name: &str) -> Option<&'static Self> {
        Self::ALL.iter().find(|preset| preset.name == name)
    }
}

/// A name without quotes; any other value as JSON.
pub(super) fn text(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::SetError;

    fn set(changes: &[&str]) -> Result<Parameters, SetError> {
        Parameters::default().with(&changes.iter().map(ToString::to_string).collect::<Vec<_>>())
    }

    #[test]
    fn every_preset_is_valid_and_the_first_of_its_kind_is_the_default() {
        for kind in PresetKind::ALL {
            let alike: Vec<_> = Preset::ALL.iter().filter(|preset| preset.kind == kind).collect();
            for preset in &alike {
                let parameters = set(&[&format!("preset={}", preset.name)]).unwrap();
                assert_eq!(parameters == Parameters::default(), preset.name == alike[0].name, "{}", preset.name);
            }
        }
    }

    #[test]
    fn presets_of_different_kinds_are_independent() {
        let both = set(&["preset=poor", "preset=realistic"]).unwrap();
        assert_eq!((both.tracker_dropout, both.camera_sees_magnet), (0.2, true));
        let back = set(&["preset=poor", "preset=realistic", "preset=ideal"]).unwrap();
        assert_eq!(back, set(&["preset=poor"]).unwrap());
    }

    #[test]
    fn a_preset_undoes_another_and_keeps_what_no_preset_names() {
        let changed = set(&["drag_n_s_m=0.03", "preset=poor", "preset=laboratory"]).unwrap();
        assert_eq!(changed, Parameters { drag_n_s_m: 0.03, ..Parameters::default() });
        let adjusted = set(&["preset=poor", "tracker_noise_m=0.001"]).unwrap();
        assert_eq!((adjusted.tracker_noise_m, adjusted.tracker_dropout), (0.001, 0.2));
    }

    #[test]
    fn an_unknown_preset_is_named() {
        let error = set(&["preset=rich"]).unwrap_err().to_string();
        assert_eq!(
            error,
            "there is no preset \"rich\"; there are laboratory, poor, ideal, realistic, smooth, paper, \
                        rigid, peristalsis, strong, segments"
        );
    }
}
