//! Draws and textures: attachments, depth, texture reads, uploads and read-backs of every storage.

use crate::Session;
use crate::tests::pass;
use shadowgraph_core::array::Array;
use shadowgraph_core::array::Element::{F32, U32};
use shadowgraph_core::param::Params;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::port::{Direction::Out, Port, Storage};
use shadowgraph_core::record::{Bind, ColorTarget, Command, Cull, DepthTarget, Draw, GpuCx, Shader, Target};
use shadowgraph_core::stage::Stage;

/// A draw of one triangle into nothing; tests set the rest.
fn triangle(cx: &GpuCx, pieces: &'static [&'static str], fragment: Option<&'static str>) -> Draw {
    Draw {
        label: "triangle",
        shader: Shader { pieces, constants: Vec::new() },
        vertex: "corner",
        fragment,
        bind: Vec::new(),
        vertices: 3,
        instances: 1,
        size: cx.image().map(|side| side as u32),
        color: Vec::new(),
        depth: None,
        cull: Cull::None,
        conservative: false,
    }
}

/// The left lower half of the picture at depth `z` of an override.
const HALF: &str = "
override z: f32 = 0.5;
@vertex fn corner(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(f32(index & 1u) * 2.0 - 1.0, f32(index >> 1u) * 2.0 - 1.0, z, 1.0);
}
";

static PICTURES: Stage = Stage {
    name: "pictures",
    doc: "Draws into both kinds of colour texture at once.",
    ports: &[
        Port::new(Out, "number", U32, "id", "H W").storage(Storage::R32Uint),
        Port::new(Out, "place", F32, "place", "H W 4").storage(Storage::Rgba32Float),
    ],
};
static DRAW_BOTH: Pass = pass(
    "draw_both",
    &PICTURES,
    |cx| vec![("number", vec![cx.image[1], cx.image[0]]), ("place", vec![cx.image[1], cx.image[0], 4])],
    |cx| {
        let mut draw = triangle(cx, &[HALF, DRAW_BOTH_WGSL], Some("texel"));
        let color = |port, clear| ColorTarget { target: Target::Port(port), clear: Some(clear) };
        draw.color = vec![color("number", [7.0, 0.0, 0.0, 0.0]), color("place", [0.25, 0.0, 0.0, 1.0])];
        cx.push(Command::Draw(draw));
        Ok(())
    },
);
const DRAW_BOTH_WGSL: &str = "
struct Both { @location(0) number: u32, @location(1) place: vec4<f32> }
@fragment fn texel(@builtin(position) at: vec4<f32>) -> Both {
    return Both(u32(at.x) + 1000u * u32(at.y), at);
}";

#[test]
fn a_draw_fills_half_of_both_colour_textures() {
    let Some(session) = Session::shared_or_skip("a_draw_fills_half_of_both_colour_textures") else { return };
    // 70 texels a row are not a multiple of 256 bytes in either format.
    let (outputs, _) = session.run_node(&DRAW_BOTH, &Params::default(), [70, 70], &[]).unwrap();
    let [(_, number), (_, place)] = &outputs[..] else { panic!("two outputs") };
    assert_eq!((number.shape(), place.shape()), (&[70, 70][..], &[70, 70, 4][..]));
    for (row, column) in [(0, 0), (0, 69), (33, 10), (69, 0), (69, 68), (40, 60)] {
        let texel = row * 70 + column;
        let inside = column < row;
        if column != row {
            let expected = if inside { (column + 1000 * row) as u32 } else { 7 };
            assert_eq!(number.as_u32()[texel], expected, "row {row} column {column}");
            let x = if inside { column as f32 + 0.5 } else { 0.25 };
            assert_eq!(place.as_f32()[4 * texel], x, "row {row} column {column}");
        }
    }
}

