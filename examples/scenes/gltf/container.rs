//! The two forms of a file: GLB, a header and chunks; and plain JSON.

use super::source::Source;
use shadowgraph_core::problem::{Kind, Problem};

const HEADER_BYTES: usize = 12;
const CHUNK_HEADER_BYTES: usize = 8;

/// JSON text and the binary chunk, where there is one.
#[derive(Debug)]
pub struct Container<'a> {
    /// JSON text.
    pub json: &'a [u8],
    /// Contents of the BIN chunk.
    pub bin: Option<&'a [u8]>,
}

/// Splits a file. Chunks of unknown kind are passed over, as the format asks.
pub fn split<'a>(source: &Source, bytes: &'a [u8]) -> Result<Container<'a>, Problem> {
    if !bytes.starts_with(b"glTF") {
        return Ok(Container { json: bytes, bin: None });
    }
    let cut = |path: &str, expected: usize| {
        source
            .problem(Kind::Syntax, path, "the file is cut")
            .expected(format!("{expected} bytes"))
            .found(format!("{} bytes", bytes.len()))
            .remedy("copy or export the file again")
    };
    let header = bytes.get(..HEADER_BYTES).ok_or_else(|| cut("header", HEADER_BYTES))?;
    let version = word(&header[4..]);
    if version != 2 {
        return Err(source
            .problem(Kind::Unsupported, "header.version", "not a glTF 2.0 file")
            .expected("version 2")
            .found(format!("version {version}"))
            .remedy("export the scene as glTF 2.0"));
    }
    let length = word(&header[8..]) as usize;
    if length < HEADER_BYTES {
        return Err(source
            .problem(Kind::Syntax, "header.length", "the file is shorter than its header")
            .expected(format!("at least {HEADER_BYTES} bytes"))
            .found(format!("{length} bytes"))
            .remedy("export the file again"));
    }
    let bytes = bytes.get(..length).ok_or_else(|| cut("header.length", length))?;

    let (mut json, mut bin) = (None, None);
    let (mut start, mut chunk) = (HEADER_BYTES, 0);
    while start < length {
        let path = format!("chunks[{chunk}]");
        let contents_start = start + CHUNK_HEADER_BYTES;
        let header = bytes.get(start..contents_start).ok_or_else(|| cut(&path, contents_start))?;
        let contents_end = contents_start + word(header) as usize;
        let contents = bytes.get(contents_start..contents_end).ok_or_else(|| cut(&path, contents_end))?;
        match &header[4..] {
            b"JSON" if chunk == 0 => json = Some(contents),
            b"BIN\0" if bin.is_none() => bin = Some(contents),
            _ => {}
        }
        start = contents_end;
        chunk += 1;
    }
    match json {
        Some(json) => Ok(Container { json, bin }),
        None => Err(source
            .problem(Kind::Syntax, "chunks[0]", "no JSON chunk")
            .expected("a chunk of kind JSON")
            .remedy("export the file again")),
    }
}

fn word(bytes: &[u8]) -> u32 {
    u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])
}
