//! Hairs of filled outlines: lines that go out and come back. They have no area and are not drawn, but rounded
//! coordinates can give them one, and the union keeps it.

use std::collections::VecDeque;

use super::Ring;

/// A hair is narrower, in metres.
const LEAST_WIDTH_M: f64 = 1e-6;
/// The same, relative to the largest coordinate: those of paths are rounded to 24 bits.
const LEAST_WIDTH: f64 = 1e-6;
/// Hairs are longer in all. Outlines often have points that are nearly the same.
const LEAST_LENGTH_M: f64 = 1e-4;

/// A ring without its hairs; `None` if nothing is left. A ring that has none stays as it is to the last bit.
pub(super) fn without_hairs(ring: &Ring) -> Option<Ring> {
    let reach_m = ring.as_flattened().iter().fold(0.0, |reach: f64, value| reach.max(value.abs()));
    let width_m = LEAST_WIDTH_M.max(LEAST_WIDTH * reach_m);
    // The length of a tip, if it is one.
    let tip_m = |[a, b, c]: [[f64; 2]; 3]| {
        let [u, v] = [a, c].map(|end| [end[0] - b[0], end[1] - b[1]]);
        let [u_m, v_m] = [u, v].map(|[x, y]| x.hypot(y));
        let (along, across) = (u[0] * v[0] + u[1] * v[1], u[0] * v[1] - u[1] * v[0]);
        let is_tip = u_m == 0.0 || v_m == 0.0 || along > 0.0 && across.abs() <= width_m * u_m.max(v_m);
        is_tip.then(|| u_m.min(v_m))
    };
    let mut removed_m = 0.0;
    let mut left: VecDeque<[f64; 2]> = VecDeque::with_capacity(ring.len());
    for &point in ring {
        left.push_back(point);
        while let n @ 3.. = left.len()
            && let Some(length_m) = tip_m([left[n - 3], left[n - 2], left[n - 1]])
        {
            left.remove(n - 2);
            removed_m += length_m;
        }
    }
    // Where the ring's end meets its beginning.
    while let n @ 3.. = left.len() {
        if let Some(length_m) = tip_m([left[n - 2], left[n - 1], left[0]]) {
            left.pop_back();
            removed_m += length_m;
        } else if let Some(length_m) = tip_m([left[n - 1], left[0], left[1]]) {
            left.pop_front();
            removed_m += length_m;
        } else {
            break;
        }
    }
    match removed_m < LEAST_LENGTH_M {
        true => Some(ring.clone()),
        false => (left.len() >= 3).then(|| left.into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_goes_out_and_comes_back_is_removed_and_nothing_else() {
        let square = vec![[0.0, 0.0], [0.04, 0.0], [0.04, 0.04], [0.0, 0.04]];
        let doubled = vec![[0.0, 0.0], [0.04, 0.0], [0.04, 1e-7], [0.04 + 1e-8, 0.0], [0.04, 0.04], [0.0, 0.04]];
        for whole in [&square, &doubled] {
            assert_eq!(without_hairs(whole), Some(whole.clone()));
        }
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
