//! Changes to files that keep most of their form, so that more than the first check is reached: in JSON, CBOR and a
//! policy's header a value somewhere in the tree, in text a number or a word, in anything bytes.

use ciborium::Value;
use rand::seq::IndexedRandom;
use rand::{Rng, RngExt};

use super::targets::Target;

const NUMBERS: [f64; 20] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    2.0,
    1e-9,
    1e-300,
    -1e-3,
    0.1,
    1e3,
    -1e5,
    1e9,
    4294967296.0,
    1.8446744073709552e19,
    1e30,
    1e308,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
];

/// Words of drawings; others may take the place of any of them.
const WORDS: [&str; 30] = [
    "<g>",
    "</g>",
    "/>",
    "\"",
    "=",
    "z",
    "A1 1 0 0 1 5 5",
    "100%",
    "1e",
    "-",
    "<use href=\"#a\"/>",
    " id=\"a\" ",
    "<path d=\"M0 0L9 9L9 0L0 9\"/>",
    "<line x2=\"50\" stroke=\"red\"/>",
    " stroke=\"url(#a)\" ",
    " stroke-width=\"9\" ",
    " stroke-linejoin=\"round\" ",
    " transform=\"scale(1e3)\" ",
    " transform=\"matrix(1 0 0 0 1 1)\" ",
    " style=\"fill:none;stroke:red\" ",
    " class=\"a\" ",
    "<style>g .a,*{stroke:red}</style>",
    "<pattern id=\"a\"><rect/></pattern>",
    "<svg viewBox=\"0 0 9 9\" width=\"9\" height=\"9\">",
    "</svg>",
    "<!--",
    "-->",
    "<![CDATA[",
    "&#0;",
    "<!DOCTYPE svg [<!ENTITY a \"b\">]>",
];

/// Bytes near to `bytes`.
pub fn mutated(target: Target, bytes: &[u8], rng: &mut impl Rng) -> Vec<u8> {
    let mut changed = bytes.to_vec();
    for _ in 0..rng.random_range(1..4) {
        let in_form = if rng.random_ratio(1, 5) { None } else { in_form(target, &changed, rng) };
        changed = in_form.unwrap_or_else(|| of_bytes(changed, rng));
    }
    changed
}

fn in_form(target: Target, bytes: &[u8], rng: &mut impl Rng) -> Option<Vec<u8>> {
    match target {
        Target::Message | Target::Case => in_json(bytes, rng),
        Target::Policy => {
            let (length, rest) = bytes.split_first_chunk()?;
            let (header, rest) = rest.split_at_checked(usize::try_from(u64::from_le_bytes(*length)).ok()?)?;
            let header = if rng.random() { in_manifest(header, rng)? } else { in_json(header, rng)? };
            Some([&(header.len() as u64).to_le_bytes()[..], &header, rest].concat())
        }
        Target::Entries => {
            let mut entries = entries(bytes);
            let at = rng.random_range(0..entries.len().max(1));
            in_tree(entries.get_mut(at)?, rng);
            match rng.random_range(0..8) {
                0 => entries.truncate(at + 1),
                1 => entries.insert(0, entries[at].clone()),
                _ => {}
            }
            let mut changed = Vec::new();
            entries.iter().for_each(|entry| ciborium::into_writer(entry, &mut changed).unwrap());
            Some(changed)
        }
        Target::Map => Some(in_text(std::str::from_utf8(bytes).ok()?, rng).into_bytes()),
        Target::Log | Target::Drawing | Target::Rtde | Target::Reports | Target::Script | Target::Dashboard => None,
    }
}

fn entries(mut bytes: &[u8]) -> Vec<Value> {
    let mut entries = Vec::new();
    while let Ok(entry) = ciborium::from_reader(&mut bytes) {
        entries.push(entry);
    }
    entries
}

fn in_json(bytes: &[u8], rng: &mut impl Rng) -> Option<Vec<u8>> {
    let mut value: Value = serde_json::from_slice(bytes).ok()?;
    in_tree(&mut value, rng);
    serde_json::to_vec(&value).ok()
}

/// Changes one value of the manifest, which is a text in a policy's header.
fn in_manifest(header: &[u8], rng: &mut impl Rng) -> Option<Vec<u8>> {
    let mut header: serde_json::Value = serde_json::from_slice(header).ok()?;
    let manifest = header.pointer_mut("/__metadata__/ferry")?;
    *manifest = String::from_utf8(in_json(manifest.as_str()?.as_bytes(), rng)?).ok()?.into();
    serde_json::to_vec(&header).ok()
}

/// Changes one value of the tree, each as likely as any other.
fn in_tree(value: &mut Value, rng: &mut impl Rng) {
    let at = rng.random_range(0..values_in(value));
    change(value, at, rng);
}

