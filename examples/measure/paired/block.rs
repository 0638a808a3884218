//! One block of timings.

use shadowgraph_core::problem::{Kind, Problem};

/// What is timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
pub enum Side {
    /// The one compared with.
    A,
    /// The one judged.
    B,
}

/// A B B A or B A A B: the place of either side is the same on average.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Block {
    /// What was timed, in order.
    pub order: [Side; 4],
    /// How long it took, milliseconds, in that order.
    pub millis: [f64; 4],
}

impl Block {
    pub(super) const ORDERS: [[Side; 4]; 2] =
        [[Side::A, Side::B, Side::B, Side::A], [Side::B, Side::A, Side::A, Side::B]];

    /// # Errors
    /// The order is neither A B B A nor B A A B, or a time is not a number above 0.
    pub fn check(&self) -> Result<(), Problem> {
        if !Self::ORDERS.contains(&self.order) {
            return Err(Problem::new(Kind::BadValue, "a block does not pair its timings")
                .expected("A B B A or B A A B")
                .found(format!("{:?}", self.order)));
        }
        match self.millis.iter().position(|millis| !(millis.is_finite() && *millis > 0.0)) {
            None => Ok(()),
            Some(index) => Err(Problem::new(Kind::BadValue, "a time cannot be compared")
                .expected("milliseconds above 0")
                .found(format!("{} as timing {index} of a block", self.millis[index]))
                .remedy("time several frames at once where the clock is too coarse")),
        }
    }

    /// Both timings of a side.
    pub fn of(&self, side: Side) -> [f64; 2] {
        let outer = self.order[0] == side;
        if outer { [self.millis[0], self.millis[3]] } else { [self.millis[1], self.millis[2]] }
    }

    /// Logarithm of B over A, each the smaller of its two: other work makes a timing longer, never shorter.
    pub fn log_ratio(&self) -> f64 {
        let undisturbed = |side: Side| self.of(side)[0].min(self.of(side)[1]);
        (undisturbed(Side::B) / undisturbed(Side::A)).ln()
    }
}
