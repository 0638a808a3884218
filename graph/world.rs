//! Which facts hold, and which nodes and alternatives they leave.

use crate::resolve::Resolved;
use shadowgraph_core::facts::Facts;

/// Facts as bits, in the order of [`Facts::NAMES`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct World(pub u32);

/// Bits of facts that must hold, and of facts that must not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Guard {
    pub when: u32,
    pub unless: u32,
}

/// What of the graph is there.
#[derive(Debug)]
pub(crate) struct Selection {
    pub world: World,
    /// Choice of each node; none for a node that is left out.
    pub chosen: Vec<Option<usize>>,
}

impl Guard {
    pub fn holds(self, world: World) -> bool {
        self.when & !world.0 == 0 && self.unless & world.0 == 0
    }
    /// Why the guard does not hold, or that it does: `light_is_point holds`.
    pub fn text(self, world: World) -> String {
        let blocked: Vec<String> = named(self.when & !world.0)
            .map(|name| format!("{name} does not hold"))
            .chain(named(self.unless & world.0).map(|name| format!("{name} holds")))
            .collect();
        if !blocked.is_empty() {
            return blocked.join(", ");
        }
        let open = named(self.when)
            .map(|name| format!("{name} holds"))
            .chain(named(self.unless).map(|name| format!("{name} does not hold")));
        open.collect::<Vec<_>>().join(", ")
    }
}

fn named(bits: u32) -> impl Iterator<Item = &'static str> {
    Facts::NAMES.iter().enumerate().filter(move |(index, _)| bits & bit(*index) != 0).map(|(_, (name, _))| *name)
}

fn bit(index: usize) -> u32 {
    1 << index
}

/// The bit of fact `name`.
pub(crate) fn fact_bit(name: &str) -> Option<u32> {
    Facts::NAMES.iter().position(|(known, _)| *known == name).map(bit)
}

impl World {
    pub fn of(facts: &Facts) -> Self {
        let bits = Facts::NAMES.iter().enumerate().filter(|(_, (name, _))| facts.get(name) == Some(true));
        Self(bits.map(|(index, _)| bit(index)).sum())
    }

    /// Whether a scene and a light can be so. A false fact that the graph does not ask for counts as open.
    fn can_be(self, asked: u32) -> bool {
        let is = |name| fact_bit(name).is_some_and(|bit| self.0 & bit != 0);
        let is_not = |name| fact_bit(name).is_some_and(|bit| asked & bit != 0 && self.0 & bit == 0);
        let point_off_plane = is("light_is_point") && is_not("light_is_planar");
        let empty_and_not = is("scene_is_empty")
            && (is("light_inside_scene") || is("transparency_present") || is_not("all_casters_closed"));
        !point_off_plane && !empty_and_not
    }

    /// Every world that differs in what the graph asks for; the one where no fact holds is first.
    pub fn all(resolved: &Resolved) -> Vec<Self> {
        let guards = resolved
            .nodes
            .iter()
            .flat_map(|node| std::iter::once(node.guard).chain(node.choices.iter().map(|choice| choice.guard)));
        let asked = guards.fold(0, |bits, guard| bits | guard.when | guard.unless);
        // Counts through the subsets of `asked`, from none to all.
        let mut worlds = vec![Self(0)];
        let mut bits = 0u32;
        while bits != asked {
            bits = bits.wrapping_sub(asked) & asked;
            worlds.push(Self(bits));
        }
        worlds.retain(|world| world.can_be(asked));
        worlds
    }

    /// Nodes that are there, each with the first alternative whose guard holds.
    pub fn select(self, resolved: &Resolved) -> Selection {
        let chosen = resolved
            .nodes
            .iter()
            .map(|node| {
                let first = node.choices.iter().position(|choice| choice.guard.holds(self));
                first.filter(|_| node.guard.holds(self))
            })
            .collect();
        Selection { world: self, chosen }
    }
}

impl Selection {
    /// Whether node `index` of `resolved` is there; one of unknown stage is, if its guard holds.
    pub fn has(&self, resolved: &Resolved, index: usize) -> bool {
        resolved.nodes[index].guard.holds(self.world)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn worlds_that_cannot_be_are_not_checked() {
        let bits = |names: &[&str]| names.iter().filter_map(|name| fact_bit(name)).sum::<u32>();
        let both = bits(&["light_is_point", "light_is_planar"]);
        // A point lies in a plane: three of four.
        let possible: Vec<u32> =
            (0..4).map(|k| bits(&["light_is_point"]) * (k & 1) + bits(&["light_is_planar"]) * (k >> 1)).collect();
        let kept: Vec<u32> = possible.into_iter().filter(|world| World(*world).can_be(both)).collect();
        assert_eq!(kept, [0, bits(&["light_is_planar"]), both]);
        // A fact that nobody asks for rules nothing out.
        assert!(World(bits(&["light_is_point"])).can_be(bits(&["light_is_point"])));
        assert!(!World(bits(&["scene_is_empty", "light_inside_scene"])).can_be(u32::MAX));
    }

    #[test]
    fn a_guard_says_why() {
        let inside = fact_bit("light_inside_scene").unwrap_or_default();
        let guard = Guard { when: inside, unless: fact_bit("scene_is_empty").unwrap_or_default() };
        assert!(guard.holds(World(inside)) && !guard.holds(World(0)) && !guard.holds(World(inside | guard.unless)));
        assert_eq!(guard.text(World(inside)), "light_inside_scene holds, scene_is_empty does not hold");
        assert_eq!(guard.text(World(guard.unless)), "light_inside_scene does not hold, scene_is_empty holds");
    }
}
