//! Shared by tests: servers, browsers, child processes, files of recordings.

mod browser;
mod child;
mod laboratory;
mod plain;
mod recordings;
pub mod visitor;

use std::sync::{Arc, OnceLock};

use ferry_camera::{AdapterChoice, Gpu};

pub use browser::Browser;
pub use child::{Ferry, ended_at_once, ferry, memory_mb, refused_at_once};
pub use laboratory::{Answer, Laboratory};
pub use plain::{exchange, read_answer};
pub use recordings::{files, read, tool};
pub use visitor::Visitor;

pub fn gpu() -> Arc<Gpu> {
    static GPU: OnceLock<Arc<Gpu>> = OnceLock::new();
    GPU.get_or_init(|| Gpu::open(AdapterChoice::Auto).expect("tests render: a graphics adapter is needed")).clone()
}
