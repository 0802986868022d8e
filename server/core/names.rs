//! Names of things that users add.

/// Longest name.
const NAME_LENGTH: usize = 40;

/// Whether a user may give this name to something that becomes a file: up to 40 of a to z, 0 to 9, - and _.
pub fn is_name(name: &str) -> bool {
    let fits = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '_';
    (1..=NAME_LENGTH).contains(&name.len()) && name.chars().all(fits) && !name.starts_with(['-', '_'])
}
