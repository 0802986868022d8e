//! Elements as the selector library sees them.

use std::num::NonZeroUsize;
use std::ptr::NonNull;

use cssparser::{ParseError, ToCss};
use precomputed_hash::PrecomputedHash;
use selectors::attr::{AttrSelectorOperation, CaseSensitivity, NamespaceConstraint};
use selectors::bloom::BloomFilter;
use selectors::context::MatchingContext;
use selectors::matching::ElementSelectorFlags;
use selectors::parser::{NonTSPseudoClass, PseudoElement, SelectorImpl};
use selectors::{Element, OpaqueElement};
use usvg::roxmltree::{Node, NodeId};

use super::super::own;
use super::{Top, Unread};

/// States of elements that people do not touch.
const STATES: [&str; 9] =
    ["hover", "active", "focus", "focus-visible", "focus-within", "visited", "target", "checked", "disabled"];

impl<'i> selectors::Parser<'i> for Top {
    type Impl = Names;
    type Error = Unread;

    fn parse_is_and_where(&self) -> bool {
        true
    }

    fn allow_forgiving_selectors(&self) -> bool {
        false
    }

    fn parse_non_ts_pseudo_class(&self, name: &str) -> Result<Never, ParseError<Unread>> {
        let is_state = STATES.iter().any(|state| name.eq_ignore_ascii_case(state));
        is_state.then_some(Never).ok_or_else(|| ParseError::custom(Unread))
    }

    /// Shapes have none.
    fn parse_pseudo_element(&self, _: &str) -> Result<Never, ParseError<Unread>> {
        Ok(Never)
    }
}

#[derive(Clone, Debug)]
pub(super) struct Names;

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Name(String);

/// What no element is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Never;

impl SelectorImpl for Names {
    type ExtraMatchingData<'a> = ();
    type AttrValue = Name;
    type Identifier = Name;
    type LocalName = Name;
    type NamespaceUrl = Name;
    type NamespacePrefix = Name;
    type BorrowedNamespaceUrl = Name;
    type BorrowedLocalName = Name;
    type NonTSPseudoClass = Never;
    type PseudoElement = Never;
}

impl From<&str> for Name {
    fn from(name: &str) -> Self {
        Self(name.to_owned())
    }
}

impl AsRef<str> for Name {
    fn as_ref(&self) -> &str {
        &self.0
    }
}

impl ToCss for Name {
    fn to_css<W: std::fmt::Write>(&self, to: &mut W) -> std::fmt::Result {
        cssparser::serialize_identifier(&self.0, to)
    }
}

/// Only needed with filters of ancestors, which are not used.
impl PrecomputedHash for Name {
    fn precomputed_hash(&self) -> u32 {
        0
    }
}

impl ToCss for Never {
    fn to_css<W: std::fmt::Write>(&self, to: &mut W) -> std::fmt::Result {
        to.write_str("never")
    }
}

impl NonTSPseudoClass for Never {
    fn is_active_or_hover(&self) -> bool {
        false
    }

    fn is_user_action_state(&self) -> bool {
        false
    }
}

impl PseudoElement for Never {}

/// An element, or a copy of it by a `use`, whose tree begins with what the `use` refers to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Matched<'a, 'input> {
    pub node: Node<'a, 'input>,
    pub top: Option<NodeId>,
}

impl<'a, 'input> Matched<'a, 'input> {
    /// An element beside it or above; none if this is the top.
    fn other(self, node: Option<Node<'a, 'input>>) -> Option<Self> {
        let Self { top, .. } = self;
        node.filter(|_| top != Some(self.node.id())).map(|node| Self { node, top })
    }
}

impl Element for Matched<'_, '_> {
    type Impl = Names;

    fn opaque(&self) -> OpaqueElement {
        let address = NonZeroUsize::MIN.saturating_add(self.node.id().get_usize());
        OpaqueElement::from_ptr(NonNull::without_provenance(address))
    }

    fn parent_element(&self) -> Option<Self> {
        self.other(self.node.parent_element())
    }

    fn prev_sibling_element(&self) -> Option<Self> {
        self.other(self.node.prev_sibling_element())
    }

    fn next_sibling_element(&self) -> Option<Self> {
        self.other(self.node.next_sibling_element())
    }

    fn first_element_child(&self) -> Option<Self> {
        self.node.first_element_child().map(|node| Self { node, ..*self })
    }

    fn has_local_name(&self, name: &Name) -> bool {
        self.node.tag_name().name() == name.0
    }

    fn has_namespace(&self, namespace: &Name) -> bool {
        self.node.tag_name().namespace().unwrap_or_default() == namespace.0
    }

    fn is_same_type(&self, other: &Self) -> bool {
        self.node.tag_name() == other.node.tag_name()
    }

    fn attr_matches(
        &self,
        namespace: &NamespaceConstraint<&Name>,
        name: &Name,
        operation: &AttrSelectorOperation<&Name>,
    ) -> bool {
        let is_there = |found: Option<&str>| match namespace {
            NamespaceConstraint::Any => true,
            NamespaceConstraint::Specific(wanted) => found.unwrap_or_default() == wanted.0,
        };
        let mut named = self.node.attributes().filter(|one| one.name() == name.0 && is_there(one.namespace()));
        named.any(|one| operation.eval_str(one.value()))
    }

    fn has_id(&self, id: &Name, case: CaseSensitivity) -> bool {
        own(self.node, "id").is_some_and(|own| case.eq(own.as_bytes(), id.0.as_bytes()))
    }

    fn has_class(&self, class: &Name, case: CaseSensitivity) -> bool {
        let mut own = own(self.node, "class").unwrap_or_default().split_ascii_whitespace();
        own.any(|own| case.eq(own.as_bytes(), class.0.as_bytes()))
    }

    fn is_empty(&self) -> bool {
        let is_text = |child: Node<'_, '_>| child.is_text() && child.text().is_some_and(|text| !text.is_empty());
        !self.node.children().any(|child| child.is_element() || is_text(child))
    }

    fn is_root(&self) -> bool {
        self.node.parent_element().is_none()
    }

    fn match_non_ts_pseudo_class(&self, _: &Never, _: &mut MatchingContext<Names>) -> bool {
        false
    }

    fn match_pseudo_element(&self, _: &Never, _: &mut MatchingContext<Names>) -> bool {
        false
    }

    fn parent_node_is_shadow_root(&self) -> bool {
        false
    }

    fn containing_shadow_host(&self) -> Option<Self> {
        None
    }

    fn is_pseudo_element(&self) -> bool {
        false
    }

    fn is_html_element_in_html_document(&self) -> bool {
        false
    }

    fn is_html_slot_element(&self) -> bool {
        false
    }

    fn is_link(&self) -> bool {
        false
    }

    fn has_custom_state(&self, _: &Name) -> bool {
        false
    }

    fn imported_part(&self, _: &Name) -> Option<Name> {
        None
    }

    fn is_part(&self, _: &Name) -> bool {
        false
    }

    fn apply_selector_flags(&self, _: ElementSelectorFlags) {}

    fn add_element_unique_hashes(&self, _: &mut BloomFilter) -> bool {
        false
    }
}
