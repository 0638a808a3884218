//! Synthetic records and pictures: invented figures in the shape of real ones, for tests and for looking at pages. Nothing here
//! was measured.

use shadowgraph_charts::error_map;
use shadowgraph_charts::model::*;

/// Scenes; the last has a name that breaks whatever forgets to escape.
pub const SCENES: [&str; 6] = ["sponza", "bistro", "columns", "hairball", "thin", ODD];
/// An odd name.
pub const ODD: &str = "a<b>&\"c'</script> \u{5f71} \u{1F311}";

struct Method {
    graph: &'static str,
    axis: Option<&'static str>,
    values: &'static [&'static str],
    millis: f64,
    /// Time grows by this power of the value over the first.
    growth: f64,
    /// Error at the first value, 0 for exact; how it falls.
    error: f64,
    fall: f64,
    has_mask: bool,
}

const fn exact(graph: &'static str, millis: f64) -> Method {
    Method { graph, axis: None, values: &[""], millis, growth: 0.0, error: 0.0, fall: 0.0, has_mask: true }
}

const METHODS: [Method; 12] = [
    exact("truth_soft", 2600.0),
    exact("soft", 410.0),
    exact("soft_shafts", 62.0),
    exact("soft_certain", 240.0),
    exact("rays_soft", 118.0),
    Method {
        graph: "soft_lu",
        axis: Some("lu_table.angles"),
        values: &["32", "64", "128", "256"],
        millis: 55.0,
        growth: 0.35,
        error: 0.031,
        fall: 0.9,
        has_mask: true,
    },
    Method {
        graph: "soft_lu_planar",
        axis: Some("lu_table.angles"),
        values: &["64", "256", "1024"],
        millis: 48.0,
        growth: 0.3,
        error: 0.018,
        fall: 0.9,
        has_mask: true,
    },
    Method {
        graph: "shadow_map",
        axis: Some("light_depth.size"),
        values: &["512", "1024", "2048", "4096", "8192"],
        millis: 3.1,
        growth: 0.55,
        error: 0.41,
        fall: 0.12,
        has_mask: true,
    },
    Method {
        graph: "pcf",
        axis: Some("shadow_lookup.width"),
        values: &["3", "5", "9", "17"],
        millis: 6.0,
        growth: 0.9,
        error: 0.34,
        fall: 0.2,
        has_mask: false,
    },
    Method {
        graph: "pcss",
        axis: Some("shadow_lookup.taps"),
        values: &["16", "64", "256"],
        millis: 9.0,
        growth: 0.7,
        error: 0.21,
        fall: 0.1,
        has_mask: false,
    },
    Method {
        graph: "multi_shadow_map",
        axis: Some("light_depth.size"),
        values: &["64", "256", "1024"],
        millis: 210.0,
        growth: 0.4,
        error: 0.24,
        fall: 0.35,
        has_mask: true,
    },
    Method {
        graph: "bundle_of_a_guest",
        axis: Some("taps"),
        values: &["few", "many"],
        millis: 15.0,
        growth: 0.0,
        error: 0.1,
        fall: 0.0,
        has_mask: false,
    },
];

/// A number from 0 to 1 that depends on its arguments alone.
fn noise(words: &[&str]) -> f64 {
    (hash(words) >> 40) as f64 / (1u64 << 24) as f64
}

