//! Style sheets and `style` attributes: which declarations an element has, and in which order. Syntax and selectors are
//! read as in browsers, by Servo's crates. What a browser would drop is an error here.

mod selecting;

use cssparser::{
    AtRuleParser, CowRcStr, DeclarationParser, Delimiter, ParseError, Parser, ParserState, QualifiedRuleParser,
    RuleBodyItemParser, RuleBodyParser, StyleSheetParser, Token,
};
use selectors::context::{
    MatchingContext, MatchingForInvalidation, MatchingMode, NeedsSelectorFlags, QuirksMode, SelectorCaches,
};
use selectors::matching::matches_selector;
use selectors::parser::{ParseRelative, Selector, SelectorList, SelectorParseErrorKind};
use usvg::roxmltree::{Node, NodeId};

use super::{own, short};
use selecting::{Matched, Names};

/// `name: value`
#[derive(Clone, Debug, PartialEq)]
pub struct Declaration {
    /// In lower case.
    pub name: String,
    pub value: String,
    is_important: bool,
}

/// A rule of a style sheet.
#[derive(Debug)]
struct Rule {
    selectors: SelectorList<Names>,
    declarations: Vec<Declaration>,
    cost: Cost,
}

/// What a comparison of selectors with an element costs, in simple selectors.
#[derive(Clone, Copy, Debug)]
struct Cost {
    simple: usize,
    /// Whether the elements beside it are compared, too.
    beside: bool,
}

/// The rules of a drawing's style sheets.
#[derive(Debug, Default)]
pub struct Sheet {
    rules: Vec<Rule>,
}

impl Sheet {
    /// Adds the rules of a style sheet.
    ///
    /// # Errors
    /// The part that is not understood.
    pub fn add(&mut self, text: &str) -> Result<(), String> {
        let (mut input, mut top) = (Parser::new(text), Top);
        for rule in StyleSheetParser::new(&mut input, &mut top) {
            self.rules.extend(rule.map_err(|(_, part, _)| not_understood(part))?);
        }
        Ok(())
    }

    /// Comparisons with one element that has at most so many beside it.
    pub fn cost(&self, most_beside: usize) -> usize {
        let of_one = |cost: Cost| cost.simple * if cost.beside { 1 + most_beside / 16 } else { 1 };
        self.rules.iter().map(|rule| of_one(rule.cost)).sum()
    }

    /// The declarations of an element, in a copy of the tree below `top` if that is given. The one that counts is last: rules, then its attribute `style`, then what is important
    /// of both.
    ///
    /// # Errors
    /// The part of the attribute that is not understood.
    pub fn declarations(
        &self,
        node: Node<'_, '_>,
        top: Option<NodeId>,
        caches: &mut SelectorCaches,
    ) -> Result<Vec<Declaration>, String> {
        let mut context = MatchingContext::new(
            MatchingMode::Normal,
            None,
            caches,
            QuirksMode::NoQuirks,
            NeedsSelectorFlags::No,
            MatchingForInvalidation::No,
        );
        let mut specificity = |selectors: &SelectorList<Names>| {
            let matching = |one: &&Selector<Names>| matches_selector(one, 0, None, Matched { node, top }, &mut context);
            selectors.slice().iter().filter(matching).map(Selector::specificity).max()
        };
        let matching = self.rules.iter().filter_map(|rule| Some((specificity(&rule.selectors)?, rule)));
        let mut matching: Vec<_> = matching.collect();
        // Of equals the last one counts.
        matching.sort_by_key(|(specificity, _)| *specificity);
        let own = body(own(node, "style").unwrap_or_default())?;
        let all = matching.into_iter().flat_map(|(_, rule)| rule.declarations.iter().cloned()).chain(own);
        let (important, normal): (Vec<_>, Vec<_>) = all.partition(|one: &Declaration| one.is_important);
        Ok([normal, important].concat())
    }
}

fn not_understood(part: &str) -> String {
    let part = part.trim();
    if part.to_ascii_lowercase().starts_with("@import") {
        return "it refers to another file; copy its content here".to_owned();
    }
    format!("{:?} is not understood; use attributes, or plain rules such as .wall {{ fill: black }}", short(part))
}

/// The content of a rule or of an attribute `style`.
fn body(text: &str) -> Result<Vec<Declaration>, String> {
    let (mut input, mut body) = (Parser::new(text), Body);
    let all = RuleBodyParser::new(&mut input, &mut body);
    all.map(|one| one.map_err(|(_, part, _)| not_understood(part))).collect()
}

/// Of the selector library: a text that is not understood.
struct Unread;

impl From<SelectorParseErrorKind> for Unread {
    fn from(_: SelectorParseErrorKind) -> Self {
        Self
    }
}

struct Body;

impl<'i> DeclarationParser<'i> for Body {
    type Declaration = Declaration;
    type Error = Unread;

    fn parse_value(
        &mut self,
        name: CowRcStr<'i>,
        input: &mut Parser<'i>,
        _: &ParserState,
    ) -> Result<Declaration, ParseError<Unread>> {
        let value = input.parse_until_before::<_, _, Unread>(Delimiter::Bang, |input| {
            let from = input.position();
            while let Ok(token) = input.next_including_whitespace_and_comments() {
                // A rule in a rule.
                if matches!(token, Token::CurlyBracketBlock) && !name.starts_with("--") {
                    return Err(ParseError::custom(Unread));
                }
            }
            Ok(without_comments(input.slice_from(from)))
        })?;
        let is_important = input.try_parse(cssparser::parse_important).is_ok();
        input.expect_exhausted()?;
        Ok(Declaration { name: name.to_ascii_lowercase(), value: value.trim().to_owned(), is_important })
    }
}

