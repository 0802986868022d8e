//! The cells of a map of places, coarse where all neighbours agree.

use super::Spot;
use ferry_core::geometry::Point2;
use ferry_core::map::Map;
use ferry_core::plant::BEAD_RADIUS_M;

/// A coarse cell has this many columns and rows of fine ones. Odd, so that both have a common centre.
const COARSE: usize = 3;

/// Square cells over a map. A cell without room for the bead at its centre is left out.
#[derive(Clone, Debug)]
pub struct Grid {
    columns: usize,
    size_m: f64,
    origin_m: Point2<f64>,
    /// Whether the bead fits at the centre. Row by row from the lower left.
    free: Vec<bool>,
    /// Whether no wall touches the cell.
    clear: Vec<bool>,
}

/// A cell, fine or coarse, by the index of the fine cell at its centre.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    pub center: usize,
    pub is_coarse: bool,
}

impl Grid {
    pub fn new(map: &Map, columns: u32) -> Self {
        let workspace = map.workspace();
        let size = workspace.size_m();
        let size_m = size.x / f64::from(columns);
        // A row that is not whole is left out, unless only rounding is missing.
        let rows = (size.y / size_m + 1e-9) as usize;
        let columns = columns as usize;
        let origin_m = Point2::new(workspace.x_min_m, workspace.y_min_m);
        let mut grid = Self { columns, size_m, origin_m, free: Vec::new(), clear: Vec::new() };
        let clearances_m: Vec<f64> = (0..columns * rows).map(|cell| map.clearance_m(grid.center_m(cell))).collect();
        let half_diagonal_m = size_m * std::f64::consts::FRAC_1_SQRT_2;
        grid.free = clearances_m.iter().map(|&clearance_m| clearance_m >= BEAD_RADIUS_M).collect();
        grid.clear =
            clearances_m.iter().map(|&clearance_m| clearance_m >= half_diagonal_m.max(BEAD_RADIUS_M)).collect();
        grid
    }

    fn center_m(&self, cell: usize) -> Point2<f64> {
        let at = |index: usize, origin_m: f64| origin_m + (index as f64 + 0.5) * self.size_m;
        Point2::new(at(cell % self.columns, self.origin_m.x), at(cell / self.columns, self.origin_m.y))
    }

    pub fn spot(&self, place: Place) -> Spot {
        let columns = if place.is_coarse { COARSE as f64 } else { 1.0 };
        Spot::Place { at_m: self.center_m(place.center), size_m: self.size_m * columns }
    }

    /// Every fine cell.
    pub fn fine(&self) -> Vec<Place> {
        let cells = self.free.iter().enumerate().filter(|&(_, &is_free)| is_free);
        cells.map(|(center, _)| Place { center, is_coarse: false }).collect()
    }

    /// Coarse cells where no wall touches them, and fine ones elsewhere.
    pub fn coarse(&self) -> Vec<Place> {
        let rows = self.free.len() / self.columns;
        let mut is_covered = vec![false; self.free.len()];
        let mut places = Vec::new();
        for row in (1..rows.saturating_sub(1)).step_by(COARSE) {
            for column in (1..self.columns.saturating_sub(1)).step_by(COARSE) {
                let place = Place { center: row * self.columns + column, is_coarse: true };
                let cells = self.cells(place);
                if cells.iter().all(|&cell| self.clear[cell]) {
                    cells.iter().for_each(|&cell| is_covered[cell] = true);
                    places.push(place);
                }
            }
        }
        places.extend(self.fine().into_iter().filter(|place| !is_covered[place.center]));
        places
    }

    /// The fine cells of a cell.
    fn cells(&self, place: Place) -> Vec<usize> {
        if !place.is_coarse {
            return vec![place.center];
        }
        let corner = place.center - self.columns - 1;
        (0..COARSE * COARSE).map(|index| corner + index / COARSE * self.columns + index % COARSE).collect()
    }

    /// The coarse cells that have a neighbour of another value, by their index among `places`.
    pub fn unlike<V: PartialEq>(&self, places: &[Place], values: &[V]) -> Vec<usize> {
        let mut owner = vec![None; self.free.len()];
        for (index, &place) in places.iter().enumerate() {
            self.cells(place).into_iter().for_each(|cell| owner[cell] = Some(index));
        }
        let differs = |index: usize, cell: usize| {
            self.neighbours(cell).filter_map(|other| owner[other]).any(|other| values[other] != values[index])
        };
        (0..places.len())
            .filter(|&index| places[index].is_coarse)
            .filter(|&index| self.cells(places[index]).into_iter().any(|cell| differs(index, cell)))
            .collect()
    }

    fn neighbours(&self, cell: usize) -> impl Iterator<Item = usize> {
        let (columns, count) = (self.columns, self.free.len());
        let (column, row) = (cell % columns, cell / columns);
        [(-1, 0), (1, 0), (0, -1), (0, 1)].into_iter().filter_map(move |(dx, dy)| {
            let column = column.checked_add_signed(dx).filter(|&column| column < columns)?;
            let other = row.checked_add_signed(dy)? * columns + column;
            (other < count).then_some(other)
        })
    }

    /// The fine cell at the centre of a coarse one, and those around it.
    pub fn refine(&self, place: Place) -> (Place, Vec<Place>) {
        let fine = |center| Place { center, is_coarse: false };
        let around = self.cells(place).into_iter().filter(|&cell| cell != place.center).map(fine);
        (fine(place.center), around.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(columns: u32) -> Grid {
        Grid::new(&Map::shipped("posts").unwrap(), columns)
    }

    #[test]
    fn coarse_and_fine_cells_cover_the_same_place_once() {
        for columns in [10, 24, 31] {
            let grid = grid(columns);
            let mut covered: Vec<usize> = grid.coarse().into_iter().flat_map(|place| grid.cells(place)).collect();
            covered.sort_unstable();
            let fine: Vec<usize> = grid.fine().iter().map(|place| place.center).collect();
            assert_eq!(covered, fine, "{columns} columns");
            assert!(fine.len() < grid.free.len(), "posts are left out");
        }
        let coarse_ones = |name: &str| {
            let coarse = Grid::new(&Map::shipped(name).unwrap(), 48).coarse();
            (coarse.iter().filter(|place| place.is_coarse).count(), coarse.len())
        };
        let ((open, _), (colon, all)) = (coarse_ones("open"), coarse_ones("colon"));
        assert!(open > 50 && colon > 0 && all > 5 * colon, "{open}; {colon} of {all}");
    }

    #[test]
    fn a_coarse_cell_is_unlike_its_neighbours_on_both_sides_of_a_border() {
        let grid =
            Grid { columns: 9, size_m: 0.01, origin_m: Point2::origin(), free: vec![true; 81], clear: vec![true; 81] };
        let places = grid.coarse();
        assert_eq!(places.len(), 9);
        let values: Vec<bool> = places.iter().map(|place| place.center % 9 < 5).collect();
        let unlike: Vec<usize> = grid.unlike(&places, &values).iter().map(|&index| places[index].center % 9).collect();
        assert_eq!(unlike, [4, 7, 4, 7, 4, 7]);
        assert!(grid.unlike(&places, &[0; 9]).is_empty());
        let (center, around) = grid.refine(places[0]);
        assert_eq!((center.center, around.len()), (places[0].center, 8));
    }
}
