//! Records in a folder: one file a run, or a shard, that is only appended to. A run that was killed goes on where it was.

use crate::file_problem;
use crate::shard::Shard;
use shadowgraph_charts::lines;
use shadowgraph_charts::model::Stability;
use shadowgraph_core::problem::{Problem, Problems};
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// The file that a shard writes.
fn file_of(shard: Shard) -> String {
    match shard.count {
        1 => "records.jsonl".into(),
        count => format!("records.{}of{count}.jsonl", shard.index),
    }
}

/// The folder of a suite's results.
pub struct Records {
    folder: PathBuf,
    file: File,
    /// What is there, of every shard, the last of each id.
    pub all: Vec<Stability>,
    /// What is worth telling and stops nothing.
    pub remarks: Vec<Problem>,
}

impl Records {
    /// Opens the folder, made if need be, and reads what earlier runs and all shards left in it.
    ///
    /// # Errors
    /// The folder or a file in it cannot be made or read; lines that are no records.
    pub fn open(folder: &Path, shard: Shard) -> Result<Self, Problems> {
        std::fs::create_dir_all(folder.join(PICTURES)).map_err(|error| file_problem(folder, &error))?;
        let own = folder.join(file_of(shard));
        let mut files = vec![own.clone()];
        for entry in std::fs::read_dir(folder).map_err(|error| file_problem(folder, &error))?.flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            if name.starts_with("records.") && name.ends_with(".jsonl") && entry.path() != own {
                files.push(entry.path());
            }
        }
        files[1..].sort();
        let (mut all, mut remarks, mut end) = (Vec::<Stability>::new(), Vec::new(), (0, ""));
        for path in &files {
            let bytes = match std::fs::read(path) {
                Ok(bytes) => bytes,
                Err(error) if error.kind() == std::io::ErrorKind::NotFound => continue,
                Err(error) => return Err(file_problem(path, &error).into()),
            };
            let read = lines::read::<Stability>(&bytes, &path.display().to_string())?;
            if *path == own {
                end = (read.whole_bytes, read.lead);
            }
            remarks.extend(read.remarks);
            read.records.into_iter().for_each(|record| replace(&mut all, record));
        }
        let open = || -> std::io::Result<File> {
            let mut file = OpenOptions::new().create(true).append(true).open(&own)?;
            file.set_len(end.0 as u64)?;
            file.write_all(end.1.as_bytes())?;
            Ok(file)
        };
        let file = open().map_err(|error| file_problem(&own, &error))?;
        Ok(Self { folder: folder.into(), file, all, remarks })
    }

    /// The record of this number.
    pub fn find(&self, id: &str) -> Option<&Stability> {
        self.all.iter().find(|record| record.id == id)
    }

    /// Writes a record, and keeps it in place of an earlier one of its number.
    ///
    /// # Errors
    /// The file cannot be written; a record that must not be.
    pub fn add(&mut self, record: Stability) -> Result<(), Problem> {
        let line = lines::to_line(&record)?;
        self.file.write_all(line.as_bytes()).map_err(|error| file_problem(&self.folder, &error))?;
        replace(&mut self.all, record);
        Ok(())
    }
}

/// Folder of pictures, beside the records.
pub const PICTURES: &str = "pictures";

fn replace(all: &mut Vec<Stability>, record: Stability) {
    match all.iter_mut().find(|earlier| earlier.id == record.id) {
        Some(earlier) => *earlier = record,
        None => all.push(record),
    }
}
