//! Realistic drawings, and how each is read, repaired or refused.

use std::fmt::Write;

use crate::map::{Map, MapError};

pub(super) fn wrap(body: &str) -> String {
    format!(r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-100 200 200 200">{body}</svg>"#)
}

fn draw(body: &str) -> Result<Map, MapError> {
    Map::from_svg("case", &wrap(body))
}

fn area_m2(map: &Map) -> f64 {
    let ring_area = |ring: &[[f64; 2]]| {
        (0..ring.len())
            .map(|i| {
                let (a, b) = (ring[i], ring[(i + 1) % ring.len()]);
                0.5 * (a[0] * b[1] - b[0] * a[1])
            })
            .sum::<f64>()
    };
    map.walls().iter().flat_map(|p| p.rings()).map(ring_area).sum()
}

/// Asserts that each body is refused with an error that contains the given text.
fn assert_refused(cases: &[(&str, &str)]) {
    for (body, part) in cases {
        let message = draw(body).err().unwrap_or_else(|| panic!("{body} was accepted")).to_string();
        assert!(message.contains(part), "{body}: {message}");
    }
}

#[test]
fn circles_strokes_groups_and_transforms_have_their_true_area() {
    let cases = [
        (r#"<circle cx="0" cy="300" r="30"/>"#, std::f64::consts::PI * 0.03 * 0.03),
        (r#"<path d="M-50 300H50" fill="none" stroke="red" stroke-width="10"/>"#, 0.1 * 0.01),
        (
            r#"<g transform="translate(0 300) rotate(45) scale(2)"><rect x="-10" y="-10" width="20" height="20"/></g>"#,
            0.04 * 0.04,
        ),
        (
            r#"<rect x="-20" y="290" width="20" height="20"/><rect x="-10" y="290" width="20" height="20"/>"#,
            0.03 * 0.02,
        ),
        (r#"<path fill-rule="evenodd" d="M-50 250H50V350H-50ZM-20 280H20V320H-20Z"/>"#, 0.1 * 0.1 - 0.04 * 0.04),
        (r#"<path d="M0 300m-30 0a30 30 0 1 0 60 0a30 30 0 1 0-60 0z"/>"#, std::f64::consts::PI * 0.03 * 0.03),
        (r#"<rect x="-10%" y="150%" width="20%" height="10%"/>"#, 0.04 * 0.02),
        (
            r#"<g transform="scale(.001) translate(0 3e5)"><circle fill="none" stroke="red" stroke-width="10000" r="30000"/></g>"#,
            std::f64::consts::PI * (0.035 * 0.035 - 0.025 * 0.025),
        ),
        (
            r#"<g transform="translate(0 300) scale(1000)"><circle fill="none" stroke="red" stroke-width=".01" r=".03"/></g>"#,
            std::f64::consts::PI * (0.035 * 0.035 - 0.025 * 0.025),
        ),
        (
            r##"<defs><rect id="r" width="20" height="10"/></defs><use href="#r" y="300"/><use href="#r" x="30" y="300"/>"##,
            2.0 * 0.02 * 0.01,
        ),
        (
            r##"<symbol id="s" viewBox="0 0 2 2"><rect width="1" height="1"/></symbol><use href="#s" y="300" width="40" height="40"/>"##,
            0.02 * 0.02,
        ),
        ("<g/><g><g></g></g><defs/><symbol/>", 0.0),
        (r#"<style>.a{fill:none;stroke:#000;stroke-width:4}</style><path class="a" d="M0 300H50"/>"#, 0.05 * 0.004),
        (
            r#"<rect y="300" width="20" height="10" display="none"/><rect y="300" width="5" height="5" visibility="hidden"/>"#,
            0.0,
        ),
        // Styles.
        (r#"<rect width="20" height="10" style="transform: translate(-10px, 300px) rotate(.25turn)"/>"#, 0.02 * 0.01),
        (r#"<rect style="x: 5px; y: 300px; width: 20px; height: 10px"/>"#, 0.02 * 0.01),
        (r#"<path d="" style="d: path('M0 300h20v10h-20z')"/>"#, 0.02 * 0.01),
        (
            r#"<style>rect:nth-child(2) { display: none } rect { fill: red !important }</style><rect y="300" width="20" height="10" style="fill: none"/>"#,
            0.0,
        ),
        (
            r#"<rect y="300" width="20" height="10" style="transform: scale(2); transform-origin: 0px 300px"/>"#,
            0.04 * 0.02,
        ),
        // What cannot be seen.
        (r#"<g opacity="0"><rect y="300" width="20" height="10"/></g>"#, 0.0),
        (r#"<rect y="300" width="20" height="10" fill="transparent"/>"#, 0.0),
        (r#"<rect y="300" width="20" height="10" fill="rgba(0, 0, 0, 0)" style="stroke: #1230"/>"#, 0.0),
        (r#"<rect y="300" width="20" height="10" fill-opacity="0%"/>"#, 0.0),
        (r##"<g color="#0000"><rect y="300" width="20" height="10" fill="currentColor"/></g>"##, 0.0),
        (r#"<rect y="300" width="20" height="10" fill="url(#none) red"/>"#, 0.02 * 0.01),
        // What is not drawn is not judged.
        (
            r##"<g style="display:none"><image href="a.png"/><text>no</text></g><clipPath id="c"><text>no</text></clipPath>
            <text> <tspan/></text><mask id="m"/><marker id="k"/><rect y="300" width="20" height="10" stroke-dasharray="3"/>"##,
            0.02 * 0.01,
        ),
        (
            r#"<switch><foreignObject requiredExtensions="x"/><g><rect y="300" width="20" height="10"/></g><text>no</text></switch>"#,
            0.02 * 0.01,
        ),
        // A clip that cuts nothing.
        (
            r##"<clipPath id="c"><rect x="-5" y="295" width="50" height="50"/></clipPath>
            <g clip-path="url(#c)"><rect y="300" width="20" height="10" clip-path="url(#no)"/></g>"##,
            0.02 * 0.01,
        ),
        // Texts as programs write them.
        (r#"<rect y="300" width="20" height="10" content="&lt;mxfile&gt;" data-a="b"/>"#, 0.02 * 0.01),
        (r#"<path d="M0 300a10 10 0 1120 0 10 10 0 01-20 0z"/>"#, std::f64::consts::PI * 0.01 * 0.01),
    ];
    for (body, expected) in cases {
        let map = draw(body).unwrap();
        let area = area_m2(&map);
        assert!((area - expected).abs() <= 5e-3 * expected, "{body}: {area} instead of {expected}");
        assert!(map.repairs().is_empty(), "{body}: {:?}", map.repairs());
    }
}

#[test]
fn the_fill_of_a_shape_does_not_matter() {
    for paint in [
        r##"<linearGradient id="a" href="#b"/><linearGradient id="b" href="#c"/><linearGradient id="c"><stop/></linearGradient>"##,
        r#"<radialGradient id="a"><stop/></radialGradient>"#,
        r##"<pattern id="a" width="1" height="1"><rect fill="url(#b)"/></pattern><pattern id="b"><rect fill="url(#a)"/></pattern>"##,
        r#"<pattern id="a" width="5" height="50%"><image/></pattern>"#,
    ] {
        let body = format!(r#"{paint}<rect y="300" width="20" height="10" fill="url(#a)"/>"#);
        assert!((area_m2(&draw(&body).unwrap()) - 0.02 * 0.01).abs() < 1e-6, "{paint}");
    }
}

#[test]
fn a_nominal_size_in_other_units_has_no_effect() {
    let body = r#"<rect x="-20" y="280" width="40" height="40"/>"#;
    let plain = draw(body).unwrap();
    for size in [r#"width="20cm" height="30cm""#, r#"width="1e30" height="1e-30""#, r#"width="0" height="100%""#] {
        let text = wrap(body).replacen("viewBox", &format!("{size} viewBox"), 1);
        assert_eq!(Map::from_svg("sized", &text).unwrap().walls(), plain.walls(), "{size}");
    }
}

#[test]
fn repairs_name_the_element_its_line_and_what_was_done() {
    let cases = [
        (
            r#"<path id="bow" d="M-50 250L50 350V250L-50 350Z"/>"#,
            r#"<path> id="bow" at line 2: its outline crosses itself; the fill rule decides what is wall"#,
        ),
        (
            r#"<path d="M-50 250H50V350L0 250L-50 350Z"/>"#,
            "<path> at line 2: its outline touches itself; the fill rule decides what is wall",
        ),
        (
            r#"<polyline points="-50,250 50,250 50,350"/>"#,
            "<polyline> at line 2: its outline is open; closed with a straight line",
        ),
        (
            r#"<rect id="flat" y="300" width="0" height="9"/>"#,
            r#"<rect> id="flat" at line 2: it draws nothing, having neither area nor stroke; left out"#,
        ),
        (r#"<line id="a" x2="50" y1="300" y2="300"/>"#, r#"<line> id="a" at line 2: it draws nothing"#),
        (r#"<circle cy="300" transform="scale(0)" r="9"/>"#, "<circle> at line 2: it draws nothing"),
        (
            r##"<defs><path d="M0 300H50V350" id="p"/></defs>
            <use href="#p"/><use href="#p" x="-50"/>"##,
            "<path> id=\"p\" at line 2: its outline is open",
        ),
        (
            r#"<rect y="300" width="1cm" height="10"/>"#,
            r#"<rect> at line 2: width="1cm" is taken as millimetres of the table"#,
        ),
        (
            r#"<path d="M0 300h20" stroke="red" stroke-width="null"/>"#,
            r#"<path> at line 2: stroke-width="null" is no value; ignored, as in browsers"#,
        ),
        (
            r#"<rect y="300" width="9" height="9" fill="url(#x)"/>"#,
            r#"<rect> at line 2: there is no gradient or pattern "x""#,
        ),
        (r#"<rect y="500" width="9" height="9"/>"#, "<rect> at line 2: it lies wholly outside the workspace"),
        (
            r#"<path fill="none" d="M0 300h20" stroke="red" stroke-width=".01"/>"#,
            "<path> at line 2: it is thinner than 0.1 mm",
        ),
    ];
    for (body, expected) in cases {
        let map = draw(&format!("\n{body}")).unwrap();
        let message = map.repairs()[0].to_string();
        assert!(message.starts_with(expected), "{body}: {message}");
    }
    let twice = draw("<line id=\"a\"/>\n<line id=\"a\"/><path id=\"a\" d=\"M0 300H9V310Z\"/>").unwrap();
    let lines: Vec<u32> = twice.repairs().iter().map(|repair| repair.place.line).collect();
    assert_eq!(lines, [1, 2]);
    // Strokes may be open, and a ring that ends at its start is closed.
    let fine = r#"<path fill="none" stroke="red" d="M0 300H50V350"/><path d="M0 300H50V350L0 300"/>"#;
    assert!(draw(fine).unwrap().repairs().is_empty());
    for name in Map::shipped_names() {
        assert!(Map::shipped(&name).unwrap().repairs().is_empty(), "{name}");
    }
}

#[test]
fn refuses_elements_that_cannot_be_walls_and_names_them() {
    assert_refused(&[
        (r#"<text id="label" x="0" y="300">hi</text>"#, "<text> id=\"label\" at line 1"),
        (r#"<image href="x.png"/>"#, "<image>"),
        (
            r##"<mask id="m"/><g id="g" mask="url(#m)"><rect width="9" height="9"/></g>"##,
            r#"<g> id="g" at line 1: mask="#,
        ),
        (r#"<script>alert()</script>"#, "<script>"),
        (r#"<rect y="300" width="9" height="9" filter="blur(3)"/>"#, "filter=\"blur(3)\" is not applied"),
        (r#"<line x2="50" stroke="red" stroke-dasharray="3 1"/>"#, r#"stroke-dasharray="3 1" is not drawn"#),
        (r#"<line x2="50" style="stroke:red; vector-effect: non-scaling-stroke"/>"#, "vector-effect"),
        (
            r#"<svg y="300" width="9" height="9"><rect width="20" height="9"/></svg>"#,
            "<svg> at line 1: its clip or viewport cuts off",
        ),
        (
            r##"<clipPath id="c"><circle cy="300" r="5"/></clipPath><rect id="r" y="300" width="9" height="9" clip-path="url(#c)"/>"##,
            "cuts off a part of it",
        ),
        (
            r#"<rect id="a" width="9" height="9" style="transform: rotate(90deg); transform-origin: center"/>"#,
            "transform-origin",
        ),
        (
            r#"<rect id="a" width="9" height="9" style="transform: translate(50%)"/>"#,
            r#"<rect> id="a" at line 1: transform="#,
        ),
        (r#"<rect id="a" width="9" height="9" style="translate: 5px"/>"#, r#"translate="5px" is not applied"#),
        (r#"<rect id="a" width="9" height="9" style="rx: calc(2px + 1px)"/>"#, "is computed"),
        ("<style>@media print { rect { display: none } }</style>", "<style> at line 1: \"@media print"),
        ("<style>@import url(a.css);</style>", "<style> at line 1: it refers to another file"),
        (r##"<marker id="k"/><path id="p" d="M0 300h9v9z" style="marker: url(#k)"/>"##, "markers are not drawn"),
        (r#"<rect width="9" height="9"><set attributeName="x" to="5"/></rect>"#, "<set> at line 1: animations"),
        (r#"<rect x="-100" y="200" width="200" height="200"/>"#, "no free space"),
    ]);
    for (text, part) in [
        ("<svg", "not a readable SVG"),
        ("no drawing at all", "this is not an SVG"),
        (r#"<html viewBox="0 0 50 50"/>"#, "this is not an SVG"),
        (r#"<html class="svg" viewBox="0 0 50 50"/>"#, "<html>"),
        (r#"<svg xmlns="http://www.w3.org/2000/svg"/>"#, "viewBox"),
        (r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 nan 5"/>"#, "finite"),
        (r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 5 5"/>"#, "20 to 4000"),
        (r#"<!DOCTYPE svg [<!ENTITY a "&b;"><!ENTITY b "">]><svg viewBox="0 0 50 50"/>"#, "entities"),
        (r#"<svg width="580mm" height="330mm" viewbox="0 0 9 9"/>"#, r#"viewBox="0 0 580 330", with a capital B"#),
        ("<?xml-stylesheet href='walls.css'?>\n<svg viewBox='0 0 50 50'/>", "another file"),
        (
            r#"<svg viewBox="0 0 50 50"><rect id="page" width="50" height="50" fill="white"/><g/></svg>"#,
            r#"<rect> id="page" at line 1 covers all of it"#,
        ),
    ] {
        let message = Map::from_svg("case", text).unwrap_err().to_string();
        assert!(message.contains(part), "{message}");
    }
    let doctype = format!("<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"svg11.dtd\">\n{}", wrap(""));
    assert!(Map::from_svg("doctype", &doctype).is_ok());
}

#[test]
fn refuses_values_out_of_range_and_names_element_and_value() {
    assert_refused(&[
        (r#"<circle id="c" r="ten"/>"#, r#"<circle> id="c" at line 1: r="ten" is not a number"#),
        (r#"<rect width="1e30" height="1"/>"#, r#"width="1e30""#),
        (r#"<rect x="NaN" width="1" height="1"/>"#, r#"x="NaN""#),
        (r#"<rect width="3em" height="1"/>"#, r#"width="3em""#),
        (r#"<path d="M0 300L1e30 0V9Z"/>"#, "d has the number 1e30"),
        (r#"<path d="M0 300A1e300 1e300 0 0 1 9 9Z"/>"#, "d has the number 1e300"),
        (r#"<path d="M0 300 l9 9 q5 Z"/>"#, "is broken"),
        (r#"<path d="M0 300 9 9;L9 9"/>"#, "is broken"),
        (r#"<path d="M0 300 9 9 7z"/>"#, "is broken"),
        (r#"<path d="M0 300 9 9 z 5 5"/>"#, "is broken"),
        (r#"<path d="M0 300 9,,9 z"/>"#, "is broken"),
        (r#"<polygon points="0,0 9,NaN 0,9"/>"#, "points=\"0,0 9,NaN 0,9\" is broken"),
        (r#"<polygon points="0,0 9,9 0"/>"#, "which is odd"),
        (r#"<polygon points="0,0 1e9,0 0,9"/>"#, "points has the number 1e9"),
        (r#"<line x2="9" stroke="red" stroke-width="1e30"/>"#, r#"stroke-width="1e30""#),
        (r#"<line x2="9" stroke="red" stroke-width="9e5"/>"#, "its stroke is too wide: 9e5 mm"),
        (
            r#"<g transform="scale(1e5)"><rect id="r" width="9" height="9"/></g>"#,
            r#"<rect> id="r" at line 1: it reaches too far"#,
        ),
        (r##"<use id="u" href="#nowhere"/>"##, r##"<use> id="u" at line 1: href="#nowhere""##),
    ]);
    // What is negative is no value, so that the stroke has its usual width.
    for (width, area) in [("0", 0.0), ("-1", 9e-6)] {
        let line = format!(r#"<path fill="none" d="M0 300H9" stroke="red" stroke-width="{width}"/>"#);
        assert!((area_m2(&draw(&line).unwrap()) - area).abs() < 1e-9, "{width}");
    }
}

/// Small files with a very large cost: each is refused before the cost arises.
#[test]
fn refuses_drawings_with_excessive_cost() {
    let zigzag = |count: u32, step: u32| {
        (0..count).fold("M0 300".to_owned(), |mut d, k| {
            write!(d, "L{} {}", k.wrapping_mul(step) % 200, 200 + k.wrapping_mul(step + 66) % 199).unwrap();
            d
        })
    };
    let hatch = |count: u32, length: f64| {
        (0..count).fold("M0 200".to_owned(), |mut d, k| {
            write!(d, "L{} {:.3}", f64::from(k % 2) * length, 200.0 + f64::from(k) / f64::from(count) * 199.0).unwrap();
            d
        })
    };
    let nested = |count| format!("{}<rect width=\"9\" height=\"9\"/>{}", "<g>".repeat(count), "</g>".repeat(count));
    let uses = (1..12).fold("<g id=\"a0\"/>".to_owned(), |mut text, k| {
        write!(text, "<g id=\"a{k}\">{}</g>", format!("<use href=\"#a{}\"/>", k - 1).repeat(9)).unwrap();
        text
    });
    let attributes = (0..2000).fold(String::new(), |text, k| format!("{text} a{k}=\"\""));
    let namespaces = (0..2000).fold(String::new(), |text, k| format!("{text} xmlns:a{k}=\"\""));
    let path = |d: &str| format!("<path id=\"z\" d=\"{d}Z\"/>");
    assert_refused(&[
        (
            &path(&zigzag(100_001, 7919)),
            r#"<path> id="z" at line 1: up to here the drawing has more than 200000 coordinates"#,
        ),
        (&path(&zigzag(1400, 7919)), r#"<path> id="z" at line 1: here too many outlines cross"#),
        (&path(&zigzag(49_000, 2)), r#"<path> id="z" at line 1: up to here the outlines are longer than 1000 times"#),
        // Edges that cross only at the closing edge. Found by manual fuzzing: it took four seconds and a gigabyte.
        (
            &path(&hatch(45_000, 200.0)),
            r#"<path> id="z" at line 1: up to here the outlines are longer than 1000 times"#,
        ),
        (&path(&format!("M0 300{}", "C9 9 90000 9 0 300".repeat(9000))), "more than 50000 vertices"),
        (&nested(65), "<g> at line 1: it is nested more than 64 elements deep"),
        (&nested(60_000), "nested more than 64"),
        (&"<g/>".repeat(30_000), "more than 20000 elements"),
        (r##"<g id="a"><use id="u" href="#b"/></g><g id="b"><use href="#a"/></g>"##, "or refers to itself"),
        (&uses, "each <use> resolved"),
        (&format!("<g{attributes}/>"), "more than 1000 attributes"),
        (&format!("<g{namespaces}/>"), "more than 100 namespaces"),
        (&format!("<style>{}</style>{}", "g,".repeat(9000) + "a{fill:red}", "<g/>".repeat(9000)), "too many rules"),
        (&format!("<style>{}</style>{}", "z ~ g{fill:red}".repeat(200), "<g/>".repeat(9000)), "too many rules"),
        (
            &format!("<g id=\"a\" transform=\"{}\"/>{}", "rotate(1)".repeat(60_000), "<use href=\"#a\"/>".repeat(9000)),
            "bytes, each <use> resolved",
        ),
        (&format!("<rect fill=\"{}\"/>", "url(#a)".repeat(90_000)), "is a colour that Ferry does not know"),
        (&format!("<title>{}</title>", " ".repeat(1 << 20)), "the limit is 1048576"),
    ]);
    assert!(draw(&nested(60)).is_ok());
    assert!(draw(&path(&hatch(500, 200.0))).is_ok());
}

/// Found by fuzzing: a coarser precision of the union left a thousand slivers of these.
#[test]
fn strokes_that_nearly_coincide_leave_no_slivers() {
    let paths = ["m5 5h5v33.3q5 5 -200 5t250 33.3s-.5 100 100 5", "m0 0h0v5q5 5 5 5t5 5s5 5 100 1.5"];
    let others = ["m0 0h0v7e1q7e1 7e1 7e1 400t7e1 7e1s7e1 5 5 5", "m5 33.3h5v5q-200 5 250 33.3t-.5 100s100 5 5 5"];
    let stroke = |d| {
        format!(
            "<path d=\"{d}\" fill-rule=\"evenodd\" stroke=\"#123\" stroke-linecap=\"square\" transform=\"scale(1.5 -.5)\"/>"
        )
    };
    let ellipse = "<ellipse cx=\"70\" cy=\"5\" rx=\"100\" ry=\"5\" stroke=\"#123\" transform=\"scale(1.5 -.5)\"/>";
    let body = [paths.map(stroke).concat(), ellipse.to_owned(), others.map(stroke).concat()].concat();
    let view = "-2000 -2000 4000 4000";
    let svg = format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{view}\">{body}</svg>");
    let map = Map::from_svg("case", &svg).unwrap();
    assert_eq!(map.walls().len(), 1);
    assert!(map.walls()[0].holes.len() < 20, "{}", map.walls()[0].holes.len());
}

/// Found by fuzzing: with the union's own precision these took seven seconds.
#[test]
fn strokes_that_nearly_coincide_are_united_within_a_second() {
    let ends = ["t100 5s5 5 5 5", "t5 5s5 5 5 5", "t5 5s7e1 7e1 7e1 7e1"];
    let stroke = |end| {
        format!(
            "<path d=\"m5 5h5v5q5 5 5 5{end}\" stroke=\"#123\" stroke-width=\"4\" stroke-linecap=\"round\" transform=\"scale(1.5 -.5)\"/>"
        )
    };
    let body = ends.map(stroke).concat();
    let view = "-2000 -2000 4000 4000";
    let svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{view}\"><g transform=\"scale(1.5 -.5)\">{body}</g></svg>"
    );
    let started = std::time::Instant::now();
    let map = Map::from_svg("case", &svg).unwrap();
    assert_eq!(map.walls().len(), 1);
    assert!(started.elapsed().as_secs_f64() < 1.0, "{:?}", started.elapsed());
}
