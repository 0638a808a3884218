//! A host that owns everything: its frame is its own G-buffer pass, the graph's hard shadows, and its own tone mapping pass, in one
//! encoder and one submission.
//!
//! `cargo run --example minimal` writes `out/minimal.png`.
//!
//! The library makes no device, polls nothing and submits nothing here. It reads the host's geometry buffer and G-buffer
//! textures and draws into a texture of the host, all bound by name.

use shadowgraph_core::input;
use shadowgraph_core::plan::{Backend, Grown, Plan};
use shadowgraph_core::problem::Problems;
use shadowgraph_graph::{Overrides, Source, builtin, load, plan};
use shadowgraph_passes::ports;
use shadowgraph_wgpu::{Externals, Prepared, Request, features, limits, readback, wgpu};
use std::error::Error;
use std::fs::File;

/// `hard.ron` with two differences: view-samples come from the host's textures, and the picture goes to one.
const GRAPH: &str = r#"(
    version: 1,
    base: "hard",
    replace: [(id: "view_samples", pass: "gbuffer")],
    add: [(id: "present", pass: "to_rgba32float")],
    outputs: {"picture": "present.image_texture"},
)"#;
const SIZE: [usize; 2] = [640, 400];
/// What the host binds itself.
const EXTERNAL: [&str; 5] = ["triangles", "gbuffer_position", "gbuffer_normal", "gbuffer_triangle", "picture"];

const GBUFFER_WGSL: &str = "
struct Camera { eye: vec4<f32>, right: vec4<f32>, up: vec4<f32>, forward: vec4<f32>, size: vec4<f32> }
@group(0) @binding(0) var<storage, read> triangles: array<f32>;
@group(0) @binding(1) var<uniform> camera: Camera;
struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) @interpolate(flat, either) triangle: u32,
}
fn corner(index: u32) -> vec3<f32> {
    return vec3(triangles[3u * index], triangles[3u * index + 1u], triangles[3u * index + 2u]);
}
@vertex fn vertex(@builtin(vertex_index) index: u32) -> Corner {
    let position = corner(index);
    let d = position - camera.eye.xyz;
    let w = dot(d, camera.forward.xyz);
    let x = dot(d, camera.right.xyz) / camera.right.w;
    let y = dot(d, camera.up.xyz) / camera.up.w;
    return Corner(vec4(x, y, w - 0.01, w), position, index / 3u);
}
struct Texel { @location(0) position: vec4<f32>, @location(1) normal: vec4<f32>, @location(2) triangle: u32 }
@fragment fn fragment(in: Corner) -> Texel {
    let a = corner(3u * in.triangle);
    let n = normalize(cross(corner(3u * in.triangle + 1u) - a, corner(3u * in.triangle + 2u) - a));
    let to_eye = camera.eye.xyz - in.position;
    return Texel(vec4(in.position, 1.0), vec4(select(-n, n, dot(n, to_eye) > 0.0), 0.0), in.triangle);
}";

const TONEMAP_WGSL: &str = "
@group(0) @binding(0) var picture: texture_2d<f32>;
@vertex fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}
@fragment fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let texel = textureLoad(picture, vec2<u32>(at.xy), 0);
    let sky = mix(vec3(0.55, 0.70, 0.90), vec3(0.20, 0.35, 0.65), 1.0 - at.y / f32(textureDimensions(picture).y));
    let light = mix(sky, 0.05 * sky + texel.rgb, texel.a);
    return vec4(pow(light / (1.0 + 0.3 * light), vec3(1.0 / 2.2)), 1.0);
}";

fn main() {
    if let Err(error) = frame() {
        eprintln!("{error}");
        std::process::exit(1);
    }
}

