//! `ferry replay`.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

use anyhow::Context;

use ferry_camera::Camera;
use ferry_core::image::{CameraError, ImageSource};
use ferry_core::robot::ur5::SERVO_PERIOD_S;
use ferry_core::trial::{Arena, Deciding, Entry, replay};
use ferry_files::open;
use ferry_lab::learn::Library;

#[derive(clap::Args)]
pub struct Arguments {
    /// An input log
    #[arg(value_name = "FILE.ferry")]
    file: PathBuf,
    /// Render the camera images and decide again, instead of using the log's decisions: the controller's hashes are
    /// compared too. Images are equal only on the same machine and adapter
    #[arg(long)]
    camera: bool,
    /// Folder of the server, for policies that the trials have selected
    #[arg(long, default_value = "data")]
    data: PathBuf,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    let path = arguments.file.display();
    let log = open::log(&arguments.file).with_context(|| format!("{path}"))?;
    if log.torn_bytes > 0 {
        let torn = log.torn_bytes;
        println!(
            "the log was cut off: its last {torn} bytes are an incomplete frame; replaying up to the last complete tick"
        );
    }
    let ticks = log.entries.iter().filter(|entry| matches!(entry, Entry::Tick(_))).count();
    let bar = super::progress::progress(ticks as u64, "ticks replayed")?;
    let gpu = if arguments.camera { Some(super::open_gpu()?) } else { None };
    let mut cameras = |arena: &Arena| -> Result<Box<dyn ImageSource>, CameraError> {
        let gpu = gpu.as_ref().expect("the adapter is open if cameras are used");
        Ok(Box::new(Camera::of(gpu, arena.static_scene())?))
    };
    let deciding = arguments.camera.then(|| {
        let policies = Library::in_folder(arguments.data.join("policies"));
        Deciding { make_camera: &mut cameras, policies: Arc::new(policies) }
    });
    let replayed = replay(&log, deciding, &mut |_| bar.inc(1));
    bar.finish_and_clear();
    let replayed = replayed.with_context(|| format!("{path}"))?;
    let compared = if arguments.camera { "world and controller" } else { "world" };
    println!(
        "{} ticks ({:.1} s) of {} trials replayed: every {compared} hash is equal",
        replayed.ticks,
        replayed.ticks as f64 * SERVO_PERIOD_S,
        replayed.trials,
    );
    if replayed.resumed > 0 {
        println!("{} times a trial continued from a state in the log", replayed.resumed);
    }
    Ok(ExitCode::SUCCESS)
}
