//! Writes every chart and page of the synthetic set into a folder, to be looked at: `cargo run --example charts_demo -- out`.

use shadowgraph_charts::front::front;
use shadowgraph_charts::metric::{FRAME_FIGURES, Metric};
use shadowgraph_charts::model::{Point, Stability};
use shadowgraph_charts::style::Styles;
use shadowgraph_charts::svg::bars::{Bars, bars};
use shadowgraph_charts::svg::scatter::{Scatter, scatter};
use shadowgraph_charts::svg::sequence::{Lines, lines};

mod synthetic;

fn main() -> std::io::Result<()> {
    let out = std::path::PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "out/charts_demo".into()));
    std::fs::create_dir_all(&out)?;
    let points = synthetic::points();
    let stages = points.iter().flat_map(|p| p.nodes.iter().map(|n| (n.stage.as_str(), n.millis)));
    let styles = Styles::new(points.iter().map(|p| p.graph.as_str()), stages).backends(points.iter().map(|p| p.backend.as_str()));
    let some: Vec<&Point> = points.iter().filter(|p| p.scene == "sponza").collect();
    let metric = Metric::named("rmse_penumbra").unwrap();
    let front = front(&some, metric);
    let s = scatter(&Scatter { title: "sponza · overview", points: &some, metric, front: &front, styles: &styles, with_legend: true });
    std::fs::write(out.join("scatter.svg"), s.svg)?;
    std::fs::write(out.join("bars.svg"), bars(&Bars { title: "sponza", points: &some, styles: &styles }).svg)?;
    let stab = synthetic::stabilities();
    for scene in ["contact", "hairball", "columns", "thin"] {
        let some: Vec<&Stability> = stab.iter().filter(|p| p.scene == scene).collect();
        let l = lines(&Lines { title: scene, records: &some, figure: &FRAME_FIGURES[1], styles: &styles, with_legend: true });
        std::fs::write(out.join(format!("lines_{scene}.svg")), l.svg)?;
    }
    Ok(())
}
