//! The native part of the Python package `ferry`.

mod job;
mod lattice;
mod maze;
mod threads;

use std::ffi::OsString;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ferry_camera::{AdapterChoice, Gpu};
use ferry_core::geometry::Rect;
use ferry_core::image::GrayImage;
use ferry_core::perception::{OBSERVATION_SIZE_PX, Observation};
use numpy::ndarray::{ArrayD, IxDyn};
use numpy::{PyArray, PyReadonlyArray2};
use pyo3::PyTypeInfo;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// As in the command `ferry`.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Runs the command `ferry`; returns its exit status.
#[pyfunction]
fn run(py: Python<'_>, arguments: Vec<OsString>) -> PyResult<i32> {
    threads::claim()?;
    let ended = py.detach(|| ferry::cli::run(arguments.into_iter(), ferry_assets::FILES));
    let code = ended.map_err(|error| PyRuntimeError::new_err(format!("{error:#}")))?;
    Ok(i32::from(code != std::process::ExitCode::SUCCESS))
}

/// What a policy gets: the image, and goal and tool over the workspace.
#[pyfunction]
fn observation<'py>(
    py: Python<'py>,
    gray: PyReadonlyArray2<'py, u8>,
    goal_m: [f64; 2],
    tool_m: [f64; 2],
    workspace_m: [f64; 4],
) -> PyResult<(Array<'py, u8>, Array<'py, f32>)> {
    const SIDE: usize = OBSERVATION_SIZE_PX;
    let (height_px, width_px) = gray.as_array().dim();
    if height_px < SIDE || width_px < SIDE {
        return Err(bad(format!(
            "gray has the shape ({height_px}, {width_px}), it must have at least ({SIDE}, {SIDE})"
        )));
    }
    let gray = GrayImage { width_px, height_px, pixels: gray.as_array().iter().copied().collect() };
    let [x_min_m, x_max_m, y_min_m, y_max_m] = workspace_m;
    let workspace = Rect { x_min_m, x_max_m, y_min_m, y_max_m };
    let seen = Observation::new(&gray, Some(goal_m.into()), tool_m.into(), &workspace);
    Ok((array(py, &[SIDE, SIDE], seen.bytes[..SIDE * SIDE].to_vec()), array(py, &[4], seen.places().to_vec())))
}

/// The variable that chooses the graphics adapter, as for the command.
const ADAPTER: &str = "FERRY_ADAPTER";

/// The graphics adapter. With Vulkan, Mesa keeps its LLVM to itself; with OpenGL it does not, and torch's Triton, which has
/// another LLVM, crashes if it is loaded later.
fn open_gpu() -> PyResult<Arc<Gpu>> {
    threads::claim()?;
    match std::env::var_os(ADAPTER).filter(|name| !name.is_empty()) {
        Some(name) => {
            let choice =
                name.to_string_lossy().parse::<AdapterChoice>().map_err(|error| bad(format!("{ADAPTER}: {error}")))?;
            Gpu::open(choice).map_err(|error| failed(format!("{ADAPTER} is {name:?}: {error}")))
        }
        None => Gpu::open(AdapterChoice::Vulkan).or_else(|_| Gpu::open(AdapterChoice::Auto)).map_err(failed),
    }
}

/// What `copyreg` needs: how an object is made again, and its bytes.
type Reduced<'py> = (Bound<'py, PyAny>, (Bound<'py, PyBytes>,));

/// An object as `__reduce__` returns it: its class has `from_pickle`.
fn packed<'py>(object: &Bound<'py, impl PyTypeInfo>, state: &impl Serialize) -> PyResult<Reduced<'py>> {
    let mut bytes = Vec::new();
    ciborium::into_writer(state, &mut bytes).map_err(failed)?;
    Ok((object.as_any().get_type().getattr("from_pickle")?, (PyBytes::new(object.py(), &bytes),)))
}

/// The state in a pickle.
fn unpacked<S: DeserializeOwned>(bytes: &Bound<'_, PyBytes>) -> PyResult<S> {
    ciborium::from_reader(bytes.as_bytes())
        .map_err(|error| bad(format!("the pickle is damaged or of another version of Ferry: {error}")))
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Bad input.
fn bad(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Something that is not the caller's fault.
fn failed(error: impl std::fmt::Display) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}

type Array<'py, T> = Bound<'py, PyArray<T, IxDyn>>;

/// Numbers in rows as an array of a shape.
fn array<'py, T: numpy::Element>(py: Python<'py>, shape: &[usize], numbers: Vec<T>) -> Array<'py, T> {
    let array = ArrayD::from_shape_vec(IxDyn(shape), numbers).expect("as many numbers as the shape has");
    PyArray::from_owned_array(py, array)
}

#[pymodule]
fn _ferry(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_function(wrap_pyfunction!(run, module)?)?;
    module.add_function(wrap_pyfunction!(observation, module)?)?;
    module.add_class::<lattice::Lattice>()?;
    module.add_class::<maze::Mazes>()?;
    module.add_function(wrap_pyfunction!(job::merge, module)?)?;
    module.add_class::<job::Job>()
}
