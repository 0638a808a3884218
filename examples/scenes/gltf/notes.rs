//! What was left out of a file or taken differently, counted while loading and told in sentences.

/// Counts.
#[derive(Debug, Default)]
pub struct Counts {
    /// Primitives of points or lines.
    pub points_or_lines: usize,
    /// Primitives without positions.
    pub without_positions: usize,
    /// Corners after the last whole triangle.
    pub left_over_corners: usize,
    /// Corners whose normal was zero or not finite.
    pub replaced_normals: usize,
    /// Triangles of primitives without normals.
    pub flat_triangles: usize,
    /// Triangles with alphaMode MASK.
    pub masked: usize,
    /// Triangles with alphaMode BLEND.
    pub blended: usize,
    /// Materials with a base colour texture.
    pub textured_materials: usize,
    /// Orthographic cameras, and such without a usable angle.
    pub skipped_cameras: usize,
    /// Directional lights.
    pub directional_lights: usize,
    /// Spot lights.
    pub spot_lights: usize,
    /// Lights and cameras at no finite place.
    pub lost_nodes: usize,
}

impl Counts {
    /// One sentence for each count that is not zero.
    pub fn sentences(&self) -> Vec<String> {
        let all = [
            (self.points_or_lines, "primitives of points or lines left out: they have no area"),
            (self.without_positions, "primitives without positions left out"),
            (self.left_over_corners, "corners left over after the last whole triangle of a primitive"),
            (self.replaced_normals, "corner normals of no length replaced by geometric normals"),
            (self.flat_triangles, "triangles have no normals in the file: shaded flat"),
            (self.masked, "triangles have alphaMode MASK: they cast as opaque, so their shadows are too large"),
            (self.blended, "triangles have alphaMode BLEND: they cast as opaque, so their shadows are too dark"),
            (self.textured_materials, "materials have textures: their base colour factor alone is used"),
            (self.skipped_cameras, "cameras left out: not perspective, or without a usable angle"),
            (self.directional_lights, "directional lights placed as points ten scene diagonals away"),
            (self.spot_lights, "spot lights taken as points that shine in all directions"),
            (self.lost_nodes, "cameras or lights left out: their nodes put them at no finite place"),
        ];
        all.iter().filter(|(count, _)| *count > 0).map(|(count, text)| format!("{count} {text}")).collect()
    }
}
