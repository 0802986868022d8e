//! `ferry sweep`.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use ferry_files::open;
use ferry_lab::learn::sweep::{STEP_M, Sweep, cells};

#[derive(clap::Args)]
pub struct Arguments {
    /// A map's name, or the path of an SVG
    #[arg(long, default_value = "colon")]
    map: String,
    /// Folder for image sweeps
    #[arg(long, default_value = "data/sweeps")]
    out: PathBuf,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    let arena = open::arena(&arguments.map)?;
    let gpu = super::open_gpu()?;
    let (columns, rows) = cells(&arena, STEP_M);
    let bar = super::progress::progress((columns * rows) as u64, "images")?;
    let started = Instant::now();
    let sweep = Sweep::open(&arena, &gpu, &arguments.out, STEP_M, &[], &|| {
        bar.inc(1);
        ControlFlow::Continue(())
    })?;
    let taken = bar.position();
    bar.finish_and_clear();
    let obstacles = sweep.obstacle.iter().filter(|&&obstacle| obstacle).count();
    println!("map        {}", arena.map.name());
    println!("images     {} × {}, one per centimetre, {obstacles} of them over a wall", sweep.columns, sweep.rows);
    match taken {
        0 => println!("kept       in {}", arguments.out.display()),
        _ => println!("taken      in {:.1} s, for {}", started.elapsed().as_secs_f64(), arguments.out.display()),
    }
    Ok(ExitCode::SUCCESS)
}
