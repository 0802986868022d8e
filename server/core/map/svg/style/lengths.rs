//! Lengths, opacities and dashes.

use svgtypes::{Length, LengthUnit};

use super::{Origin, Wrong};

/// Larger numbers are mistakes, and make usvg divide an arc into billions of pieces.
pub(super) const MAX_NUMBER: f64 = 1e6;

/// A length as usvg reads it: a number, or a percentage. Absolute lengths are millimetres of the table.
///
/// # Errors
/// [`Wrong::Refused`].
pub fn size(value: &str, origin: Origin) -> Result<String, Wrong> {
    let value = value.trim();
    if value.eq_ignore_ascii_case("auto") {
        return Ok("auto".to_owned());
    }
    let refused =
        || Wrong::Refused("is not a number within ±1e6, plain or with px, mm, cm, in, pt, pc or %".to_owned());
    if has_bare_dot(value) {
        return Err(Wrong::Refused("ends a number with a dot, which browsers do not read".to_owned()));
    }
    let Length { number, unit } = value.to_ascii_lowercase().parse().map_err(|_| refused())?;
    let factor = match unit {
        LengthUnit::None if origin == Origin::Css && number != 0.0 => {
            return Err(Wrong::Refused("has no unit; in a style browsers want one, such as px".to_owned()));
        }
        LengthUnit::None | LengthUnit::Px | LengthUnit::Percent | LengthUnit::Mm => 1.0,
        LengthUnit::Cm => 10.0,
        LengthUnit::In => 25.4,
        LengthUnit::Pt => 25.4 / 72.0,
        LengthUnit::Pc => 25.4 / 6.0,
        LengthUnit::Em | LengthUnit::Ex => return Err(refused()),
    };
    let number = number * factor;
    if number.abs() > MAX_NUMBER {
        return Err(refused());
    }
    Ok(format!("{number}{}", if unit == LengthUnit::Percent { "%" } else { "" }))
}

/// Whether a length is absolute: in a drawing program it would have another size.
pub fn is_absolute(value: &str) -> bool {
    let parsed = value.trim().to_ascii_lowercase().parse::<Length>();
    let units = [LengthUnit::Mm, LengthUnit::Cm, LengthUnit::In, LengthUnit::Pt, LengthUnit::Pc];
    parsed.is_ok_and(|length| units.contains(&length.unit) && length.number != 0.0)
}

/// Whether a dot has no digit behind it: browsers read no such number.
pub fn has_bare_dot(numbers: &str) -> bool {
    numbers.split('.').skip(1).any(|behind| !behind.starts_with(|c: char| c.is_ascii_digit()))
}

/// Whether an opacity lets anything be seen.
pub(super) fn is_opaque(lower: &str) -> Result<bool, Wrong> {
    let number = lower.strip_suffix('%').unwrap_or(lower);
    let opacity = number.parse().ok().filter(|opacity: &f64| opacity.is_finite() && !has_bare_dot(number));
    opacity.map(|opacity| opacity > 0.0).ok_or(Wrong::Invalid)
}

/// Whether there are gaps between dashes.
pub(super) fn dashes(lower: &str) -> Result<bool, Wrong> {
    if lower == "none" {
        return Ok(false);
    }
    let separated = |c: char| c == ',' || c.is_ascii_whitespace();
    let lengths = lower.split(separated).filter(|part| !part.is_empty()).map(|part| {
        let number = part.trim_end_matches(|c: char| c.is_ascii_alphabetic() || c == '%');
        number.parse::<f64>().ok().filter(|length| *length >= 0.0).ok_or(Wrong::Invalid)
    });
    let lengths = lengths.collect::<Result<Vec<f64>, _>>()?;
    if lengths.is_empty() {
        return Err(Wrong::Invalid);
    }
    // Every second one is a gap; an odd number is taken twice.
    let gaps = lengths.iter().chain(&lengths).skip(1).step_by(2).take(lengths.len());
    Ok(gaps.into_iter().any(|length| *length > 0.0))
}
