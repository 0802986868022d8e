//! Every parameter, once. [`Parameters`], its defaults and [`Parameters::ALL`] come from this table; from those come
//! the range checks, `--set`, the API's description, the page's form and `docs/parameters.md`.
//!
//! A new parameter is one entry: `name: type = default, kind, "label on the page", "help";`. A field that is renamed
//! keeps its old name with `#[serde(alias = "…")]` before its entry. The order is that of stored states and of links.

use serde::ser::SerializeStruct;
use serde::{Deserialize, Serialize, Serializer};

use super::descriptor::{
    Bound, CM, DEGREES, Group, Kind, LEVELS, MM, MM_S, MN_S_M, Numeric, PERCENT, PLAIN, PX, Parameter, S, TICKS,
    bounded, number, whole,
};
use super::{AttractorLaw, RlPolicy, SwitchingLaw};
use crate::image::CameraMount;
use crate::plant::{
    BeadMotion, BlockOrientation, Contraction, LEAST_PERIOD_S, LEAST_WAVELENGTH_M, MOST_CLOSING_M, ToolOrientation,
};

impl Numeric for BlockOrientation {}
impl Numeric for ToolOrientation {}
impl Numeric for BeadMotion {}
impl Numeric for Contraction {}
impl Numeric for SwitchingLaw {}
impl Numeric for RlPolicy {}
impl Numeric for AttractorLaw {}

/// Parameters as they are hashed. The walls' group came later: at its defaults it is left out, so that what was recorded
/// before keeps its hashes.
pub struct Hashed<'a>(pub &'a Parameters);

macro_rules! parameters {
    ($($group:ident {$(
        $(#[$attribute:meta])* $name:ident: $type:ty = $default:expr, $kind:expr, $label:literal, $help:literal;
    )*})*) => {
        /// All parameters that the operator can change, in the units of their names.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[serde(deny_unknown_fields, default)]
        pub struct Parameters {
            $($(#[doc = $help] $(#[$attribute])* pub $name: $type,)*)*
        }

        impl Default for Parameters {
            fn default() -> Self {
                Self { $($($name: $default,)*)* }
            }
        }

        impl Serialize for Hashed<'_> {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let (values, defaults) = (self.0, Parameters::default());
                let mut fields = serializer.serialize_struct("Parameters", Parameters::ALL.len())?;
                $(if Group::$group != Group::Walls || $(values.$name != defaults.$name)||* {
                    $(fields.serialize_field(stringify!($name), &values.$name)?;)*
                })*
                fields.end()
            }
        }

        impl Parameters {
            /// All parameters, in the order of the fields.
            pub const ALL: &'static [Parameter] = &[$($(
                Parameter {
                    name: stringify!($name),
                    label: $label,
                    help: $help,
                    group: Group::$group,
                    kind: $kind,
                },
            )*)*];

            /// Values in the order of [`Parameters::ALL`]; `None` for flags and choices.
            pub(super) fn numbers(&self) -> Vec<Option<f64>> {
                vec![$($(self.$name.number(),)*)*]
            }
        }
    };
}

