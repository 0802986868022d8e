//! `ferry track`.

use std::process::ExitCode;

use anyhow::{Context, ensure};
use serde::Serialize;

use ferry_core::scenario::Parameters;
use ferry_lab::evaluate::tracking::{Aim, Course, Followed, PUBLISHED_RMSE_M, SIZES_M, SPEEDS_M_S, Shape, WIDTHS_M};

#[derive(clap::Args)]
pub struct Arguments {
    /// Only this path
    #[arg(long)]
    shape: Option<Shape>,
    /// Side of the square, and diameter of the circle
    #[arg(long, value_name = "M", default_value_t = 0.1)]
    size: f64,
    /// Speed of the point
    #[arg(long, value_name = "M/S", default_value_t = 0.01)]
    speed: f64,
    /// A channel of this width along the path; without it the table is open
    #[arg(long, value_name = "M")]
    channel: Option<f64>,
    /// Set a parameter, for example preset=peristalsis; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Row {
    shape: Shape,
    aim: Aim,
    #[serde(flatten)]
    followed: Followed,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    let within = |name: &str, value: f64, allowed: std::ops::RangeInclusive<f64>| {
        let (least, most) = (allowed.start(), allowed.end());
        ensure!(allowed.contains(&value), "{name} is {value}, it must be {least} to {most}");
        Ok(())
    };
    within("--size", arguments.size, SIZES_M)?;
    within("--speed", arguments.speed, SPEEDS_M_S)?;
    arguments.channel.map_or(Ok(()), |width_m| within("--channel", width_m, WIDTHS_M))?;
    let parameters = Parameters::default().with(&arguments.set).context("--set")?;
    let gpu = super::open_gpu()?;
    let shapes = arguments.shape.map_or_else(|| vec![Shape::Square, Shape::Circle], |shape| vec![shape]);
    let mut rows = Vec::new();
    let courses: Vec<_> = shapes.into_iter().flat_map(|shape| Aim::ALL.map(|aim| (shape, aim))).collect();
    let bar = super::progress::progress(courses.len() as u64, "paths")?;
    for (shape, aim) in courses {
        let course = Course {
            shape,
            size_m: arguments.size,
            speed_m_s: arguments.speed,
            channel_m: arguments.channel,
            aim,
            parameters: parameters.clone(),
            seed: arguments.seed,
        };
        rows.push(Row { shape, aim, followed: course.run(&gpu)? });
        bar.inc(1);
    }
    bar.finish_and_clear();
    if arguments.json {
        println!("{}", serde_json::to_string_pretty(&rows)?);
        return Ok(ExitCode::SUCCESS);
    }
    println!("path    aim                        RMSE mm  across mm  most mm  not carried");
    for Row { shape, aim, followed } in &rows {
        let Followed { rmse_m, across_rmse_m, most_m, not_carried_share, .. } = followed;
        let name = if *shape == Shape::Square { "square" } else { "circle" };
        println!(
            "{name}  {:26} {:7.2}  {:9.2}  {:7.2}  {:10.1} %",
            aim.label(),
            rmse_m * 1e3,
            across_rmse_m * 1e3,
            most_m * 1e3,
            not_carried_share * 100.0
        );
    }
    let [square_mm, circle_mm] = PUBLISHED_RMSE_M.map(|rmse_m| rmse_m * 1e3);
    println!("arXiv 2601.15545, four electromagnets on a UR5: square {square_mm:.2} mm, circle {circle_mm:.2} mm");
    Ok(ExitCode::SUCCESS)
}