const DEPTH: Port = Port::new(Out, "depth", F32, "light_depth", "F D D").storage(Storage::DepthTexture);
static DEPTHS: Stage = Stage { name: "depths", doc: "Draws depth.", ports: &[DEPTH] };
static DRAW_DEPTH: Pass = pass(
    "draw_depth",
    &DEPTHS,
    |cx| vec![("depth", vec![2, cx.image[1], cx.image[0]])],
    |cx| {
        // Layer 0: far first, then near, then far again, which must lose. Layer 1: cleared only.
        for (z, clear) in [(0.5, Some(1.0)), (0.25, None), (0.75, None)] {
            let mut draw = triangle(cx, &[HALF], None);
            draw.shader.constants = vec![("z", z)];
            draw.depth = Some(DepthTarget { target: Target::Port("depth"), layer: 0, clear, write: true });
            cx.push(Command::Draw(draw));
        }
        let mut clear = triangle(cx, &[HALF], None);
        clear.vertices = 0;
        clear.depth = Some(DepthTarget { target: Target::Port("depth"), layer: 1, clear: Some(0.125), write: true });
        cx.push(Command::Draw(clear));
        Ok(())
    },
);

static LOOKUPS: Stage = Stage {
    name: "lookups",
    doc: "Texels of every kind of texture as numbers.",
    ports: &[DEPTH.read(), Port::new(Out, "words", F32, "depth", "F D D")],
};
static LOOKUP: Pass = pass(
    "lookup",
    &LOOKUPS,
    |cx| vec![("words", vec![cx.dim("depth", 0), cx.dim("depth", 1), cx.dim("depth", 2)])],
    |cx| {
        let bind = vec![Bind::Texture(Target::Port("depth")), Bind::ReadWrite(Target::Port("words"))];
        cx.dispatch("lookup", &[LOOKUP_WGSL], "lookup", bind, cx.words("words"), 64);
        Ok(())
    },
);
const LOOKUP_WGSL: &str = "
@group(0) @binding(0) var depth: texture_depth_2d_array;
@group(0) @binding(1) var<storage, read_write> words: array<f32>;
@compute @workgroup_size(64) fn lookup(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(depth);
    if id.x >= arrayLength(&words) { return; }
    let at = vec2(id.x % size.x, id.x / size.x % size.y);
    words[id.x] = textureLoad(depth, at, id.x / (size.x * size.y), 0);
}";

#[test]
fn depth_is_drawn_read_back_uploaded_and_looked_up() {
    let Some(session) = Session::shared_or_skip("depth_is_drawn_read_back_uploaded_and_looked_up") else { return };
    let (outputs, _) = session.run_node(&DRAW_DEPTH, &Params::default(), [33, 33], &[]).unwrap();
    let depth = outputs[0].1.clone();
    assert_eq!(depth.shape(), [2, 33, 33]);
    let at = |layer: usize, row: usize, column: usize| depth.as_f32()[(layer * 33 + row) * 33 + column];
    assert_eq!([at(0, 20, 3), at(0, 3, 20), at(1, 20, 3), at(1, 3, 20)], [0.25, 1.0, 0.125, 0.125]);
    // The way of a shadow map that the CPU drew: up to a depth texture, and read there.
    let (outputs, _) = session.run_node(&LOOKUP, &Params::default(), [1, 1], &[("depth", depth.clone())]).unwrap();
    assert_eq!(outputs[0].1.as_f32(), depth.as_f32());
}

static COUNTS: Stage =
    Stage { name: "counts", doc: "Counts fragments.", ports: &[Port::new(Out, "fragments", U32, "fragments", "2")] };
