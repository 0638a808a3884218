//! Pictures of a place: method, truth and error side by side, whole and enlarged.

use super::album::Album;
use crate::error_map;
use crate::markup::Markup;
use crate::model::{Pictures, Point};
use crate::number::figure;

/// Names of all files, in the order of a row, with captions.
fn files(pictures: &Pictures) -> [(Option<&str>, &'static str); 6] {
    [
        (pictures.picture.as_deref(), "method"),
        (pictures.truth.as_deref(), "truth"),
        (pictures.error.as_deref(), "error"),
        (pictures.closeup_picture.as_deref(), "penumbra, method"),
        (pictures.closeup_truth.as_deref(), "penumbra, truth"),
        (pictures.closeup_error.as_deref(), "penumbra, error"),
    ]
}

/// Whether a point has a picture of its own; the truth alone does not make a row.
pub fn has_any(point: &Point) -> bool {
    let p = &point.pictures;
    point.failure.is_none()
        && [&p.picture, &p.error, &p.closeup_picture, &p.closeup_error].iter().any(|name| name.is_some())
}

/// Takes in the files of a point.
pub fn admit(album: &mut Album, point: &Point) {
    if has_any(point) {
        files(&point.pictures).iter().filter_map(|(name, _)| *name).for_each(|name| album.admit(name));
    }
}

/// A row for each point.
pub fn rows(markup: &mut Markup, album: &Album, points: &[&Point], caption: impl Fn(&Point) -> String) {
    for point in points {
        markup.open("section", &[("class", "row"), ("data-m", &point.graph)]);
        markup.element("h4", &[], &caption(point)).open("div", &[("class", "six")]);
        for (name, what) in files(&point.pictures) {
            album.figure(markup, name, what, &format!("{what}: {}, {} {}", point.label, point.scene, point.view));
        }
        markup.close().close().line();
    }
}

/// The scale of error maps, as a strip with figures.
pub fn scale(markup: &mut Markup) {
    const STEPS: [f32; 9] = [-1.0, -0.1, -0.01, -0.001, 0.0, 0.001, 0.01, 0.1, 1.0];
    markup.open("div", &[("class", "scale")]).open("ol", &[]);
    for step in STEPS {
        let [red, green, blue] = error_map::colour(Some(step));
        let ink = if u32::from(red) + u32::from(green) + u32::from(blue) > 380 { "#000" } else { "#fff" };
        let sign = if step > 0.0 { "+" } else { "" };
        let style = format!("background:rgb({red},{green},{blue});color:{ink}");
        let text = format!("{sign}{}", figure(f64::from((step * 1000.0).round()) / 1000.0));
        markup.element("li", &[("style", &style)], &text);
    }
    markup.close().element("p", &[], &format!("Error: {}.", error_map::DOC)).close().line();
}
