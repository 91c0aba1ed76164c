// SPDX-License-Identifier: MIT OR Apache-2.0
//! Queue of vertices in a block RAM, the oldest ones at hand.
//!
//! | port            | format       |   Interval 1; a vertex pushed into an empty queue is at the head two cycles later
//! | clear           | Bit          | empties the queue; not together with push or pop, and with no vertex owed |
//! | push, push_data | Bit, L x signed V | never when `full` |
//! | pop             | Bit          | the oldest vertex is spoken for; never when `empty` |
//! | take            | Bit          | and leaves, in a later cycle, one after the other, as soon as there is `head_valid` |
//! | head            | L x signed V | the oldest vertex not taken, with `head_valid` | Golden: models::strip_unit (queue)   Error 0
//! | empty, single, full | Bit      | of the vertices not popped: none, one, `depth` |
//!
//! What is popped is decided by counts alone. Up to 15 of the oldest vertices stand in a small memory before the head. While
//! no others are behind them, what is pushed goes there at once; else it goes through the block RAM, which answers late and
//! lies all over the part: nothing holds it, and it is read as far as there is room for what it answers.

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
    pub take: Input<Bit>,
    pub head: Output<Lanes<L, V>>,
    pub head_valid: Output<Bit>,
    pub empty: Output<Bit>,
    pub single: Output<Bit>,
    pub full: Output<Bit>,
    ram: RegisteredRam<Lanes<L, V>, K>,
    queue: Ram<Lanes<L, V>, 4>,
    /// Vertices not popped, and what the decisions want to know of their number.
    count: Register<U<K>>,
    none: Register<Bit>,
    one: Register<Bit>,
    all: Register<Bit>,
    // The slots of the RAM where the next vertex goes and from where the next one comes, and how many are in between.
    next: Register<U<K>>,
    first: Register<U<K>>,
    unread: Register<U<K>>,
    some: Register<Bit>,
    /// Reads that the RAM answers, and that stand in its register.
    s1_read: Register<Bit>,
    s2_read: Register<Bit>,
    // The slots of the small memory likewise, and how many are taken or spoken for.
    queue_in: Register<U<4>>,
    queue_out: Register<U<4>>,
    used: Register<U<5>>,
    room: Register<Bit>,
    /// Nothing is in the RAM or on its way from there, and there is room.
    direct: Register<Bit>,
    held_valid: Register<Bit>,
    head_room: Wire<Bit>,
    fetches: Wire<Bit>,
    reads: Wire<Bit>,
    passes: Wire<Bit>,
    stores: Wire<Bit>,
    some_behind: Wire<Bit>,
    depth_less_one: Constant<U<K>>,
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
            take: Input::default(),
            head: Output::default(),
            head_valid: Output::default(),
            empty: Output::default(),
            single: Output::default(),
            full: Output::default(),
            ram: RegisteredRam::new(depth),
            queue: Ram::default(),
            count: Register::default(),
            none: Register::new(true),
            one: Register::default(),
            all: Register::default(),
            next: Register::default(),
            first: Register::default(),
            unread: Register::default(),
            some: Register::default(),
            s1_read: Register::default(),
            s2_read: Register::default(),
            queue_in: Register::default(),
            queue_out: Register::default(),
            used: Register::default(),
            room: Register::new(true),
            direct: Register::new(true),
            held_valid: Register::default(),
            head_room: Wire::default(),
            fetches: Wire::default(),
            reads: Wire::default(),
            passes: Wire::default(),
            stores: Wire::default(),
            some_behind: Wire::default(),
            depth_less_one: Constant::new(U::new(depth as i64 - 1)),
        }
    }
}

