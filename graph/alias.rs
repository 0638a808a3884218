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
