// SPDX-License-Identifier: MIT OR Apache-2.0
//! The side walk: the strips of a sub-triangle, each the ladder between two columns of the remeshing plane.

use super::place::{Observer, Place};
use super::port::Port;
use super::setup::Setup;
use super::sweep::Sub;
use super::walk::{Foot, Upper, Walker, add};

/// Sweeps one sub-triangle: its strips, from the primary edge's walker and the foot to the upper edge.
pub(super) fn strips<const N: usize, O: Observer>(
    port: &mut Port<'_, N, O>,
    setup: &Setup,
    sub: Sub<N>,
    primary: &mut Walker<N>,
    foot: &mut Foot<N>,
    upper: &mut Upper<N>,
) {
    let place = |column: i32, row: i32| Place::Interior {
        sweep: if sub.from_right != setup.mirror_sweep { -column } else { column },
        side: if setup.mirror_side { -row } else { row },
    };
    if sub.start.is_some() {
        upper.advance();
    }
    let side_difference = foot.side_difference;
    for strip in 0..sub.columns {
        let last_strip = strip == sub.columns - 1;
        let again = !last_strip || sub.continues;
        let closes = last_strip && sub.finishes;
        let to_point = last_strip && sub.to_point;
        let mut column_edge = if last_strip { sub.column_edge } else { None };
        let (left_column, right_column) = (sub.first + strip, sub.first + strip + 1);
        if O::WATCHES {
            (port.rung.sub, port.rung.strip) = (sub.index, strip as u32);
        }
        port.watch(&upper.walker);

        let below = *primary;
        let (mut left_cursor, mut left_row) = (foot.accumulator, primary.row());
        primary.advance();
        let mut right_row = primary.row();
        foot.advance(right_row);
        let mut right_cursor = foot.accumulator;
        let mut on_edge = false;
        match sub.start {
            Some(swap) if strip == 0 => {
                on_edge = true;
                port.start(swap, &below, primary);
            }
            _ => port.init(below.place(), primary),
        }
        if let Some(walker) = &mut column_edge {
            walker.advance();
        }

        loop {
            port.watch(&upper.walker);
            let left_ends = on_edge || left_row + 1 >= upper.walker.row();
            let stored = port.left_stored();
            if to_point {
                // A vertex of AC before C cannot be next here: it takes an AC of two segments in a strip that is both
                // first and last, and then AC or BC would be longer than AB and the primary edge instead.
                if left_ends {
                    return fan(port, upper, closes);
                }
                add(&mut left_cursor, &side_difference);
                left_row += 1;
                port.left_interior(&left_cursor, place(left_column, left_row));
                port.step(false);
                continue;
            }
            // Whether the right side may move to an interior (or column edge) vertex; else only the upper edge is left.
            let inside = |upper: &Upper<N>, right_row: i32, column_edge: &Option<Walker<N>>| match column_edge {
                Some(walker) => !walker.at_end(),
                // `>=`: the edge's row may be the primary edge's own (amendments A1, A3).
                None => right_row + 1 < upper.walker.row(),
            };
            let finished = |upper: &Upper<N>| upper.column(sub.first, sub.columns) > strip;

            let mut fin = finished(upper);
            let mut move_right = fin || (left_row > right_row && inside(upper, right_row, &column_edge));
            if !move_right {
                move_right = left_row == right_row;
                if left_ends {
                    port.left_edge(&upper.walker);
                    left_row = upper.walker.row();
                    on_edge = true;
                    upper.advance();
                    fin = finished(upper);
                } else {
                    add(&mut left_cursor, &side_difference);
                    left_row += 1;
                    port.left_interior(&left_cursor, place(left_column, left_row));
                }
            }
            let mut done = false;
            if move_right {
                if inside(upper, right_row, &column_edge) {
                    if let Some(walker) = &mut column_edge {
                        port.right_column(walker);
                        // Were the row left where it is, the whole edge would fan about one left vertex: a tiling of
                        // slivers that gape as soon as they are displaced.
                        right_row = walker.row();
                        walker.advance();
                    } else {
                        add(&mut right_cursor, &side_difference);
                        right_row += 1;
                        port.right_interior(&right_cursor, place(right_column, right_row), stored, again);
                    }
                } else if fin {
                    port.right_edge(&upper.walker);
                    done = true;
                }
            }
            port.step(done && closes);
            if done {
                break;
            }
        }
    }
}

/// Closes the strip that ends in the point B: the upper edge's vertices of the last column lie on a line with B, so they
/// fan about the last left vertex below the edge (amendment A4).
fn fan<const N: usize, O: Observer>(port: &mut Port<'_, N, O>, upper: &mut Upper<N>, closes: bool) {
    port.fan(&upper.walker);
    loop {
        upper.advance();
        port.watch(&upper.walker);
        port.left_edge(&upper.walker);
        let done = upper.then.is_none() && upper.walker.at_end();
        port.step(done && closes);
        if done {
            return;
        }
    }
}
