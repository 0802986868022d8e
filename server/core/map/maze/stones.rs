//! Round and angular stones on an open floor.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::between;
use super::ink::{Ink, PAGE_MM};

const RADII_MM: [f64; 2] = [12.0, 45.0];
const TRIES: usize = 400;
const MAX_STONES: usize = 40;
/// Corners of a round stone.
const ROUND: usize = 48;

/// Stones with gaps of at least `width_mm` between them and to the border. Some stand in the border.
pub fn stones(width_mm: f64, rng: &mut ChaCha8Rng) -> Ink {
    let [x, y, width, height] = PAGE_MM;
    let mut placed: Vec<[f64; 3]> = Vec::new();
    let mut ink = Ink::default();
    for _ in 0..TRIES {
        let radius_mm = between(RADII_MM[0], RADII_MM[1], rng);
        let at = [between(x, x + width, rng), between(y, y + height, rng)];
        let to_border_mm = (at[0] - x).min(x + width - at[0]).min(at[1] - y).min(y + height - at[1]) - radius_mm;
        let to_others_mm = placed.iter().map(|[px, py, r]| (at[0] - px).hypot(at[1] - py) - r - radius_mm);
        // A stone that only just stands in the border would leave a slit.
        let fits = to_border_mm >= width_mm || to_border_mm <= -0.5 * radius_mm;
        if !fits || to_others_mm.fold(f64::INFINITY, f64::min) < width_mm {
            continue;
        }
        placed.push([at[0], at[1], radius_mm]);
        ink.solid(stone(at, radius_mm, rng));
        if placed.len() >= MAX_STONES {
            break;
        }
    }
    ink
}

/// A circle, or a polygon inside it.
fn stone(at: [f64; 2], radius_mm: f64, rng: &mut ChaCha8Rng) -> Vec<[f64; 2]> {
    let is_round = rng.random_bool(0.5);
    let corners = if is_round { ROUND } else { rng.random_range(4..9) };
    let turn = between(0.0, std::f64::consts::TAU, rng);
    (0..corners)
        .map(|corner| {
            let far_mm = if is_round { radius_mm } else { radius_mm * between(0.65, 1.0, rng) };
            let angle_rad = turn + std::f64::consts::TAU * corner as f64 / corners as f64;
            [at[0] + far_mm * angle_rad.cos(), at[1] + far_mm * angle_rad.sin()]
        })
        .collect()
}