parameters! {
    MagnetAndBead {
        block_orientation: BlockOrientation = BlockOrientation::A,
            Kind::Choice(&[("A", "A: flat, vertical field"), ("B", "B: on edge"), ("C", "C: flat, along 50 mm")]),
            "Block", "How the block magnet on the tool is turned.";
        tool_orientation: ToolOrientation = ToolOrientation::Vertical,
            Kind::Choice(&[("vertical", "Straight down"), ("paper", "3.2° off (paper)")]),
            "Tool", "How the arm holds its flange; the planar stage is always vertical. \
                     The paper's rotation vector is 3.2° off the vertical.";
        tool_height_m: f64 = 0.100, number(MM, [0.09, 0.2], 1.0),
            "Tool height", "Lower face of the block above the table.";
        bead_motion: BeadMotion = BeadMotion::Sliding,
            Kind::Choice(&[("sliding", "Slides"), ("rolling", "Rolls")]),
            "Bead", "Slides: the field holds the bead's axis. Rolls: the bead is free to turn.";
        friction: f64 = 0.2, number(PLAIN, [0.0, 1.0], 0.01),
            "Friction μ", "Coulomb friction of the bead on the table.";
        rolling_resistance: f64 = 0.01, number(PLAIN, [0.0, 0.2], 0.005),
            "Rolling resistance", "In units of the normal load, for a bead that rolls. At μ or above, the bead slides.";
        drag_n_s_m: f64 = 0.01, number(MN_S_M, [0.0, 0.1], 1.0),
            "Viscous drag", "Drag on the bead.";
    }
    Camera {
        camera_height_m: f64 = CameraMount::default().height_m, number(CM, [0.1, 1.0], 0.1),
            "Camera height", "Height of the camera above the table.";
        // With the tilt at its ends, the image's corners still show the table and no horizon.
        camera_field_of_view_rad: f64 = CameraMount::default().field_of_view_rad, number(DEGREES, [0.1, 1.2], 0.01),
            "Field of view", "Angle across the image. 36.87° shows 20 cm of the table from a height of 30 cm.";
        camera_offset_x_m: f64 = CameraMount::default().offset_m[0], number(CM, [-0.15, 0.15], 0.1),
            "Offset x", "From the tool's axis to the camera, along x.";
        camera_offset_y_m: f64 = CameraMount::default().offset_m[1], number(CM, [-0.15, 0.15], 0.1),
            "Offset y", "From the tool's axis to the camera, along y.";
        camera_tilt_x_rad: f64 = CameraMount::default().tilt_rad[0], number(DEGREES, [-0.4, 0.4], 0.1),
            "Tilt x", "How far the camera leans toward +x. A tilted image is rectified before it is used.";
        camera_tilt_y_rad: f64 = CameraMount::default().tilt_rad[1], number(DEGREES, [-0.4, 0.4], 0.1),
            "Tilt y", "How far the camera leans toward +y.";
        camera_sees_magnet: bool = CameraMount::default().sees_magnet, Kind::Flag,
            "Magnet in the picture", "Whether the magnet is in the image, as with a real camera. \
                                      What it hides is not observed.";
        camera_noise_levels: f64 = 0.0, number(LEVELS, [0.0, 40.0], 0.5),
            "Image noise σ", "Standard deviation of the brightness of each pixel.";
        camera_latency_ticks: u32 = 0, whole(TICKS, [0.0, 50.0], 1.0),
            "Image latency", "Age of the image at a control step, in ticks of 8 ms. Its place is known.";
        obstacle_level: u8 = 125, whole(PLAIN, [50.0, 199.0], 1.0),
            "Obstacle level", "Gray at or below this is an obstacle, for blocks and map. \
                               Walls are 50 or darker, floor is 200 or lighter.";
        smallest_block_px: u32 = 6, whole(PX, [1.0, 240.0], 1.0),
            "Smallest block", "Smallest side of the quadtree's blocks. The paper's figures have 50.";
    }
    Switching {
        threshold_m: f64 = 0.10, number(CM, [0.02, 0.2], 0.1),
            "Threshold T", "Farther than this from the tool, the bead is lost and sub-controller 1 takes over.";
        fetch_radius_m: f64 = 0.01, bounded(CM, [0.002, 0.2], 0.1, Bound::AtMost("threshold_m")),
            "Fetch radius", "Nearer than this, sub-controller 1 has fetched the bead. Never above T.";
        switching_law: SwitchingLaw = SwitchingLaw::Hysteresis,
            Kind::Choice(&[("hysteresis", "Hysteresis"), ("literal", "Literal (paper)")]),
            "Switching law", "With hysteresis, sub-controller 1 keeps control until the bead is fetched. \
                              The paper has one threshold both ways.";
    }
    Speeds {
        approach_speed_m_s: f64 = 0.25, number(MM_S, [0.02, 0.25], 1.0),
            "Approach", "Speed of the tool while it goes to the bead.";
        transport_speed_m_s: f64 = 0.04, number(MM_S, [0.01, 0.079], 1.0),
            "Transport", "Speed of the tool while it carries the bead.";
        step_limit: u32 = 150, whole(PLAIN, [10.0, 5000.0], 10.0),
            "Step limit", "Control steps that a transport may take after a fetch. \
                           A goal may take four times as many. The paper has 150.";
    }
    Tracker {
        tracker_noise_m: f64 = 0.001, number(MM, [0.0, 0.01], 0.1),
            "Noise σ", "Standard deviation of the tracked position.";
        tracker_latency_ticks: u32 = 2, whole(TICKS, [0.0, 50.0], 1.0),
            "Latency", "Age of the tracked position, in ticks of 8 ms.";
        tracker_dropout: f64 = 0.0, number(PERCENT, [0.0, 0.9], 1.0),
            "Dropout", "Share of lost samples.";
        tracker_bias_x_m: f64 = 0.0, number(MM, [-0.02, 0.02], 0.5),
            "Bias x", "Constant error of the tracked position, along x.";
        tracker_bias_y_m: f64 = 0.0, number(MM, [-0.02, 0.02], 0.5),
            "Bias y", "Constant error of the tracked position, along y.";
        tracker_drift_m: f64 = 0.0, number(MM, [0.0, 0.02], 0.5),
            "Drift σ", "Standard deviation of an error that changes within about ten seconds.";
        tracker_is_hidden_by_arm: bool = false, Kind::Flag,
            "Hidden by the arm", "Whether the tracker loses the bead while the arm is between them. \
                                  The tracker looks from the right side of the table.";
        tracker_timeout_s: f64 = 0.2, number(S, [0.05, 10.0], 0.05),
            "Timeout", "When no sample has arrived for this long, the arm holds. Latency does not count.";
    }
    Rl {
        rl_policy: RlPolicy = RlPolicy::Auto,
            Kind::Policy,
            "Policy", "Which trained policy runs. Auto takes the one trained on this map, else the explorer, which \
                       remembers what the camera has seen and needs no training on the map.";
        rl_shield: bool = true, Kind::Flag,
            "Shield", "Replaces a best step that comes near a visible wall by the next best. \
                       Without it, such a step is refused and the arm holds.";
        rl_visit_penalty: f64 = 0.1, number(PLAIN, [0.0, 1.0], 0.01),
            "Visit penalty", "Subtracted from the value of a step for each earlier visit of its cell since the last \
                              fetch or goal. It ends going to and fro. 0 is the paper.";
        rl_shortcut: bool = true, Kind::Flag,
            "Shortcuts", "A policy with a memory goes straight over the next cells of its route where the way is known \
                          to be clear, instead of step by step along the axes.";
        rl_corrects_image: bool = true, Kind::Flag,
            "Corrected image", "The network gets the square of table around the tool, as in training, wherever the camera \
                                is. Without it, it gets the camera's own image.";
    }
    Errt {
        errt_goal_probability: f64 = 0.1, number(PERCENT, [0.0, 0.9], 1.0),
            "Goal probability", "Share of the extensions that go toward the goal. It limits the share toward waypoints.";
        errt_waypoint_probability: f64 = 0.6,
            bounded(PERCENT, [0.0, 0.9], 1.0, Bound::Remainder("errt_goal_probability")),
            "Waypoint probability", "Share of the extensions that go toward a waypoint of an earlier path. \
                                     At most what the goal leaves.";
        errt_waypoints: u32 = 200, whole(PLAIN, [0.0, 1000.0], 10.0),
            "Waypoints", "How many waypoints of earlier paths are remembered. 0 turns this off.";
        errt_beta_most: f64 = 0.65, number(PLAIN, [0.0, 0.95], 0.01),
            "Most β", "Upper limit of β, the weight of the cost from the root. 0 is the plain nearest neighbour.";
        errt_step_m: f64 = 0.03, number(MM, [0.005, 0.1], 1.0),
            "Edge length", "Longest edge of the tree.";
        errt_clearance_m: f64 = 0.012, number(MM, [0.004, 0.03], 0.5),
            "Clearance", "Distance that paths keep from walls where there is room.";
        errt_nodes_per_step: u32 = 2000, whole(PLAIN, [10.0, 20_000.0], 10.0),
            "Edges per step", "Edges tried in one control step at most. Then the arm holds, \
                               and the search continues in the next step.";
        errt_ways: u32 = 8, whole(PLAIN, [1.0, 20.0], 1.0),
            "Paths compared", "Paths planned before the shortest is followed. The publication follows the first.";
        errt_unseen_weight: f64 = 3.0, number(PLAIN, [1.0, 10.0], 0.1),
            "Unseen weight", "How many times a length through unseen area counts when paths are compared.";
        errt_shortcut: bool = true, Kind::Flag,
            "Shortcuts", "Whether corners of a path are cut where there is room.";
    }
    Attractor {
        attractor_law: AttractorLaw = AttractorLaw::Improved,
            Kind::Choice(&[("improved", "Improved"), ("literal", "Literal (paper)")]),
            "Attractor law", "The literal law can stick behind a flat face. \
                              The improved one follows contours and keeps clear.";
        attractor_gain: f64 = 2.0, number(PLAIN, [1.05, 10.0], 0.05),
            "Gain K", "Feedback gain K = k·I; stable above 1.";
        attractor_safety_factor: f64 = 1.2, number(PLAIN, [1.0, 2.0], 0.05),
            "Safety factor", "Scales the half sides of the superellipse around an obstacle.";
        attractor_reactivity: f64 = 1.0, number(PLAIN, [0.2, 5.0], 0.1),
            "Reactivity ρ", "How early the motion bends around an obstacle.";
        attractor_clearance_m: f64 = 0.012, number(MM, [0.0, 0.03], 1.0),
            "Clearance", "Distance that the improved law keeps from walls.";
    }
    Walls {
        peristalsis_amplitude_m: f64 = 0.0,
            bounded(MM, [0.0, MOST_CLOSING_M], 0.5, Bound::Quarter("peristalsis_wavelength_m")),
            "Amplitude", "How far the walls close in; 0: they are rigid. Narrow places keep room for the bead. \
                          At most a quarter of the wavelength.";
        peristalsis_wavelength_m: f64 = 0.12, number(CM, [LEAST_WAVELENGTH_M, 1.0], 1.0),
            "Wavelength", "From one wave to the next along the lumen, or length of a segment.";
        peristalsis_period_s: f64 = 6.0, number(S, [LEAST_PERIOD_S, 60.0], 0.5),
            "Period", "Duration of a contraction at one place. Another period, wavelength, pause, kind or irregularity \
                       begins when the walls are at rest.";
        peristalsis_pause_s: f64 = 0.0, number(S, [0.0, 60.0], 0.5),
            "Pause", "Rest between two contractions.";
        peristalsis_contraction: Contraction = Contraction::Travelling,
            Kind::Choice(&[("travelling", "Waves"), ("segmental", "Segments")]),
            "Kind", "Waves travel along the lumen. Segments contract in place, every second one in turn.";
        peristalsis_irregularity: f64 = 0.0, number(PERCENT, [0.0, 1.0], 5.0),
            "Irregularity", "0 %: all contractions are equally strong. 100 %: any strength from none to full.";
        flow_m_s: f64 = 0.0, number(MM_S, [-0.1, 0.1], 1.0),
            "Flow", "Speed of the fluid along the lumen. The bead feels drag relative to it.";
        obstacle_memory_s: f64 = 12.0, number(S, [1.0, 600.0], 1.0),
            "Obstacle memory", "While the walls move: how long the obstacle map keeps what changes and is out of view.";
    }
}
