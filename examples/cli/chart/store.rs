//! What a chart run leaves on disk as it goes: answers, rounds of timings, finished points. Each is a file of JSON lines that is only
//! appended to, so a run that is killed loses at most the line it was writing.

use crate::file_problem;
use serde::{Deserialize, Serialize};
use shadowgraph_charts::check::Record;
use shadowgraph_charts::lines;
use shadowgraph_charts::model::{Interval, NodeCost, Pictures, Point};
use shadowgraph_core::problem::{Kind, Problem, Problems};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Points without times: errors and pictures, or why there are none.
pub const ANSWERS: &str = "answers.jsonl";
/// One timed round of one variant a line.
pub const ROUNDS: &str = "rounds.jsonl";
/// Points as the page shows them.
pub const POINTS: &str = "points.jsonl";
/// Which answers are of variants or scenes as they were before.
pub const SUPERSEDED: &str = "superseded.jsonl";
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

/// Whether an answer is of a variant or scene as it was before; the last of an id counts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Superseded {
    /// Id of the answer.
    pub id: String,
    /// The answer in its place; none: it is what it was again.
    pub by: Option<String>,
}

impl Record for Superseded {
    fn id(&self) -> &str {
        &self.id
    }

    fn check(&self) -> Result<(), Problem> {
        Ok(())
    }
}

