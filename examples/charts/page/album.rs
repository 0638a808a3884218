//! Pictures of a page: each file once, as a data URI, however often it is looked at.

use super::ReadPicture;
use crate::markup::Markup;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use shadowgraph_core::problem::{Kind, Place, Problem};
use std::collections::HashMap;

pub struct Album<'a> {
    read: &'a ReadPicture<'a>,
    left_bytes: usize,
    entries: HashMap<String, Result<usize, &'static str>>,
    pictures: Vec<Picture>,
    pub remarks: Vec<Problem>,
}

struct Picture {
    bytes: Vec<u8>,
    size: [u32; 2],
}

const TOO_MANY: &str = "beyond the page's room for pictures";
const UNREADABLE: &str = "cannot be read";

impl<'a> Album<'a> {
    pub fn new(read: &'a ReadPicture<'a>, max_bytes: usize) -> Self {
        Self { read, left_bytes: max_bytes, entries: HashMap::new(), pictures: Vec::new(), remarks: Vec::new() }
    }

    /// Takes a file in, if there is room. The order of calls is the order of importance.
    pub fn admit(&mut self, name: &str) {
        if self.entries.contains_key(name) {
            return;
        }
        let picture = (self.read)(name).and_then(|bytes| Ok(Picture { size: png_size(&bytes, name)?, bytes }));
        let entry = match picture {
            Ok(picture) if picture.bytes.len() > self.left_bytes => Err(TOO_MANY),
            Ok(picture) => {
                self.left_bytes -= picture.bytes.len();
                self.pictures.push(picture);
                Ok(self.pictures.len() - 1)
            }
            Err(problem) => {
                self.remarks.push(problem);
                Err(UNREADABLE)
            }
        };
        self.entries.insert(name.into(), entry);
    }

    /// A figure of the file, or of the words why there is none.
    pub fn figure(&self, markup: &mut Markup, name: Option<&str>, caption: &str, alt: &str) {
        markup.open("figure", &[]);
        let entry = name.and_then(|name| Some((name, self.entries.get(name)?)));
        match entry {
            Some((_, Ok(index))) => {
                let [width, height] = self.pictures[*index].size;
                let view_box = format!("0 0 {width} {height}");
                markup
                    .open("svg", &[("class", "picture"), ("viewBox", &view_box), ("role", "img"), ("aria-label", alt)]);
                markup.leaf("use", &[("href", &format!("#picture-{index}"))]).close();
            }
            Some((name, Err(why))) => {
                markup.element("p", &[("class", "absent")], &format!("{name}: {why}"));
            }
            None => {
                markup.element("p", &[("class", "absent")], "no picture");
            }
        }
        markup.element("figcaption", &[], caption).close();
    }

    /// The files themselves; once, anywhere in the page.
    pub fn write(&self, markup: &mut Markup) {
        markup.open("svg", &[("class", "album"), ("width", "0"), ("height", "0"), ("aria-hidden", "true")]);
        markup.open("defs", &[]).line();
        for (index, picture) in self.pictures.iter().enumerate() {
            let [width, height] = picture.size.map(|side| side.to_string());
            let uri = format!("data:image/png;base64,{}", STANDARD.encode(&picture.bytes));
            let id = format!("picture-{index}");
            markup.leaf("image", &[("id", &id), ("width", &width), ("height", &height), ("href", &uri)]).line();
        }
        markup.close().close().line();
    }
}

/// Width and height, from the first chunk.
fn png_size(bytes: &[u8], name: &str) -> Result<[u32; 2], Problem> {
    let is_png = bytes.starts_with(b"\x89PNG\r\n\x1a\n") && bytes.get(12..16) == Some(b"IHDR");
    let side = |start| bytes.get(start..start + 4)?.try_into().ok().map(u32::from_be_bytes).filter(|side| *side > 0);
    match (is_png, side(16), side(20)) {
        (true, Some(width), Some(height)) => Ok([width, height]),
        _ => {
            let place = Place { file: name.into(), line: 0, column: 0, path: String::new() };
            let start = bytes.get(..bytes.len().min(8)).unwrap_or_default();
            let found = format!("{} bytes that start {:?}", bytes.len(), String::from_utf8_lossy(start));
            Err(Problem::new(Kind::Syntax, "a picture that cannot be shown")
                .at(place)
                .expected("a PNG file")
                .found(found))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn png(side: u32) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, side, 2 * side);
        encoder.set_color(png::ColorType::Grayscale);
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(&vec![0; (2 * side * side) as usize]).unwrap();
        writer.finish().unwrap();
        bytes
    }

    #[test]
    fn each_file_once_within_the_room_there_is() {
        let read = |name: &str| match name {
            "no" => Err(Problem::new(Kind::File, "gone")),
            "text" => Ok(b"hello".to_vec()),
            "cut" => Ok(png(4)[..20].to_vec()),
            _ => Ok(png(4)),
        };
        let mut album = Album::new(&read, 2 * png(4).len());
        ["a", "a", "no", "text", "cut", "b", "c", "a"].iter().for_each(|name| album.admit(name));
        let mut markup = Markup::default();
        for name in ["a", "a", "b", "c", "no", "text", "cut"] {
            album.figure(&mut markup, Some(name), "caption", "alt");
        }
        album.figure(&mut markup, None, "caption", "alt");
        album.write(&mut markup);
        let text = markup.finish();
        assert_eq!(text.matches("data:image/png;base64,").count(), 2);
        assert_eq!(text.matches("#picture-0").count(), 2);
        assert!(
            text.contains("viewBox=\"0 0 4 8\"") && text.contains("c: beyond the page") && text.contains("no picture")
        );
        assert_eq!(["no: cannot", "text: cannot", "cut: cannot"].map(|words| text.matches(words).count()), [1; 3]);
        assert_eq!(album.remarks.len(), 3);
        assert!(album.remarks[1].to_string().starts_with("text: a picture that cannot be shown; expected a PNG"));
    }
}
