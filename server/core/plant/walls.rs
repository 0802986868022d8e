//! The walls as they are now: at rest, or moved by contractions.

use std::ops::RangeInclusive;
use std::sync::{Arc, OnceLock};

use super::lumen::Lumen;
use super::peristalsis::WallMotion;
use super::{BEAD_RADIUS_M, fit};
use crate::geometry::{Band, Point2, Rect, Vector2};
use crate::map::Map;
use crate::robot::ur5::SERVO_PERIOD_S;

/// The lumen of a map, computed when it is first used. Copies share it.
#[derive(Clone, Debug, Default)]
pub struct LazyLumen(Arc<OnceLock<Lumen>>);

impl LazyLumen {
    #[cfg(test)]
    pub(super) fn with(lumen: Lumen) -> Self {
        Self(Arc::new(OnceLock::from(lumen)))
    }

    /// `map` is always the same.
    pub fn of(&self, map: &Map) -> &Lumen {
        self.0.get_or_init(|| Lumen::of(map))
    }
}

/// Everything around the bead that stays the same during a trial.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    pub map: &'a Map,
    pub lumen: &'a LazyLumen,
    /// Of the contractions' strengths.
    pub seed: u64,
}

impl<'a> Surroundings<'a> {
    /// A map whose contractions have the seed 0.
    pub fn of(map: &'a Map, lumen: &'a LazyLumen) -> Self {
        Self { map, lumen, seed: 0 }
    }

    pub fn lumen(&self) -> &'a Lumen {
        self.lumen.of(self.map)
    }

    /// How far the walls close in at the lumen's knots.
    pub fn wave_m(&self, motion: &WallMotion, tick: u64) -> Vec<f64> {
        self.wave_beside_m(motion, tick, &(0.0..=f64::INFINITY))
    }

    /// The same for a part of the lumen; 0 outside of it.
    fn wave_beside_m(&self, motion: &WallMotion, tick: u64, beside_m: &RangeInclusive<f64>) -> Vec<f64> {
        let knots_m = self.lumen().knots_m();
        let first = knots_m.clone().take_while(|knot_m| knot_m < beside_m.start()).count();
        let inside_m = knots_m.clone().skip(first).take_while(|knot_m| knot_m <= beside_m.end());
        let mut wave_m = vec![0.0; first];
        wave_m.extend(motion.wave_m(inside_m, tick as f64 * SERVO_PERIOD_S));
        wave_m.resize(knots_m.count(), 0.0);
        wave_m
    }

    /// The walls at a tick.
    pub fn walls(&self, motion: Option<&WallMotion>, tick: u64) -> Walls<'a> {
        match motion {
            None => Walls { around: *self, moving: None },
            Some(motion) => self.walls_with(self.wave_m(motion, tick), self.wave_m(motion, tick + 1)),
        }
    }

    /// The walls from a tick to the next, at its beginning, as far as they can touch a bead.
    pub(super) fn walls_between(
        &self,
        before: Option<&WallMotion>,
        after: Option<&WallMotion>,
        tick: u64,
        bead_m: Point2<f64>,
    ) -> Walls<'a> {
        if before.is_none() && after.is_none() {
            return Walls { around: *self, moving: None };
        }
        let beside_m = self.lumen().beside_m(bead_m);
        let wave_m = |motion: Option<&WallMotion>, tick| match motion {
            Some(motion) => self.wave_beside_m(motion, tick, &beside_m),
            None => vec![0.0; self.lumen().knots_m().count()],
        };
        self.walls_with(wave_m(before, tick), wave_m(after, tick + 1))
    }

    /// Walls that follow one wave at the beginning of a tick and another at its end.
    pub(super) fn walls_with(&self, before_m: Vec<f64>, after_m: Vec<f64>) -> Walls<'a> {
        let now_m = before_m.clone();
        Walls { around: *self, moving: Some(Moving { before_m, after_m, now_m }) }
    }

    /// What the walls cover beyond their drawn place; `None` at rest.
    pub fn bands(&self, motion: Option<&WallMotion>, tick: u64, bead_m: Point2<f64>) -> Option<Vec<Band>> {
        motion.map(|motion| self.lumen().bands(&self.wave_m(motion, tick), bead_m))
    }
}

