//! Pages: one self-contained HTML file each, which works offline and without scripts.

mod album;
mod case;
mod charts;
mod matrix;
mod pictures;
mod place;
mod provenance;
mod shell;
mod stability;
mod table;

pub use charts::charts;
pub(crate) use matrix::{columns, heading, summary_cell};
pub use stability::stability;

use crate::front::Front;
use crate::metric::Metric;
use crate::model::Point;
use shadowgraph_core::problem::Problem;

/// Gives the bytes of a PNG file by the name that a record has for it.
pub type ReadPicture<'a> = dyn Fn(&str) -> Result<Vec<u8>, Problem> + 'a;

/// Gives the front of points on one place.
pub type FindFront<'a> = dyn Fn(&[&Point], &Metric) -> Front + 'a;

/// What a page needs beside its records.
pub struct Options<'a> {
    /// Headline.
    pub title: &'a str,
    /// A sentence below it; may be empty.
    pub about: &'a str,
    /// Where pictures come from.
    pub picture: &'a ReadPicture<'a>,
    /// Bytes of PNG files that the page may hold; those that go beyond are named in the page instead, the least telling first.
    pub pictures_max_bytes: usize,
    /// Who is on the front.
    pub front: &'a FindFront<'a>,
}

/// A finished page.
#[derive(Clone, Debug)]
pub struct Page {
    /// The whole file.
    pub html: String,
    /// Pictures that could not be read or are no PNG; the page says so in their place.
    pub remarks: Vec<Problem>,
}
