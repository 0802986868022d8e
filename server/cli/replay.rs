//! `ferry replay`.

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Context;
use indicatif::{ProgressBar, ProgressStyle};

use crate::camera::{CameraError, Eye};
use crate::robot::ur5::SERVO_PERIOD_S;
use crate::trial::{Arena, Entry, Eyes, InputLog, replay};

/// Arguments of `ferry replay`.
#[derive(clap::Args)]
pub struct Arguments {
    /// An input log
    #[arg(value_name = "FILE.ferry")]
    file: PathBuf,
    /// Render what the camera saw and decide again, instead of taking the log's decisions: the controller's hashes
    /// are compared too. Frames are the same on the same machine and adapter only
    #[arg(long)]
    camera: bool,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    let path = arguments.file.display();
    let log = InputLog::open(&arguments.file).with_context(|| format!("{path}"))?;
    if log.torn_bytes > 0 {
        let torn = log.torn_bytes;
        println!("the log was cut off: its last {torn} bytes are no whole frame; replaying up to the last whole tick");
    }
    let ticks = log.entries.iter().filter(|entry| matches!(entry, Entry::Tick(_))).count();
    let bar = ProgressBar::new(ticks as u64)
        .with_style(ProgressStyle::with_template("replaying {bar:30} {pos}/{len} ticks, {eta} left")?);
    let gpu = if arguments.camera { Some(super::open_gpu()?) } else { None };
    let mut cameras = |arena: &Arena| -> Result<Box<dyn Eye>, CameraError> {
        let gpu = gpu.as_ref().expect("cameras are asked for with an adapter only");
        Ok(Box::new(arena.camera(gpu)?))
    };
    let eyes: Option<Eyes<'_>> = if arguments.camera { Some(&mut cameras) } else { None };
    let replayed = replay(&log, eyes, &mut |_| bar.inc(1));
    bar.finish_and_clear();
    let replayed = replayed.with_context(|| format!("{path}"))?;
    let compared = if arguments.camera { "world and controller" } else { "world" };
    println!(
        "{} ticks ({:.1} s) of {} trials are as they were: every {compared} hash is equal",
        replayed.ticks,
        replayed.ticks as f64 * SERVO_PERIOD_S,
        replayed.trials,
    );
    if replayed.resumed > 0 {
        println!("{} times a trial went on from a state in the log", replayed.resumed);
    }
    Ok(ExitCode::SUCCESS)
}
