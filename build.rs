//! Builds the page in `web/` into `OUT_DIR/web`, from where `http::assets` embeds it. Compresses Rerun's viewer into
//! `OUT_DIR/rerun`, from where `http::viewer` embeds it.

use std::io::Write;
use std::path::Path;
use std::process::Command;

const SOURCES: [&str; 10] = [
    "web/index.html",
    "web/package.json",
    "web/package-lock.json",
    "web/.npmrc",
    "web/tsconfig.json",
    "web/vite.config.ts",
    "web/src",
    "web/viewer",
    "web/login",
    "web/refused",
];

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    for source in SOURCES {
        println!("cargo::rerun-if-changed={source}");
    }
    let out = std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR");
    let page = Path::new(&out).join("web");
    if packages_are_stale() {
        npm(&["ci", "--no-audit", "--no-fund"], &page);
    }
    npm(&["run", "build"], &page);
    if let Err(error) = compress_viewer(&Path::new(&out).join("rerun")) {
        stop(&format!("Rerun's viewer could not be compressed: {error}"));
    }
}

/// Writes Rerun's browser viewer, from the crate that ships it, as gzip.
fn compress_viewer(folder: &Path) -> std::io::Result<()> {
    let viewer = re_web_viewer_server::WebViewerData::load(None).map_err(std::io::Error::other)?;
    // This build script contains the viewer. A file that is newer than the script is up to date.
    let shipped = std::env::current_exe()?.metadata()?.modified()?;
    std::fs::create_dir_all(folder)?;
    for (name, bytes) in [("re_viewer.js", viewer.viewer_js()), ("re_viewer_bg.wasm", viewer.viewer_wasm())] {
        let path = folder.join(format!("{name}.gz"));
        if path.metadata().and_then(|made| made.modified()).is_ok_and(|made| made > shipped) {
            continue;
        }
        let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
        packed.write_all(bytes)?;
        // Renamed when complete: a build that is interrupted leaves no partial file.
        let unfinished = folder.join(name);
        std::fs::write(&unfinished, packed.finish()?)?;
        std::fs::rename(unfinished, path)?;
    }
    Ok(())
}

/// Whether `web/node_modules` is missing or older than the lockfile.
fn packages_are_stale() -> bool {
    let changed = |path: &str| std::fs::metadata(path).and_then(|found| found.modified()).ok();
    match (changed("web/node_modules/.package-lock.json"), changed("web/package-lock.json")) {
        (Some(installed), Some(locked)) => locked > installed,
        _ => true,
    }
}

fn npm(arguments: &[&str], out: &Path) {
    let run = Command::new("npm").args(arguments).current_dir("web").env("FERRY_WEB_OUT", out).output();
    match run {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => stop(
            "npm is missing, and the page is built with it: install Node.js 20 or newer (Debian: apt-get install nodejs npm)",
        ),
        Err(error) => stop(&format!("npm could not be started: {error}")),
        Ok(done) if !done.status.success() => {
            eprintln!("{}{}", String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
            stop(&format!("npm {} failed in web/; see its output above", arguments.join(" ")));
        }
        Ok(_) => {}
    }
}

fn stop(reason: &str) -> ! {
    println!("cargo::error={reason}");
    std::process::exit(1)
}
