//! Constants that CPU and WGSL both see. WGSL gets them as [`PRELUDE`], so each has one home.

/// Triangle index of a view-sample that is background.
pub const NO_TRIANGLE: u32 = u32::MAX;
/// Cell index of a view-sample that is in no list.
pub const NO_CELL: u32 = u32::MAX;
/// Words a face of the light frame takes: origin xyz, valid, axis x xyz, window left, axis y xyz, window bottom,
/// axis z xyz, window width, window height, near, far, 0. The last two are depths along axis z.
pub const FACE_WORDS: usize = 20;
/// `sample_state` of background.
pub const BACKGROUND: u32 = 0;
/// `sample_state` of a view-sample that is listed and tested.
pub const KEPT: u32 = 1;
/// `sample_state` of a view-sample that faces away from the light: all its mask bits are set.
pub const FACING_AWAY: u32 = 2;
/// Invocations of a one-dimensional workgroup.
pub const GROUP: usize = 64;
/// Most loop steps one invocation may take, all loops together: software rasterisers cut longer ones silently.
pub const LOOP_STEPS: usize = 30_000;

/// The constants above in WGSL, joined before every kernel that names them.
pub const PRELUDE: &str = "const NO_TRIANGLE: u32 = 0xffffffffu;
const NO_CELL: u32 = 0xffffffffu;
const FACE_WORDS: u32 = 20u;
const BACKGROUND: u32 = 0u;
const KEPT: u32 = 1u;
const FACING_AWAY: u32 = 2u;
const GROUP: u32 = 64u;
const MAX_GROUPS: u32 = 65535u;
fn linear_index(id: vec3<u32>) -> u32 {
    return id.x + id.y * MAX_GROUPS * GROUP;
}
";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_prelude_states_the_same_numbers() {
        for (name, value) in [
            ("NO_TRIANGLE", NO_TRIANGLE),
            ("NO_CELL", NO_CELL),
            ("FACE_WORDS", FACE_WORDS as u32),
            ("BACKGROUND", BACKGROUND),
            ("KEPT", KEPT),
            ("FACING_AWAY", FACING_AWAY),
            ("GROUP", GROUP as u32),
        ] {
            let decimal = format!("const {name}: u32 = {value}u;");
            let hexadecimal = format!("const {name}: u32 = {value:#x}u;");
            assert!(PRELUDE.contains(&decimal) || PRELUDE.contains(&hexadecimal), "{name}");
        }
    }
}