/// Walls at a moment.
#[derive(Clone, Debug)]
pub struct Walls<'a> {
    around: Surroundings<'a>,
    moving: Option<Moving>,
}

/// The waves at the knots at the beginning and at the end of a tick, and at the moment.
#[derive(Clone, Debug)]
struct Moving {
    before_m: Vec<f64>,
    after_m: Vec<f64>,
    now_m: Vec<f64>,
}

/// The nearest place of a wall.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    pub wall_m: Point2<f64>,
    /// From the wall to the bead; `None` if the bead is exactly on it.
    pub normal: Option<Vector2<f64>>,
    /// How fast the wall moves along the normal.
    pub speed_m_s: f64,
}

impl Walls<'_> {
    pub(super) fn are_moving(&self) -> bool {
        self.moving.is_some()
    }

    /// Moves on to a share of the tick.
    pub(super) fn advance_to(&mut self, part: f64) {
        if let Some(Moving { before_m, after_m, now_m, .. }) = &mut self.moving {
            for ((now_m, before_m), after_m) in now_m.iter_mut().zip(before_m).zip(after_m) {
                *now_m = *before_m * (1.0 - part) + *after_m * part;
            }
        }
    }

    /// The nearest place of a wall within `within_m` of a point, at most a bead's radius and a little.
    pub(super) fn touch(&self, point: Point2<f64>, within_m: f64) -> Option<Touch> {
        let Some(moving) = &self.moving else {
            let wall_m = self.around.map.nearest_wall_point_within(point, within_m)?;
            return Some(Touch { wall_m, normal: (point - wall_m).try_normalize(1e-12), speed_m_s: 0.0 });
        };
        let Moving { before_m, after_m, now_m } = moving;
        let lumen = self.around.lumen();
        let nearest = lumen.nearest_within(point, within_m, now_m)?;
        let change_m = lumen.closing_at_m(&nearest, after_m) - lumen.closing_at_m(&nearest, before_m);
        Some(Touch {
            wall_m: point - nearest.normal * nearest.distance_m,
            normal: Some(nearest.normal),
            speed_m_s: change_m / SERVO_PERIOD_S,
        })
    }

    /// Whether the bead fits at a place while the walls are at their drawn place.
    pub(super) fn fits_between_drawn(&self, point: Point2<f64>) -> bool {
        self.around.map.nearest_wall_point_within(point, BEAD_RADIUS_M - 1e-9).is_none()
    }

    /// Distance from the nearest wall: positive in free space, negative inside a wall. Beside moving walls it is exact
    /// where the bead touches them, and elsewhere at most the distance.
    pub fn clearance_m(&self, point: Point2<f64>) -> f64 {
        let drawn_m = self.around.map.clearance_m(point);
        let Some(Moving { now_m, .. }) = &self.moving else { return drawn_m };
        if drawn_m <= 0.0 {
            return drawn_m;
        }
        match self.around.lumen().nearest_within(point, BEAD_RADIUS_M, now_m) {
            Some(nearest) => nearest.distance_m,
            None => drawn_m.min(BEAD_RADIUS_M),
        }
    }

    /// The nearest point to `wanted` at which the bead fits; to a millimetre.
    pub fn nearest_fit(&self, wanted: Point2<f64>) -> Option<Point2<f64>> {
        fit::nearest_fit(self.workspace(), wanted, |point| self.clearance_m(point))
    }

    pub(super) fn workspace(&self) -> &Rect {
        self.around.map.workspace()
    }

    /// Direction of a fluid that flows along the lumen; see [`Lumen::flow`].
    pub(super) fn flow(&self, point: Point2<f64>) -> Vector2<f64> {
        self.around.lumen().flow(point)
    }
}
