//! The arm that a controller takes its own for: from which it computes the poses that it reports.

use serde::Deserialize;

use ferry_core::geometry::{Isometry3, Translation3};
use ferry_core::plant::TOOL_LENGTH_M;
use ferry_core::robot::{
    Joints, forward,
    ur5::{self, DhRow},
};

/// Longest name.
const NAME_MOST: usize = 40;
/// Largest length and angle in a table.
const LENGTH_MOST_M: f64 = 3.0;
const TWIST_MOST_RAD: f64 = std::f64::consts::PI;

/// A model of Universal Robots, or one arm after its calibration. The simulated joints move as a UR5's, whatever the model.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    pub name: String,
    /// From the flange to the tool that is set on the robot, straight out of the flange.
    tcp_m: f64,
    rows: [DhRow; 6],
}

impl Default for Model {
    fn default() -> Self {
        Self { name: "UR5".to_owned(), tcp_m: TOOL_LENGTH_M, rows: ur5::DH }
    }
}

/// A file that does not describe an arm.
#[derive(Debug, thiserror::Error)]
pub enum ModelError {
    #[error(transparent)]
    Json(#[from] serde_json::Error),
    #[error("name has {0} characters, it must have 1 to {NAME_MOST}")]
    Name(usize),
    #[error("tcp_m is {0}, it must be within ±{LENGTH_MOST_M}")]
    Tcp(f64),
    #[error("{field}[{joint}] is {value}, it must be within ±{most}")]
    Range { field: &'static str, joint: usize, value: f64, most: f64 },
}

/// The parameters as Universal Robots publishes them, joint by joint.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    name: String,
    d_m: [f64; 6],
    a_m: [f64; 6],
    alpha_rad: [f64; 6],
    #[serde(default = "tool_length_m")]
    tcp_m: f64,
}

fn tool_length_m() -> f64 {
    TOOL_LENGTH_M
}

impl Model {
    /// Reads `{"name": "UR5", "d_m": [6 numbers], "a_m": [6 numbers], "alpha_rad": [6 numbers]}`,
    /// and `tcp_m` if it is not [`TOOL_LENGTH_M`].
    ///
    /// # Errors
    /// [`ModelError`].
    pub fn read(text: &str) -> Result<Self, ModelError> {
        let Table { name, d_m, a_m, alpha_rad, tcp_m } = serde_json::from_str(text)?;
        let length = name.chars().count();
        if !(1..=NAME_MOST).contains(&length) {
            return Err(ModelError::Name(length));
        }
        let fields =
            [("d_m", d_m, LENGTH_MOST_M), ("a_m", a_m, LENGTH_MOST_M), ("alpha_rad", alpha_rad, TWIST_MOST_RAD)];
        for (field, values, most) in fields {
            if let Some(joint) = values.iter().position(|value| value.abs() > most) {
                return Err(ModelError::Range { field, joint, value: values[joint], most });
            }
        }
        if tcp_m.abs() > LENGTH_MOST_M {
            return Err(ModelError::Tcp(tcp_m));
        }
        let rows =
            std::array::from_fn(|i| DhRow { d_m: d_m[i], a_m: a_m[i], half_twist: (0.5 * alpha_rad[i]).sin_cos() });
        Ok(Self { name, tcp_m, rows })
    }

    /// Where the elbow is in `base`: the frame of the second link's end.
    pub fn elbow_m(&self, joints: &Joints) -> [f64; 3] {
        let [first, second] = [0, 1].map(|joint| forward::link(&self.rows[joint], joints[joint]));
        (first * second).translation.vector.into()
    }

    /// `base_from_flange`.
    pub fn flange(&self, joints: &Joints) -> Isometry3<f64> {
        let links = self.rows.iter().zip(joints).map(|(row, &angle_rad)| forward::link(row, angle_rad));
        links.fold(Isometry3::identity(), |base_from_link, link| base_from_link * link)
    }

    /// `base_from_tool`, with the flange's axes.
    pub fn tool(&self, joints: &Joints) -> Isometry3<f64> {
        self.flange(joints) * Translation3::new(0.0, 0.0, self.tcp_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_is_the_arm_that_ferry_computes_with() {
        let joints = [-1.6, -1.7, -1.5, -1.4, 1.6, 0.3];
        assert_eq!(Model::default().flange(&joints), forward::flange(&joints));
        // An upper arm of .425 m that points straight up.
        let [x_m, y_m, z_m] = Model::default().elbow_m(&[0.0, -std::f64::consts::FRAC_PI_2, 1.0, 2.0, 3.0, 4.0]);
        assert!(x_m.abs() < 1e-12 && y_m.abs() < 1e-12 && (z_m - 0.514159).abs() < 1e-12);
        let text = r#"{"name": "UR5", "d_m": [0.089159, 0, 0, 0.10915, 0.09465, 0.0823], "a_m": [0, -0.425, -0.39225, 0, 0, 0],
            "alpha_rad": [1.5707963267948966, 0, 0, 1.5707963267948966, -1.5707963267948966, 0]}"#;
        let read = Model::read(text).unwrap().flange(&joints);
        assert!((read.translation.vector - forward::flange(&joints).translation.vector).norm() < 1e-15);
        for (part, other, why) in [
            ("\"UR5\"", "\"\"", "name has 0 characters"),
            ("-0.425", "-425", "a_m[1] is -425, it must be within ±3"),
            ("[0, -0.425", "[-0.425", "invalid length 5"),
            ("\"name\"", "\"arm\"", "unknown field `arm`"),
        ] {
            let refused = Model::read(&text.replace(part, other)).unwrap_err().to_string();
            assert!(refused.contains(why), "{refused}");
        }
    }
}
