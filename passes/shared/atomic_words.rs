//! Arrays that several threads write at once: words of 32 bits with relaxed atomics, which cost no more than plain stores.

use std::sync::atomic::AtomicU32;

/// Zeros. The memory comes zeroed from the system and is only touched where it is written.
pub fn atomic_zeros(count: usize) -> Vec<AtomicU32> {
    vec![0; count].into_iter().map(AtomicU32::new).collect()
}

/// The words once no thread writes them any more; no copy is made.
pub fn into_words(atomic: Vec<AtomicU32>) -> Vec<u32> {
    atomic.into_iter().map(AtomicU32::into_inner).collect()
}
