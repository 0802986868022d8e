//! Random drawings: any input gives a map or an error.

use proptest::prelude::*;
use proptest::sample::{Index, select};

use super::tests::wrap;
use crate::map::{FreeSpace, Map};

const WORDS: [&str; 40] = [
    "",
    "NaN",
    "inf",
    "1e30",
    "-1e5",
    "1e-30",
    "0",
    "100%",
    "9e5",
    "-",
    "e",
    ".",
    "A1 1 0 0 1 5 5",
    "z",
    "\"",
    "<",
    "/>",
    "=",
    "é",
    "\0",
    "&#0;",
    "<g>",
    "</g>",
    "<use href=\"#a\"/>",
    "<path d=\"M0 0L9 9L9 0L0 9\"/>",
    "<line x2=\"50\" stroke=\"red\"/>",
    " id=\"a\" ",
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
    "<!--",
    "-->",
    "<![CDATA[",
];

const NUMBERS: [&str; 14] =
    ["0", "-0", "1e-30", "1e-9", "-50", "5", "50", "299.5", "300", "300.0001", "400", "999", "1e4", "-1e4"];

const SHAPES: [&str; 9] = [
    "<path d='M? ?L? ?L? ?A? ? ? 1 0 ? ?C? ? ? ? ? ?Z'",
    "<path d='m? ?h?v?q? ? ? ?t? ?s? ? ? ?' fill='none' stroke='red' stroke-width='?'",
    "<rect x='?' y='?' width='?' height='?' rx='?'",
    "<circle cx='?' cy='?' r='?' stroke='red' stroke-miterlimit='?'",
    "<ellipse cx='?' cy='?' rx='?' ry='?' transform='rotate(?)'",
    "<line x1='?' y1='?' x2='?' y2='?' stroke='red' stroke-width='?' stroke-linecap='square'",
    "<polygon points='? ? ? ? ? ? ? ?' fill-rule='evenodd' transform='scale(?)'",
    "<polyline points='? ? ? ? ? ? ? ?' stroke='red' stroke-linejoin='round' transform='matrix(? ? ? ? ? ?)'",
    "<use href='#a' x='?' y='?' transform='skewX(?)'",
];

/// Loads a drawing and, if it is accepted, checks that its polygons are valid.
fn survives(text: &str) {
    let Ok(map) = Map::from_svg("fuzz", text) else { return };
    FreeSpace::new(&map, 0.012);
    for ring in map.walls().iter().chain(map.free()).flat_map(|polygon| polygon.rings()) {
        assert!(ring.len() >= 3 && ring.iter().flatten().all(|c| c.is_finite()));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes_are_a_map_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        let text = String::from_utf8_lossy(&bytes);
        survives(&text);
        survives(&wrap(&text));
    }

    #[test]
    fn any_mutation_of_a_map_is_a_map_or_an_error(
        name in select(Map::shipped_names()),
        edits in prop::collection::vec((any::<Index>(), 0..30_usize, select(&WORDS[..])), 1..6),
    ) {
        let mut text = Map::shipped(&name).unwrap().svg().to_owned();
        for (at, cut, word) in edits {
            let places: Vec<usize> = text.char_indices().map(|(place, _)| place).collect();
            let first = at.index(places.len());
            let last = (first + cut).min(places.len() - 1);
            text.replace_range(places[first]..places[last], word);
        }
        survives(&text);
    }

    #[test]
    fn any_numbers_in_any_shapes_are_a_map_or_an_error(
        shapes in prop::collection::vec((select(&SHAPES[..]), prop::collection::vec(select(&NUMBERS[..]), 20)), 1..5),
    ) {
        let mut body = String::from("<g id='a'><rect x='5' y='300' width='9' height='9'/></g>");
        for (shape, numbers) in shapes {
            let mut numbers = numbers.into_iter();
            for piece in shape.split_inclusive('?') {
                body += piece.trim_end_matches('?');
                body += if piece.ends_with('?') { numbers.next().unwrap_or("1") } else { "" };
            }
            body += "/>";
        }
        survives(&wrap(&body));
    }
}