fn frame() -> Result<(), Box<dyn Error>> {
    // A scene, a camera and a light, as plain arrays with the names of the graph's inputs.
    let scene = shadowgraph_scenes::load("builtin:columns")?;
    let view = shadowgraph_scenes::choose_view(&scene, "builtin:columns", None, None)?;
    let samples = [view.light.position];
    let arrays = input::scene_arrays(&scene, &view.camera, SIZE, &view.light, &samples, &[[1.0; 3]]);
    let plan = host_plan(&input::facts(&scene, &samples, false))?;

    // What the graph needs is known before the device exists.
    let [height, width] = [SIZE[1], SIZE[0]];
    let mut shapes: Vec<(String, Vec<usize>)> =
        arrays.iter().map(|(name, array)| ((*name).into(), array.shape().to_vec())).collect();
    shapes.push(("gbuffer_position".into(), vec![height, width, 4]));
    shapes.push(("gbuffer_normal".into(), vec![height, width, 4]));
    shapes.push(("gbuffer_triangle".into(), vec![height, width]));
    let request = Request { external: &EXTERNAL, ..Request::new(&plan, &shapes, SIZE) };
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&Default::default()))?;
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
        required_features: features::required_features(&plan),
        required_limits: wgpu::Limits {
            max_color_attachment_bytes_per_sample: 36,
            ..limits::required_limits(&request, &adapter.limits())?
        },
        ..Default::default()
    }))?;

    // The host's own resources: geometry, camera, G-buffer, the graph's picture, the final picture.
    let words =
        |name: &str| arrays.iter().find(|(known, _)| *known == name).map_or(&[][..], |(_, array)| array.words());
    let buffer = |words: &[u32], usage| {
        let size = words.len() as u64 * 4;
        let usage = usage | wgpu::BufferUsages::COPY_DST;
        let buffer =
            device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false });
        queue.write_buffer(&buffer, 0, &words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<u8>>());
        buffer
    };
    let triangles = buffer(words("triangles"), wgpu::BufferUsages::STORAGE);
    let camera = buffer(words("camera"), wgpu::BufferUsages::UNIFORM);
    let texture = |format| {
        device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: width as u32, height: height as u32, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        })
    };
    let formats = [wgpu::TextureFormat::Rgba32Float, wgpu::TextureFormat::Rgba32Float, wgpu::TextureFormat::R32Uint];
    let gbuffer = formats.map(texture);
    let depth = texture(wgpu::TextureFormat::Depth32Float);
    let picture = texture(wgpu::TextureFormat::Rgba32Float);
    let final_picture = texture(wgpu::TextureFormat::Rgba8Unorm);
    let texels = buffer(&vec![0; width * height], wgpu::BufferUsages::COPY_SRC);
    let view_of = |texture: &wgpu::Texture| texture.create_view(&Default::default());
    let nearer = wgpu::DepthStencilState {
        format: depth.format(),
        depth_write_enabled: Some(true),
        depth_compare: Some(wgpu::CompareFunction::Less),
        stencil: Default::default(),
        bias: Default::default(),
    };
    let geometry = [triangles.as_entire_binding(), camera.as_entire_binding()];
    let gbuffer_pass = host_pass(&device, GBUFFER_WGSL, &formats, Some(nearer), &geometry);
    let picture_view = [wgpu::BindingResource::TextureView(&view_of(&picture))];
    let tonemap_pass = host_pass(&device, TONEMAP_WGSL, &[final_picture.format()], None, &picture_view);
    let externals = Externals::new()
        .buffer("triangles", &triangles)
        .texture("gbuffer_position", &gbuffer[0])
        .texture("gbuffer_normal", &gbuffer[1])
        .texture("gbuffer_triangle", &gbuffer[2])
        .texture("picture", &picture);

    // A list may turn out to be longer than its buffer. The counters say so, and how long it is: prepare again, once.
    let mut grown = Grown::new();
    for _ in 0..3 {
        let prepared = Prepared::prepare(&device, &queue, &Request { grown: &grown, ..request.clone() })?;
        for (name, array) in arrays.iter().filter(|(name, _)| *name != "triangles" && plan.slot(name).is_some()) {
            prepared.upload(&queue, name, array)?;
        }
        let status = buffer(&vec![0; prepared.status_words().max(1)], wgpu::BufferUsages::COPY_SRC);

        // The frame: the host's pass, the graph, the host's pass.
        let mut encoder = device.create_command_encoder(&Default::default());
        let targets: Vec<_> = gbuffer.iter().map(&view_of).collect();
        let corners = 3 * scene.triangle_count();
        draw(&mut encoder, &gbuffer_pass, &targets, Some(&view_of(&depth)), corners);
        prepared.record(&mut encoder, &externals)?;
        draw(&mut encoder, &tonemap_pass, &[view_of(&final_picture)], None, 3);
        encoder.copy_texture_to_buffer(
            final_picture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &texels,
                // 640 texels of four bytes are a multiple of the 256 bytes that rows must start at.
                layout: wgpu::TexelCopyBufferLayout { bytes_per_row: Some(width as u32 * 4), ..Default::default() },
            },
            final_picture.size(),
        );
        prepared.record_status(&mut encoder, &status);
        queue.submit([encoder.finish()]);

        let verdict = prepared.judge(&readback::read_words(&device, &queue, &status, 0, prepared.status_words())?);
        match verdict.problem {
            Some(problem) if verdict.grown.is_empty() => return Err(problem.into()),
            Some(_) => grown = verdict.grown,
            None => break,
        }
    }

    let words = readback::read_words(&device, &queue, &texels, 0, width * height)?;
    std::fs::create_dir_all("out")?;
    let mut encoder = png::Encoder::new(File::create("out/minimal.png")?, width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header()?.write_image_data(&words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<u8>>())?;
    println!("out/minimal.png, drawn by {}", adapter.get_info().name);
    Ok(())
}