/// A draw without attachments, then one that tests nothing against a depth texture it leaves alone.
static COUNT: Pass = pass(
    "count",
    &COUNTS,
    |_| vec![("fragments", vec![2])],
    |cx| {
        cx.zero(Target::Port("fragments"));
        let [width, height] = cx.image();
        let depth = cx.scratch_texture("depth", Storage::DepthTexture, vec![1, height, width]);
        let target = |clear, write| Some(DepthTarget { target: depth, layer: 0, clear, write });
        for (which, depth) in [(0, None), (1, target(Some(0.0), false))] {
            let mut draw = triangle(cx, &[HALF, COUNT_WGSL], Some("count"));
            draw.bind = vec![Bind::ReadWrite(Target::Port("fragments")), Bind::Uniform(vec![which])];
            draw.depth = depth;
            cx.push(Command::Draw(draw));
        }
        Ok(())
    },
);
const COUNT_WGSL: &str = "
@group(0) @binding(0) var<storage, read_write> fragments: array<atomic<u32>>;
@group(0) @binding(1) var<uniform> which: vec4<u32>;
@fragment fn count() { atomicAdd(&fragments[which.x], 1u); }";

#[test]
fn fragments_without_attachments_write_storage() {
    let Some(session) = Session::shared_or_skip("fragments_without_attachments_write_storage") else { return };
    let (outputs, _) = session.run_node(&COUNT, &Params::default(), [8, 8], &[]).unwrap();
    let [plain, with_depth] = outputs[0].1.as_u32() else { panic!("two counts") };
    // The diagonal passes through eight texel centres, which the fill rule gives to the triangle or not.
    assert!([28, 36].contains(plain), "{plain}");
    assert_eq!(plain, with_depth);
}

static ECHOES: Stage = Stage {
    name: "echoes",
    doc: "Textures to words.",
    ports: &[
        Port::new(Out, "number", U32, "id", "H W").storage(Storage::R32Uint).read(),
        Port::new(Out, "place", F32, "place", "H W 4").storage(Storage::Rgba32Float).read(),
        Port::new(Out, "words", U32, "words", "N"),
    ],
};
static ECHO: Pass = pass(
    "echo",
    &ECHOES,
    |cx| vec![("words", vec![5 * cx.dim("number", 0) * cx.dim("number", 1)])],
    |cx| {
        let [number, place, words] = ["number", "place", "words"].map(Target::Port);
        let bind = vec![Bind::Texture(number), Bind::Texture(place), Bind::ReadWrite(words)];
        cx.dispatch("echo", &[ECHO_WGSL], "echo", bind, cx.words("words") / 5, 64);
        Ok(())
    },
);
const ECHO_WGSL: &str = "
@group(0) @binding(0) var number: texture_2d<u32>;
@group(0) @binding(1) var place: texture_2d<f32>;
@group(0) @binding(2) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64) fn echo(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(number);
    if id.x >= size.x * size.y { return; }
    let at = vec2(id.x % size.x, id.x / size.x);
    let four = bitcast<vec4<u32>>(textureLoad(place, at, 0));
    words[5u * id.x] = textureLoad(number, at, 0).x;
    words[5u * id.x + 1u] = four.x;
    words[5u * id.x + 2u] = four.y;
    words[5u * id.x + 3u] = four.z;
    words[5u * id.x + 4u] = four.w;
}";

#[test]
fn colour_textures_are_uploaded_bit_by_bit() {
    let Some(session) = Session::shared_or_skip("colour_textures_are_uploaded_bit_by_bit") else { return };
    let [height, width] = [5, 7];
    let number: Vec<u32> = (0..35).map(|word| word * 0x0123_4567).collect();
    let place: Vec<f32> = (0..140).map(|word| word as f32 * 0.1 - 3.0).collect();
    let inputs = [
        ("number", Array::u32([height, width], number.clone())),
        ("place", Array::f32([height, width, 4], place.clone())),
    ];
    let (outputs, _) = session.run_node(&ECHO, &Params::default(), [1, 1], &inputs).unwrap();
    for (texel, words) in outputs[0].1.as_u32().chunks(5).enumerate() {
        assert_eq!(words[0], number[texel]);
        assert!((0..4).all(|k| words[k + 1] == place[4 * texel + k].to_bits()), "texel {texel}");
    }
}
