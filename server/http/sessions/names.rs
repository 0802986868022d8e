//! Names of sessions.

use std::io;

/// Longest name of a session.
pub const NAME_LENGTH: usize = 32;

const HOW: [&str; 10] = ["amber", "brave", "calm", "clear", "keen", "mild", "neat", "quick", "quiet", "warm"];
const WHO: [&str; 10] = ["crane", "finch", "heron", "lark", "otter", "plaice", "robin", "seal", "tern", "wren"];
const LETTERS: &[u8; 36] = b"0123456789abcdefghijklmnopqrstuvwxyz";
/// At the end of a name: with three, two servers seldom choose the same.
const LETTERS_AT_END: usize = 3;

/// Whether a text is a valid session name: it becomes part of addresses and of recordings' names.
pub fn is_name(name: &str) -> bool {
    let fits = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    (1..=NAME_LENGTH).contains(&name.len()) && name.chars().all(fits) && !name.starts_with('-')
}

/// A name that can be read aloud and is not taken, such as `calm-otter-7k2`.
///
/// # Errors
/// The system provides no random numbers.
pub fn free_name(is_taken: impl Fn(&str) -> bool) -> io::Result<String> {
    loop {
        let mut bytes = [0; 2 + LETTERS_AT_END];
        getrandom::fill(&mut bytes)?;
        let [how, who, end @ ..] = bytes.map(usize::from);
        let end = end.map(|number| char::from(LETTERS[number % LETTERS.len()]));
        let name = format!("{}-{}-{}", HOW[how % HOW.len()], WHO[who % WHO.len()], String::from_iter(end));
        if !is_taken(&name) {
            return Ok(name);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_free_name_is_valid_and_not_taken() {
        let mut names = std::collections::BTreeSet::new();
        for _ in 0..1000 {
            let name = free_name(|name| names.contains(name)).unwrap();
            assert!(is_name(&name), "{name}");
            assert!(names.insert(name));
        }
    }
}
