// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps a block cycle by cycle in the calling thread.
//!
//! One cycle: inputs are set, the block settles, outputs are sampled, and the rising edge latches every register. What
//! follows the edge settles in the next cycle, together with its inputs. The clock net itself stays low: registers take
//! the edge by [`Latch`](relief_hdl::signal::Latch), and waveforms draw the clock.

use relief_hdl::ports::Ports;

/// Passes after which a block that has not settled is taken to oscillate.
const SETTLE_LIMIT: usize = 200;

/// A block under a stepped clock, reset on construction.
#[derive(Clone, Debug)]
pub struct Stepped<B: Ports> {
    block: B,
    cycle: u64,
}

impl<B: Ports> Stepped<B> {
    /// Connects `block` and holds its reset for two cycles.
    pub fn new(mut block: B) -> Self {
        block.connect_all();
        let mut bench = Self { block, cycle: 0 };
        bench.reset(2);
        bench.cycle = 0;
        bench
    }

    /// Holds the reset for `cycles` cycles, with the inputs as they stand.
    pub fn reset(&mut self, cycles: usize) {
        self.block.clock_mut().next.reset = true;
        for _ in 0..cycles {
            self.settle();
            self.edge();
        }
        self.block.clock_mut().next.reset = false;
    }

    /// The block. Write inputs before [`Stepped::settle`], read outputs after it.
    pub fn block(&self) -> &B {
        &self.block
    }
    /// The block, to write its inputs.
    pub fn block_mut(&mut self) -> &mut B {
        &mut self.block
    }
    /// Rising edges since the reset.
    pub fn cycle(&self) -> u64 {
        self.cycle
    }

    /// Low phase: lets the block settle.
    ///
    /// # Panics
    /// When the block does not settle: a combinational loop, which is a fault of the block.
    pub fn settle(&mut self) {
        for _ in 0..SETTLE_LIMIT {
            self.block.update_all();
            if !self.block.inside_moves() {
                return;
            }
        }
        panic!("the block does not settle in {SETTLE_LIMIT} passes: it has a combinational loop");
    }

    /// Rising edge.
    pub fn edge(&mut self) {
        let reset = self.block.clock_mut().next.reset;
        self.block.latch(reset);
        self.cycle += 1;
    }
}