fn hash(words: &[&str]) -> u64 {
    let mut state = 0xcbf2_9ce4_8422_2325_u64;
    for byte in words.join("\u{1f}").bytes() {
        state = (state ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    }
    state = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (state ^ (state >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb)
}

fn provenance(graph: &str, scene: &str, backend: &str) -> Provenance {
    let gpu = backend == "wgpu";
    Provenance {
        graph_hash: format!("{:016x}", hash(&["graph", graph])),
        scene_hash: format!("{:016x}", hash(&["scene", scene])),
        program_version: "0.0.0-synthetic".into(),
        commit: "0000000+".into(),
        adapter: if gpu { "invented rasteriser".into() } else { String::new() },
        driver: if gpu { "invented 1.0".into() } else { String::new() },
        adapter_type: if gpu { "Cpu".into() } else { String::new() },
        threads: 2,
        wgpu_version: "30".into(),
        started: "2000-01-01T00:00:00Z".into(),
    }
}

/// 6 scenes, 12 methods, several variants each; a few fail, lack a figure, or lie on top of each other.
pub fn points() -> Vec<Point> {
    let mut points = Vec::new();
    for scene in SCENES {
        for method in &METHODS {
            for (step, value) in method.values.iter().enumerate() {
                for backend in ["cpu", "wgpu"] {
                    if backend == "cpu" || ["soft", "shadow_map"].contains(&method.graph) {
                        points.push(point(scene, method, step, value, backend));
                    }
                }
            }
        }
    }
    points
}

fn point(scene: &str, method: &Method, step: usize, value: &str, backend: &str) -> Point {
    let words = [scene, method.graph, value, backend];
    let at = |what| noise(&[scene, method.graph, value, backend, what]);
    let first: f64 = method.values[0].parse().unwrap_or(1.0);
    let ratio = value.parse().unwrap_or(1.0 + step as f64) / first;
    let device = if backend == "wgpu" { 2.2 } else { 1.0 };
    let median = method.millis * ratio.powf(method.growth) * (0.5 + noise(&[scene])) * device * (0.9 + 0.2 * at("ms"));
    let spread = median * (0.01 + 0.06 * at("spread"));
    let millis = Some(Interval { median, low: median - spread, high: median + 1.5 * spread });
    let error = method.error * ratio.powf(-method.fall) * (0.4 + noise(&[scene, method.graph])) * (0.9 + 0.2 * at("e"));
    let failed = (scene == "hairball" && method.graph == "soft_lu" && value == "256").then(|| {
        "lu_table.lu: the table does not fit the device; expected at most 134217728 bytes; found 201326592 bytes (use fewer angles)"
            .to_string()
    });
    let has_penumbra = scene != "thin";
    let shape = if value.is_empty() { method.graph.into() } else { format!("{} {value}", method.graph) };
    let axis = method.axis.map(String::from);
    let name = format!("{:016x}", hash(&words));
    let picture = |what: &str| (failed.is_none() && backend == "cpu").then(|| format!("{name}.{what}.png"));
    let truth = |what: &str| Some(format!("{:016x}.truth.{what}.png", hash(&["scene", scene])));
    Point {
        part: String::new(),
        id: name.clone(),
        suite: "synthetic".into(),
        scene: scene.into(),
        view: "overview".into(),
        graph: method.graph.into(),
        choices: axis.iter().map(|axis| (axis.clone(), value.to_string())).collect(),
        quality_axis: axis,
        label: shape,
        backend: backend.into(),
        size: [512, 512],
        light_samples: 64,
        millis: if failed.is_some() { None } else { millis },
        runs_count: 20,
        nodes: if failed.is_some() { Vec::new() } else { nodes(method.graph, median) },
        errors: if failed.is_some() { Errors::default() } else { errors(method, error, has_penumbra) },
        left_out: vec![("sample_filter".into(), "every view-sample faces the light".into())],
        pictures: Pictures {
            picture: picture("picture"),
            truth: truth("picture"),
            error: picture("error"),
            closeup_picture: picture("closeup"),
            closeup_truth: truth("closeup"),
            closeup_error: picture("closeup_error"),
        },
        failure: failed,
        provenance: provenance(method.graph, scene, backend),
    }
}

fn errors(method: &Method, error: f64, has_penumbra: bool) -> Errors {
    let grey = error.min(1.0);
    Errors {
        wrong_bit_share: method.has_mask.then_some(grey * 0.2),
        light_leak_share: Some(grey * 0.15),
        shadow_leak_share: Some(grey * 0.05),
        rmse_penumbra: has_penumbra.then_some(grey),
        rmse_all: Some(grey * 0.3),
        p99: Some((grey * 3.0).min(1.0)),
        max: Some((grey * 20.0).min(1.0)),
        mean_signed: Some(grey * if method.graph == "pcf" { -0.1 } else { 0.1 }),
        flip_tonemapped: Some(grey * 0.25),
        flip_linear: Some(grey * 0.3),
        penumbra_width_ratio: has_penumbra.then_some(1.0 + grey * 2.0),
        penumbra_rows_count: Some(if has_penumbra { 23_456 } else { 0 }),
        rows_count: Some(200_000),
    }
}

fn nodes(graph: &str, millis: f64) -> Vec<NodeCost> {
    let stages: &[(&str, &str, f64)] = if graph.contains("map") || graph.starts_with("pc") {
        &[
            ("view_samples", "raster", 0.2),
            ("light_depth", "raster", 0.4),
            ("shadow_lookup", "biased", 0.2),
            ("combine", "mean", 0.05),
            ("shade", "lambert", 0.1),
        ]
    } else {
        &[
            ("view_samples", "raster", 0.08),
            ("sample_filter", "facing", 0.01),
            ("light_samples", "stored", 0.002),
            ("light_frame", "fitted", 0.01),
            ("list_build", "sort", 0.06),
            ("scan", "scan", 0.01),
            ("list_fill", "fill", 0.03),
            ("casters", "all", 0.02),
            ("conservative_raster", "influence", 0.12),
            ("caster_fill", "fill", 0.05),
            ("visibility", "half_planes", 0.5),
            ("combine", "mean", 0.02),
            ("shade", "lambert", 0.03),
        ]
    };
    let cost = |(stage, pass, share): &(&str, &str, f64)| NodeCost {
        node: (*stage).into(),
        stage: (*stage).into(),
        pass: (*pass).into(),
        millis: millis * share * (0.7 + 0.6 * noise(&[graph, stage])),
        bytes: (share * 4e7) as u64,
        counts: vec![("pairs_tested".into(), (share * 1e8) as u64)],
    };
    stages.iter().map(cost).collect()
}

/// Cases of failure scenes: scene, sequence, parameter, unit, first and last value, methods that fail.
type Case = (&'static str, Sequence, &'static str, &'static str, [f64; 2], &'static [&'static str]);

const CASES: [Case; 14] = [
    (
        "contact",
        Sequence::ClosingContact,
        "gap",
        "scene units",
        [1.0, 0.0],
        &["shadow_map", "pcf", "pcss", "multi_shadow_map"],
    ),
    ("aligned", Sequence::Still, "frame", "", [0.0, 0.0], &["shadow_map"]),
    ("hairball", Sequence::LightOrbit, "light angle", "degrees", [0.0, 63.0], &["shadow_map", "pcf", "pcss"]),
    ("grazing", Sequence::LightOrbit, "light angle", "degrees", [0.0, 63.0], &["shadow_map", "pcf", "pcss"]),
    ("long-view", Sequence::CameraPan, "pan", "px", [0.0, 4.0], &["shadow_map"]),
    ("zoom", Sequence::Zoom, "distance", "scene units", [10.0, 0.01], &["shadow_map", "pcf", "multi_shadow_map"]),
    ("thin", Sequence::Tessellation, "triangles", "", [100.0, 1e6], &["shadow_map", "pcf", "pcss"]),
    ("open", Sequence::OpeningMeshes, "triangles removed", "", [0.0, 40.0], &["shadow_map"]),
    (
        "nonmanifold",
        Sequence::WorldScale,
        "world scale",
        "",
        [1e-3, 1e4],
        &["shadow_map", "pcf", "pcss", "multi_shadow_map"],
    ),
    ("big-penumbra", Sequence::GrowingLight, "light radius", "scene units", [0.0, 2.0], &["pcss", "shadow_map", "pcf"]),
    ("two-depths", Sequence::GrowingLight, "light radius", "scene units", [0.0, 2.0], &["pcss"]),
    ("hidden", Sequence::Still, "frame", "", [0.0, 0.0], &["pcss", "soft_shafts"]),
    ("columns", Sequence::FarFromOrigin, "distance", "scene units", [0.0, 1e6], &["shadow_map", "soft_certain"]),
    (ODD, Sequence::CameraPan, "pan", "px", [0.0, 4.0], &[]),
];

/// Every method on every case.
pub fn stabilities() -> Vec<Stability> {
    CASES.iter().flat_map(|case| METHODS.iter().map(|method| stability(case, method))).collect()
}

fn stability(case: &Case, method: &Method) -> Stability {
    let (scene, sequence, parameter, unit, [first, last], fail) = *case;
    let fails = fail.contains(&method.graph);
    let count: usize = match sequence {
        Sequence::Still => 1,
        Sequence::LightOrbit | Sequence::CameraPan => 64,
        _ => 9,
    };
    let not_run = scene == "hairball" && method.graph == "soft_lu";
    let geometric =
        !matches!(sequence, Sequence::LightOrbit | Sequence::CameraPan | Sequence::OpeningMeshes | Sequence::Still);
    let frame = |index: usize| {
        let share = index as f64 / (count.max(2) - 1) as f64;
        let value = match geometric {
            true if first.min(last) <= 0.0 && (share == 0.0) == (first <= 0.0) && (share == 0.0 || share == 1.0) => 0.0,
            true => {
                let [first, last] = [first, last].map(|end: f64| if end <= 0.0 { first.max(last) * 1e-5 } else { end });
                first * (last / first).powf(share)
            }
            false => first + (last - first) * share,
        };
        let wave = 0.6 + 0.4 * noise(&[scene, method.graph, &index.to_string()]);
        let small = if method.error > 0.0 { 4e-4 * wave } else { 0.0 };
        let error =
            if fails { small + 0.3 * share.max(if count == 1 { 1.0 } else { 0.02 }).powi(2) * wave } else { small };
        StabilityFrame {
            value,
            wrong_bit_share: method.has_mask.then_some(error * 0.3),
            wrong_outside_share: method.has_mask.then_some(error * 0.3),
            light_leak_share: Some(error * 0.2),
            shadow_leak_share: Some(error * 0.1),
            rmse_penumbra: Some(error),
            rmse_all: Some(error * 0.4),
            millis: Some(method.millis * wave),
            longest_list_count: method.has_mask.then_some((900.0 * wave) as u64),
        }
    };
    let frames: Vec<StabilityFrame> = if not_run { Vec::new() } else { (0..count).map(frame).collect() };
    let errors = frames.iter().map(|frame| frame.rmse_penumbra.unwrap_or(0.0));
    let figure = errors.clone().fold(0.0, f64::max);
    let worst = errors.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index);
    let threshold = if method.error > 0.0 { 0.02 } else { 0.0 };
    let expected = match method.error {
        0.0 => Expected::MustHold,
        _ if fails || (scene == "grazing" && method.graph == "multi_shadow_map") => Expected::ExpectedToFail,
        _ => Expected::Open,
    };
    let name = format!("{:016x}", hash(&["stability", scene, method.graph, parameter]));
    let picture = |what: &str| figure.gt(&threshold).then(|| format!("{name}.{what}.png"));
    Stability {
        id: name.clone(),
        suite: "synthetic".into(),
        graph: method.graph.into(),
        choices: Vec::new(),
        label: method.graph.into(),
        backend: "cpu".into(),
        scene: scene.into(),
        view: "overview".into(),
        sequence,
        parameter: parameter.into(),
        unit: unit.into(),
        temporal: matches!(sequence, Sequence::LightOrbit | Sequence::CameraPan).then_some(Temporal {
            t_rmse: Some(figure * 0.1),
            toggled_share: method.has_mask.then_some(figure * 0.01),
            toggled_count: method.has_mask.then_some((figure * 1e5) as u64),
        }),
        worst: worst.map(|frame| Worst {
            frame,
            pixel: [120, 341],
            picture: picture("closeup"),
            truth: picture("truth"),
            error: picture("closeup_error"),
        }),
        verdict: match (not_run, figure <= threshold) {
            (true, _) => {
                Verdict::NotRun { why: "lu_table: the list of casters does not fit (use fewer strips)".into() }
            }
            (false, true) => Verdict::Holds,
            (false, false) => Verdict::Fails,
        },
        judged_by: "rmse_penumbra".into(),
        figure: (!not_run).then_some(figure),
        threshold: (!not_run).then_some(threshold),
        expected,
        expected_source: "invented <source> of the synthetic set, section 3".into(),
        frames,
        provenance: provenance(method.graph, scene, "cpu"),
    }
}

/// Pixels of the picture of this name: a soft disc, or its error, 96 on a side.
pub fn picture(name: &str) -> (usize, Vec<u8>) {
    const SIDE: usize = 96;
    let shift = (hash(&[name.split('.').next().unwrap_or_default()]) % 17) as f32 - 8.0;
    let disc = |x: usize, y: usize, shift: f32, soft: f32| {
        let far = ((x as f32 - 48.0 - shift).powi(2) + (y as f32 - 52.0).powi(2)).sqrt();
        ((far - 24.0) / soft + 0.5).clamp(0.0, 1.0)
    };
    let mut pixels = Vec::new();
    for y in 0..SIDE {
        for x in 0..SIDE {
            let [truth, test] = [disc(x, y, 0.0, 16.0), disc(x, y, shift, 10.0)];
            let grey = |v: f32| [0.95, 0.9, 0.8].map(|channel: f32| (255.0 * channel * (0.15 + 0.85 * v)) as u8);
            pixels.extend(match name {
                _ if name.contains("error") => error_map::colour((y > 8).then_some(test - truth)),
                _ if name.contains("truth") => grey(truth),
                _ => grey(test),
            });
        }
    }
    (SIDE, pixels)
}
