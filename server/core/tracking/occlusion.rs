//! What hides the bead from the optical tracker: the arm, between the two.

use crate::geometry::{Isometry3, Point3, Vector3};
use crate::robot::ur5::{A2_M, A3_M, FOREARM_ASIDE_M, UPPER_ARM_ASIDE_M};

/// Where the tracker is, in `base`: beside the table, above head height of a seated user.
pub const TRACKER_M: [f64; 3] = [0.9, -0.1, 0.9];
const UPPER_ARM_RADIUS_M: f64 = 0.05;
const FOREARM_RADIUS_M: f64 = 0.042;
const WRIST_RADIUS_M: f64 = 0.04;
/// Of the gripper with the block, which is 50 mm long.
const GRIPPER_RADIUS_M: f64 = 0.025;

/// Whether the arm is between the tracker and a bead: its limbs are capsules around the centre lines. A planar stage has
/// only the holder of the magnet, which is as long as a gripper.
pub fn is_hidden(bead_m: Point3<f64>, tool_m: Point3<f64>, link_frames: Option<&[Isometry3<f64>; 6]>) -> bool {
    let sight = [Point3::from(TRACKER_M), bead_m];
    let meets = |limb: [Point3<f64>; 2], radius_m: f64| distance_m(sight, limb) < radius_m;
    let holder_m = Vector3::new(0.0, 0.0, 0.18);
    let Some(frames) = link_frames else { return meets([tool_m, tool_m + holder_m], GRIPPER_RADIUS_M) };
    let origin = |frame: usize| Point3::from(frames[frame].translation.vector);
    let limb = |frame: usize, length_m: f64, aside_m: f64| {
        [length_m, 0.0].map(|along_m| frames[frame] * Point3::new(along_m, 0.0, aside_m))
    };
    meets(limb(1, -A2_M, UPPER_ARM_ASIDE_M), UPPER_ARM_RADIUS_M)
        || meets(limb(2, -A3_M, FOREARM_ASIDE_M), FOREARM_RADIUS_M)
        || (2..5).any(|frame| meets([origin(frame), origin(frame + 1)], WRIST_RADIUS_M))
        || meets([origin(5), tool_m], GRIPPER_RADIUS_M)
}

/// Distance between two segments (Ericson, "Real-Time Collision Detection", 2005, §5.1.9).
fn distance_m([p1, q1]: [Point3<f64>; 2], [p2, q2]: [Point3<f64>; 2]) -> f64 {
    let (d1, d2, r) = (q1 - p1, q2 - p2, p1 - p2);
    let (a, b, e) = (d1.norm_squared(), d1.dot(&d2), d2.norm_squared());
    let (c, f) = (d1.dot(&r), d2.dot(&r));
    if a == 0.0 || e == 0.0 {
        // One of them is a point.
        let t = if e > 0.0 { (f / e).clamp(0.0, 1.0) } else { 0.0 };
        let s = if a > 0.0 { (-c / a).clamp(0.0, 1.0) } else { 0.0 };
        return (p1 + d1 * s - (p2 + d2 * t)).norm();
    }
    let denominator = a * e - b * b;
    let s = if denominator > 0.0 { ((b * f - c * e) / denominator).clamp(0.0, 1.0) } else { 0.0 };
    let t = (b * s + f) / e;
    let (s, t) = match t {
        t if t < 0.0 => ((-c / a).clamp(0.0, 1.0), 0.0),
        t if t > 1.0 => (((b - c) / a).clamp(0.0, 1.0), 1.0),
        t => (s, t),
    };
    (p1 + d1 * s - (p2 + d2 * t)).norm()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn a_gripper_hides_what_is_behind_it() {
        let tool_m = Point3::new(0.0, -0.4, 0.1);
        let toward = (Point3::from(TRACKER_M) - tool_m).xy().normalize();
        let slope = (TRACKER_M[2] - 0.15) / (Point3::from(TRACKER_M) - tool_m).xy().norm();
        // The sight line passes the gripper half way up.
        let behind = tool_m.xy() - toward * (0.15 / slope);
        assert!(is_hidden(Point3::new(behind.x, behind.y, 0.0025), tool_m, None));
        let before = tool_m.xy() + toward * 0.05;
        assert!(!is_hidden(Point3::new(before.x, before.y, 0.0025), tool_m, None));
    }

    proptest! {
        #[test]
        fn no_two_places_are_nearer_than_the_distance(
            ends in prop::array::uniform12(-1.0..1.0_f64), s in 0.0..=1.0_f64, t in 0.0..=1.0_f64,
        ) {
            let point = |i: usize| Point3::new(ends[i], ends[i + 1], ends[i + 2]);
            let (one, other) = ([point(0), point(3)], [point(6), point(9)]);
            let place = |[from, to]: [Point3<f64>; 2], share: f64| from + (to - from) * share;
            let found_m = distance_m(one, other);
            prop_assert!(found_m <= (place(one, s) - place(other, t)).norm() + 1e-12);
            let grid = (0..=60).flat_map(|i| (0..=60).map(move |j| (f64::from(i) / 60.0, f64::from(j) / 60.0)));
            let nearest_m = grid.map(|(s, t)| (place(one, s) - place(other, t)).norm()).fold(f64::INFINITY, f64::min);
            prop_assert!(nearest_m - found_m < 0.06, "{nearest_m} {found_m}");
        }
    }
}
