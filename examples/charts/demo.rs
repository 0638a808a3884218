//! Writes the pages of the synthetic set into a folder, to be looked at: `cargo run -p shadowgraph-charts --example charts_demo -- out`.

use shadowgraph_charts::front::front;
use shadowgraph_charts::metric::Metric;
use shadowgraph_charts::page::{self, Options};
use shadowgraph_charts::{csv, files};
use std::path::PathBuf;

mod synthetic;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let out = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "out/charts_demo".into()));
    std::fs::create_dir_all(&out)?;
    let options = |title| Options {
        title,
        about: "Invented figures in the shape of real ones: nothing here was measured.",
        picture: &|name| Ok(png(name)),
        pictures_max_bytes: 8 << 20,
        front: &front,
    };
    let page = page::charts(&synthetic::points(), &options("Synthetic suite: milliseconds against error"))?;
    std::fs::write(out.join("charts.html"), page.html)?;
    let page = page::stability(&synthetic::stabilities(), &options("Synthetic suite: stability"))?;
    std::fs::write(out.join("stability.html"), page.html)?;
    let metrics: Vec<_> = Metric::named("rmse_penumbra").into_iter().collect();
    let files = files::charts(&synthetic::points(), &metrics, &front);
    for (name, text) in files.into_iter().chain(files::stability(&synthetic::stabilities())) {
        std::fs::write(out.join(name), text)?;
    }
    std::fs::write(out.join("points.csv"), csv::points(&synthetic::points()))?;
    println!("{}", out.display());
    Ok(())
}

fn png(name: &str) -> Vec<u8> {
    let (side, pixels) = synthetic::picture(name);
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, side as u32, side as u32);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&pixels).expect("pixels");
    writer.finish().expect("a picture");
    bytes
}
