//! Builds the page below `web/` into `OUT_DIR/web`, where `http::assets` embeds it.

use std::path::Path;
use std::process::Command;

const SOURCES: [&str; 7] = [
    "web/index.html",
    "web/package.json",
    "web/package-lock.json",
    "web/.npmrc",
    "web/tsconfig.json",
    "web/vite.config.ts",
    "web/src",
];

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    for source in SOURCES {
        println!("cargo::rerun-if-changed={source}");
    }
    let out = Path::new(&std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR")).join("web");
    if packages_are_stale() {
        npm(&["ci", "--no-audit", "--no-fund"], &out);
    }
    npm(&["run", "build"], &out);
}

/// Whether `web/node_modules` is absent or older than the lockfile.
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
            stop(&format!("npm {} failed in web/; its output stands above", arguments.join(" ")));
        }
        Ok(_) => {}
    }
}

fn stop(reason: &str) -> ! {
    println!("cargo::error={reason}");
    std::process::exit(1)
}