fn values_in(value: &Value) -> usize {
    1 + match value {
        Value::Array(values) => values.iter().map(values_in).sum(),
        Value::Map(fields) => fields.iter().map(|(_, value)| values_in(value)).sum(),
        _ => 0,
    }
}

/// Changes the value with this number, the tree's own being 0.
fn change(value: &mut Value, mut at: usize, rng: &mut impl Rng) {
    if at == 0 {
        return *value = replaced(value, rng);
    }
    at -= 1;
    let values: Vec<&mut Value> = match value {
        Value::Array(values) => values.iter_mut().collect(),
        Value::Map(fields) => fields.iter_mut().map(|(_, value)| value).collect(),
        _ => Vec::new(),
    };
    for value in values {
        let size = values_in(value);
        if at < size {
            return change(value, at, rng);
        }
        at -= size;
    }
}

/// A list with a part left out or doubled.
fn pruned<T: Clone>(list: &[T], rng: &mut impl Rng) -> Vec<T> {
    let mut list = list.to_vec();
    match (rng.random_range(0..4), list.len()) {
        (0 | 1, 1..) => drop(list.remove(rng.random_range(0..list.len()))),
        (2, 1..) => list.extend_from_within(rng.random_range(0..list.len())..),
        _ => list.clear(),
    }
    list
}

fn replaced(value: &Value, rng: &mut impl Rng) -> Value {
    let number = *NUMBERS.choose(rng).expect("there are numbers");
    match value {
        Value::Array(values) => Value::Array(pruned(values, rng)),
        Value::Map(fields) => Value::Map(pruned(fields, rng)),
        Value::Float(x) if rng.random() => Value::Float(x * number),
        Value::Float(_) => Value::Float(number),
        Value::Integer(n) => {
            let n = i128::from(*n);
            let n = match rng.random_range(0..6) {
                0 => 0,
                1 => n - 1,
                2 => n + 1,
                3 => u64::MAX.into(),
                4 => i64::MIN.into(),
                _ => number as i128,
            };
            Value::Integer(n.clamp(i64::MIN.into(), u64::MAX.into()).try_into().expect("CBOR holds it"))
        }
        Value::Bool(is) => Value::Bool(!is),
        Value::Bytes(bytes) => Value::Bytes(of_bytes(bytes.clone(), rng)),
        Value::Text(text) if rng.random_ratio(1, 2) => Value::Text(in_text(text, rng)),
        Value::Text(_) => {
            let names = ["open", "posts", "colon", "rl", "errt", "attractor", "planar_stage", "run", "step", ""];
            Value::Text((*names.choose(rng).expect("there are names")).to_owned())
        }
        Value::Null => Value::Float(number),
        _ => Value::Null,
    }
}

/// Another number in place of one, or a word in place of a few characters.
fn in_text(text: &str, rng: &mut impl Rng) -> String {
    let is_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-');
    let numbers: Vec<(usize, &str)> = text
        .match_indices(is_number)
        .filter(|&(at, _)| !text[..at].ends_with(is_number))
        .map(|(at, _)| (at, text[at..].split(|c| !is_number(c)).next().unwrap_or_default()))
        .collect();
    let mut text = text.to_owned();
    if let (Some(&(at, old)), true) = (numbers.choose(rng), rng.random_ratio(2, 3)) {
        let number = NUMBERS.choose(rng).expect("there are numbers");
        let new = match old.parse::<f64>() {
            Ok(old) if rng.random() => old * rng.random_range(-2.0..3.0),
            _ => *number,
        };
        text.replace_range(at..at + old.len(), &new.to_string());
        return text;
    }
    let places: Vec<usize> = text.char_indices().map(|(at, _)| at).chain([text.len()]).collect();
    let first = rng.random_range(0..places.len());
    let last = (first + rng.random_range(0..30)).min(places.len() - 1);
    match rng.random_range(0..4) {
        0 => {
            let again = text[places[first]..].repeat(rng.random_range(1..3));
            text.insert_str(places[rng.random_range(0..places.len())], &again);
        }
        1 => text.truncate(places[first]),
        _ => text.replace_range(places[first]..places[last], WORDS.choose(rng).expect("there are words")),
    }
    text
}

fn of_bytes(mut bytes: Vec<u8>, rng: &mut impl Rng) -> Vec<u8> {
    if bytes.is_empty() {
        return vec![rng.random()];
    }
    let at = rng.random_range(0..bytes.len());
    let span = rng.random_range(1..=(bytes.len() - at).min(64));
    match rng.random_range(0..6) {
        0 => bytes[at] ^= 1 << rng.random_range(0..8),
        1 => bytes[at] = rng.random(),
        2 => bytes[at..at + span].fill(rng.random()),
        3 => drop(bytes.drain(at..at + span)),
        4 => drop(bytes.splice(at..at, bytes[at..at + span].to_vec())),
        _ => bytes.truncate(at),
    }
    bytes
}
