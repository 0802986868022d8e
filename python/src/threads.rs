//! Threads of this process: those of graphics drivers and of pools. A fork does not copy them.

use std::sync::OnceLock;

use pyo3::PyResult;

use crate::failed;

/// The process that has them.
static OWNER: OnceLock<u32> = OnceLock::new();

/// Whether this process was forked from one with threads: what belongs to them can neither be used nor closed.
pub fn are_lost() -> bool {
    OWNER.get().is_some_and(|&owner| owner != std::process::id())
}

/// Call it before anything that begins or uses threads.
///
/// # Errors
/// They are lost.
pub fn claim() -> PyResult<()> {
    OWNER.get_or_init(std::process::id);
    if !are_lost() {
        return Ok(());
    }
    Err(failed(
        "this process was forked from one in which Ferry had begun threads, and a fork does not copy threads. Start \
         processes by \"spawn\" or \"forkserver\": AsyncVectorEnv(..., context=\"spawn\") in Gymnasium, \
         multiprocessing.get_context(\"spawn\") elsewhere",
    ))
}
