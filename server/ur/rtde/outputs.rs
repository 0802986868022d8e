//! What a controller reports, by name. What Ferry does not simulate is 0, as on a robot at rest: currents, voltages,
//! temperatures, digital and analog signals.

use super::Arm;
use crate::controller::Controller;
use crate::registers::REGISTERS;

/// One output of a recipe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// One with a name of its own, by its place in the table.
    Named(usize),
    IntOutput(usize),
    DoubleOutput(usize),
    IntInput(usize),
    DoubleInput(usize),
    BitRegister,
}

/// A value with one of RTDE's types.
enum Value {
    Bool(bool),
    Uint8(u8),
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
/// Of `tool_mode`: the tool's electronics run.
const TOOL_RUNNING: u32 = 253;

type Read = fn(&Arm, &Controller) -> Value;

const NAMED: &[(&str, Read)] = &[
    ("timestamp", |arm, _| Value::Double(arm.time_s)),
    ("target_q", |arm, _| Value::Vector6(arm.target_q_rad)),
    ("target_qd", |arm, _| Value::Vector6(arm.target_qd_rad_s)),
    ("target_qdd", |arm, _| Value::Vector6(arm.target_qdd_rad_s2)),
    ("target_current", |_, _| Value::Vector6([0.0; 6])),
    ("target_moment", |_, _| Value::Vector6([0.0; 6])),
    ("actual_q", |arm, _| Value::Vector6(arm.actual_q_rad)),
    ("actual_qd", |arm, _| Value::Vector6(arm.actual_qd_rad_s)),
    ("actual_current", |_, _| Value::Vector6([0.0; 6])),
    ("joint_control_output", |_, _| Value::Vector6([0.0; 6])),
    ("actual_TCP_pose", |arm, _| Value::Vector6(arm.actual_tool)),
    ("actual_TCP_speed", |arm, _| Value::Vector6(arm.actual_tool_speed)),
    ("actual_TCP_force", |arm, _| Value::Vector6(arm.tool_force)),
    ("target_TCP_pose", |arm, _| Value::Vector6(arm.target_tool)),
    ("target_TCP_speed", |arm, _| Value::Vector6(arm.target_tool_speed)),
    ("tcp_force_scalar", |arm, _| Value::Double(arm.tool_force.iter().map(|n| n * n).sum::<f64>().sqrt())),
    ("actual_digital_input_bits", |_, _| Value::Uint64(0)),
    ("actual_digital_output_bits", |_, _| Value::Uint64(0)),
    ("joint_temperatures", |_, _| Value::Vector6([0.0; 6])),
    ("actual_execution_time", |_, _| Value::Double(0.0)),
    ("robot_mode", |arm, _| Value::Int32(if arm.has_joints { RUNNING } else { DISCONNECTED })),
    ("joint_mode", |arm, _| Value::Vector6Int32([if arm.has_joints { JOINT_RUNNING } else { JOINT_POWER_OFF }; 6])),
    ("safety_mode", |_, robot| Value::Int32(robot.safety_mode())),
    ("safety_status", |_, robot| Value::Int32(robot.safety_mode())),
    ("actual_tool_accelerometer", |_, _| Value::Vector3([0.0; 3])),
    ("speed_scaling", |_, robot| Value::Double(robot.speed_fraction())),
    ("target_speed_fraction", |_, robot| Value::Double(robot.speed_fraction())),
    ("actual_momentum", |_, _| Value::Double(0.0)),
    ("actual_main_voltage", |_, _| Value::Double(0.0)),
    ("actual_robot_voltage", |_, _| Value::Double(0.0)),
    ("actual_robot_current", |_, _| Value::Double(0.0)),
    ("actual_joint_voltage", |_, _| Value::Vector6([0.0; 6])),
    ("joint_position_deviation_ratio", |_, _| Value::Double(0.0)),
    ("runtime_state", |_, robot| Value::Uint32(if robot.is_running() { 2 } else { 1 })),
    ("robot_status_bits", |arm, robot| Value::Uint32(u32::from(arm.has_joints) | u32::from(robot.is_running()) << 1)),
    ("safety_status_bits", |_, robot| Value::Uint32(if robot.is_stopped() { 1 << 2 } else { 1 })),
    ("standard_analog_input0", |_, _| Value::Double(0.0)),
    ("standard_analog_input1", |_, _| Value::Double(0.0)),
    ("standard_analog_output0", |_, _| Value::Double(0.0)),
    ("standard_analog_output1", |_, _| Value::Double(0.0)),
    ("analog_io_types", |_, _| Value::Uint32(0)),
    ("io_current", |_, _| Value::Double(0.0)),
    ("tool_mode", |_, _| Value::Uint32(TOOL_RUNNING)),
    ("tool_analog_input_types", |_, _| Value::Uint32(0)),
    ("tool_analog_input0", |_, _| Value::Double(0.0)),
    ("tool_analog_input1", |_, _| Value::Double(0.0)),
    ("tool_output_mode", |_, _| Value::Uint8(0)),
    ("tool_output_voltage", |_, _| Value::Int32(0)),
    ("tool_output_current", |_, _| Value::Double(0.0)),
    ("tool_temperature", |_, _| Value::Double(0.0)),
    ("elbow_position", |arm, _| Value::Vector3(arm.elbow_m)),
    ("elbow_velocity", |arm, _| Value::Vector3(arm.elbow_m_s)),
    ("script_control_line", |_, _| Value::Uint32(0)),
    ("payload", |_, _| Value::Double(0.0)),
    ("payload_cog", |_, _| Value::Vector3([0.0; 3])),
    ("payload_inertia", |_, _| Value::Vector6([0.0; 6])),
    ("output_bit_registers0_to_31", |_, _| Value::Uint32(0)),
    ("output_bit_registers32_to_63", |_, _| Value::Uint32(0)),
    ("input_bit_registers0_to_31", |_, _| Value::Uint32(0)),
    ("input_bit_registers32_to_63", |_, _| Value::Uint32(0)),
];

impl Output {
    pub fn named(name: &str) -> Option<Self> {
        if let Some(place) = NAMED.iter().position(|(known, _)| *known == name) {
            return Some(Self::Named(place));
        }
        let (kind, number) = name.split_once("_register_")?;
        let number: usize = number.parse().ok()?;
        match kind {
            "output_int" if number < REGISTERS => Some(Self::IntOutput(number)),
            "output_double" if number < REGISTERS => Some(Self::DoubleOutput(number)),
            "input_int" if number < REGISTERS => Some(Self::IntInput(number)),
            "input_double" if number < REGISTERS => Some(Self::DoubleInput(number)),
            "output_bit" | "input_bit" if (64..128).contains(&number) => Some(Self::BitRegister),
            _ => None,
        }
    }

