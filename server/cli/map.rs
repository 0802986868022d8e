//! `ferry map`.

use std::process::ExitCode;

use crate::geometry::Point2;
use crate::map::{FreeSpace, Map};
use crate::plant::BEAD_RADIUS_M;
use crate::scenario::CLEARANCE_M;

/// Limit of printed repairs: one mistake is often repeated everywhere in a drawing.
const SHOWN_REPAIRS: usize = 20;

#[derive(clap::Args)]
pub struct Arguments {
    /// The path of an SVG, or a shipped map's name
    file: String,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    let map = Map::open(&arguments.file)?;
    let size = map.workspace().size_m();
    let w = map.workspace();
    println!("map        {}", map.name());
    println!(
        "workspace  {:.0} × {:.0} mm, x {:.3} to {:.3} m, y {:.3} to {:.3} m",
        size.x * 1e3,
        size.y * 1e3,
        w.x_min_m,
        w.x_max_m,
        w.y_min_m,
        w.y_max_m
    );
    println!("moved by   {}", if map.is_for_stage() { "a planar stage, no arm" } else { "the arm" });
    println!("walls      {} polygons, {} free regions", map.walls().len(), map.free().len());
    for (what, clearance_m) in [("bead", BEAD_RADIUS_M), ("trials", CLEARANCE_M)] {
        let space = FreeSpace::new(&map, clearance_m);
        println!(
            "{what:<10} {:.1} cm² free with {:.1} mm clearance, in {} connected part(s)",
            space.area_m2() * 1e4,
            clearance_m * 1e3,
            space.components()
        );
    }
    let reach_m = |p: Point2<f64>| (map.nearest_wall_point(p) - p).norm();
    let widest_m = 2.0 * FreeSpace::new(&map, BEAD_RADIUS_M).points().map(reach_m).fold(0.0, f64::max);
    println!("widest     {:.0} mm across", widest_m * 1e3);
    for repair in map.repairs().iter().take(SHOWN_REPAIRS) {
        println!("repaired   {repair}");
    }
    if let Some(more) = map.repairs().len().checked_sub(SHOWN_REPAIRS).filter(|&more| more > 0) {
        println!("repaired   {more} more");
    }
    Ok(ExitCode::SUCCESS)
}
