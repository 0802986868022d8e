//! What a controller reports, by name. What Ferry does not simulate is 0, as on a robot at rest: currents, voltages,
//! temperatures, digital and analog signals, and the registers, which only a program on the robot could set.

use super::Arm;

/// Registers of each type.
const REGISTERS: usize = 48;

/// One output of a recipe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// One with a name of its own, by its place in the table.
    Named(usize),
    IntRegister,
    DoubleRegister,
    BitRegister,
}

/// A value with one of RTDE's types.
enum Value {
    Bool(bool),
    Uint32(u32),
    Uint64(u64),
    Int32(i32),
    Double(f64),
    Vector3([f64; 3]),
    Vector6([f64; 6]),
    Vector6Int32([i32; 6]),
}

const RUNNING: i32 = 7;
const DISCONNECTED: i32 = 0;
/// A joint that follows its controller.
const JOINT_RUNNING: i32 = 255;
const JOINT_POWER_OFF: i32 = 239;

type Read = fn(&Arm) -> Value;

const NAMED: &[(&str, Read)] = &[
    ("timestamp", |arm| Value::Double(arm.time_s)),
    ("target_q", |arm| Value::Vector6(arm.target_q_rad)),
    ("target_qd", |arm| Value::Vector6(arm.target_qd_rad_s)),
    ("target_qdd", |arm| Value::Vector6(arm.target_qdd_rad_s2)),
    ("target_current", |_| Value::Vector6([0.0; 6])),
    ("target_moment", |_| Value::Vector6([0.0; 6])),
    ("actual_q", |arm| Value::Vector6(arm.actual_q_rad)),
    ("actual_qd", |arm| Value::Vector6(arm.actual_qd_rad_s)),
    ("actual_current", |_| Value::Vector6([0.0; 6])),
    ("joint_control_output", |_| Value::Vector6([0.0; 6])),
    ("actual_TCP_pose", |arm| Value::Vector6(arm.actual_tool)),
    ("actual_TCP_speed", |arm| Value::Vector6(arm.actual_tool_speed)),
    ("actual_TCP_force", |arm| Value::Vector6(arm.tool_force)),
    ("target_TCP_pose", |arm| Value::Vector6(arm.target_tool)),
    ("target_TCP_speed", |arm| Value::Vector6(arm.target_tool_speed)),
    ("tcp_force_scalar", |arm| Value::Double(arm.tool_force.iter().map(|n| n * n).sum::<f64>().sqrt())),
    ("actual_digital_input_bits", |_| Value::Uint64(0)),
    ("actual_digital_output_bits", |_| Value::Uint64(0)),
    ("joint_temperatures", |_| Value::Vector6([0.0; 6])),
    ("actual_execution_time", |_| Value::Double(0.0)),
    ("robot_mode", |arm| Value::Int32(if arm.has_joints { RUNNING } else { DISCONNECTED })),
    ("joint_mode", |arm| Value::Vector6Int32([if arm.has_joints { JOINT_RUNNING } else { JOINT_POWER_OFF }; 6])),
    ("safety_mode", |_| Value::Int32(1)),
    ("safety_status", |_| Value::Int32(1)),
    ("actual_tool_accelerometer", |_| Value::Vector3([0.0; 3])),
    ("speed_scaling", |_| Value::Double(1.0)),
    ("target_speed_fraction", |_| Value::Double(1.0)),
    ("actual_momentum", |_| Value::Double(0.0)),
    ("actual_main_voltage", |_| Value::Double(0.0)),
    ("actual_robot_voltage", |_| Value::Double(0.0)),
    ("actual_robot_current", |_| Value::Double(0.0)),
    ("actual_joint_voltage", |_| Value::Vector6([0.0; 6])),
    // No program runs.
    ("runtime_state", |_| Value::Uint32(1)),
    ("robot_status_bits", |arm| Value::Uint32(u32::from(arm.has_joints))),
    ("safety_status_bits", |_| Value::Uint32(1)),
    ("standard_analog_input0", |_| Value::Double(0.0)),
    ("standard_analog_input1", |_| Value::Double(0.0)),
    ("standard_analog_output0", |_| Value::Double(0.0)),
    ("standard_analog_output1", |_| Value::Double(0.0)),
    ("payload", |_| Value::Double(0.0)),
    ("payload_cog", |_| Value::Vector3([0.0; 3])),
    ("payload_inertia", |_| Value::Vector6([0.0; 6])),
    ("output_bit_registers0_to_31", |_| Value::Uint32(0)),
    ("output_bit_registers32_to_63", |_| Value::Uint32(0)),
    ("input_bit_registers0_to_31", |_| Value::Uint32(0)),
    ("input_bit_registers32_to_63", |_| Value::Uint32(0)),
];

impl Output {
    pub fn named(name: &str) -> Option<Self> {
        if let Some(place) = NAMED.iter().position(|(known, _)| *known == name) {
            return Some(Self::Named(place));
        }
        let register = name.strip_prefix("output_").or_else(|| name.strip_prefix("input_"))?;
        let (kind, number) = register.split_once("_register_")?;
        let number: usize = number.parse().ok()?;
        match kind {
            "int" if number < REGISTERS => Some(Self::IntRegister),
            "double" if number < REGISTERS => Some(Self::DoubleRegister),
            "bit" if (64..128).contains(&number) => Some(Self::BitRegister),
            _ => None,
        }
    }

    fn value(self, arm: &Arm) -> Value {
        match self {
            Self::Named(place) => NAMED[place].1(arm),
            Self::IntRegister => Value::Int32(0),
            Self::DoubleRegister => Value::Double(0.0),
            Self::BitRegister => Value::Bool(false),
        }
    }

    /// RTDE's name of its type.
    pub fn type_name(self) -> &'static str {
        match self.value(&Arm::default()) {
            Value::Bool(_) => "BOOL",
            Value::Uint32(_) => "UINT32",
            Value::Uint64(_) => "UINT64",
            Value::Int32(_) => "INT32",
            Value::Double(_) => "DOUBLE",
            Value::Vector3(_) => "VECTOR3D",
            Value::Vector6(_) => "VECTOR6D",
            Value::Vector6Int32(_) => "VECTOR6INT32",
        }
    }

    /// Appends its value.
    pub fn write(self, arm: &Arm, bytes: &mut Vec<u8>) {
        match self.value(arm) {
            Value::Bool(value) => bytes.push(u8::from(value)),
            Value::Uint32(value) => bytes.extend(value.to_be_bytes()),
            Value::Uint64(value) => bytes.extend(value.to_be_bytes()),
            Value::Int32(value) => bytes.extend(value.to_be_bytes()),
            Value::Double(value) => bytes.extend(value.to_be_bytes()),
            Value::Vector3(values) => bytes.extend(values.map(f64::to_be_bytes).as_flattened()),
            Value::Vector6(values) => bytes.extend(values.map(f64::to_be_bytes).as_flattened()),
            Value::Vector6Int32(values) => bytes.extend(values.map(i32::to_be_bytes).as_flattened()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn registers_are_found_by_number() {
        assert_eq!(Output::named("output_int_register_47"), Some(Output::IntRegister));
        assert_eq!(Output::named("input_double_register_0"), Some(Output::DoubleRegister));
        assert_eq!(Output::named("output_bit_register_64"), Some(Output::BitRegister));
        for name in ["output_int_register_48", "output_bit_register_63", "int_register_1", "output_wing_register_1", ""]
        {
            assert_eq!(Output::named(name), None, "{name}");
        }
        assert_eq!(Output::named("joint_mode").unwrap().type_name(), "VECTOR6INT32");
    }
}
