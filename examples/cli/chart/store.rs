//! What a chart run leaves on disk as it goes: answers, rounds of timings, finished points. Each is a file of JSON lines that is only
//! appended to, so a run that is killed loses at most the line it was writing.

use crate::file_problem;
use serde::{Deserialize, Serialize};
use shadowgraph_charts::check::Record;
use shadowgraph_charts::lines;
use shadowgraph_charts::model::{Interval, NodeCost, Point};
use shadowgraph_core::problem::{Kind, Problem, Problems};
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Points without times: errors and pictures, or why there are none.
pub const ANSWERS: &str = "answers.jsonl";
/// One timed round of one variant a line.
pub const ROUNDS: &str = "rounds.jsonl";
/// Points as the page shows them.
pub const POINTS: &str = "points.jsonl";
/// PNG files.
pub const PICTURES: &str = "pictures";

/// A point without times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Answer(pub Point);

impl Record for Answer {
    fn id(&self) -> &str {
        &self.0.id
    }

    /// All that a point must satisfy, but for its time.
    fn check(&self) -> Result<(), Problem> {
        let untimed = Interval { median: 0.0, low: 0.0, high: 0.0 };
        Point { millis: self.0.millis.or(Some(untimed)), ..self.0.clone() }.check()
    }
}

/// One timed frame of a variant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Round {
    /// The variant and which round it is: `0123456789abcdef#2`.
    pub id: String,
    /// The whole frame, node timers off, milliseconds.
    pub millis: f64,
    /// Its nodes; on wgpu of a frame of their own.
    pub nodes: Vec<NodeCost>,
}

impl Round {
    /// Id of its variant.
    pub fn variant(&self) -> &str {
        self.id.split('#').next().unwrap_or_default()
    }
}

impl Record for Round {
    fn id(&self) -> &str {
        &self.id
    }

    fn check(&self) -> Result<(), Problem> {
        let times = self.nodes.iter().map(|node| node.millis).chain([self.millis]);
        match times.into_iter().find(|millis| !millis.is_finite() || *millis < 0.0) {
            None => Ok(()),
            Some(millis) => Err(Problem::new(Kind::BadValue, "a time that no clock gives")
                .expected("milliseconds, 0 or more")
                .found(millis.to_string())),
        }
    }
}

/// A folder of a chart run.
pub struct Store {
    folder: PathBuf,
    /// Points without times, by id.
    pub answers: Vec<Point>,
    /// Rounds of all variants.
    pub rounds: Vec<Round>,
    /// What was cut off: last lines that were not written to their end.
    pub remarks: Vec<Problem>,
}

impl Store {
    /// Opens a folder, made if need be, and reads what an earlier run left in it.
    ///
    /// # Errors
    /// The folder cannot be made or read; a line in the middle of a file that is no record.
    pub fn open(folder: &Path) -> Result<Self, Problems> {
        let pictures = folder.join(PICTURES);
        std::fs::create_dir_all(&pictures).map_err(|error| file_problem(&pictures, &error))?;
        let mut store = Self { folder: folder.into(), answers: Vec::new(), rounds: Vec::new(), remarks: Vec::new() };
        store.answers = store.read::<Answer>(ANSWERS)?.into_iter().map(|answer| answer.0).collect();
        store.rounds = store.read(ROUNDS)?;
        Ok(store)
    }