/// The graph's plan for this scene; its inputs are the scene's arrays and the host's textures.
fn host_plan(facts: &shadowgraph_core::facts::Facts) -> Result<Plan, Problems> {
    let source = Source { name: "minimal.ron".into(), text: GRAPH.into() };
    let graph = load(source, &|name| Ok(builtin(name).unwrap_or_default().into()))?;
    let mut inputs: Vec<_> = input::ALL.iter().filter(|port| !port.name.starts_with("imported_")).copied().collect();
    inputs.extend([ports::GBUFFER_POSITION, ports::GBUFFER_NORMAL, ports::GBUFFER_TRIANGLE]);
    let overrides = Overrides { default_backend: Backend::Wgpu, ..Overrides::default() };
    plan(&graph, &shadowgraph_passes::catalogue(), &inputs, Some(facts), &overrides)
}

/// A pass of the host: a pipeline and what it reads.
fn host_pass(
    device: &wgpu::Device,
    wgsl: &str,
    formats: &[wgpu::TextureFormat],
    depth_stencil: Option<wgpu::DepthStencilState>,
    resources: &[wgpu::BindingResource],
) -> (wgpu::RenderPipeline, wgpu::BindGroup) {
    let source = wgpu::ShaderSource::Wgsl(wgsl.into());
    let module = &device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let targets: Vec<_> = formats.iter().map(|format| Some((*format).into())).collect();
    let (entry_point, compilation_options) = (None, wgpu::PipelineCompilationOptions::default());
    let vertex =
        wgpu::VertexState { module, entry_point, compilation_options: compilation_options.clone(), buffers: &[] };
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex,
        primitive: Default::default(),
        depth_stencil,
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState { module, entry_point, compilation_options, targets: &targets }),
        multiview_mask: None,
        cache: None,
    });
    let entry = |(index, resource)| wgpu::BindGroupEntry { binding: index as u32, resource };
    let entries: Vec<_> = resources.iter().cloned().enumerate().map(entry).collect();
    let layout = &pipeline.get_bind_group_layout(0);
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries });
    (pipeline, group)
}

fn draw(
    encoder: &mut wgpu::CommandEncoder,
    (pipeline, group): &(wgpu::RenderPipeline, wgpu::BindGroup),
    targets: &[wgpu::TextureView],
    depth: Option<&wgpu::TextureView>,
    vertices: usize,
) {
    // All bits set in the triangle texture: background.
    let clear = wgpu::LoadOp::Clear(wgpu::Color { r: f64::from(u32::MAX), ..wgpu::Color::TRANSPARENT });
    let ops = wgpu::Operations { load: clear, store: wgpu::StoreOp::Store };
    let far = wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Discard };
    let color = |view| Some(wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target: None, ops });
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &targets.iter().map(color).collect::<Vec<_>>(),
        depth_stencil_attachment: depth.map(|view| wgpu::RenderPassDepthStencilAttachment {
            view,
            depth_ops: Some(far),
            stencil_ops: None,
        }),
        ..Default::default()
    });
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, group, &[]);
    pass.draw(0..vertices as u32, 0..1);
}
