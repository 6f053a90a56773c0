//! The properties of SVG elements: presentation attributes, style rules, `style` attributes.

use roxmltree::Node;
use simplecss::{AttributeOperator, DeclarationTokenizer, Element, PseudoClass, StyleSheet};

use super::super::warning::{WarningKind, Warnings};
use super::super::{ImportError, MOST_STYLE_RULES};
use super::LineNumbers;

/// The most bytes of all style sheets.
const MOST_STYLE_BYTES: usize = 1 << 18;
/// The most declarations of all rules together.
const MOST_DECLARATIONS: usize = 1_000_000;

/// The properties that matter here.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Properties<'a> {
    pub(super) color: Option<&'a str>,
    pub(super) fill: Option<&'a str>,
    pub(super) stroke: Option<&'a str>,
    pub(super) stroke_opacity: Option<&'a str>,
    pub(super) opacity: Option<&'a str>,
    pub(super) display: Option<&'a str>,
    pub(super) visibility: Option<&'a str>,
    pub(super) transform: Option<&'a str>,
}

impl<'a> Properties<'a> {
    fn set(&mut self, name: &str, value: &'a str) {
        let value = Some(value.trim());
        match name {
            "color" => self.color = value,
            "fill" => self.fill = value,
            "stroke" => self.stroke = value,
            "stroke-opacity" => self.stroke_opacity = value,
            "opacity" => self.opacity = value,
            "display" => self.display = value,
            "visibility" => self.visibility = value,
            "transform" => self.transform = value,
            _ => {}
        }
    }
}

/// The rules of all style sheets, later ones stronger.
pub(super) struct Styles<'a> {
    sheet: StyleSheet<'a>,
}

impl<'a> Styles<'a> {
    /// Reads every `<style>`. Rules that depend on other elements are left out with a warning.
    pub(super) fn read(
        root: Node<'a, 'a>,
        numbering: &LineNumbers,
        warnings: &mut Warnings,
    ) -> Result<Self, ImportError> {
        let mut sheet = StyleSheet::new();
        let mut bytes = 0;
        let elements = root.descendants().filter(|n| n.tag_name().name() == "style");
        for element in elements {
            for text in element.children().filter_map(|c| c.text()) {
                bytes += text.len();
                check("bytes of style sheets", bytes, MOST_STYLE_BYTES)?;
                let count = |signs: &[u8]| text.bytes().filter(|b| signs.contains(b)).count();
                // Each selector of a list gets all declarations that follow.
                let selectors = count(b",{") + 1;
                check(
                    "declarations in style sheets",
                    selectors * (count(b";}") + 1),
                    MOST_DECLARATIONS,
                )?;
                let before = sheet.rules.len();
                sheet.parse_more(text);
                let looks_around = |rule: &simplecss::Rule<'_>| {
                    rule.selector.to_string().contains([' ', '>', '+', ':'])
                };
                if sheet.rules.iter().any(looks_around) {
                    warnings.add(WarningKind::Ignored, &numbering.source(element));
                }
                sheet.rules.retain(|rule| !looks_around(rule));
                if sheet.rules.len() == before && !text.trim().is_empty() {
                    warnings.add(WarningKind::Ignored, &numbering.source(element));
                }
            }
        }
        check("style rules", sheet.rules.len(), MOST_STYLE_RULES)?;
        Ok(Self { sheet })
    }

    /// The properties of an element itself, before inheritance.
    pub(super) fn of(&self, node: Node<'a, 'a>) -> Properties<'a> {
        let mut properties = Properties::default();
        for attribute in node.attributes().filter(|a| a.namespace().is_none()) {
            properties.set(attribute.name(), attribute.value());
        }
        let element = SingleElement(node);
        let rules = self.sheet.rules.iter();
        let matching = rules.filter(|rule| rule.selector.matches(&element));
        let ruled: Vec<_> = matching.flat_map(|rule| &rule.declarations).collect();
        let style = node.attribute("style").unwrap_or_default();
        let own: Vec<_> = DeclarationTokenizer::from(style).collect();
        for is_important in [false, true] {
            let by_rule = ruled.iter().copied();
            for declaration in by_rule.chain(&own).filter(|d| d.important == is_important) {
                properties.set(declaration.name, declaration.value);
            }
        }
        properties
    }
}

fn check(what: &'static str, found: usize, limit: usize) -> Result<(), ImportError> {
    if found <= limit {
        return Ok(());
    }
    Err(ImportError::TooMany { what, found, limit })
}

/// An element as selectors see it: without the elements around it, which would make matching slow without bound.
struct SingleElement<'a>(Node<'a, 'a>);

impl Element for SingleElement<'_> {
    fn parent_element(&self) -> Option<Self> {
        None
    }

    fn prev_sibling_element(&self) -> Option<Self> {
        None
    }

    fn has_local_name(&self, name: &str) -> bool {
        self.0.tag_name().name() == name
    }

    fn attribute_matches(&self, name: &str, operator: AttributeOperator<'_>) -> bool {
        self.0.attribute(name).is_some_and(|value| operator.matches(value))
    }

    fn pseudo_class_matches(&self, _: PseudoClass<'_>) -> bool {
        false
    }
}
