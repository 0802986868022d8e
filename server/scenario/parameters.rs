//! Everything an operator can tune, with the range of each.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use crate::image::CameraMount;
use crate::plant::{BeadMotion, BlockOrientation, PlantParameters, ToolOrientation};

/// Which switching law runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum SwitchingLaw {
    /// Sub-controller 1 keeps control until the bead is within `fetch_radius_m`.
    Hysteresis,
    /// The paper's equation to the letter: one threshold both ways.
    Literal,
}

/// Which attractor law runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum AttractorLaw {
    /// The paper's law to the letter; it can stick behind a flat face.
    Literal,
    /// With contouring, a star-shaped basis and clearance.
    Improved,
}

/// Which trained policy runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum RlPolicy {
    /// The one trained on the map, else the general one.
    Auto,
    /// Trained on the colon alone.
    Colon,
    /// Trained on several maps.
    General,
}

/// Everything an operator can tune. Ranges are in [`Parameters::check`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Parameters {
    /// How the block is turned.
    pub block_orientation: BlockOrientation,
    /// How the arm holds its flange; the planar stage is always vertical.
    pub tool_orientation: ToolOrientation,
    /// Height of the block's lower face above the table, .09 to .2 m.
    pub tool_height_m: f64,
    /// How the bead moves over the table.
    pub bead_motion: BeadMotion,
    /// Coulomb friction of the bead on the table, 0 to 1.
    pub friction: f64,
    /// Resistance to rolling in units of the normal load, 0 to .2; at the friction or above, the bead slides.
    pub rolling_resistance: f64,
    /// Viscous drag on the bead, 0 to .1 N·s/m.
    pub drag_n_s_m: f64,
    /// Height of the camera above the table, .1 to 1 m.
    pub camera_height_m: f64,
    /// Angle across the camera's image, .1 to 1.2 rad; the default, 36.87°, sees .20 m of table.
    pub camera_field_of_view_rad: f64,
    /// From the tool's axis to the camera along x, −.15 to .15 m.
    pub camera_offset_x_m: f64,
    /// The same along y.
    pub camera_offset_y_m: f64,
    /// How far the camera leans toward +x, −.4 to .4 rad.
    pub camera_tilt_x_rad: f64,
    /// The same toward +y.
    pub camera_tilt_y_rad: f64,
    /// Whether the magnet stands in the picture.
    pub camera_sees_magnet: bool,
    /// Gray at or below this is an obstacle, for blocks and map, 50 to 199: walls are 50 or darker, floor 200 or
    /// lighter.
    pub obstacle_level: u8,
    /// Smallest side of a block of the quadtree, 1 to 240 px; the paper's figures have 50.
    pub smallest_block_px: u32,
    /// Threshold T of the switching law, .02 to .2 m.
    pub threshold_m: f64,
    /// Distance at which sub-controller 1 has fetched the bead, .002 m to `threshold_m`.
    pub fetch_radius_m: f64,
    /// Which switching law runs.
    pub switching_law: SwitchingLaw,
    /// Tool speed while approaching, .02 to .25 m/s.
    pub approach_speed_m_s: f64,
    /// Tool speed while transporting, .01 to .079 m/s.
    pub transport_speed_m_s: f64,
    /// Standard deviation of the tracker's noise, 0 to .01 m.
    pub tracker_noise_m: f64,
    /// Latency of the tracker, 0 to 50 ticks of 8 ms.
    pub tracker_latency_ticks: u32,
    /// Share of the tracker's samples that are lost, 0 to .9.
    pub tracker_dropout: f64,
    /// Which trained policy runs.
    pub rl_policy: RlPolicy,
    /// Whether the policy's best action gives way to the next best where its step comes near a wall in view; without,
    /// such a step is refused and the arm holds.
    pub rl_shield: bool,
    /// Share of ERRT's extensions that go toward the goal, 0 to .9.
    pub errt_goal_probability: f64,
    /// Share that go toward a waypoint of an earlier way, 0 to .9; at most 1 with the one above.
    pub errt_waypoint_probability: f64,
    /// Waypoints that ERRT keeps, 0 to 1000; 0 is without.
    pub errt_waypoints: u32,
    /// Most that β, the weight of the cost from the root, grows to, 0 to .95; 0 is the plain nearest neighbour.
    pub errt_beta_most: f64,
    /// Longest edge of ERRT's tree, .005 to .1 m.
    pub errt_step_m: f64,
    /// Distance that ERRT's ways keep from walls where there is room, .004 to .03 m.
    pub errt_clearance_m: f64,
    /// Edges that ERRT tries at one control step at most, 10 to 20000; then the arm holds and it goes on at the next.
    pub errt_nodes_per_step: u32,
    /// Ways that ERRT plans before it follows the shortest, 1 to 20; the publication follows the first.
    pub errt_ways: u32,
    /// How many times a length through the unseen counts when ERRT compares ways, 1 to 10.
    pub errt_unseen_weight: f64,
    /// Whether ERRT's ways are cut short.
    pub errt_shortcut: bool,
    /// Which attractor law runs.
    pub attractor_law: AttractorLaw,
    /// Feedback gain K, 1.05 to 10 (K = kI; stable above 1).
    pub attractor_gain: f64,
    /// Safety factor sf on the superellipse's half sides, 1 to 2.
    pub attractor_safety_factor: f64,
    /// Reactivity ρ of the modulation, .2 to 5.
    pub attractor_reactivity: f64,
    /// Distance kept from walls by the improved law, 0 to .03 m.
    pub attractor_clearance_m: f64,
}