/// A folder of a chart run.
pub struct Store {
    folder: PathBuf,
    /// Points without times, by id; those that others superseded too.
    pub answers: Vec<Point>,
    superseded: Vec<Superseded>,
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
        Self::load(folder, true)
    }

    /// Reads a folder that another run may be writing into, and changes nothing in it.
    ///
    /// # Errors
    /// No records are there; as [`Store::open`].
    pub fn look(folder: &Path) -> Result<Self, Problems> {
        if !folder.join(ANSWERS).exists() {
            return Err(Problem::new(Kind::File, "this folder holds no records of a chart run")
                .expected(format!("{ANSWERS} in it"))
                .found(folder.display().to_string())
                .into());
        }
        Self::load(folder, false)
    }

    fn load(folder: &Path, mends: bool) -> Result<Self, Problems> {
        let mut store = Self {
            folder: folder.into(),
            answers: Vec::new(),
            superseded: Vec::new(),
            rounds: Vec::new(),
            remarks: Vec::new(),
        };
        store.answers = store.read::<Answer>(ANSWERS, mends)?.into_iter().map(|answer| answer.0).collect();
        store.superseded = store.read(SUPERSEDED, mends)?;
        store.rounds = store.read(ROUNDS, mends)?;
        Ok(store)
    }

    /// Its path.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    fn read<T: Record>(&mut self, name: &str, mends: bool) -> Result<Vec<T>, Problems> {
        let path = self.folder.join(name);
        let Some(bytes) = bytes_of(&path)? else { return Ok(Vec::new()) };
        let lines = lines::read::<T>(&bytes, &path.display().to_string())?;
        if mends && (lines.whole_bytes < bytes.len() || !lines.lead.is_empty()) {
            mend(&path, lines.whole_bytes, lines.lead)?;
        }
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

    /// The answer of this id.
    pub fn answer(&self, id: &str) -> Option<&Point> {
        self.answers.iter().find(|point| point.id == id)
    }

    /// Answers that no other superseded.
    pub fn shown(&self) -> impl Iterator<Item = &Point> {
        self.answers.iter().filter(|point| !self.is_superseded(&point.id))
    }

    fn is_superseded(&self, id: &str) -> bool {
        self.superseded.iter().any(|known| known.id == id && known.by.is_some())
    }

    /// Shows `now` in place of what the same variants of this machine answered before they or their scene were changed: points that
    /// are one of `now` by name and have another id. These stay on disk with their rounds, and are shown again if the change is
    /// undone. A point without a plan takes nobody's place, as it says nothing about what there is to measure. Returns how many
    /// measured points went out of sight.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn show(&mut self, now: &[&Point]) -> Result<usize, Problem> {
        let mut count = 0;
        for point in now.iter().filter(|point| is_planned(point)) {
            if self.is_superseded(&point.id) {
                self.supersede(&point.id, None)?;
            }
            let is_earlier = |known: &&Point| {
                known.id != point.id && is_of_name(known, point) && (!is_planned(known) || is_of_machine(known, point))
            };
            let earlier: Vec<(String, bool)> =
                self.shown().filter(is_earlier).map(|known| (known.id.clone(), known.failure.is_none())).collect();
            for (id, was_measured) in earlier {
                self.supersede(&id, Some(point.id.clone()))?;
                count += usize::from(was_measured);
            }
        }
        // What cannot be planned is told as long as that is so.
        for point in now.iter().filter(|point| !is_planned(point) && self.is_superseded(&point.id)).collect::<Vec<_>>()
        {
            self.supersede(&point.id, None)?;
        }
        Ok(count)
    }

    fn supersede(&mut self, id: &str, by: Option<String>) -> Result<(), Problem> {
        let superseded = Superseded { id: id.into(), by };
        self.append(SUPERSEDED, &lines::to_line(&superseded)?)?;
        self.superseded.retain(|known| known.id != id);
        self.superseded.push(superseded);
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

/// Whether it came to a plan: else it says only why not.
fn is_planned(point: &Point) -> bool {
    !point.provenance.graph_hash.is_empty()
}

fn is_of_name(a: &Point, b: &Point) -> bool {
    let name =
        |point: &Point| [&point.suite, &point.scene, &point.graph, &point.label, &point.backend].map(String::clone);
    name(a) == name(b)
}

/// Times of another machine are other figures.
fn is_of_machine(a: &Point, b: &Point) -> bool {
    let machine = |point: &Point| {
        let of = &point.provenance;
        (of.adapter.clone(), of.driver.clone(), of.threads)
    };
    machine(a) == machine(b)
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

/// Copies the records and pictures of `from` into the folder of `into`: the parts of a sharded run make a whole one. What was
/// measured takes the place of a failure to measure it. A part that is that folder itself is there already. Returns how many answers
/// and rounds were new.
///
/// # Errors
/// A file cannot be read or written; a line that is no record.
pub fn merge(into: &mut Store, from: &Path) -> Result<[usize; 2], Problems> {
    let part = Store::look(from)?;
    let real = |folder: &Path| std::fs::canonicalize(folder).map_err(|error| file_problem(folder, &error));
    if real(from)? == real(&into.folder)? {
        return Ok([0, 0]);
    }
    into.remarks.extend(part.remarks.iter().cloned());
    let (mut answers, mut rounds) = (0, 0);
    for point in &part.answers {
        let known = into.answer(&point.id);
        let is_better = |known: &Point| known.failure.is_some() && point.failure.is_none();
        if known.is_some_and(|known| !is_better(known)) {
            continue;
        }
        let was_known = known.is_some();
        copy_pictures(&point.pictures, from, &into.folder)?;
        into.add_answer(point.clone())?;
        answers += 1;
        let by = part.superseded.iter().find(|superseded| superseded.id == point.id).and_then(|known| known.by.clone());
        if by.is_some() && !was_known {
            into.supersede(&point.id, by)?;
        }
    }
    for round in part.rounds {
        if !into.rounds.iter().any(|known| known.id == round.id) {
            into.add_round(round)?;
            rounds += 1;
        }
    }
    Ok([answers, rounds])
}

fn copy_pictures(pictures: &Pictures, from: &Path, to: &Path) -> Result<(), Problem> {
    let of_method = [&pictures.picture, &pictures.error, &pictures.closeup_picture, &pictures.closeup_error];
    let names = of_method.into_iter().chain([&pictures.truth, &pictures.closeup_truth]).flatten();
    for name in names {
        let (from, to) = (from.join(name), to.join(name));
        std::fs::copy(&from, &to).map_err(|error| file_problem(&from, &error))?;
    }
    Ok(())
}

/// Holds a folder for one run at a time: two would write into each other's lines. The system lets go of it when a run is killed.
pub struct Lock {
    _file: File,
}

impl Lock {
    /// Takes the folder.
    ///
    /// # Errors
    /// Another run has it, or it cannot be written.
    pub fn take(folder: &Path) -> Result<Self, Problem> {
        std::fs::create_dir_all(folder).map_err(|error| file_problem(folder, &error))?;
        let path = folder.join("lock");
        let problem = |error: std::io::Error| file_problem(&path, &error);
        let mut file =
            OpenOptions::new().create(true).truncate(false).read(true).write(true).open(&path).map_err(problem)?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let holder = std::fs::read_to_string(&path).unwrap_or_default();
                return Err(Problem::new(Kind::File, "another run writes into this folder")
                    .found(format!("process {}", holder.trim()))
                    .remedy("wait for it, or give this one another --out"));
            }
            Err(TryLockError::Error(error)) => return Err(problem(error)),
        }
        let mut write = || {
            file.set_len(0)?;
            write!(file, "{}", std::process::id())
        };
        write().map_err(problem)?;
        Ok(Self { _file: file })
    }
}
