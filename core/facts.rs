//! Facts of a scene and a light that guard alternatives in a graph file: model no more than the scene needs.

/// What `choose` may ask.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Facts {
    /// The light has one sample.
    pub light_is_point: bool,
    /// All light samples lie in one plane (a point does).
    pub light_is_planar: bool,
    /// Light samples carry unequal shares of the light, by a texture or colours: bits cannot be counted alike.
    pub light_is_textured: bool,
    /// Some light sample lies inside the scene's bounding box.
    pub light_inside_scene: bool,
    /// Every caster is part of a closed two-manifold.
    pub all_casters_closed: bool,
    /// Some triangle is alpha-masked or alpha-blended.
    pub transparency_present: bool,
    /// There are no triangles.
    pub scene_is_empty: bool,
    /// View-samples come from a file, not from the camera.
    pub view_samples_imported: bool,
}

impl Facts {
    /// Names that a graph file may use, with one line each.
    pub const NAMES: &'static [(&'static str, &'static str)] = &[
        ("light_is_point", "the light has one sample"),
        ("light_is_planar", "all light samples lie in one plane"),
        ("light_is_textured", "light samples carry unequal shares of the light"),
        ("light_inside_scene", "a light sample lies inside the scene's bounding box"),
        ("all_casters_closed", "every triangle is part of a closed two-manifold"),
        ("transparency_present", "some triangle is alpha-masked or alpha-blended"),
        ("scene_is_empty", "there are no triangles"),
        ("view_samples_imported", "view-samples come from a file"),
    ];

    /// The same facts of a light whose samples carry these shares.
    pub fn with_weights(self, weights: &[[f32; 3]]) -> Self {
        let share = weights.first().map_or(0.0, |weight| weight[0]);
        Self { light_is_textured: weights.iter().flatten().any(|channel| *channel != share), ..self }
    }

    /// The fact called `name`.
    pub fn get(&self, name: &str) -> Option<bool> {
        Some(match name {
            "light_is_point" => self.light_is_point,
            "light_is_planar" => self.light_is_planar,
            "light_is_textured" => self.light_is_textured,
            "light_inside_scene" => self.light_inside_scene,
            "all_casters_closed" => self.all_casters_closed,
            "transparency_present" => self.transparency_present,
            "scene_is_empty" => self.scene_is_empty,
            "view_samples_imported" => self.view_samples_imported,
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_has_a_fact() {
        let facts = Facts {
            light_is_point: true,
            light_is_planar: true,
            light_is_textured: true,
            light_inside_scene: false,
            all_casters_closed: false,
            transparency_present: false,
            scene_is_empty: true,
            view_samples_imported: false,
        };
        for (name, _) in Facts::NAMES {
            assert!(facts.get(name).is_some(), "{name}");
        }
        assert_eq!(facts.get("no_such_fact"), None);
        assert!(!facts.clone().with_weights(&[[0.5; 3]; 2]).light_is_textured);
        assert!(facts.clone().with_weights(&[[0.25; 3], [0.75; 3]]).light_is_textured);
        assert!(facts.with_weights(&[[0.5, 0.5, 1.0], [0.5, 0.5, 0.0]]).light_is_textured);
    }
}