impl Default for Parameters {
    fn default() -> Self {
        let camera = CameraMount::default();
        Self {
            block_orientation: BlockOrientation::A,
            tool_orientation: ToolOrientation::Vertical,
            tool_height_m: 0.100,
            bead_motion: BeadMotion::Sliding,
            friction: 0.2,
            rolling_resistance: 0.01,
            drag_n_s_m: 0.01,
            camera_height_m: camera.height_m,
            camera_field_of_view_rad: camera.field_of_view_rad,
            camera_offset_x_m: camera.offset_m[0],
            camera_offset_y_m: camera.offset_m[1],
            camera_tilt_x_rad: camera.tilt_rad[0],
            camera_tilt_y_rad: camera.tilt_rad[1],
            camera_sees_magnet: camera.sees_magnet,
            obstacle_level: 125,
            smallest_block_px: 6,
            threshold_m: 0.10,
            fetch_radius_m: 0.01,
            switching_law: SwitchingLaw::Hysteresis,
            approach_speed_m_s: 0.25,
            transport_speed_m_s: 0.04,
            tracker_noise_m: 0.001,
            tracker_latency_ticks: 2,
            tracker_dropout: 0.0,
            rl_policy: RlPolicy::Auto,
            rl_shield: true,
            errt_goal_probability: 0.1,
            errt_waypoint_probability: 0.6,
            errt_waypoints: 200,
            errt_beta_most: 0.65,
            errt_step_m: 0.03,
            errt_clearance_m: 0.012,
            errt_nodes_per_step: 2000,
            errt_ways: 8,
            errt_unseen_weight: 3.0,
            errt_shortcut: true,
            attractor_law: AttractorLaw::Improved,
            attractor_gain: 2.0,
            attractor_safety_factor: 1.2,
            attractor_reactivity: 1.0,
            attractor_clearance_m: 0.012,
        }
    }
}

/// A parameter outside its range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{field} is {value}, it must be {least} to {most}")]
pub struct ParameterError {
    /// The field at fault.
    pub field: &'static str,
    /// Its value.
    pub value: f64,
    /// Least value allowed.
    pub least: f64,
    /// Greatest value allowed.
    pub most: f64,
}

