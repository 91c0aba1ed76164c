// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the fetch from two copies of a summed-area table: beats and golden model are those of [`crate::sat_fetch`].

use crate::binding::{Beat, Binding, Model};
use crate::device::Device;
use crate::sat_fetch;
use crate::stepped::Stepped;
use relief_hdl::widths::WidthSet;
use relief_hdl::with_width_set;

/// The fetch from two copies of a summed-area table.
#[derive(Clone, Copy, Debug)]
pub struct SatFetchParallelBinding;

impl Binding for SatFetchParallelBinding {
    fn name(&self) -> &'static str {
        "sat_fetch_parallel"
    }
    fn summary(&self) -> &'static str {
        "the sum of a rectangle from two copies of a summed-area table"
    }
    fn latency(&self) -> &'static str {
        "17"
    }
    fn interval(&self) -> &'static str {
        "1"
    }
    fn error(&self) -> &'static str {
        "0"
    }
    fn device(&self, set: &WidthSet) -> Box<dyn Device> {
        with_width_set!(set.name, W => Box::new(Stepped::new(W::SatFetchParallel::default())) as Box<dyn Device>)
            .expect("a width set of the list")
    }
    fn model(&self, set: &WidthSet) -> Box<dyn Model> {
        sat_fetch::model(set)
    }
    fn random(&self, set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        sat_fetch::random(set, seed)
    }
    fn stimulus_format(&self) -> &'static str {
        sat_fetch::STIMULUS_FORMAT
    }
    fn parse(&self, set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        sat_fetch::parse(set, numbers)
    }
}
