// SPDX-License-Identifier: MIT OR Apache-2.0
//! Parts of straight pipelines, which stand or move as a whole: the handshake at both ends, delay lines, and arithmetic
//! wider than one DSP block or one carry chain.
//!
//! Each part but [`Flow`] moves while `go` is high and stands while it is low; its factors and values come from registers.

mod delay;
mod dsp_product;
mod flow;
mod leading;
mod line_table;
mod product;
mod shift_right;

pub use delay::{Delay, FarDelay, LongDelay, LongVectorDelay, VectorDelay};
pub use dsp_product::DspProduct;
pub use flow::Flow;
pub use leading::Leading;
pub use line_table::LineTable;
pub use product::{Product2x1, Product2x2, Product3x1, Product3x2};
pub use shift_right::ShiftRight;