impl Parameters {
    /// Checks every range; the first field at fault is named.
    pub fn check(&self) -> Result<(), ParameterError> {
        let ranges = [
            ("tool_height_m", self.tool_height_m, 0.09, 0.2),
            ("friction", self.friction, 0.0, 1.0),
            ("rolling_resistance", self.rolling_resistance, 0.0, 0.2),
            ("drag_n_s_m", self.drag_n_s_m, 0.0, 0.1),
            ("camera_height_m", self.camera_height_m, 0.1, 1.0),
            // With the tilt at its ends the image's corners still see table and no horizon.
            ("camera_field_of_view_rad", self.camera_field_of_view_rad, 0.1, 1.2),
            ("camera_offset_x_m", self.camera_offset_x_m, -0.15, 0.15),
            ("camera_offset_y_m", self.camera_offset_y_m, -0.15, 0.15),
            ("camera_tilt_x_rad", self.camera_tilt_x_rad, -0.4, 0.4),
            ("camera_tilt_y_rad", self.camera_tilt_y_rad, -0.4, 0.4),
            ("obstacle_level", f64::from(self.obstacle_level), 50.0, 199.0),
            ("smallest_block_px", f64::from(self.smallest_block_px), 1.0, 240.0),
            ("threshold_m", self.threshold_m, 0.02, 0.2),
            ("fetch_radius_m", self.fetch_radius_m, 0.002, self.threshold_m),
            ("approach_speed_m_s", self.approach_speed_m_s, 0.02, 0.25),
            ("transport_speed_m_s", self.transport_speed_m_s, 0.01, 0.079),
            ("tracker_noise_m", self.tracker_noise_m, 0.0, 0.01),
            ("tracker_latency_ticks", f64::from(self.tracker_latency_ticks), 0.0, 50.0),
            ("tracker_dropout", self.tracker_dropout, 0.0, 0.9),
            ("errt_goal_probability", self.errt_goal_probability, 0.0, 0.9),
            (
                "errt_waypoint_probability",
                self.errt_waypoint_probability,
                0.0,
                (1.0 - self.errt_goal_probability).min(0.9),
            ),
            ("errt_waypoints", f64::from(self.errt_waypoints), 0.0, 1000.0),
            ("errt_beta_most", self.errt_beta_most, 0.0, 0.95),
            ("errt_step_m", self.errt_step_m, 0.005, 0.1),
            ("errt_clearance_m", self.errt_clearance_m, 0.004, 0.03),
            ("errt_ways", f64::from(self.errt_ways), 1.0, 20.0),
            ("errt_unseen_weight", self.errt_unseen_weight, 1.0, 10.0),
            ("errt_nodes_per_step", f64::from(self.errt_nodes_per_step), 10.0, 20_000.0),
            ("attractor_gain", self.attractor_gain, 1.05, 10.0),
            ("attractor_safety_factor", self.attractor_safety_factor, 1.0, 2.0),
            ("attractor_reactivity", self.attractor_reactivity, 0.2, 5.0),
            ("attractor_clearance_m", self.attractor_clearance_m, 0.0, 0.03),
        ];
        for (field, value, least, most) in ranges {
            if !(least..=most).contains(&value) {
                return Err(ParameterError { field, value, least, most });
            }
        }
        Ok(())
    }

    /// How the camera sits on the tool.
    pub fn camera_mount(&self) -> CameraMount {
        CameraMount {
            height_m: self.camera_height_m,
            offset_m: [self.camera_offset_x_m, self.camera_offset_y_m],
            tilt_rad: [self.camera_tilt_x_rad, self.camera_tilt_y_rad],
            field_of_view_rad: self.camera_field_of_view_rad,
            sees_magnet: self.camera_sees_magnet,
        }
    }

    /// The part that the physics are told.
    pub fn plant(&self) -> PlantParameters {
        PlantParameters {
            block_orientation: self.block_orientation,
            bead_motion: self.bead_motion,
            friction: self.friction,
            rolling_resistance: self.rolling_resistance,
            drag_n_s_m: self.drag_n_s_m,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_are_in_range_and_what_is_not_is_named() {
        Parameters::default().check().unwrap();
        let bad = Parameters { friction: -0.1, ..Parameters::default() };
        assert_eq!(bad.check().unwrap_err().to_string(), "friction is -0.1, it must be 0 to 1");
        let nan = Parameters { tool_height_m: f64::NAN, ..Parameters::default() };
        assert_eq!(nan.check().unwrap_err().field, "tool_height_m");
        let narrow = Parameters { threshold_m: 0.05, fetch_radius_m: 0.06, ..Parameters::default() };
        assert_eq!(narrow.check().unwrap_err().field, "fetch_radius_m");
    }
}
