// SPDX-License-Identifier: MIT OR Apache-2.0
//! Builds the maxima and the minima of every filter level of a map, a texel a cycle.
//!
//! ```text
//! node:  level L+1 node (i, j) = max and min of the 3 x 3 neighbours of node (2i, 2j) of level L
//! cell:  level L+1 cell (i, j) = max and min of the 2 x 2 cells (2i .. 2i+1, 2j .. 2j+1) of level L
//! ```
//!
//! | port        | format      | meaning |   Latency 15 from the last texel of a map of odd sides   Interval 1 (see fold)
//! | in_kind     | 1 bit       | 0 size, 1 texel, in raster order   Golden: models::mip_build::MipBuild   Error 0
//! | in_width, in_height | unsigned M | of the map, at least one | size
//! | in_repeat_u, in_repeat_v | Bit | the map repeats; the side must be even at every level | size
//! | in_cell     | Bit         | cells, otherwise nodes | size
//! | in_poles    | Bit         | the first and the last row are poles; not together with in_repeat_v | size
//! | in_levels   | 4 bits      | levels, the map included: 1 ..= 15 | size
//! | in_value    | UQ16.0      | the texel | texel
//! | out_level   | 4 bits      | 1 and up, one after the other; with poles 0 before, of which only row 0 and the last one
//! | out_i, out_j | unsigned M | column and row, in raster order
//! | out_max, out_min | UQ16.0 |
//! | out_last    | Bit         | the last node of the last level
//! | error       | Bit         | sticky: a size that cannot be used (level 1 has more than 2^A nodes, for one; it is
//! forgotten), a size before the map was complete (the old map is forgotten), a texel without a size (dropped)
//!
//! Odd levels stand in one memory, even ones in another: a complete level is sent, and as it is sent it is the map of
//! the next one. A map of N texels takes about 4/3 N cycles. 2^B nodes hold every level 2 if B = A - 1.
//!
//! A pole is one point of a body, and has one height: with `in_poles` both extrema of a pole row are those of all its
//! samples, at every level, the map included. A last row of the map between two rows of nodes makes both the pole's.

mod extrema_memory;
mod fold;
mod poles;

pub use extrema_memory::ExtremaMemory;
pub use fold::MipFold;
pub use poles::MipPoles;

use crate::prelude::*;

/// What the builder does.
#[derive(Copy, Clone, PartialEq, Eq, Debug, LogicState)]
#[allow(missing_docs)]
pub enum MipBuildState {
    /// Waits for a size.
    Idle,
    /// Waits for the sides of level 1, and for their product.
    Measure,
    /// Takes the size, or refuses it.
    Check,
    /// Takes texels, or nodes of the level before, and sends these.
    Run,
    /// Sends the pole rows of the map.
    Poles,
    /// Waits until the last node is written.
    Flush,
}

