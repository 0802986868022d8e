//! The files of `ferry train`.

use std::path::{Path, PathBuf};

use anyhow::{Context, ensure};

use super::Arguments;

/// The policy's file: that of `--out`, or one with the names of the maps.
pub fn out(arguments: &Arguments) -> PathBuf {
    let name = |map: &String| Path::new(map).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let names: Vec<String> = arguments.map.iter().map(name).collect();
    let named = || Path::new("data/policies").join(format!("{}.safetensors", names.join("-")));
    arguments.out.clone().unwrap_or_else(named)
}

/// Seed and file of each round.
pub fn rounds(arguments: &Arguments, out: &Path) -> anyhow::Result<Vec<(u64, PathBuf)>> {
    let Arguments { seed, rounds, .. } = *arguments;
    let last =
        seed.checked_add(rounds - 1).with_context(|| format!("--seed: {seed} and {rounds} rounds is too large"))?;
    let file = |seed: u64| match rounds {
        1 => out.to_owned(),
        _ => out.with_extension(format!("{seed}.safetensors")),
    };
    Ok((seed..=last).map(|seed| (seed, file(seed))).collect())
}

/// Refuses to overwrite what another training has left, if that is not asked for.
pub fn check(arguments: &Arguments, out: &Path, rounds: &[(u64, PathBuf)]) -> anyhow::Result<()> {
    ensure!(out.file_name().is_some(), "--out: {} is not the name of a file", out.display());
    let files = |out: &PathBuf| [out.clone(), out.with_extension("checkpoint"), out.with_extension("curve.csv")];
    let mut all = rounds.iter().flat_map(|(_, out)| files(out)).chain([out.with_extension("curve.svg")]);
    if !(arguments.resume || arguments.force)
        && let Some(file) = all.find(|file| file.symlink_metadata().is_ok())
    {
        anyhow::bail!(
            "--out: {} exists already; name another file with --out, go on with that training by --resume, or overwrite \
             it with --force",
            file.display()
        );
    }
    Ok(())
}

pub fn create_folder(out: &Path) -> anyhow::Result<()> {
    match out.parent() {
        Some(folder) => std::fs::create_dir_all(folder).with_context(|| format!("--out: {}", folder.display())),
        None => Ok(()),
    }
}
