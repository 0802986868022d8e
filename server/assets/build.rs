//! Builds the page in `web/` into `OUT_DIR/web`, compresses Rerun's viewer into `OUT_DIR/web/rerun`, and lists all files
//! in `OUT_DIR/files.rs`.

use std::fmt::Write as _;
use std::io::Write;
use std::path::Path;
use std::process::Command;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

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
        println!("cargo::rerun-if-changed={ROOT}/{source}");
    }
    let out = std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR");
    let (page, viewer) = (Path::new(&out).join("web"), Path::new(&out).join("viewer"));
    if packages_are_stale() {
        npm(&["ci", "--no-audit", "--no-fund"], &page);
    }
    npm(&["run", "build"], &page);
    if let Err(error) = compress_viewer(&viewer.join("rerun")) {
        stop(&format!("Rerun's viewer could not be compressed: {error}"));
    }
    let listed = list(&[&page, &viewer]).and_then(|list| std::fs::write(Path::new(&out).join("files.rs"), list));
    if let Err(error) = listed {
        stop(&format!("the files of the page could not be listed: {error}"));
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

/// The files in these folders as the content of `FILES`: beside `NAME` may be `NAME.gz` and `NAME.br`.
fn list(folders: &[&Path]) -> std::io::Result<String> {
    let mut files = std::collections::BTreeMap::<String, [Option<String>; 3]>::new();
    for root in folders {
        let mut pending = vec![root.to_path_buf()];
        while let Some(folder) = pending.pop() {
            for entry in std::fs::read_dir(folder)? {
                let path = entry?.path();
                if path.is_dir() {
                    pending.push(path);
                    continue;
                }
                let inside = path.strip_prefix(root).expect("it is in the folder").components();
                let name = inside.map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/");
                let (name, encoding) = match name.rsplit_once('.') {
                    Some((name, "gz")) => (name.to_owned(), 1),
                    Some((name, "br")) => (name.to_owned(), 2),
                    _ => (name, 0),
                };
                files.entry(name).or_default()[encoding] = Some(format!("include_bytes!({path:?})"));
            }
        }
    }
    let mut listed = String::from("&[\n");
    for (name, encodings) in files {
        let [plain, gzip, brotli] = encodings.map(|one| one.map_or("None".into(), |code| format!("Some({code})")));
        writeln!(listed, "    ({name:?}, [{plain}, {gzip}, {brotli}]),").expect("a string takes all");
    }
    Ok(listed + "]\n")
}

/// Whether `web/node_modules` is missing or older than the lockfile.
fn packages_are_stale() -> bool {
    let changed = |path: &str| std::fs::metadata(Path::new(ROOT).join(path)).and_then(|found| found.modified()).ok();
    match (changed("web/node_modules/.package-lock.json"), changed("web/package-lock.json")) {
        (Some(installed), Some(locked)) => locked > installed,
        _ => true,
    }
}

fn npm(arguments: &[&str], out: &Path) {
    let run =
        Command::new("npm").args(arguments).current_dir(Path::new(ROOT).join("web")).env("FERRY_WEB_OUT", out).output();
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
