//! Buffers: the GLB's own chunk, data URIs, files beside the scene.

use super::limits;
use super::source::Source;
use gltf::json::{Buffer, Root};
use shadowgraph_core::problem::{Kind, Problem};
use std::borrow::Cow;
use std::io::Read;
use std::path::{Component, Path};

/// All buffers of a file, each at least as long as it declares; longer ones are cut to that.
pub fn load<'a>(source: &Source, root: &Root, bin: Option<&'a [u8]>) -> Result<Vec<Cow<'a, [u8]>>, Problem> {
    let declared = root.buffers.iter().fold(0u64, |sum, buffer| sum.saturating_add(buffer.byte_length.0));
    // Only what a file of its own or a data URI must fill is ever allocated, so the sum of honest files passes here.
    if declared > limits::BYTES {
        return Err(source
            .problem(Kind::BadValue, "buffers", "the buffers are too long together")
            .expected(format!("at most {} bytes", limits::BYTES))
            .found(format!("{declared} bytes")));
    }
    root.buffers.iter().enumerate().map(|(index, buffer)| load_one(source, index, buffer, bin)).collect()
}

fn load_one<'a>(
    source: &Source,
    index: usize,
    buffer: &Buffer,
    bin: Option<&'a [u8]>,
) -> Result<Cow<'a, [u8]>, Problem> {
    let path = format!("buffers[{index}]");
    let wanted = buffer.byte_length.0;
    let bytes: Cow<[u8]> = match (&buffer.uri, bin) {
        (None, Some(bin)) if index == 0 => Cow::Borrowed(bin),
        (None, _) => {
            return Err(source
                .problem(Kind::Missing, path, "the buffer has no contents")
                .expected("a uri, or for the first buffer of a GLB its BIN chunk")
                .found("neither")
                .remedy("export the file again with its buffers"));
        }
        (Some(uri), _) if uri.starts_with("data:") => Cow::Owned(from_data_uri(source, &path, uri)?),
        (Some(uri), _) => Cow::Owned(from_file(source, &path, uri, wanted)?),
    };
    if (bytes.len() as u64) < wanted {
        return Err(source
            .problem(Kind::BadValue, format!("{path}.byteLength"), "the buffer is shorter than it declares")
            .expected(format!("{wanted} bytes"))
            .found(format!("{} bytes", bytes.len()))
            .remedy("copy or export the file again"));
    }
    Ok(match bytes {
        Cow::Borrowed(bytes) => Cow::Borrowed(&bytes[..wanted as usize]),
        Cow::Owned(mut bytes) => {
            bytes.truncate(wanted as usize);
            Cow::Owned(bytes)
        }
    })
}

fn from_data_uri(source: &Source, path: &str, uri: &str) -> Result<Vec<u8>, Problem> {
    let path = format!("{path}.uri");
    let Some((_, text)) = uri.split_once(";base64,") else {
        let problem = source.problem(Kind::Unsupported, path, "a data URI without base64");
        return Err(problem.expected("data:application/octet-stream;base64,.."));
    };
    base64(text.as_bytes()).map_err(|place| {
        source
            .problem(Kind::Syntax, path, format!("character {place} of the base64 text does not belong there"))
            .remedy("export the file again")
    })
}

/// Bytes of base64 text with or without padding; else the place of the first wrong character.
pub(super) fn base64(text: &[u8]) -> Result<Vec<u8>, usize> {
    let end = text.iter().position(|byte| *byte == b'=').unwrap_or(text.len());
    if let Some(place) = text[end..].iter().position(|byte| *byte != b'=') {
        return Err(end + place);
    }
    let mut bytes = Vec::with_capacity(end / 4 * 3 + 3);
    let mut bits = 0u32;
    for (place, &character) in text[..end].iter().enumerate() {
        let six = match character {
            b'A'..=b'Z' => character - b'A',
            b'a'..=b'z' => character - b'a' + 26,
            b'0'..=b'9' => character - b'0' + 52,
            b'+' | b'-' => 62,
            b'/' | b'_' => 63,
            _ => return Err(place),
        };
        bits = bits << 6 | u32::from(six);
        if place % 4 > 0 {
            // A character adds 6 bits: after the second, third and fourth of a group another whole byte is there.
            bytes.push((bits >> (6 - 2 * (place % 4))) as u8);
        }
    }
    match end % 4 {
        1 => Err(end),
        _ => Ok(bytes),
    }
}

fn from_file(source: &Source, path: &str, uri: &str, wanted: u64) -> Result<Vec<u8>, Problem> {
    let path = format!("{path}.uri");
    let refused = |why: &str| {
        source
            .problem(Kind::Unsupported, &path, why.to_owned())
            .expected("a relative path inside the scene's folder")
            .found(uri.to_owned())
            .remedy("put the buffer beside the scene file, or export as .glb")
    };
    let name = percent_decoded(uri).ok_or_else(|| refused("the buffer's uri is not a file name"))?;
    let relative = Path::new(&name);
    let stays_inside = relative.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    if !stays_inside || uri.contains("://") {
        return Err(refused("the buffer lies outside the scene's folder"));
    }
    let folder = source.folder.as_ref().ok_or_else(|| refused("a scene in memory has no folder for its buffers"))?;
    let unreadable = |error: std::io::Error| {
        source
            .problem(Kind::Missing, &path, format!("cannot read the buffer's file: {error}"))
            .expected(format!("a file {name} beside the scene"))
            .remedy("copy it there, or export as .glb")
    };
    let file = std::fs::File::open(folder.join(relative)).map_err(unreadable)?;
    if !file.metadata().map_err(unreadable)?.is_file() {
        return Err(refused("the buffer's uri names no plain file"));
    }
    let mut bytes = Vec::new();
    // `take` and growth by what is really there: a declared length alone reserves nothing.
    file.take(wanted).read_to_end(&mut bytes).map_err(unreadable)?;
    Ok(bytes)
}

fn percent_decoded(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let [first, tail @ ..] = rest {
        if *first == b'%' {
            let digits = std::str::from_utf8(tail.get(..2)?).ok()?;
            bytes.push(u8::from_str_radix(digits, 16).ok()?);
            rest = &tail[2..];
        } else {
            bytes.push(*first);
            rest = tail;
        }
    }
    String::from_utf8(bytes).ok().filter(|name| !name.contains('\0'))
}
