//! `ferry attempts`.

mod episode;
mod minari;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::Context;

use self::episode::Episode;
use self::minari::{DATA_SET, DataSet};
use crate::boards::{Boards, Kept};
use ferry_camera::Camera;
use ferry_core::challenge::{AttemptError, Challenge, ChallengeName};

#[derive(clap::Subcommand)]
pub enum Command {
    /// Write attempts as a data set for Minari and Gymnasium, one episode per attempt
    Export(Export),
}

#[derive(clap::Args)]
pub struct Export {
    /// Challenges, such as easy-2026-11-26; if left out, all that have attempts
    #[arg(value_name = "CHALLENGE")]
    challenges: Vec<ChallengeName>,
    /// Folder of the server
    #[arg(long, default_value = "data")]
    data: PathBuf,
    /// New folder for data sets; Minari finds it by MINARI_DATASETS_PATH
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,
}

/// The attempts of a challenge.
type Board = (ChallengeName, Vec<Kept>);

pub fn run(Command::Export(arguments): &Command) -> anyhow::Result<ExitCode> {
    let out = arguments.out.display();
    anyhow::ensure!(arguments.out.symlink_metadata().is_err(), "--out: {out} exists already; name a new folder");
    let boards = boards(&arguments.challenges, &arguments.data.join("challenges"))?;
    let mut data_set = DataSet::create(&arguments.out).with_context(|| format!("--out: {out}"))?;
    let exported = export(&boards, &mut data_set).and_then(|left_out| {
        anyhow::ensure!(
            data_set.episodes() > 0,
            "no attempt agrees with its score ({left_out} left out): nothing is exported"
        );
        data_set.finish().with_context(|| format!("--out: {out}"))?;
        Ok(left_out)
    });
    let left_out = exported.inspect_err(|_| {
        // It did not exist before. A data set without its last file is of no use.
        let _ = std::fs::remove_dir_all(&arguments.out);
    })?;
    let rest = if left_out == 0 { String::new() } else { format!(", {left_out} left out") };
    println!("{out}: {DATA_SET}, {} attempts with {} steps{rest}", data_set.episodes(), data_set.steps());
    Ok(ExitCode::SUCCESS)
}

/// Reads the attempts of the chosen challenges, by name, or of all.
fn boards(chosen: &[ChallengeName], folder: &Path) -> anyhow::Result<Vec<Board>> {
    let mut names = if chosen.is_empty() { Boards::in_folder(folder.to_owned()).names() } else { chosen.to_owned() };
    names.sort_by_key(ToString::to_string);
    names.dedup();
    let read = |name: ChallengeName| {
        let kept = Boards::kept(&folder.join(name.to_string()));
        (name, kept)
    };
    let mut boards: Vec<Board> = names.into_iter().map(read).collect();
    if let Some((name, _)) = boards.iter().find(|(_, kept)| !chosen.is_empty() && kept.is_empty()) {
        anyhow::bail!("CHALLENGE: {} has no attempts at {name}", folder.display());
    }
    boards.retain(|(_, kept)| !kept.is_empty());
    anyhow::ensure!(!boards.is_empty(), "--data: there are no attempts in {}", folder.display());
    Ok(boards)
}

/// Runs all attempts again and adds them. Returns how many are left out because they do not agree with their score.
fn export(boards: &[Board], data_set: &mut DataSet) -> anyhow::Result<usize> {
    let attempts: usize = boards.iter().map(|(_, kept)| kept.len()).sum();
    let bar = super::progress::progress(attempts as u64, "attempts run again")?;
    let gpu = super::open_gpu()?;
    let mut left_out = 0;
    for (name, kept) in boards {
        let challenge = Challenge::of(name.clone())?;
        let mut camera = Camera::of(&gpu, challenge.arena.static_scene())?;
        for kept in kept {
            match Episode::of(&challenge, kept, &mut camera) {
                Ok(episode) => data_set.add(&episode).context("--out")?,
                // The camera failed, not the attempt.
                Err(error @ AttemptError::Trial(_)) => return Err(error).with_context(|| name.to_string()),
                Err(error) => {
                    left_out += 1;
                    let player = &kept.signature.player;
                    bar.suspend(|| eprintln!("warning: the attempt of {player:?} at {name} is left out: {error}"));
                }
            }
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    Ok(left_out)
}
