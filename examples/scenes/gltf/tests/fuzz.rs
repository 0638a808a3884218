//! Thousands of damaged files: loading ends in a sound scene or a located problem, in bounded time and memory.

use super::{CORNERS, File, everything};
use crate::random::Random;
use proptest::prelude::*;
use serde_json::{Value, json};
use shadowgraph_core::scene::Scene;
use std::time::{Duration, Instant};

/// A load takes a few milliseconds; the rest is for a busy machine.
const LONGEST: Duration = Duration::from_secs(20);

fn bases() -> Vec<File> {
    let mut indexed = File::with_primitive(&CORNERS, json!({}));
    let indices = indexed.shorts(&[0, 1, 2]);
    indexed.primitive()["indices"] = json!(indices);
    vec![everything(), indexed]
}

/// Loads, and checks what every scene promises.
fn check(bytes: &[u8]) -> Result<(), TestCaseError> {
    let started = Instant::now();
    let loaded = super::super::from_bytes("fuzz.glb", bytes);
    prop_assert!(started.elapsed() < LONGEST, "took {:?}", started.elapsed());
    match loaded {
        Ok(scene) => check_scene(&scene),
        Err(problem) => {
            prop_assert!(problem.place.is_some(), "{}", problem);
            prop_assert!(!problem.message.is_empty());
            Ok(())
        }
    }
}

fn check_scene(scene: &Scene) -> Result<(), TestCaseError> {
    let count = scene.triangle_count();
    let sizes = [scene.normals.len(), scene.flags.len(), scene.albedo.len(), scene.corner_vertex.len()];
    prop_assert_eq!(sizes, [count; 4]);
    prop_assert!(scene.positions.iter().flatten().flatten().all(|x| x.abs() <= 1.001e12));
    for normal in scene.normals.iter().flatten() {
        let length = normal.iter().map(|x| x * x).sum::<f32>();
        prop_assert!((length - 1.0).abs() < 1e-4, "{:?}", normal);
    }
    prop_assert!(scene.albedo.iter().flatten().all(|x| (0.0..=1.0).contains(x)));
    for camera in &scene.cameras {
        prop_assert!(camera.eye != camera.target && camera.fov_y > 0.0 && camera.fov_y < 3.15, "{:?}", camera);
        prop_assert!(camera.eye.iter().chain(&camera.target).all(|x| x.is_finite()));
    }
    prop_assert!(scene.lights.iter().all(|light| light.position.iter().chain(&light.color).all(|x| x.is_finite())));
    prop_assert!(crate::choose_view(scene, "fuzz.glb", None, None).is_ok());
    Ok(())
}

fn below(random: &mut Random, end: usize) -> usize {
    (random.bits() % end.max(1) as u64) as usize
}

/// Flips, overwrites, cuts out, repeats and splices bytes.
fn damage_bytes(bytes: &mut Vec<u8>, random: &mut Random) {
    for _ in 0..1 + below(random, 8) {
        if bytes.is_empty() {
            return;
        }
        let at = below(random, bytes.len());
        let length = (1 + below(random, 16)).min(bytes.len() - at);
        match below(random, 6) {
            0 => bytes[at] ^= 1 << below(random, 8),
            1 => bytes[at..at + length].fill([0x00, 0xff, 0x7f, 0x80][below(random, 4)]),
            2 => drop(bytes.drain(at..at + length)),
            3 => {
                let piece = bytes[at..at + length].to_vec();
                let to = below(random, bytes.len());
                bytes.splice(to..to, piece);
            }
            4 => {
                let word =
                    [f32::NAN.to_bits(), 1e38f32.to_bits(), u32::MAX, 0x7f80_0000, 4_000_000_000][below(random, 5)];
                bytes.splice(at..at + length.min(4), word.to_le_bytes().into_iter().take(length.min(4)));
            }
            _ => bytes.truncate(at),
        }
    }
}

/// The places of all values in a tree.
fn pointers(value: &Value, at: &str, all: &mut Vec<String>) {
    all.push(at.to_owned());
    match value {
        Value::Array(array) => {
            array.iter().enumerate().for_each(|(key, inner)| pointers(inner, &format!("{at}/{key}"), all))
        }
        Value::Object(map) => map.iter().for_each(|(key, inner)| pointers(inner, &format!("{at}/{key}"), all)),
        _ => {}
    }
}

/// Puts absurd, misplaced or missing values into the tree.
fn damage_tree(root: &mut Value, random: &mut Random) {
    for _ in 0..1 + below(random, 3) {
        let mut all = Vec::new();
        pointers(root, "", &mut all);
        let pointer = all[below(random, all.len())].clone();
        let other = root.pointer(&all[below(random, all.len())]).cloned().unwrap_or_default();
        let absurd = [
            json!(-1),
            json!(0),
            json!(1),
            json!(2),
            json!(3),
            json!(7),
            json!(255),
            json!(5121),
            json!(5123),
            json!(5125),
            json!(5126),
            json!(4_000_000_000u64),
            json!(u64::MAX),
            json!(i64::MIN),
            json!(1e39),
            json!(-1e38),
            json!(1e-45),
            json!(0.5),
            json!(""),
            json!("VEC3"),
            json!("MAT4"),
            json!("data:;base64,AAAA"),
            json!("/dev/zero"),
            json!(null),
            json!(true),
            json!([]),
            json!({}),
            json!([0, 1, 2, 3]),
            json!([[1e39, 1e39]]),
        ];
        let choice = below(random, 10);
        if choice == 0 {
            if let Some((parent, key)) = pointer.rsplit_once('/')
                && let Some(Value::Object(map)) = root.pointer_mut(parent)
            {
                map.remove(key);
            }
        } else if let Some(place) = root.pointer_mut(&pointer) {
            *place = if choice < 4 { other } else { absurd[below(random, absurd.len())].clone() };
        }
    }
}

/// Most memory this process has had at once, where the system tells.
fn peak_bytes() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM:")).unwrap_or_default();
    line.split_whitespace().nth(1).and_then(|kibibytes| kibibytes.parse::<u64>().ok()).unwrap_or(0) * 1024
}

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(config(4000))]
    #[test]
    fn damaged_bytes_never_panic_hang_or_fill_memory(seed in any::<u32>(), base in 0..2usize) {
        let mut random = Random::new(seed);
        let mut bytes = bases()[base].bytes();
        damage_bytes(&mut bytes, &mut random);
        check(&bytes)?;
        prop_assert!(peak_bytes() < 4 << 30, "{} bytes", peak_bytes());
    }

    #[test]
    fn damaged_trees_never_panic_hang_or_fill_memory(seed in any::<u32>(), base in 0..2usize) {
        let mut random = Random::new(seed);
        let mut file = bases().swap_remove(base);
        damage_tree(&mut file.root, &mut random);
        check(&file.bytes())?;
        prop_assert!(peak_bytes() < 4 << 30, "{} bytes", peak_bytes());
    }

    #[test]
    fn plain_json_of_any_damage_is_read_or_refused(seed in any::<u32>()) {
        let mut random = Random::new(seed);
        let mut bytes = everything().root.to_string().into_bytes();
        damage_bytes(&mut bytes, &mut random);
        check(&bytes)?;
    }
}
