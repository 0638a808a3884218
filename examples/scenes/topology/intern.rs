//! Equal keys of a few words to equal small numbers, in order of first appearance.

/// An open-addressed table. Slots hold key number + 1, zero is empty.
pub struct Intern<const N: usize> {
    slots: Vec<u32>,
    keys: Vec<[u32; N]>,
}

impl<const N: usize> Intern<N> {
    /// A table that holds `expected` keys without growing.
    pub fn with_capacity(expected: usize) -> Self {
        Self { slots: vec![0; (2 * expected.max(8)).next_power_of_two()], keys: Vec::with_capacity(expected) }
    }

    /// The number of `key`.
    pub fn number(&mut self, key: [u32; N]) -> u32 {
        if 2 * self.keys.len() >= self.slots.len() {
            self.grow();
        }
        let mut slot = self.home(&key);
        loop {
            match self.slots[slot] {
                0 => {
                    self.keys.push(key);
                    self.slots[slot] = self.keys.len() as u32;
                    return self.keys.len() as u32 - 1;
                }
                taken if self.keys[taken as usize - 1] == key => return taken - 1,
                _ => slot = (slot + 1) & (self.slots.len() - 1),
            }
        }
    }

    /// All keys, by number.
    pub fn keys(&self) -> &[[u32; N]] {
        &self.keys
    }

    fn home(&self, key: &[u32; N]) -> usize {
        // Multiply and fold to the upper half: every bit of the key reaches the low bits, which choose the slot.
        let folded = key.iter().fold(0x243f_6a88_85a3_08d3_u64, |state, &word| {
            let product = u128::from(state ^ u64::from(word)) * 0x9e37_79b9_7f4a_7c15_u128;
            (product ^ (product >> 64)) as u64
        });
        (folded ^ (folded >> 32)) as usize & (self.slots.len() - 1)
    }

    fn grow(&mut self) {
        self.slots = vec![0; 2 * self.slots.len()];
        for number in 0..self.keys.len() {
            let mut slot = self.home(&self.keys[number]);
            while self.slots[slot] != 0 {
                slot = (slot + 1) & (self.slots.len() - 1);
            }
            self.slots[slot] = number as u32 + 1;
        }
    }
}

/// Bits by which positions and normals are compared: minus zero equals zero.
pub fn comparable(point: [f32; 3]) -> [u32; 3] {
    point.map(|x| (x + 0.0).to_bits())
}
