//! Arrays as .npy files.

use crate::file_problem;
use npyz::{NpyFile, WriterBuilder};
use shadowgraph_core::array::{Array, Element};
use shadowgraph_core::problem::{Kind, Place, Problem};
use std::fs::File;
use std::io::{BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::Path;

/// Writes `array` in its own element type and shape.
///
/// # Errors
/// The file cannot be written.
pub fn write(path: &Path, array: &Array) -> Result<(), Problem> {
    let shape: Vec<u64> = array.shape().iter().map(|side| *side as u64).collect();
    let io = || -> std::io::Result<()> {
        let mut file = BufWriter::new(File::create(path)?);
        match array.element() {
            Element::F32 => write_values(&mut file, &shape, array.as_f32())?,
            Element::U32 => write_values(&mut file, &shape, array.as_u32())?,
        }
        file.flush()
    };
    io().map_err(|error| file_problem(path, &error))
}

fn write_values<T: npyz::AutoSerialize + Copy>(file: impl Write, shape: &[u64], values: &[T]) -> std::io::Result<()> {
    let mut writer = npyz::WriteOptions::new().default_dtype().shape(shape).writer(file).begin_nd()?;
    writer.extend(values.iter().copied())?;
    writer.finish()
}

/// Reads a float array of `columns` columns (or any shape when `columns` is 0), from f32 only: no silent rounding.
///
/// # Errors
/// The file cannot be read, or holds another type or shape.
pub fn read_f32(path: &Path, columns: usize) -> Result<Array, Problem> {
    let (shape, file) = open(path)?;
    let found = type_text(&file);
    if !found.ends_with("f4") {
        return Err(wrong(path, "32-bit floats (<f4)", &found));
    }
    let values = file.into_vec::<f32>().map_err(|error| file_problem(path, &error))?;
    if columns > 0 && (shape.len() != 2 || shape[1] != columns) {
        return Err(wrong(path, &format!("shape [P, {columns}]"), &format!("{shape:?}")));
    }
    Ok(Array::f32(shape, values))
}

/// Reads one column of whole numbers that fit 32 bits.
///
/// # Errors
/// The file cannot be read, or holds another type, shape, or a number that does not fit.
pub fn read_u32(path: &Path) -> Result<Array, Problem> {
    let (shape, file) = open(path)?;
    if shape.len() != 1 {
        return Err(wrong(path, "shape [P]", &format!("{shape:?}")));
    }
    let found = type_text(&file);
    let io = |error: std::io::Error| file_problem(path, &error);
    let values: Vec<i128> = match found.get(1..).unwrap_or_default() {
        "u4" => file.into_vec::<u32>().map_err(io)?.into_iter().map(i128::from).collect(),
        "i4" => file.into_vec::<i32>().map_err(io)?.into_iter().map(i128::from).collect(),
        "i8" => file.into_vec::<i64>().map_err(io)?.into_iter().map(i128::from).collect(),
        "u8" => file.into_vec::<u64>().map_err(io)?.into_iter().map(i128::from).collect(),
        _ => return Err(wrong(path, "whole numbers (<u4, <i4, <u8 or <i8)", &found)),
    };
    let mut words = Vec::with_capacity(values.len());
    for (row, value) in values.into_iter().enumerate() {
        let word = u32::try_from(value)
            .map_err(|_| wrong(path, "numbers in 0..=4294967295", &format!("{value} in row {row}")))?;
        words.push(word);
    }
    Ok(Array::u32(shape, words))
}

fn open(path: &Path) -> Result<(Vec<usize>, NpyFile<BufReader<File>>), Problem> {
    let mut file = File::open(path).map_err(|error| file_problem(path, &error))?;
    let length = file.metadata().map_err(|error| file_problem(path, &error))?.len();
    let header = header_length(&mut file).map_err(|error| file_problem(path, &error))?;
    if header > length {
        return Err(wrong(path, "a header within the file", &format!("{header} bytes of {length}")));
    }
    let file = NpyFile::new(BufReader::new(file)).map_err(|error| file_problem(path, &error))?;
    if file.order() != npyz::Order::C && file.shape().len() > 1 {
        return Err(wrong(path, "row-major (C) order", "column-major (Fortran) order"));
    }
    let shape: Vec<usize> = file.shape().iter().map(|side| *side as usize).collect();
    let words = file.shape().iter().try_fold(1u64, |product, side| product.checked_mul(*side));
    match words {
        Some(words) if words <= length => Ok((shape, file)),
        _ => Err(wrong(path, "as much data as the header says", &format!("{length} bytes for shape {shape:?}"))),
    }
}

/// What the file says its header's length is, before anyone makes room for it. The file is at its start again.
fn header_length(file: &mut File) -> std::io::Result<u64> {
    let mut start = [0; 12];
    file.read_exact(&mut start)?;
    file.seek(SeekFrom::Start(0))?;
    Ok(match start[6] {
        1 => u64::from(u16::from_le_bytes([start[8], start[9]])),
        _ => u64::from(u32::from_le_bytes([start[8], start[9], start[10], start[11]])),
    })
}

fn type_text(file: &NpyFile<BufReader<File>>) -> String {
    file.dtype().descr().trim_matches('\'').to_string()
}

fn wrong(path: &Path, expected: &str, found: &str) -> Problem {
    let place = Place { file: path.display().to_string(), line: 0, column: 0, path: String::new() };
    Problem::new(Kind::BadValue, "array does not fit").at(place).expected(expected).found(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn in_file<T>(bytes: &[u8], read: impl Fn(&Path) -> T) -> T {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), bytes).unwrap();
        read(file.path())
    }

    fn whole() -> Vec<u8> {
        let file = tempfile::NamedTempFile::new().unwrap();
        write(file.path(), &Array::f32([5, 3], (0..15).map(|x| x as f32).collect())).unwrap();
        std::fs::read(file.path()).unwrap()
    }

    #[test]
    fn a_header_that_promises_more_than_there_is_is_refused_before_it_is_read() {
        let mut bytes = whole();
        (bytes[6], bytes[7]) = (2, 0);
        bytes[8..12].copy_from_slice(&[0xff; 4]);
        let problem = in_file(&bytes, |path| read_f32(path, 3)).unwrap_err().to_string();
        assert!(problem.contains("expected a header within the file; found 4294967295 bytes"), "{problem}");
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 600, failure_persistence: None, ..ProptestConfig::default() })]
        #[test]
        fn damaged_files_end_in_an_array_or_a_problem_with_the_file(
            damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
            cut in prop::option::of(any::<prop::sample::Index>()),
        ) {
            let mut bytes = whole();
            for (at, value) in damage {
                let at = at.index(bytes.len());
                bytes[at] = value;
            }
            if let Some(cut) = cut {
                bytes.truncate(cut.index(bytes.len()));
            }
            for columns in [0, 3] {
                match in_file(&bytes, |path| read_f32(path, columns)) {
                    Ok(array) => prop_assert!(array.bytes() <= 4 * bytes.len()),
                    Err(problem) => prop_assert!(problem.place.is_some(), "{}", problem),
                }
            }
            if let Err(problem) = in_file(&bytes, read_u32) {
                prop_assert!(problem.place.is_some(), "{}", problem);
            }
        }
    }
}
