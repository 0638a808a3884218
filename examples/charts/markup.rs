//! The one writer of SVG and HTML: every text and attribute goes through it, and is escaped by it.

/// Well-formed markup in the making.
#[derive(Debug, Default)]
pub struct Markup {
    text: String,
    open: Vec<&'static str>,
}

/// `(name, value)`; the value as plain text.
pub type Attribute<'a> = (&'a str, &'a str);

impl Markup {
    /// Opens an element.
    pub fn open(&mut self, name: &'static str, attributes: &[Attribute]) -> &mut Self {
        self.start(name, attributes);
        self.text.push('>');
        self.open.push(name);
        self
    }

    /// Closes the innermost open element; panics when none is open.
    pub fn close(&mut self) -> &mut Self {
        let Some(name) = self.open.pop() else { unreachable!("nothing is open after {}", self.text) };
        self.text.push_str("</");
        self.text.push_str(name);
        self.text.push('>');
        self
    }

    /// An element without content.
    pub fn leaf(&mut self, name: &'static str, attributes: &[Attribute]) -> &mut Self {
        self.start(name, attributes);
        self.text.push_str("/>");
        self
    }

    /// An element that holds a text.
    pub fn element(&mut self, name: &'static str, attributes: &[Attribute], text: &str) -> &mut Self {
        self.open(name, attributes).text(text).close()
    }

    /// Plain text.
    pub fn text(&mut self, text: &str) -> &mut Self {
        escape_into(&mut self.text, text);
        self
    }

    /// A line end between elements, for people who read the source.
    pub fn line(&mut self) -> &mut Self {
        self.text.push('\n');
        self
    }

    /// Markup that is finished: another `Markup`'s, or a file of this crate.
    pub fn raw(&mut self, markup: &str) -> &mut Self {
        self.text.push_str(markup);
        self
    }

    /// The text; panics when an element is still open.
    pub fn finish(self) -> String {
        assert!(self.open.is_empty(), "still open: {:?}", self.open);
        self.text
    }

    fn start(&mut self, name: &str, attributes: &[Attribute]) {
        self.text.push('<');
        self.text.push_str(name);
        for (name, value) in attributes {
            self.text.push(' ');
            self.text.push_str(name);
            self.text.push_str("=\"");
            escape_into(&mut self.text, value);
            self.text.push('"');
        }
    }
}

/// `text` so that it stands for itself between tags and in quoted attributes, of HTML as of XML 1.0. Characters that XML cannot
/// hold become U+FFFD.
pub fn escape(text: &str) -> String {
    let mut out = String::new();
    escape_into(&mut out, text);
    out
}

fn escape_into(out: &mut String, text: &str) {
    for character in text.chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\t' | '\n' => out.push(character),
            '\0'..'\u{20}' | '\u{7f}'..='\u{9f}' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            _ => out.push(character),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ODD: &str = "<script>&amp;\"' ]]> \u{1F300} \u{0} \u{b} \u{202e}-- \u{fffe}";

    #[test]
    fn odd_text_stands_for_itself_in_text_and_attributes() {
        let mut markup = Markup::default();
        markup.open("a", &[("b", ODD)]).text(ODD).leaf("c", &[]).close();
        let text = markup.finish();
        let document = roxmltree::Document::parse(&text).unwrap();
        let back = ODD.replace(['\0', '\u{b}', '\u{fffe}'], "\u{fffd}");
        assert_eq!(document.root_element().text(), Some(back.as_str()));
        assert_eq!(document.root_element().attribute("b"), Some(back.as_str()));
    }

    #[test]
    fn what_is_not_escaped_would_not_parse() {
        let mut markup = Markup::default();
        markup.open("a", &[]).raw(ODD).close();
        assert!(roxmltree::Document::parse(&markup.finish()).is_err());
    }

    #[test]
    #[should_panic(expected = "still open")]
    fn an_element_left_open_is_a_fault() {
        let mut markup = Markup::default();
        markup.open("a", &[]);
        markup.finish();
    }
}
