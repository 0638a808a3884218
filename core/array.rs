//! The one value type: a shape and 32-bit words.

/// What one 32-bit word of an array means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Element {
    /// Unsigned integer.
    U32,
    /// IEEE binary32.
    F32,
}

/// A dense row-major array of 32-bit words.
///
/// Invariant: `words.len()` is the product of `shape`.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    element: Element,
    shape: Vec<usize>,
    words: Vec<u32>,
}

impl Array {
    /// `words` seen as `shape`; panics if the product of `shape` is not the number of words (our bug, never a user's).
    pub fn u32(shape: impl Into<Vec<usize>>, words: Vec<u32>) -> Self {
        Self::from_words(Element::U32, shape.into(), words)
    }

    /// As [`Array::u32`], for floats. No copy is made.
    pub fn f32(shape: impl Into<Vec<usize>>, values: Vec<f32>) -> Self {
        Self::from_words(Element::F32, shape.into(), bytemuck::cast_vec(values))
    }

    /// All-zero words.
    pub fn zeros(element: Element, shape: impl Into<Vec<usize>>) -> Self {
        let shape = shape.into();
        let count = shape.iter().product();
        Self::from_words(element, shape, vec![0; count])
    }

    /// Raw words of either element.
    pub fn from_words(element: Element, shape: Vec<usize>, words: Vec<u32>) -> Self {
        assert_eq!(shape.iter().product::<usize>(), words.len(), "shape {shape:?} does not hold {} words", words.len());
        Self { element, shape, words }
    }

    /// What a word means.
    pub fn element(&self) -> Element {
        self.element
    }

    /// Rows first.
    pub fn shape(&self) -> &[usize] {
        &self.shape
    }

    /// Length of dimension `axis`; 1 past the last.
    pub fn dim(&self, axis: usize) -> usize {
        self.shape.get(axis).copied().unwrap_or(1)
    }

    /// Raw words.
    pub fn words(&self) -> &[u32] {
        &self.words
    }

    /// Raw words, writable.
    pub fn words_mut(&mut self) -> &mut [u32] {
        &mut self.words
    }

    /// The words as unsigned integers; panics on a float array.
    pub fn as_u32(&self) -> &[u32] {
        assert_eq!(self.element, Element::U32);
        &self.words
    }

    /// The words as floats; panics on an integer array.
    pub fn as_f32(&self) -> &[f32] {
        assert_eq!(self.element, Element::F32);
        bytemuck::cast_slice(&self.words)
    }

    /// The words as rows of three floats; panics unless the array is f32 with a multiple of three words.
    pub fn as_vec3(&self) -> &[[f32; 3]] {
        bytemuck::cast_slice(self.as_f32())
    }

    /// Size in bytes.
    pub fn bytes(&self) -> usize {
        self.words.len() * 4
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_float_array_keeps_its_bits() {
        let array = Array::f32([2, 3], vec![1.0, -0.0, 2.5, f32::INFINITY, 0.1, -3.0]);
        assert_eq!(array.as_vec3()[1][1], 0.1);
        assert_eq!(array.words()[1], 0x8000_0000);
        assert_eq!((array.dim(0), array.dim(1), array.dim(2), array.bytes()), (2, 3, 1, 24));
    }

    #[test]
    #[should_panic(expected = "does not hold")]
    fn a_wrong_shape_is_refused() {
        Array::u32([2, 2], vec![0; 3]);
    }
}
