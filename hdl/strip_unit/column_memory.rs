// SPDX-License-Identifier: MIT OR Apache-2.0
//! Queue of vertices in a block RAM, the oldest one always readable.
//!
//! | port            | format       |   Interval 1; a vertex pushed into an empty queue is at the head two cycles later
//! | clear           | Bit          | empties the queue; wins over push and pop |
//! | push, push_data | Bit, L x signed V | ignored by the caller's promise when `full` |
//! | pop             | Bit          | only with `head_valid` |
//! | head            | L x signed V | the oldest vertex, with `head_valid` | Golden: models::strip_unit (queue)   Error 0
//! | head_slot, tail_slot | unsigned K | where the head stands, and where the next vertex goes |

use crate::prelude::*;

/// Queue of up to `depth` < 2^K vertices of `L` x `V` bits.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct ColumnMemory<const L: usize, const V: usize, const K: usize> {
    pub clock: Input<ClockReset>,
    pub clear: Input<Bit>,
    pub push: Input<Bit>,
    pub push_data: Input<Lanes<L, V>>,
    pub pop: Input<Bit>,
    pub head: Output<Lanes<L, V>>,
    pub head_valid: Output<Bit>,
    pub empty: Output<Bit>,
    pub full: Output<Bit>,
    pub head_slot: Output<U<K>>,
    pub tail_slot: Output<U<K>>,
    ram: Ram<Lanes<L, V>, K>,
    first: Register<U<K>>,
    next: Register<U<K>>,
    count: Register<U<K>>,
    ready: Register<Bit>,
    first_behind: Wire<U<K>>,
    first_chosen: Wire<U<K>>,
    depth: Constant<U<K>>,
    last: Constant<U<K>>,
}

impl<const L: usize, const V: usize, const K: usize> ColumnMemory<L, V, K> {
    /// A queue of `depth` vertices, `1 <= depth < 2^K`.
    pub fn new(depth: usize) -> Self {
        assert!(depth < 1 << K, "a column memory of {depth} vertices needs counters of more than {K} bits");
        Self {
            clock: Input::default(),
            clear: Input::default(),
            push: Input::default(),
            push_data: Input::default(),
            pop: Input::default(),
            head: Output::default(),
            head_valid: Output::default(),
            empty: Output::default(),
            full: Output::default(),
            head_slot: Output::default(),
            tail_slot: Output::default(),
            ram: Ram::new(depth),
            first: Register::default(),
            next: Register::default(),
            count: Register::default(),
            ready: Register::default(),
            first_behind: Wire::default(),
            first_chosen: Wire::default(),
            depth: Constant::new(U::new(depth as i64)),
            last: Constant::new(U::new(depth as i64 - 1)),
        }
    }
}

impl<const L: usize, const V: usize, const K: usize> Logic for ColumnMemory<L, V, K> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, first, next, count, ready);
        clock!(self, clock, ram);
        self.head.next = self.ram.read_data.val();
        self.head_valid.next = self.ready.q.val();
        self.empty.next = self.count.q.val() == 0;
        self.full.next = self.count.q.val() == self.depth.val();
        self.head_slot.next = self.first.q.val();
        self.tail_slot.next = self.next.q.val();
        self.first_behind.next = self.first.q.val() + 1;
        if self.first.q.val() == self.last.val() {
            self.first_behind.next = 0.into();
        }
        self.first_chosen.next = self.first.q.val();
        if self.pop.val() {
            self.first_chosen.next = self.first_behind.val();
        }
        self.ram.read_address.next = self.first_chosen.val();
        self.ram.write_address.next = self.next.q.val();
        self.ram.write_enable.next = self.push.val() && !self.clear.val();
        self.ram.write_data.next = self.push_data.val();
        if self.clear.val() {
            self.first.d.next = self.next.q.val();
            self.count.d.next = 0.into();
            self.ready.d.next = false;
        } else {
            self.first.d.next = self.first_chosen.val();
            // The word read at this edge was written before it if the queue holds it already.
            self.ready.d.next = self.count.q.val() != 0 && !(self.pop.val() && self.count.q.val() == 1);
            if self.push.val() {
                self.next.d.next = self.next.q.val() + 1;
                if self.next.q.val() == self.last.val() {
                    self.next.d.next = 0.into();
                }
            }
            if self.push.val() && !self.pop.val() {
                self.count.d.next = self.count.q.val() + 1;
            } else if self.pop.val() && !self.push.val() {
                self.count.d.next = self.count.q.val() - 1;
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("column_memory")
    }
}

latches! { [const L: usize, const V: usize, const K: usize] ColumnMemory<L, V, K>: ram, first, next, count, ready }
