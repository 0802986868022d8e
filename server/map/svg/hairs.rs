//! Hairs of filled outlines: lines that go out and come back. They have no area and are not drawn, but rounded
//! coordinates can give them one, and the union keeps it.

use std::collections::VecDeque;

use super::Ring;

/// A hair is narrower, in metres.
const LEAST_WIDTH_M: f64 = 1e-6;
/// The same, relative to the largest coordinate: those of paths are rounded to 24 bits.
const LEAST_WIDTH: f64 = 1e-6;

/// A ring without its hairs; `None` if nothing is left.
pub(super) fn without_hairs(ring: &Ring) -> Option<Ring> {
    let reach_m = ring.as_flattened().iter().fold(0.0, |reach: f64, value| reach.max(value.abs()));
    let width_m = LEAST_WIDTH_M.max(LEAST_WIDTH * reach_m);
    let is_tip = |[a, b, c]: [[f64; 2]; 3]| {
        let [u, v] = [a, c].map(|end| [end[0] - b[0], end[1] - b[1]]);
        let [u_m, v_m] = [u, v].map(|[x, y]| x.hypot(y));
        let (along, across) = (u[0] * v[0] + u[1] * v[1], u[0] * v[1] - u[1] * v[0]);
        u_m == 0.0 || v_m == 0.0 || along > 0.0 && across.abs() <= width_m * u_m.max(v_m)
    };
    let mut left: VecDeque<[f64; 2]> = VecDeque::with_capacity(ring.len());
    for &point in ring {
        left.push_back(point);
        while let n @ 3.. = left.len()
            && is_tip([left[n - 3], left[n - 2], left[n - 1]])
        {
            left.remove(n - 2);
        }
    }
    // Where the ring's end meets its beginning.
    loop {
        let n = left.len();
        if n < 3 {
            return None;
        } else if is_tip([left[n - 2], left[n - 1], left[0]]) {
            left.pop_back();
        } else if is_tip([left[n - 1], left[0], left[1]]) {
            left.pop_front();
        } else {
            return Some(left.into());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_goes_out_and_comes_back_is_removed_and_nothing_else() {
        let square = vec![[0.0, 0.0], [0.04, 0.0], [0.04, 0.04], [0.0, 0.04]];
        assert_eq!(without_hairs(&square), Some(square.clone()));
        let hair = [[0.3, 0.02], [0.31, 0.02 + 1e-7], [0.3, 0.02 + 1e-7]];
        let mut ring = square.clone();
        let feet = [[0.04, 0.02], [0.04, 0.02 + 1e-9]];
        ring.splice(2..2, [feet[0]].into_iter().chain(hair).chain([feet[1]]));
        for _ in 0..ring.len() {
            ring.rotate_left(1);
            let left = without_hairs(&ring).unwrap();
            assert!(left.iter().all(|[x, _]| *x <= 0.04), "{left:?}");
            assert!(square.iter().all(|corner| left.contains(corner)), "{left:?}");
        }
        assert_eq!(without_hairs(&vec![[0.1033, -0.005], [0.2815, -0.005], [0.1048, -0.005_000_004]]), None);
        // A needle that can be seen stays.
        let needle = vec![[0.0, 0.0], [0.1, 0.000_01], [0.1, 0.0]];
        assert_eq!(without_hairs(&needle), Some(needle.clone()));
    }
}
