//! The arm as a model for MuJoCo (<https://mujoco.readthedocs.io/en/stable/XMLreference.html>).

use super::xml::{Element, rgba};
use super::{Form, Link, Shape, links};
use ferry_core::geometry::{Isometry3, Point3};
use ferry_core::plant::{Positioner, PositionerKind};
use ferry_core::robot::ur5::JOINT_LIMIT_RAD;
use ferry_core::scenario::Parameters;

/// Stiffness of a joint's servo per newton metre of its largest torque, 1/rad.
const STIFFNESS_PER_RAD: f64 = 13.0;

/// The MJCF of the arm with gripper and magnet. Each joint has a position servo and, as in the real arm, gravity is
/// compensated. The keyframe `home` is the pose in which Ferry's arm rests. Needs no other file.
pub fn mjcf(parameters: &Parameters) -> String {
    let links = links(parameters);
    let bodies = links.iter().rev().fold(None, |inside, link| Some(body(link).children(inside)));
    let servos = links.iter().filter_map(servo);
    let home = Positioner::home(PositionerKind::Arm, Point3::origin()).joints_rad().unwrap_or_default();
    let key = Element::new("key").with("name", "home").numbers("qpos", &home).numbers("ctrl", &home);
    let joint =
        Element::new("joint").numbers("range", &[-JOINT_LIMIT_RAD, JOINT_LIMIT_RAD]).numbers("armature", &[0.1]);
    // The base does not move, so MuJoCo does not leave out its contacts with the first link by itself.
    let exclude = Element::new("exclude").with("body1", "base").with("body2", "shoulder_link");
    Element::new("mujoco")
        .with("model", "ferry_ur5")
        .child(Element::new("compiler").with("angle", "radian"))
        .child(Element::new("option").with("integrator", "implicitfast"))
        .child(Element::new("default").child(joint))
        .child(Element::new("worldbody").children(bodies))
        .child(Element::new("contact").child(exclude))
        .child(Element::new("actuator").children(servos))
        .child(Element::new("keyframe").child(key))
        .document("Written by `ferry export mjcf`. Metres, kilograms, radians.")
}

fn placed(element: Element, pose: &Isometry3<f64>) -> Element {
    let turn = pose.rotation;
    element.numbers("pos", pose.translation.vector.as_slice()).numbers("quat", &[turn.w, turn.i, turn.j, turn.k])
}

fn body(link: &Link) -> Element {
    let joint = link
        .joint
        .as_ref()
        .map(|joint| Element::new("joint").with("name", joint.name).numbers("axis", &[0.0, 0.0, 1.0]));
    let inertial = link.inertia.as_ref().map(|inertia| {
        Element::new("inertial")
            .numbers("pos", inertia.center_m.as_slice())
            .numbers("mass", &[inertia.mass_kg])
            .numbers("diaginertia", inertia.moments_kg_m2.as_slice())
    });
    placed(Element::new("body").with("name", link.name), &link.parent_from_link)
        .with("gravcomp", "1")
        .children(inertial)
        .children(joint)
        .children(link.shapes.iter().map(geom))
}

fn geom(shape: &Shape) -> Element {
    let geom = placed(Element::new("geom"), &shape.link_from_shape).numbers("rgba", &rgba(shape.color));
    let geom = match &shape.form {
        Form::Cylinder { radius_m, length_m } => {
            geom.with("type", "cylinder").numbers("size", &[*radius_m, 0.5 * length_m])
        }
        Form::Cuboid { size_m } => geom.with("type", "box").numbers("size", (size_m * 0.5).as_slice()),
    };
    // Masses are those of the links.
    let geom = geom.with("mass", "0");
    if shape.collides { geom } else { geom.with("contype", "0").with("conaffinity", "0") }
}

fn servo(link: &Link) -> Option<Element> {
    let joint = link.joint.as_ref()?;
    let servo = Element::new("position")
        .with("name", joint.name)
        .with("joint", joint.name)
        .numbers("kp", &[STIFFNESS_PER_RAD * joint.torque_n_m])
        .with("dampratio", "1")
        .numbers("ctrlrange", &[-JOINT_LIMIT_RAD, JOINT_LIMIT_RAD])
        .numbers("forcerange", &[-joint.torque_n_m, joint.torque_n_m]);
    Some(servo)
}