impl QualifiedRuleParser<'_> for Body {
    type Prelude = ();
    type QualifiedRule = Declaration;
    type Error = Unread;
}

impl AtRuleParser<'_> for Body {
    type Prelude = ();
    type AtRule = Declaration;
    type Error = Unread;
}

impl RuleBodyItemParser<'_, Declaration, Unread> for Body {
    fn parse_declarations(&self) -> bool {
        true
    }

    fn parse_qualified(&self) -> bool {
        false
    }
}

/// Comments become spaces. No value that matters here has a string with `/*`.
fn without_comments(value: &str) -> String {
    let mut parts = value.split("/*");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| text + " " + part.split_once("*/").map_or("", |(_, after)| after))
}

struct Top;

/// At-rules without effect on shapes, if nothing refers to them.
const IDLE: [&str; 7] =
    ["font-face", "keyframes", "-webkit-keyframes", "font-feature-values", "counter-style", "page", "color-profile"];

impl<'i> AtRuleParser<'i> for Top {
    type Prelude = ();
    type AtRule = Option<Rule>;
    type Error = Unread;

    fn parse_prelude(&mut self, name: CowRcStr<'i>, input: &mut Parser<'i>) -> Result<(), ParseError<Unread>> {
        while input.next().is_ok() {}
        let is_idle = IDLE.iter().any(|idle| name.eq_ignore_ascii_case(idle));
        is_idle.then_some(()).ok_or_else(|| ParseError::custom(Unread))
    }

    fn parse_block(
        &mut self,
        (): (),
        _: &ParserState,
        input: &mut Parser<'i>,
    ) -> Result<Option<Rule>, ParseError<Unread>> {
        while input.next().is_ok() {}
        Ok(None)
    }
}

impl<'i> QualifiedRuleParser<'i> for Top {
    type Prelude = (SelectorList<Names>, Cost);
    type QualifiedRule = Option<Rule>;
    type Error = Unread;

    fn parse_prelude(&mut self, input: &mut Parser<'i>) -> Result<(SelectorList<Names>, Cost), ParseError<Unread>> {
        let from = input.position();
        let selectors = SelectorList::parse(self, input, ParseRelative::No)?;
        let text = input.slice_from(from);
        let beside = ["~", "nth", "last", "only", "type"].iter().any(|part| text.to_ascii_lowercase().contains(part));
        Ok((selectors, Cost { simple: 1 + text.len() / 16, beside }))
    }

    fn parse_block(
        &mut self,
        (selectors, cost): (SelectorList<Names>, Cost),
        _: &ParserState,
        input: &mut Parser<'i>,
    ) -> Result<Option<Rule>, ParseError<Unread>> {
        let mut body = Body;
        let all = RuleBodyParser::new(input, &mut body).map(|one| one.map_err(|(error, ..)| error));
        Ok(Some(Rule { selectors, declarations: all.collect::<Result<_, _>>()?, cost }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use usvg::roxmltree::Document;

    /// The declarations of the element with the id `x`, as `name:value`.
    fn of_x(sheet: &str, body: &str) -> String {
        let text = format!("<svg xmlns='http://www.w3.org/2000/svg' xmlns:i='urn:i'>{body}</svg>");
        let document = Document::parse(&text).unwrap();
        let x = document.descendants().find(|node| node.attribute("id") == Some("x")).unwrap();
        let mut all = Sheet::default();
        all.add(sheet).unwrap();
        let found = all.declarations(x, None, &mut SelectorCaches::default()).unwrap();
        found.iter().map(|one| format!("{}:{}", one.name, one.value)).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn declarations_come_in_the_order_of_the_cascade() {
        let body = "<g class='a b'><path/><path id='x' class='w' i:k='v' style='D: 4; e: 5 !important'/></g>";
        let sheet = "#x {a: 1} path {b: 2 /* no */ ; b2:url(#q)} .w, #no {c: 3 !IMPORTANT} @font-face {src: x} .a path:hover {z: 9}";
        assert_eq!(of_x(sheet, body), "b:2 b2:url(#q) a:1 d:4 c:3 e:5");
        for (selector, matches) in [
            ("path:nth-child(2)", true),
            ("g > path + path", true),
            ("g.b.a path", true),
            ("svg ~ path", false),
            ("path:not(.w)", false),
            (":is(g, svg) > .w", true),
            ("[class^=w]", true),
            ("Path", false),
            ("path:last-child", true),
            ("path::before", false),
            ("*", true),
        ] {
            assert_eq!(!of_x(&format!("{selector} {{a:1}}"), body).contains("a:1"), !matches, "{selector}");
        }
    }

    #[test]
    fn what_is_not_understood_is_named() {
        for (sheet, part) in [
            ("@media print { path { fill: none } }", "@media print"),
            ("@import 'walls.css';", "refers to another file"),
            ("path:has(g) { fill: none }", "path:has(g)"),
            ("path { fill }", "path"),
            ("path { fill: red", ""),
            ("i|path { fill: red }", "i|path"),
            ("a:future { fill: red }", "a:future"),
            ("} .a { fill: none }", "} .a"),
            ("g { rect:first-child { fill: none } }", "rect:first-child"),
        ] {
            let error = Sheet::default().add(sheet).err().unwrap_or_default();
            assert_eq!(error.is_empty(), part.is_empty(), "{sheet}: {error}");
            assert!(error.contains(part), "{sheet}: {error}");
        }
        assert!(body("fill: red; nonsense; stroke: red").unwrap_err().contains("nonsense"));
        assert!(body(" ; fill:red;; ").is_ok());
    }
}
