//! The arm as a URDF (<http://wiki.ros.org/urdf/XML>).

use super::xml::{Element, rgba};
use super::{Form, Inertia, Link, Shape, links, roll_pitch_yaw};
use ferry_core::geometry::Isometry3;
use ferry_core::robot::ur5::{JOINT_LIMIT_RAD, JOINT_SPEED_LIMIT_RAD_S};
use ferry_core::scenario::Parameters;

/// The URDF of the arm with gripper and magnet. Needs no other file.
pub fn urdf(parameters: &Parameters) -> String {
    let links = links(parameters);
    let joints = links.windows(2).map(|pair| joint(&pair[0], &pair[1]));
    Element::new("robot")
        .with("name", "ferry_ur5")
        .children(links.iter().map(link).chain(joints))
        .document("Written by `ferry export urdf`. Metres, kilograms, radians.")
}

fn origin(pose: &Isometry3<f64>) -> Element {
    Element::new("origin").numbers("xyz", pose.translation.vector.as_slice()).numbers("rpy", &roll_pitch_yaw(pose))
}

fn link(link: &Link) -> Element {
    // PyBullet and MuJoCo give a link without it a mass of their own.
    let without = Inertia::default();
    let inertia = link.inertia.as_ref().unwrap_or(&without);
    let [x, y, z] = inertia.moments_kg_m2.into();
    let mut matrix = Element::new("inertia");
    for (name, value) in [("ixx", x), ("ixy", 0.0), ("ixz", 0.0), ("iyy", y), ("iyz", 0.0), ("izz", z)] {
        matrix = matrix.numbers(name, &[value]);
    }
    let inertial = Element::new("inertial")
        .child(origin(&Isometry3::from_parts(inertia.center_m.into(), nalgebra::UnitQuaternion::identity())))
        .child(Element::new("mass").numbers("value", &[inertia.mass_kg]))
        .child(matrix);
    let collisions = link.shapes.iter().filter(|shape| shape.collides).map(|shape| solid("collision", shape));
    Element::new("link")
        .with("name", link.name)
        .child(inertial)
        .children(link.shapes.iter().map(visual))
        .children(collisions)
}

fn visual(shape: &Shape) -> Element {
    let [red, green, blue] = shape.color;
    let color = Element::new("color").numbers("rgba", &rgba(shape.color));
    let name = format!("rgb_{red}_{green}_{blue}");
    solid("visual", shape).child(Element::new("material").with("name", name).child(color))
}

fn solid(role: &'static str, shape: &Shape) -> Element {
    let form = match &shape.form {
        Form::Cylinder { radius_m, length_m } => {
            Element::new("cylinder").numbers("radius", &[*radius_m]).numbers("length", &[*length_m])
        }
        Form::Cuboid { size_m } => Element::new("box").numbers("size", size_m.as_slice()),
    };
    Element::new(role).child(origin(&shape.link_from_shape)).child(Element::new("geometry").child(form))
}

fn joint(parent: &Link, child: &Link) -> Element {
    let (name, kind) = match &child.joint {
        Some(joint) => (joint.name.to_owned(), "revolute"),
        None => (format!("{}_fixed_joint", child.name), "fixed"),
    };
    let joint = Element::new("joint")
        .with("name", name)
        .with("type", kind)
        .child(Element::new("parent").with("link", parent.name))
        .child(Element::new("child").with("link", child.name))
        .child(origin(&child.parent_from_link));
    let Some(turning) = &child.joint else { return joint };
    let limit = Element::new("limit")
        .numbers("lower", &[-JOINT_LIMIT_RAD])
        .numbers("upper", &[JOINT_LIMIT_RAD])
        .numbers("effort", &[turning.torque_n_m])
        .numbers("velocity", &[JOINT_SPEED_LIMIT_RAD_S]);
    joint.child(Element::new("axis").numbers("xyz", &[0.0, 0.0, 1.0])).child(limit)
}