impl<const L: usize, const V: usize, const K: usize> Logic for ColumnMemory<L, V, K> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(
            self, clock, count, none, one, all, next, first, unread, some, s1_read, s2_read, queue_in, queue_out
        );
        dff_setup!(self, clock, used, room, direct, held_valid);
        clock!(self, clock, ram, queue);
        self.head.next = self.queue.read_data.val();
        self.head_valid.next = self.held_valid.q.val();
        self.empty.next = self.none.q.val();
        self.single.next = self.one.q.val();
        self.full.next = self.all.q.val();

        // Into the RAM, and out of it. A free slot may be written at any time: it counts once it is pushed, and `push`
        // would come late.
        self.passes.next = self.push.val() && self.direct.q.val();
        self.stores.next = self.push.val() && !self.direct.q.val();
        self.reads.next = self.some.q.val() && self.room.q.val();
        self.ram.enable.next = true;
        self.ram.output_enable.next = true;
        self.ram.read_address.next = self.first.q.val();
        self.ram.write_enable.next = !self.all.q.val();
        self.ram.write_address.next = self.next.q.val();
        self.ram.write_data.next = self.push_data.val();
        self.s1_read.d.next = self.reads.val();
        self.s2_read.d.next = self.s1_read.q.val();
        if self.reads.val() {
            self.first.d.next = self.first.q.val() + 1;
            if self.first.q.val() == self.depth_less_one.val() {
                self.first.d.next = 0.into();
            }
        }
        if self.stores.val() {
            self.next.d.next = self.next.q.val() + 1;
            if self.next.q.val() == self.depth_less_one.val() {
                self.next.d.next = 0.into();
            }
        }
        self.some_behind.next = self.some.q.val() || self.stores.val();
        if self.stores.val() && !self.reads.val() {
            self.unread.d.next = self.unread.q.val() + 1;
        } else if self.reads.val() && !self.stores.val() {
            self.unread.d.next = self.unread.q.val() - 1;
            self.some_behind.next = self.unread.q.val() != 1;
        }
        self.some.d.next = self.some_behind.val();

        // Into the small memory, one slot of which is always free, and out of it.
        self.queue.write_enable.next = true;
        self.queue.write_address.next = self.queue_in.q.val();
        self.queue.write_data.next = self.ram.read_data.val();
        if self.direct.q.val() {
            self.queue.write_data.next = self.push_data.val();
        }
        if self.s2_read.q.val() || self.passes.val() {
            self.queue_in.d.next = self.queue_in.q.val() + 1;
        }
        self.head_room.next = !self.held_valid.q.val() || self.take.val();
        self.fetches.next = self.head_room.val() && self.queue_out.q.val() != self.queue_in.q.val();
        self.queue.enable.next = self.head_room.val();
        self.queue.read_address.next = self.queue_out.q.val();
        if self.head_room.val() {
            self.held_valid.d.next = self.queue_out.q.val() != self.queue_in.q.val();
        }
        if self.fetches.val() {
            self.queue_out.d.next = self.queue_out.q.val() + 1;
        }
        if (self.reads.val() || self.passes.val()) && !self.fetches.val() {
            self.used.d.next = self.used.q.val() + 1;
        } else if self.fetches.val() && !self.reads.val() && !self.passes.val() {
            self.used.d.next = self.used.q.val() - 1;
        }
        // One more may come in this cycle, and one in the next.
        self.room.d.next = self.used.q.val() < 14;
        self.direct.d.next =
            self.used.q.val() < 14 && !self.some_behind.val() && !self.reads.val() && !self.s1_read.q.val();

        if self.push.val() && !self.pop.val() {
            self.count.d.next = self.count.q.val() + 1;
            self.none.d.next = false;
            self.one.d.next = self.none.q.val();
            self.all.d.next = self.count.q.val() == self.depth_less_one.val();
        } else if self.pop.val() && !self.push.val() {
            self.count.d.next = self.count.q.val() - 1;
            self.none.d.next = self.one.q.val();
            self.one.d.next = self.count.q.val() == 2;
            self.all.d.next = false;
        }
        if self.clear.val() {
            self.count.d.next = 0.into();
            self.none.d.next = true;
            self.one.d.next = false;
            self.all.d.next = false;
            self.next.d.next = 0.into();
            self.first.d.next = 0.into();
            self.unread.d.next = 0.into();
            self.some.d.next = false;
            self.s1_read.d.next = false;
            self.s2_read.d.next = false;
            self.queue_in.d.next = 0.into();
            self.queue_out.d.next = 0.into();
            self.used.d.next = 0.into();
            self.room.d.next = true;
            self.direct.d.next = true;
            self.held_valid.d.next = false;
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("column_memory")
    }
}

latches! { [const L: usize, const V: usize, const K: usize] ColumnMemory<L, V, K>: ram, queue, count, none, one, all, next, first, unread, some, s1_read, s2_read, queue_in, queue_out, used, room, direct, held_valid }