    fn value(self, arm: &Arm, robot: &Controller) -> Value {
        match self {
            Self::Named(place) => NAMED[place].1(arm, robot),
            Self::IntOutput(number) => Value::Int32(robot.outputs().int[number]),
            Self::DoubleOutput(number) => Value::Double(robot.outputs().double[number]),
            Self::IntInput(number) => Value::Int32(robot.inputs().int[number]),
            Self::DoubleInput(number) => Value::Double(robot.inputs().double[number]),
            Self::BitRegister => Value::Bool(false),
        }
    }

    /// RTDE's name of its type.
    pub fn type_name(self) -> &'static str {
        match self.value(&Arm::default(), &Controller::default()) {
            Value::Bool(_) => "BOOL",
            Value::Uint8(_) => "UINT8",
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
    pub fn write(self, arm: &Arm, robot: &Controller, bytes: &mut Vec<u8>) {
        match self.value(arm, robot) {
            Value::Bool(value) => bytes.push(u8::from(value)),
            Value::Uint8(value) => bytes.push(value),
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
        assert_eq!(Output::named("output_int_register_47"), Some(Output::IntOutput(47)));
        assert_eq!(Output::named("input_double_register_0"), Some(Output::DoubleInput(0)));
        assert_eq!(Output::named("output_bit_register_64"), Some(Output::BitRegister));
        for name in ["output_int_register_48", "output_bit_register_63", "int_register_1", "output_wing_register_1", ""]
        {
            assert_eq!(Output::named(name), None, "{name}");
        }
        assert_eq!(Output::named("joint_mode").unwrap().type_name(), "VECTOR6INT32");
    }
}
