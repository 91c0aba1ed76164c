// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sub-triangles of a base triangle, and which edges bound them.

use super::place::Observer;
use super::port::Port;
use super::setup::{Case, Setup};
use super::strips::strips;
use super::walk::{Foot, Upper, Walker};
use super::{BaseTriangle, Format};

/// Sends the beats of `base` to `observer`, with the component loops unrolled for the format.
pub(super) fn run<O: Observer>(format: &Format, base: &BaseTriangle, setup: &Setup, observer: &mut O) {
    macro_rules! dispatch {
        ($($n:literal)*) => {
            match format.components {
                $($n => remesh::<$n, O>(format, base, setup, observer),)*
                // `validate` has refused every other number.
                _ => {}
            }
        };
    }
    dispatch!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16);
}

/// What is particular to a sub-triangle.
pub(super) struct Sub<const N: usize> {
    /// Number, 0 or 1.
    pub(super) index: u8,
    /// Winding, where it opens at a corner that the upper edge shares; `None` where it continues the one before.
    pub(super) start: Option<bool>,
    /// Column of its first vertex in the plane, `columns` of it to sweep.
    pub(super) first: i32,
    pub(super) columns: i32,
    /// The plane is swept from right to left (the second half of a roof).
    pub(super) from_right: bool,
    /// It ends in the point B rather than in a column.
    pub(super) to_point: bool,
    /// The base edge in place of its last column (amendment A3), from its lower end.
    pub(super) column_edge: Option<Walker<N>>,
    /// A strip follows it without a corner in between.
    pub(super) continues: bool,
    /// It is the base triangle's last.
    pub(super) finishes: bool,
}

/// The sub-triangles of a base triangle.
fn remesh<const N: usize, O: Observer>(format: &Format, base: &BaseTriangle, setup: &Setup, observer: &mut O) {
    let mut port = Port::<N, O>::new(format, &base.data, observer);
    let [a, b, c] = setup.roles;
    let [at_a, at_b, at_c] = setup.plane;
    let [k1, k2] = setup.columns.map(|k| k as i32);
    let walk = |from, to, at, target| Walker::<N>::new(&setup.edges, from, to, at, target);
    let lanes = |v: &crate::step::Vertex| -> [i64; N] { std::array::from_fn(|k| v[k]) };
    let mut foot = Foot {
        accumulator: std::array::from_fn(|k| base.data[a][k] << format.guard_bits),
        row: at_a[1],
        sweep_difference: lanes(&setup.sweep_difference),
        side_difference: lanes(&setup.side_difference),
    };
    let origin = foot.accumulator;
    let mut primary = walk(a, b, at_a, at_b);
    let roof = match setup.case {
        Case::Point => return port.point(),
        Case::Roof => true,
        Case::Increasing | Case::Decreasing => false,
    };
    if k1 > 0 {
        let sub = Sub {
            index: 0,
            start: Some(setup.swap),
            first: at_a[0],
            columns: k1,
            from_right: false,
            to_point: false,
            column_edge: (k2 == 0).then(|| walk(b, c, at_b, at_c)),
            continues: !roof && k2 > 0,
            finishes: k2 == 0,
        };
        let mut upper = Upper { walker: walk(a, c, at_a, at_c), then: None };
        strips(&mut port, setup, sub, &mut primary, &mut foot, &mut upper);
    }
    if k2 == 0 {
        return;
    }
    let mirrored = |[column, row]: [i32; 2]| [-column, row];
    let sub = Sub {
        index: 1,
        start: (roof || k1 == 0).then_some(setup.swap ^ roof),
        first: if roof { -at_b[0] } else { at_c[0] },
        columns: k2,
        from_right: roof,
        to_point: !roof,
        column_edge: (roof && k1 == 0).then(|| walk(a, c, mirrored(at_a), mirrored(at_c))),
        continues: false,
        finishes: true,
    };
    let mut upper;
    if roof {
        primary = walk(b, a, mirrored(at_b), mirrored(at_a));
        upper = Upper { walker: walk(b, c, mirrored(at_b), mirrored(at_c)), then: None };
        foot.accumulator = origin;
        // Both halves descend from A, or their interior vertices of C's column would differ (amendment A6).
        let [columns, rows] = [0, 1].map(|axis| i64::from(at_b[axis]) - i64::from(at_a[axis]));
        for ((sum, sweep), side) in
            foot.accumulator.iter_mut().zip(&mut foot.sweep_difference).zip(&foot.side_difference)
        {
            *sum = sum.wrapping_add(columns.wrapping_mul(*sweep)).wrapping_add(rows.wrapping_mul(*side));
            *sweep = sweep.wrapping_neg();
        }
        foot.row = at_b[1];
    } else {
        let onward = walk(c, b, at_c, at_b);
        upper = if k1 == 0 {
            Upper { walker: walk(a, c, at_a, at_c), then: Some(onward) }
        } else {
            Upper { walker: onward, then: None }
        };
    }
    strips(&mut port, setup, sub, &mut primary, &mut foot, &mut upper);
}
