//! What the program embeds for browsers: the page in `web/` and Rerun's viewer. `build.rs` builds and compresses both.
//! The library does not know this crate, so that a change of the page compiles no more than this one.

/// The files: the name, and the content as it is, as gzip and as brotli, where they exist.
pub static FILES: &[(&str, [Option<&[u8]>; 3])] = include!(concat!(env!("OUT_DIR"), "/files.rs"));
