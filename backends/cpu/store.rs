//! Arrays by slot.

use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Plan, SlotId};

/// The values of a run that are on the CPU.
#[derive(Clone, Debug, Default)]
pub struct Store {
    arrays: Vec<Option<Array>>,
}

impl Store {
    /// An empty store for `plan`.
    pub fn new(plan: &Plan) -> Self {
        Self { arrays: vec![None; plan.slots.len()] }
    }
    /// The value of a slot; panics when it has none (the plan orders nodes so that this cannot be).
    pub fn get(&self, slot: SlotId) -> &Array {
        match &self.arrays[slot] {
            Some(array) => array,
            None => unreachable!("slot {slot} is read before it is written"),
        }
    }
    /// The value of a slot, if it has one.
    pub fn try_get(&self, slot: SlotId) -> Option<&Array> {
        self.arrays[slot].as_ref()
    }
    /// Sets the value of a slot.
    pub fn put(&mut self, slot: SlotId, array: Array) {
        self.arrays[slot] = Some(array);
    }
    /// Removes the value of a slot.
    pub fn take(&mut self, slot: SlotId) -> Option<Array> {
        self.arrays[slot].take()
    }
}
