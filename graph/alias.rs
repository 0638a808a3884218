//! Which transients share memory.

use shadowgraph_core::plan::{Producer, Slot};
use shadowgraph_core::port::Storage;

/// Memory that transients share.
struct Group {
    number: usize,
    /// Last node that touches it.
    busy_until: usize,
    /// Backend of its members.
    on: [bool; 2],
    /// Shape symbols of its last member.
    shape: &'static str,
}

/// Numbers the memory of every slot. With `share`, buffers that are made and read on one backend only, are not kept and
/// are never alive together get equal numbers; a backend sizes such memory by its largest member.
///
/// A node that reads one value and writes another has both alive. Textures keep their own memory: a larger one does not
/// serve for a smaller.
pub(crate) fn alias(slots: &mut [Slot], share: bool) {
    let mut groups: Vec<Group> = Vec::new();
    let mut next = 0;
    // Slots stand in the order in which nodes first touch them.
    for slot in slots {
        let [first, last] = slot.lifetime;
        let is_transient = slot.producer != Producer::Input
            && !slot.keep
            && slot.on != [true; 2]
            && slot.port.storage == Storage::Buffer;
        let free = |group: &&mut Group| group.busy_until < first && group.on == slot.on;
        let mut found = None;
        if share && is_transient {
            // Equal symbols mean equal sizes more often than not.
            let alike = groups.iter_mut().filter(free).position(|group| group.shape == slot.port.shape);
            found = groups.iter_mut().filter(free).nth(alike.unwrap_or(0));
        }
        match found {
            Some(group) => {
                slot.alias = group.number;
                group.busy_until = last;
                group.shape = slot.port.shape;
            }
            None => {
                slot.alias = next;
                if is_transient {
                    groups.push(Group { number: next, busy_until: last, on: slot.on, shape: slot.port.shape });
                }
                next += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowgraph_core::array::Element::U32;
    use shadowgraph_core::port::{Direction::Out, Port};

    fn slot(lifetime: [usize; 2], shape: &'static str) -> Slot {
        let port = Port::new(Out, "v", U32, "v", shape);
        Slot {
            name: "v".into(),
            port,
            producer: Producer::Node(lifetime[0]),
            lifetime,
            keep: false,
            on: [true, false],
            alias: 0,
        }
    }

    fn numbers(mut slots: Vec<Slot>, share: bool) -> Vec<usize> {
        alias(&mut slots, share);
        slots.iter().map(|slot| slot.alias).collect()
    }

    #[test]
    fn memory_is_taken_again_once_its_last_reader_is_past() {
        // The third could take either; equal symbols win. The fourth is written while the third is read.
        let slots =
            || vec![slot([0, 1], "P"), slot([0, 1], "T"), slot([2, 3], "T"), slot([3, 3], "P"), slot([4, 4], "C")];
        assert_eq!(numbers(slots(), true), [0, 1, 1, 0, 0]);
        assert_eq!(numbers(slots(), false), [0, 1, 2, 3, 4]);
        let mut touching = slots();
        touching[2].lifetime = [1, 3];
        touching[3].lifetime = [2, 3];
        assert_eq!(numbers(touching, true), [0, 1, 2, 0, 0]);
    }

    #[test]
    fn kept_transferred_textured_and_given_values_are_alone() {
        let spoil: [fn(&mut Slot); 5] = [
            |slot| slot.keep = true,
            |slot| slot.on = [true, true],
            |slot| slot.on = [false, true],
            |slot| slot.port = slot.port.storage(Storage::DepthTexture),
            |slot| slot.producer = Producer::Input,
        ];
        for change in spoil {
            let mut slots = vec![slot([0, 0], "P"), slot([1, 1], "P"), slot([2, 2], "P")];
            change(&mut slots[1]);
            assert_eq!(numbers(slots, true), [0, 1, 0]);
        }
    }
}
