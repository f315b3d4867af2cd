//! Elements of a Collada document: look-up by id, and line numbers for faults.

use crate::affine::Up;
use crate::findings::{Finding, Findings};
use roxmltree::{Document, Node as Element};
use std::collections::HashMap;

/// A document with its unit and axis.
pub(super) struct Reader<'a> {
    pub(super) document: &'a Document<'a>,
    pub(super) by_id: HashMap<&'a str, Element<'a, 'a>>,
    pub(super) file: String,
    pub(super) up: Up,
    /// Metres in one unit of the file.
    pub(super) unit_m: f64,
}

impl<'a> Reader<'a> {
    /// The element named by the `url` or `source` of another.
    pub(super) fn target(
        &self,
        from: Element<'a, 'a>,
        tag: &str,
        findings: &mut Findings,
    ) -> Option<Element<'a, 'a>> {
        findings.ok(self.linked(from, &[tag]))
    }

    pub(super) fn linked(&self, from: Element<'a, 'a>, tags: &[&str]) -> Result<Element<'a, 'a>, Finding> {
        let url = from.attribute("url").or(from.attribute("source")).unwrap_or("");
        let found = url.strip_prefix('#').and_then(|id| self.by_id.get(id)).copied();
        found.filter(|element| tags.contains(&element.tag_name().name())).ok_or_else(|| {
            let cause = match url.strip_prefix('#') {
                Some(id) => format!("there is no <{}> of the id `{id}`", tags.join("> or <")),
                None => format!("`{url}` names no part of this file"),
            };
            self.damaged(from, cause)
        })
    }

    /// File and line of an element.
    pub(super) fn place(&self, element: Element<'a, 'a>) -> String {
        format!("{}:{}", self.file, self.document.text_pos_at(element.range().start).row)
    }

    pub(super) fn damaged(&self, element: Element<'a, 'a>, cause: String) -> Finding {
        let cure = "export it again, whole and as one file".to_owned();
        Finding { path: self.place(element), rule: "damaged", cause, cure }
    }
}

pub(super) fn children<'a>(
    element: Element<'a, 'a>,
    tag: &'static str,
) -> impl Iterator<Item = Element<'a, 'a>> {
    element.children().filter(move |child| child.tag_name().name() == tag)
}

pub(super) fn child<'a>(element: Element<'a, 'a>, tag: &'static str) -> Option<Element<'a, 'a>> {
    children(element, tag).next()
}