    /// Its path.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    fn read<T: Record>(&mut self, name: &str) -> Result<Vec<T>, Problems> {
        let path = self.folder.join(name);
        let Some(bytes) = bytes_of(&path)? else { return Ok(Vec::new()) };
        let lines = lines::read::<T>(&bytes, &path.display().to_string())?;
        mend(&path, lines.whole_bytes, lines.lead)?;
        self.remarks.extend(lines.remarks);
        Ok(lines.records)
    }

    /// Appends a point without times; it takes the place of an earlier one of its id.
    ///
    /// # Errors
    /// A number that is not finite; the file cannot be written.
    pub fn add_answer(&mut self, point: Point) -> Result<(), Problem> {
        let answer = Answer(point);
        self.append(ANSWERS, &lines::to_line(&answer)?)?;
        self.answers.retain(|known| known.id != answer.0.id);
        self.answers.push(answer.0);
        Ok(())
    }

    /// Appends a timed round.
    ///
    /// # Errors
    /// A time that is not finite; the file cannot be written.
    pub fn add_round(&mut self, round: Round) -> Result<(), Problem> {
        self.append(ROUNDS, &lines::to_line(&round)?)?;
        self.rounds.push(round);
        Ok(())
    }

    /// Writes a whole file of the folder anew.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<PathBuf, Problem> {
        let path = self.folder.join(name);
        std::fs::write(&path, bytes).map_err(|error| file_problem(&path, &error))?;
        Ok(path)
    }

    fn append(&self, name: &str, line: &str) -> Result<(), Problem> {
        let path = self.folder.join(name);
        let write = || -> std::io::Result<()> {
            let mut file = OpenOptions::new().create(true).append(true).open(&path)?;
            file.write_all(line.as_bytes())
        };
        write().map_err(|error| file_problem(&path, &error))
    }
}

fn bytes_of(path: &Path) -> Result<Option<Vec<u8>>, Problem> {
    match std::fs::read(path) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(file_problem(path, &error)),
    }
}

/// Cuts off what a killed run did not write to its end.
fn mend(path: &Path, whole_bytes: usize, lead: &str) -> Result<(), Problem> {
    let mend = || -> std::io::Result<()> {
        let mut file = OpenOptions::new().write(true).open(path)?;
        file.set_len(whole_bytes as u64)?;
        use std::io::Seek;
        file.seek(std::io::SeekFrom::End(0))?;
        file.write_all(lead.as_bytes())
    };
    mend().map_err(|error| file_problem(path, &error))
}

/// Copies the records and pictures of `from` into the folder of `into`: the parts of a sharded run make a whole one.
///
/// # Errors
/// A file cannot be read or written; a line that is no record.
pub fn merge(into: &mut Store, from: &Path) -> Result<[usize; 2], Problems> {
    if !from.join(ANSWERS).exists() {
        return Err(Problem::new(Kind::File, "this folder holds no records of a chart run")
            .expected(format!("{ANSWERS} in it"))
            .found(from.display().to_string())
            .into());
    }
    let part = Store::open(from)?;
    let (mut answers, mut rounds) = (0, 0);
    for point in part.answers {
        if !into.answers.iter().any(|known| known.id == point.id) {
            into.add_answer(point)?;
            answers += 1;
        }
    }
    for round in part.rounds {
        if !into.rounds.iter().any(|known| known.id == round.id) {
            into.add_round(round)?;
            rounds += 1;
        }
    }
    let folder = from.join(PICTURES);
    let entries = std::fs::read_dir(&folder).map_err(|error| file_problem(&folder, &error))?;
    for entry in entries {
        let entry = entry.map_err(|error| file_problem(&folder, &error))?;
        let to = into.folder.join(PICTURES).join(entry.file_name());
        std::fs::copy(entry.path(), &to).map_err(|error| file_problem(&to, &error))?;
    }
    Ok([answers, rounds])
}

/// Holds a folder for one run at a time: two would write into each other's lines.
pub struct Lock(PathBuf);

impl Lock {
    /// Takes the folder.
    ///
    /// # Errors
    /// Another run has it, or it cannot be written.
    pub fn take(folder: &Path) -> Result<Self, Problem> {
        std::fs::create_dir_all(folder).map_err(|error| file_problem(folder, &error))?;
        let path = folder.join("running");
        if let Ok(text) = std::fs::read_to_string(&path)
            && Path::new("/proc").join(text.trim()).exists()
        {
            return Err(Problem::new(Kind::File, "another run writes into this folder")
                .found(format!("process {}", text.trim()))
                .remedy("wait for it, or give this one another --out"));
        }
        let write = || -> std::io::Result<()> {
            let mut file = File::create(&path)?;
            write!(file, "{}", std::process::id())
        };
        write().map_err(|error| file_problem(&path, &error))?;
        Ok(Self(path))
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}
