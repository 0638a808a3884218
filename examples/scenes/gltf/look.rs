//! Materials, as far as a shadow asks.

use super::accessor::Reader;
use crate::soup::Look;
use gltf::json::Material;
use gltf::json::material::AlphaMode;
use gltf::json::validation::Checked;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::scene::flag;

/// The look of triangles without a material: what the format's default, white, reflects is toned down to be seen shaded.
const PLAIN: Look = Look::new(0.8, 0.8, 0.8);

/// The look of a primitive whose material is `index`.
pub fn of_material(reader: &Reader, path: &str, index: Option<usize>) -> Result<Look, Problem> {
    let Some(index) = index else { return Ok(PLAIN) };
    let material: &Material =
        reader.source.item(&format!("{path}.material"), &reader.root.materials, "materials", index)?;
    let inner = format!("materials[{index}]");
    let factor = material.pbr_metallic_roughness.base_color_factor.0;
    if factor.iter().any(|part| !part.is_finite()) {
        let inner = format!("{inner}.pbrMetallicRoughness.baseColorFactor");
        return Err(reader.source.problem(Kind::BadValue, inner, "not a colour").expected("four numbers in 0..=1"));
    }
    let alpha = match material.alpha_mode {
        Checked::Valid(AlphaMode::Opaque) => 0,
        Checked::Valid(AlphaMode::Mask) => flag::ALPHA_MASK,
        Checked::Valid(AlphaMode::Blend) => flag::ALPHA_BLEND,
        Checked::Invalid => {
            let inner = format!("{inner}.alphaMode");
            return Err(reader
                .source
                .problem(Kind::BadValue, inner, "no such alpha mode")
                .expected("OPAQUE, MASK or BLEND"));
        }
    };
    let two_sided = if material.double_sided { flag::TWO_SIDED } else { 0 };
    let [red, green, blue, _] = factor.map(|part| part.clamp(0.0, 1.0));
    Ok(Look::new(red, green, blue).with(alpha | two_sided))
}
