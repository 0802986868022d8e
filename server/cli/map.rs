//! `ferry map`.

use std::process::ExitCode;

use ferry_core::map::{FreeSpace, Summary};
use ferry_core::plant::BEAD_RADIUS_M;
use ferry_core::scenario::CLEARANCE_M;
use ferry_core::trial::Arena;
use ferry_files::open;

/// Limit of printed notes: one mistake is often repeated everywhere in a drawing.
const SHOWN_NOTES: usize = 20;

#[derive(clap::Args)]
pub struct Arguments {
    /// The path of an SVG, or a shipped map's name
    file: String,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    let map = open::map(&arguments.file)?;
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
    let summary = Summary::of(&map, BEAD_RADIUS_M);
    println!("walls      {} polygons, {} free regions", summary.walls, map.free().len());
    for (what, clearance_m) in [("bead", BEAD_RADIUS_M), ("trials", CLEARANCE_M)] {
        let space = FreeSpace::new(&map, clearance_m);
        println!(
            "{what:<10} {:.1} cm² free with {:.1} mm clearance, in {} connected part(s)",
            space.area_m2() * 1e4,
            clearance_m * 1e3,
            space.components()
        );
    }
    println!("reached    {:.0} % of the free area by the tool", 100.0 * Arena::of(map.clone()).reached_share());
    println!("widest     {:.0} mm across", summary.widest_m * 1e3);
    if let Some(narrow) = summary.passages.first() {
        let (width_mm, at) = (narrow.width_m * 1e3, narrow.at);
        println!("narrowest  {width_mm:.0} mm between two rooms, at x {:.3} y {:.3} m", at.x, at.y);
    }
    for repair in map.repairs().iter().take(SHOWN_NOTES) {
        println!("noted      {repair}");
    }
    if let Some(more) = map.repairs().len().checked_sub(SHOWN_NOTES).filter(|&more| more > 0) {
        println!("noted      {more} more");
    }
    Ok(ExitCode::SUCCESS)
}
