//! What a drawing says of its origin.

/// Where a drawing comes from, carried by each of its files: RDF in the `<metadata>` of an SVG, document information
/// and XMP (ISO 16684-1) in a PDF. It holds no time, so that the same drawing has the same bytes.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Provenance {
    /// The title of what the drawing shows.
    pub title: String,
    /// The program and its version.
    pub producer: String,
    /// The text of the scene it was made from.
    pub scene: String,
    /// The identity of the motion, such as its SHA-256.
    pub hash: String,
}

impl Provenance {
    /// As RDF/XML.
    pub(super) fn rdf(&self) -> String {
        let [title, producer, scene, hash] =
            [&self.title, &self.producer, &self.scene, &self.hash].map(|text| escaped(text));
        format!(
            "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n\
             <rdf:Description rdf:about=\"\" xmlns:dc=\"http://purl.org/dc/elements/1.1/\" \
             xmlns:pdf=\"http://ns.adobe.com/pdf/1.3/\" xmlns:foldmotion=\"urn:foldmotion:1\">\n\
             <dc:title><rdf:Alt><rdf:li xml:lang=\"x-default\">{title}</rdf:li></rdf:Alt></dc:title>\n\
             <pdf:Producer>{producer}</pdf:Producer>\n\
             <foldmotion:hash>{hash}</foldmotion:hash>\n\
             <foldmotion:scene>{scene}</foldmotion:scene>\n\
             </rdf:Description>\n</rdf:RDF>\n"
        )
    }

    /// As an XMP packet; its first line holds a byte order mark, as XMP demands.
    pub(super) fn xmp(&self) -> String {
        let (mark, rdf) = ('\u{feff}', self.rdf());
        format!(
            "<?xpacket begin=\"{mark}\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n\
             <x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n{rdf}</x:xmpmeta>\n<?xpacket end=\"r\"?>\n"
        )
    }
}

/// `text` inside XML; characters that XML 1.0 cannot represent are left out.
pub(super) fn escaped(text: &str) -> String {
    let mut xml = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => xml.push_str("&amp;"),
            '<' => xml.push_str("&lt;"),
            '>' => xml.push_str("&gt;"),
            '\t' | '\n' | '\r' => xml.push(letter),
            '\0'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => {}
            _ => xml.push(letter),
        }
    }
    xml
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_escaped_and_what_xml_cannot_hold_is_left_out() {
        assert_eq!(escaped("a < b & c\n\u{1}λ"), "a &lt; b &amp; c\nλ");
        let origin = Provenance {
            scene: "[motion] # </foldmotion:scene>".to_owned(),
            ..Provenance::default()
        };
        let xmp = origin.xmp();
        assert_eq!(xmp.matches("</foldmotion:scene>").count(), 1, "{xmp}");
    }
}
