//! `ferry render`.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use anyhow::Context;

use ferry_camera::Camera;
use ferry_core::geometry::{Point2, Point3};
use ferry_core::image::{Picture, Subject};
use ferry_core::plant::{BEAD_RADIUS_M, Plant, Positioner, PositionerKind, WallMotion};
use ferry_core::scenario::{ControllerName, Parameters};
use ferry_core::trial::Tally;
use ferry_files::open;
use ferry_files::read_at_most;
use ferry_lab::evaluate::Trace;

/// Largest golden picture.
const PNG_BYTES_MOST: u64 = 64 << 20;

#[derive(clap::Args)]
pub struct Arguments {
    /// A map's name, or the path of an SVG
    #[arg(long, default_value = "posts")]
    map: String,
    /// Position of tool and bead, in metres
    #[arg(
        long,
        value_name = "X,Y",
        allow_hyphen_values = true,
        value_parser = parse_point,
        required_unless_present = "scenario"
    )]
    at: Option<Point2<f64>>,
    /// Run a scenario to its end and draw its trajectory as an SVG: the name of a shipped one, or the path of a JSON
    /// file
    #[arg(long, conflicts_with_all = ["at", "map", "view"])]
    scenario: Option<String>,
    /// Use this sub-controller 2 instead of the scenario's
    #[arg(long, requires = "scenario")]
    controller: Option<ControllerName>,
    /// Set a parameter, for example attractor_law=literal; may be repeated
    #[arg(long, requires = "scenario", value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// The controllers' view, the whole scene, or the workspace from above
    #[arg(long, value_enum, default_value = "camera")]
    view: View,
    /// File to write: PNG, or SVG for a scenario
    #[arg(long)]
    out: PathBuf,
    /// Compare the frame with this PNG, and fail if it differs; the difference is written beside OUT
    #[arg(long, value_name = "GOLDEN.png", conflicts_with = "scenario")]
    compare: Option<PathBuf>,
    /// Largest share of the pixels that may differ, 0 to 1; a pixel differs by more than 8 of 255 levels
    #[arg(long, value_name = "SHARE", default_value_t = 0.001, requires = "compare", value_parser = parse_share)]
    tolerance: f64,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum View {
    Camera,
    Scene,
    Plan,
}

fn parse_share(text: &str) -> Result<f64, String> {
    let share = text.parse::<f64>().ok().filter(|share| (0.0..=1.0).contains(share));
    share.ok_or_else(|| "must be 0 to 1".to_owned())
}

fn parse_point(text: &str) -> Result<Point2<f64>, String> {
    let (x, y) = text.split_once(',').ok_or("must be X,Y in metres, for example -0.1,-0.33")?;
    let number = |part: &str| part.trim().parse::<f64>().map_err(|_| format!("{part:?} is not a number"));
    Ok(Point2::new(number(x)?, number(y)?))
}

pub fn run(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    match (&arguments.scenario, arguments.at) {
        (Some(name), _) => trajectory(name, arguments),
        (None, Some(at)) => frame(at, arguments),
        (None, None) => anyhow::bail!("--at or --scenario is needed"),
    }
}

