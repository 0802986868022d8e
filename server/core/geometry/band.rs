//! What walls cover beyond their drawn place.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::float::simplify::SimplifyShape;

/// The closed band between two rings with as many points: what a wall covers beyond its drawn place. Where other walls
/// cover it, its edge may cross itself and the edges of other bands.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Band {
    /// The drawn place, `[x_m, y_m]` for each point, with the free side on the left.
    pub foot_m: Vec<[f64; 2]>,
    /// Where the wall is now.
    pub edge_m: Vec<[f64; 2]>,
}

impl Band {
    /// The closed outlines of what all bands of a map leave free, which is on their left. They do not cross.
    pub fn outlines(bands: &[Self]) -> Vec<Vec<[f64; 2]>> {
        let edges: Vec<_> = bands.iter().map(|band| band.edge_m.clone()).collect();
        edges.simplify_shape_as::<i64>(FillRule::Positive).into_iter().flatten().collect()
    }
}
