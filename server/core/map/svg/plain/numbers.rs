//! The numbers of paths and polygons.

use svgtypes::{NumberListParser, PathParser, PathSegment};

use crate::map::svg::short;
use crate::map::svg::style::has_bare_dot;

/// Larger numbers are mistakes, and make usvg divide an arc into billions of pieces.
const MAX_NUMBER: f64 = 1e6;

/// The count of a path's numbers.
pub(super) fn check_path(value: &str) -> Result<usize, String> {
    if value.trim() == "none" {
        return Ok(0);
    }
    let mut count = 0;
    if has_bare_dot(value) {
        return Err(format!("d={:?} ends a number with a dot, which browsers do not read", short(value)));
    }
    for segment in PathParser::from(value) {
        let segment = segment.map_err(|error| format!("d={:?} is broken: {error}", short(value)))?;
        let numbers: &[f64] = match segment {
            PathSegment::MoveTo { x, y, .. }
            | PathSegment::LineTo { x, y, .. }
            | PathSegment::SmoothQuadratic { x, y, .. } => &[x, y],
            PathSegment::HorizontalLineTo { x: one, .. } | PathSegment::VerticalLineTo { y: one, .. } => &[one],
            PathSegment::CurveTo { x1, y1, x2, y2, x, y, .. } => &[x1, y1, x2, y2, x, y],
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => &[x2, y2, x, y],
            PathSegment::Quadratic { x1, y1, x, y, .. } => &[x1, y1, x, y],
            PathSegment::EllipticalArc { rx, ry, x_axis_rotation, x, y, .. } => &[rx, ry, x_axis_rotation, x, y],
            PathSegment::ClosePath { .. } => &[],
        };
        check_numbers("d", numbers)?;
        count += numbers.len();
    }
    Ok(count)
}

/// The count of the numbers of a polygon.
pub(super) fn check_points(value: &str) -> Result<usize, String> {
    let numbers: Result<Vec<f64>, _> = NumberListParser::from(value.trim()).collect();
    let numbers = numbers.map_err(|error| format!("points={:?} is broken: {error}", short(value)))?;
    if has_bare_dot(value) {
        return Err(format!("points={:?} ends a number with a dot, which browsers do not read", short(value)));
    }
    check_numbers("points", &numbers)?;
    if numbers.len() % 2 == 1 {
        return Err(format!("points={:?} has {} numbers, which is odd", short(value), numbers.len()));
    }
    Ok(numbers.len())
}

pub(super) fn check_numbers(name: &str, numbers: &[f64]) -> Result<(), String> {
    match numbers.iter().find(|number| number.abs() > MAX_NUMBER) {
        Some(number) => Err(format!("{name} has the number {number:e}, the limit is ±{MAX_NUMBER:e}")),
        None => Ok(()),
    }
}