/// Runs a scenario with its inputs, draws it, and prints the result with the paper's figures.
fn trajectory(name: &str, arguments: &Arguments) -> anyhow::Result<ExitCode> {
    let mut case = open::case(name)?;
    let scenario = &mut case.scenario;
    scenario.controller = arguments.controller.unwrap_or(scenario.controller);
    scenario.parameters = scenario.parameters.with(&arguments.set).context("--set")?;
    let scenario = case.scenario.clone();
    let arena = open::arena_of(&case)?;
    let mut camera = Camera::of(&super::open_gpu()?, arena.static_scene())?;
    let (mut trace, mut tally) = (Trace::of(&arena.map, &scenario), Tally::default());
    let outcome = case.run(&arena, &mut camera, &mut |record| {
        trace.add(record);
        tally.add(&record.moment);
        ControlFlow::Continue(())
    })?;
    std::fs::write(&arguments.out, trace.to_svg()?).with_context(|| arguments.out.display().to_string())?;
    println!("{name}: {}, {} steps, {} switches", outcome.phase, outcome.counters.steps, outcome.counters.switches);
    for (tick, error) in &outcome.refused {
        println!("refused at tick {tick}: {error}");
    }
    let (mean_m, [x_m, y_m]) = (tally.mean_m(), tally.max_m());
    println!("tracking error: mean {mean_m:.3} m (paper .02), maximum {x_m:.3} in x (.08), {y_m:.3} in y (.09)");
    Ok(if outcome.meets(&case) { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

fn frame(at: Point2<f64>, arguments: &Arguments) -> anyhow::Result<ExitCode> {
    let arena = open::arena(&arguments.map)?;
    let parameters = Parameters::default().with(&arguments.set).context("--set")?;
    let tool_m = Point3::new(at.x, at.y, parameters.tool_height_m);
    let home = Positioner::home(PositionerKind::of(&arena.map), tool_m);
    let limits = arena.limits(&parameters);
    let positioner = limits.position(tool_m, &home).context("--at")?;
    // The tool may be over a wall; the bead is then placed beside it.
    let (around, plant) = (arena.surroundings(0), parameters.plant());
    let walls = WallMotion::in_full(&plant.peristalsis, 0);
    let fit = around.walls(walls.as_ref(), 0).nearest_fit(at);
    let bead = fit.context("--at: no space for the bead within 5 cm")?;
    let subject = Subject {
        tick: 0,
        tool_m: tool_m.coords.into(),
        turn_rad: 0.0,
        bead_m: [bead.x, bead.y, BEAD_RADIUS_M],
        goal_m: None,
        link_frames: positioner.link_frames(),
        block_size_m: Plant::new(plant).block_size_m(),
        mount: parameters.camera_mount(),
        moved_walls: around.bands(walls.as_ref(), 0, bead).map(Arc::from),
    };
    let mut camera = Camera::of(&super::open_gpu()?, arena.static_scene())?;
    let picture = match arguments.view {
        View::Camera => camera.capture(&subject)?.picture,
        View::Scene => camera.scene(&subject, 1280, 720)?,
        View::Plan => camera.plan(&subject, 1280, 720)?,
    };
    std::fs::write(&arguments.out, picture.to_png()?).with_context(|| arguments.out.display().to_string())?;
    match &arguments.compare {
        Some(golden) => compare(&picture, golden, arguments),
        None => Ok(ExitCode::SUCCESS),
    }
}

/// Compares a frame with a golden picture, and writes where they differ if it is too much.
fn compare(picture: &Picture, golden: &Path, arguments: &Arguments) -> anyhow::Result<ExitCode> {
    let name = || golden.display().to_string();
    let bytes = read_at_most(golden, PNG_BYTES_MOST).with_context(name)?;
    let difference = picture.difference(&Picture::from_png(&bytes).with_context(name)?).with_context(name)?;
    let percent = |share: f64| share * 100.0;
    if difference.share <= arguments.tolerance {
        println!("{:.3} % of the pixels differ, {:.3} % may", percent(difference.share), percent(arguments.tolerance));
        return Ok(ExitCode::SUCCESS);
    }
    let stem = arguments.out.file_stem().unwrap_or_default().to_string_lossy();
    let path = arguments.out.with_file_name(format!("{stem}-difference.png"));
    std::fs::write(&path, difference.picture.to_png()?).with_context(|| path.display().to_string())?;
    println!(
        "{:.3} % of the pixels differ from {}, {:.3} % may; see {}",
        percent(difference.share),
        golden.display(),
        percent(arguments.tolerance),
        path.display()
    );
    Ok(ExitCode::FAILURE)
}