/// Builder for sides below 2^M, levels of up to 2^A nodes.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct MipBuild<const M: usize, const A: usize, const B: usize> {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_kind: Input<U<1>>,
    pub in_width: Input<U<M>>,
    pub in_height: Input<U<M>>,
    pub in_repeat_u: Input<Bit>,
    pub in_repeat_v: Input<Bit>,
    pub in_cell: Input<Bit>,
    pub in_poles: Input<Bit>,
    pub in_levels: Input<U<4>>,
    pub in_value: Input<U<16>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_level: Output<U<4>>,
    pub out_i: Output<U<M>>,
    pub out_j: Output<U<M>>,
    pub out_max: Output<U<16>>,
    pub out_min: Output<U<16>>,
    pub out_last: Output<Bit>,
    pub error: Output<Bit>,
    state: Register<MipBuildState>,
    failed: Register<Bit>,
    // The level that is read.
    level: Register<U<4>>,
    width: DataRegister<U<M>>,
    height: DataRegister<U<M>>,
    width_last: DataRegister<U<M>>,
    height_last: DataRegister<U<M>>,
    // One less than these, and than the first row of the lower pole, unless that is row 0; a cycle later.
    width_second: DataRegister<U<M>>,
    height_second: DataRegister<U<M>>,
    lower_before: DataRegister<U<M>>,
    lower_none: DataRegister<Bit>,
    column: DataRegister<U<M>>,
    row: DataRegister<U<M>>,
    /// The row is of the upper pole, or of the lower one: decided with the row, for what is sent waits for it.
    in_upper: Register<Bit>,
    in_lower: Register<Bit>,
    /// So are these: the column and the row are the last ones, and the level is not the map.
    last_column: Register<Bit>,
    last_row: Register<Bit>,
    above_map: Register<Bit>,
    // The map.
    levels: DataRegister<U<4>>,
    repeat_u: DataRegister<Bit>,
    repeat_v: DataRegister<Bit>,
    cells: DataRegister<Bit>,
    has_poles: DataRegister<Bit>,
    // What follows from the above a cycle later, three behind a size for the last of them.
    width_above: DataRegister<U<M>>,
    height_above: DataRegister<U<M>>,
    folds: DataRegister<Bit>,
    sides_fit: DataRegister<Bit>,
    nodes_fit: DataRegister<Bit>,
    measured: Register<U<2>>,
    // Nodes on their way from the memory of this level: as many are asked for as the queue has room for.
    feed: Ram<U<32>, 3>,
    feed_in: Register<U<3>>,
    feed_out: Register<U<3>>,
    feed_valid: Register<Bit>,
    feed_room: Register<U<4>>,
    /// There is some.
    feed_free: Register<Bit>,
    // The node that is sent, and the next one where it waits: so that `out_ready` is asked for no further back.
    sent_valid: Register<Bit>,
    sent_level: DataRegister<U<4>>,
    sent_i: DataRegister<U<M>>,
    sent_j: DataRegister<U<M>>,
    sent_max: DataRegister<U<16>>,
    sent_min: DataRegister<U<16>>,
    sent_last: DataRegister<Bit>,
    spare_valid: Register<Bit>,
    spare_level: DataRegister<U<4>>,
    spare_i: DataRegister<U<M>>,
    spare_j: DataRegister<U<M>>,
    spare_max: DataRegister<U<16>>,
    spare_min: DataRegister<U<16>>,
    spare_last: DataRegister<Bit>,
    area: Multiplier<14, 14, 28>,
    fold: MipFold<M, A>,
    poles: MipPoles<M>,
    odd_levels: ExtremaMemory<A>,
    even_levels: ExtremaMemory<B>,
    running: Wire<Bit>,
    on_map: Wire<Bit>,
    on_odd: Wire<Bit>,
    texel: Wire<Bit>,
    size: Wire<Bit>,
    out_free: Wire<Bit>,
    out_room: Wire<Bit>,
    offered: Wire<Bit>,
    take: Wire<Bit>,
    word: Wire<U<32>>,
    texel_max: Wire<U<16>>,
    texel_min: Wire<U<16>>,
    none: Wire<U<M>>,
    ones: Wire<U<M>>,
    kept: Wire<U<M>>,
    nodes: Wire<U<28>>,
    nodes_behind: Wire<U<28>>,
    sound: Wire<Bit>,
    advance: Wire<Bit>,
    reads: Wire<Bit>,
    arrives: Wire<Bit>,
    feed_takes: Wire<Bit>,
    sends_poles: Wire<Bit>,
    sends: Wire<Bit>,
    replaces: Wire<Bit>,
    send_max: Wire<U<16>>,
    send_min: Wire<U<16>>,
    send_last: Wire<Bit>,
}

impl<const M: usize, const A: usize, const B: usize> MipBuild<M, A, B> {
    /// Cycles from the last texel of a map of odd sides to the first node.
    pub const LATENCY: usize = 15;
}

