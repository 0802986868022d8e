//! The native part of the Python package `ferry`.

mod lattice;
mod maze;

use std::ffi::OsString;

use numpy::PyArray;
use numpy::ndarray::{ArrayD, IxDyn};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

/// As in the command `ferry`.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Runs the command `ferry`; returns its exit status.
#[pyfunction]
fn run(py: Python<'_>, arguments: Vec<OsString>) -> PyResult<i32> {
    let ended = py.detach(|| ferry::cli::run(arguments.into_iter()));
    let code = ended.map_err(|error| PyRuntimeError::new_err(format!("{error:#}")))?;
    Ok(i32::from(code != std::process::ExitCode::SUCCESS))
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
    module.add_class::<lattice::Lattice>()?;
    module.add_class::<maze::Mazes>()
}
