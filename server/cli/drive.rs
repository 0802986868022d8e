//! `ferry drive`.

use std::net::IpAddr;
use std::process::ExitCode;

use super::serve;
use crate::http::EmbeddedFile;
use ferry_ur::Twin;

#[derive(clap::Args)]
pub struct Arguments {
    /// Address of the robot's controller. Its RTDE (port 30004) is read, and
    /// its dashboard (29999) is asked for the model
    #[arg(long, value_name = "ADDRESS", value_parser = super::host)]
    robot: IpAddr,
    /// Let Ferry move the robot while a button on the page is held. Ferry has never moved a real arm: read docs/robot.md
    /// first
    #[arg(long)]
    enable_motion: bool,
    #[command(flatten)]
    serve: serve::Arguments,
}

pub fn run(arguments: &Arguments, files: &'static [EmbeddedFile]) -> anyhow::Result<ExitCode> {
    let Arguments { robot, enable_motion, serve } = arguments;
    if *enable_motion {
        tracing::warn!(address = %robot, "Ferry may move the robot. It is not safety-rated and has never moved a real arm");
    }
    serve::run(serve, files, Some(Twin::new(*robot, *enable_motion)))
}