impl<const M: usize, const A: usize, const B: usize> Logic for MipBuild<M, A, B> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, area, fold, poles, odd_levels, even_levels, feed);
        dff_setup!(self, clock, feed_in, feed_out, feed_valid, feed_room, in_upper, in_lower, last_column, last_row);
        dff_setup!(self, clock, above_map, feed_free, width_second, height_second, lower_before, lower_none);
        self.width_second.d.next = self.width_last.q.val() - 1;
        self.height_second.d.next = self.height_last.q.val() - 1;
        self.lower_before.d.next = self.poles.map_last.val() - 1;
        self.lower_none.d.next = self.poles.map_last.val() == 0;
        dff_setup!(self, clock, state, failed, level, width, height, column, row, levels, repeat_u, repeat_v, cells);
        dff_setup!(self, clock, has_poles, width_last, height_last, width_above, height_above, folds, sides_fit);
        dff_setup!(self, clock, nodes_fit, measured, sent_valid, sent_level, sent_i, sent_j, sent_max, sent_min);
        dff_setup!(
            self,
            clock,
            sent_last,
            spare_valid,
            spare_level,
            spare_i,
            spare_j,
            spare_max,
            spare_min,
            spare_last
        );
        self.out_valid.next = self.sent_valid.q.val();
        self.out_level.next = self.sent_level.q.val();
        self.out_i.next = self.sent_i.q.val();
        self.out_j.next = self.sent_j.q.val();
        self.out_max.next = self.sent_max.q.val();
        self.out_min.next = self.sent_min.q.val();
        self.out_last.next = self.sent_last.q.val();
        self.error.next = self.failed.q.val();

        // Sides above: w / 2 + 1 nodes, w / 2 where they repeat, cells rounded up.
        self.width_above.d.next = self.width.q.val() >> 1;
        if self.cells.q.val() {
            self.width_above.d.next = (self.width.q.val() >> 1) + bit_cast_to::<U<M>>(self.width.q.val().get_bit(0));
        } else if !self.repeat_u.q.val() {
            self.width_above.d.next = (self.width.q.val() >> 1) + 1;
        }
        self.height_above.d.next = self.height.q.val() >> 1;
        if self.cells.q.val() {
            self.height_above.d.next = (self.height.q.val() >> 1) + bit_cast_to::<U<M>>(self.height.q.val().get_bit(0));
        } else if !self.repeat_v.q.val() {
            self.height_above.d.next = (self.height.q.val() >> 1) + 1;
        }
        self.area.a.next = bit_cast_to::<S<14>>(self.width_above.q.val());
        self.area.b.next = bit_cast_to::<S<14>>(self.height_above.q.val());
        // Up to 2^A nodes; none at all only where a side is none, which is refused.
        self.nodes.next = bit_cast_to::<U<28>>(self.area.p.val()) - 1;
        self.nodes_behind.next = bit_cast_to::<U<28>>(bit_cast_to::<U<A>>(self.nodes.val()));
        self.nodes_fit.d.next = self.nodes_behind.val() == self.nodes.val();
        // A side that repeats has as many factors of two as there are levels.
        self.none.next = 0.into();
        self.ones.next = self.none.val() - 1;
        self.kept.next = self.ones.val() << self.levels.q.val();
        self.sides_fit.d.next = self.width.q.val() != 0
            && self.height.q.val() != 0
            && (!self.repeat_u.q.val() || (self.width.q.val() & self.kept.val()) == self.width.q.val())
            && (!self.repeat_v.q.val() || (self.height.q.val() & self.kept.val()) == self.height.q.val());
        self.folds.d.next = self.level.q.val() + 1 != self.levels.q.val();
        self.sound.next = self.sides_fit.q.val()
            && self.levels.q.val() != 0
            && (!self.repeat_v.q.val() || !self.has_poles.q.val())
            && (self.levels.q.val() == 1 || self.nodes_fit.q.val());

        self.running.next = self.state.q.val() == MipBuildState::Run;
        self.on_map.next = !self.above_map.q.val();
        self.on_odd.next = self.level.q.val().get_bit(0);
        self.texel.next = self.in_valid.val() && self.in_kind.val() == 1;
        self.out_free.next = !self.spare_valid.q.val() && (!self.sent_valid.q.val() || self.out_ready.val());
        self.out_room.next = !self.spare_valid.q.val();
        self.offered.next = self.running.val() && self.texel.val();
        if !self.on_map.val() {
            self.offered.next = self.running.val() && self.out_room.val() && self.feed_valid.q.val();
        }
        self.word.next = self.feed.read_data.val();
        self.texel_max.next = self.word.val().get_bits::<16>(16);
        self.texel_min.next = self.word.val().get_bits::<16>(0);
        if self.on_map.val() {
            self.texel_max.next = self.in_value.val();
            self.texel_min.next = self.in_value.val();
        }
        self.fold.valid.next = self.offered.val() && self.folds.q.val();
        self.fold.max.next = self.texel_max.val();
        self.fold.min.next = self.texel_min.val();
        self.fold.column.next = self.column.q.val();
        self.fold.first_column.next = self.column.q.val() == 0;
        self.fold.last_column.next = self.last_column.q.val();
        self.fold.odd_row.next = self.row.q.val().get_bit(0);
        self.fold.first_row.next = self.row.q.val() == 0;
        self.fold.last_row.next = self.last_row.q.val();
        self.fold.cells.next = self.cells.q.val();
        self.fold.repeat_u.next = self.repeat_u.q.val();
        self.fold.repeat_v.next = self.repeat_v.q.val();
        self.fold.width_above.next = self.width_above.q.val();
        self.take.next = self.offered.val() && (!self.folds.q.val() || self.fold.ready.val());
        // A beat that waits behind a map waits for its last node, too, so that an error of its own comes after it.
        self.in_ready.next = (self.state.q.val() == MipBuildState::Idle && self.out_free.val())
            || (self.running.val()
                && self.on_map.val()
                && (!self.folds.q.val() || self.fold.ready.val() || self.in_kind.val() == 0));
        self.size.next = self.in_valid.val()
            && self.in_kind.val() == 0
            && ((self.state.q.val() == MipBuildState::Idle && self.out_free.val())
                || (self.running.val() && self.on_map.val()));

        // The memory above takes the nodes, the memory of this level is read.
        self.odd_levels.op.next = self.fold.op.val() && !self.on_odd.val();
        self.odd_levels.fresh.next = self.fold.op_fresh.val();
        self.odd_levels.address.next = self.fold.op_address.val();
        self.odd_levels.max.next = self.fold.op_max.val();
        self.odd_levels.min.next = self.fold.op_min.val();
        self.reads.next = self.running.val() && !self.on_map.val() && self.feed_free.q.val();
        self.odd_levels.read.next = self.reads.val() && self.on_odd.val();
        self.even_levels.op.next = self.fold.op.val() && self.on_odd.val();
        self.even_levels.fresh.next = self.fold.op_fresh.val();
        self.even_levels.address.next = bit_cast_to::<U<B>>(self.fold.op_address.val());
        self.even_levels.max.next = self.fold.op_max.val();
        self.even_levels.min.next = self.fold.op_min.val();
        self.even_levels.read.next = self.reads.val() && !self.on_odd.val();
        self.arrives.next = self.odd_levels.word_valid.val() || self.even_levels.word_valid.val();
        self.feed.write_enable.next = self.arrives.val();
        self.feed.write_address.next = self.feed_in.q.val();
        self.feed.write_data.next = self.even_levels.word.val();
        if self.on_odd.val() {
            self.feed.write_data.next = self.odd_levels.word.val();
        }
        if self.arrives.val() {
            self.feed_in.d.next = self.feed_in.q.val() + 1;
        }
        self.feed_takes.next = !self.feed_valid.q.val() || self.take.val();
        self.feed.enable.next = self.feed_takes.val();
        self.feed.read_address.next = self.feed_out.q.val();
        if self.feed_takes.val() {
            self.feed_valid.d.next = self.feed_out.q.val() != self.feed_in.q.val();
            if self.feed_out.q.val() != self.feed_in.q.val() {
                self.feed_out.d.next = self.feed_out.q.val() + 1;
            }
        }
        if self.reads.val() && !self.take.val() {
            self.feed_room.d.next = self.feed_room.q.val() - 1;
            self.feed_free.d.next = self.feed_room.q.val() != 1;
        } else if self.take.val() && !self.reads.val() {
            self.feed_room.d.next = self.feed_room.q.val() + 1;
            self.feed_free.d.next = true;
        }

        self.advance.next = self.state.q.val() == MipBuildState::Flush
            && self.fold.idle.val()
            && !self.odd_levels.busy.val()
            && !self.even_levels.busy.val();
        self.odd_levels.rewind.next = self.advance.val();
        self.even_levels.rewind.next = self.advance.val();
        // Nothing is on its way by then: a level ends cycles before the next one begins.
        if self.advance.val() {
            self.feed_in.d.next = 0.into();
            self.feed_out.d.next = 0.into();
            self.feed_valid.d.next = false;
            self.feed_room.d.next = 8.into();
            self.feed_free.d.next = true;
        }
        self.fold.clear.next = self.size.val() || self.advance.val();
        self.sends_poles.next =
            self.state.q.val() == MipBuildState::Poles && self.out_room.val() && !self.poles.busy.val();
        self.poles.size.next = self.size.val();
        self.poles.height.next = self.in_height.val();
        self.poles.advance.next = self.advance.val();
        self.poles.take.next = self.take.val();
        self.poles.on_map.next = self.on_map.val();
        self.poles.cells.next = self.cells.q.val();
        self.poles.row.next = self.row.q.val();
        self.poles.in_upper.next = self.in_upper.q.val();
        self.poles.in_lower.next = self.in_lower.q.val();
        self.poles.max.next = self.texel_max.val();
        self.poles.min.next = self.texel_min.val();
        self.replaces.next = self.has_poles.q.val() && self.poles.in_pole.val();
        if self.state.q.val() == MipBuildState::Measure {
            self.measured.d.next = self.measured.q.val() + 1;
            if self.measured.q.val() == 2 {
                self.state.d.next = MipBuildState::Check;
            }
        } else if self.state.q.val() == MipBuildState::Check {
            self.state.d.next = MipBuildState::Run;
            if !self.sound.val() {
                self.state.d.next = MipBuildState::Idle;
                self.failed.d.next = true;
            }
        } else if self.take.val() || self.sends_poles.val() {
            self.column.d.next = self.column.q.val() + 1;
            self.last_column.d.next = self.column.q.val() == self.width_second.q.val();
            if self.last_column.q.val() {
                self.column.d.next = 0.into();
                self.last_column.d.next = self.width_last.q.val() == 0;
                self.row.d.next = self.row.q.val() + 1;
                self.last_row.d.next = self.row.q.val() == self.height_second.q.val();
                self.in_upper.d.next = false;
                self.in_lower.d.next = self.lower_none.q.val() || self.row.q.val() >= self.lower_before.q.val();
                if self.sends_poles.val() {
                    self.row.d.next = self.poles.map_last.val();
                    self.in_upper.d.next = self.poles.map_last.val() == 0;
                    self.in_lower.d.next = true;
                    self.last_row.d.next = true;
                }
                if self.last_row.q.val() {
                    self.row.d.next = 0.into();
                    self.in_upper.d.next = true;
                    self.in_lower.d.next = self.poles.map_last.val() == 0;
                    self.last_row.d.next = self.height_last.q.val() == 0;
                    self.state.d.next = MipBuildState::Idle;
                    if self.folds.q.val() {
                        self.state.d.next = MipBuildState::Flush;
                    }
                    if self.take.val() && self.on_map.val() && self.has_poles.q.val() {
                        self.state.d.next = MipBuildState::Poles;
                    }
                }
            }
        } else if self.advance.val() {
            self.state.d.next = MipBuildState::Run;
            self.level.d.next = self.level.q.val() + 1;
            self.width.d.next = self.width_above.q.val();
            self.height.d.next = self.height_above.q.val();
            self.width_last.d.next = self.width_above.q.val() - 1;
            self.height_last.d.next = self.height_above.q.val() - 1;
            self.column.d.next = 0.into();
            self.row.d.next = 0.into();
            self.in_upper.d.next = true;
            self.in_lower.d.next = (self.poles.map_last.val() >> 1) == 0;
            self.last_column.d.next = self.width_above.q.val() == 1;
            self.last_row.d.next = self.height_above.q.val() == 1;
            self.above_map.d.next = true;
        }
        if self.size.val() {
            self.state.d.next = MipBuildState::Measure;
            self.measured.d.next = 0.into();
            self.level.d.next = 0.into();
            self.width.d.next = self.in_width.val();
            self.height.d.next = self.in_height.val();
            self.width_last.d.next = self.in_width.val() - 1;
            self.height_last.d.next = self.in_height.val() - 1;
            self.column.d.next = 0.into();
            self.row.d.next = 0.into();
            self.in_upper.d.next = true;
            self.in_lower.d.next = self.in_height.val() == 1;
            self.last_column.d.next = self.in_width.val() == 1;
            self.last_row.d.next = self.in_height.val() == 1;
            self.above_map.d.next = false;
            self.levels.d.next = self.in_levels.val();
            self.repeat_u.d.next = self.in_repeat_u.val();
            self.repeat_v.d.next = self.in_repeat_v.val();
            self.cells.d.next = self.in_cell.val();
            self.has_poles.d.next = self.in_poles.val();
            if self.running.val() {
                self.failed.d.next = true;
            }
        }
        if self.texel.val() && self.state.q.val() == MipBuildState::Idle && self.out_free.val() {
            self.failed.d.next = true;
        }

        // What is sent goes behind what waits.
        self.sends.next = (self.take.val() && !self.on_map.val()) || self.sends_poles.val();
        self.send_max.next = self.texel_max.val();
        self.send_min.next = self.texel_min.val();
        if self.replaces.val() {
            self.send_max.next = self.poles.pole_max.val();
            self.send_min.next = self.poles.pole_min.val();
        }
        self.send_last.next = self.last_column.q.val() && self.last_row.q.val() && !self.folds.q.val();
        if !self.sent_valid.q.val() || self.out_ready.val() {
            self.sent_valid.d.next = self.spare_valid.q.val() || self.sends.val();
            self.spare_valid.d.next = false;
            self.sent_level.d.next = self.level.q.val();
            self.sent_i.d.next = self.column.q.val();
            self.sent_j.d.next = self.row.q.val();
            self.sent_max.d.next = self.send_max.val();
            self.sent_min.d.next = self.send_min.val();
            self.sent_last.d.next = self.send_last.val();
            if self.spare_valid.q.val() {
                self.sent_level.d.next = self.spare_level.q.val();
                self.sent_i.d.next = self.spare_i.q.val();
                self.sent_j.d.next = self.spare_j.q.val();
                self.sent_max.d.next = self.spare_max.q.val();
                self.sent_min.d.next = self.spare_min.q.val();
                self.sent_last.d.next = self.spare_last.q.val();
            }
        } else if self.sends.val() {
            self.spare_valid.d.next = true;
        }
        if self.out_room.val() {
            self.spare_level.d.next = self.level.q.val();
            self.spare_i.d.next = self.column.q.val();
            self.spare_j.d.next = self.row.q.val();
            self.spare_max.d.next = self.send_max.val();
            self.spare_min.d.next = self.send_min.val();
            self.spare_last.d.next = self.send_last.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("mip_build")
    }
}

ports! {
    [const M: usize, const A: usize, const B: usize] MipBuild<M, A, B> {
        inputs: in_valid, in_kind, in_width, in_height, in_repeat_u, in_repeat_v, in_cell, in_poles, in_levels, in_value, out_ready;
        outputs: in_ready, out_valid, out_level, out_i, out_j, out_max, out_min, out_last, error;
        blocks: fold, poles, odd_levels, even_levels;
        state: state, failed, level, width, height, width_last, height_last, column, row, levels, repeat_u, repeat_v, cells, has_poles, in_upper, in_lower, last_column, last_row, above_map, width_second, height_second, lower_before, lower_none, width_above, height_above, folds, sides_fit, nodes_fit, measured, feed, feed_in, feed_out, feed_valid, feed_room, feed_free, sent_valid, sent_level, sent_i, sent_j, sent_max, sent_min, sent_last, spare_valid, spare_level, spare_i, spare_j, spare_max, spare_min, spare_last, area, fold, poles, odd_levels, even_levels
    }
}
