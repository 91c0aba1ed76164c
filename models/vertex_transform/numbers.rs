// SPDX-License-Identifier: MIT OR Apache-2.0
//! The numbers under which the constants of a draw are handed over, one value each.
//!
//! | number   | value | format |
//! |----------|-------|--------|
//! | 0..=8    | rotation, row by row | SQ1.30 |
//! | 9        | focal length | UQ16.16 |
//! | 10       | 1 / cell | UQ8.24 |
//! | 11       | voxels an octave | UQ16.16 |
//! | 12..=21  | the components of normals of the volume's sides that are not always zero, [`NORMALS`] | SQ1.14 |
//! | 32..=34  | translation | 2^-60 of the draw's extent |
//! | 35       | z0 | 2^-44 of the draw's extent |
//! | 36       | grid bias, times 2^10 | voxels |
//! | 37..=42  | reach of the volume's sides | 2^-58 of the draw's extent |
//! | 43       | half of the grid's range, a power of two | voxels |

use super::Constants;
use crate::cull;

/// Side and axis of the components of normals that are constants: those that are not always zero.
pub const NORMALS: [[usize; 2]; 10] = [[0, 0], [0, 2], [1, 0], [1, 2], [2, 1], [2, 2], [3, 1], [3, 2], [4, 2], [5, 2]];

/// The number of the focal length.
pub const FOCAL: u64 = 9;

/// The constants before the first one has come.
pub const RESET: (Constants, cull::Constants) = (
    Constants {
        rotation: [[0; 3]; 3],
        translation: [0; 3],
        z0: 1 << 16,
        focal: 1 << 16,
        inverse_cell: 0,
        octave: 0,
        grid_bias: 0,
        coordinate_bits: 1,
    },
    cull::Constants { normal: [[0; 3]; 6], reach: [0; 6] },
);

/// The constants of a draw, each with its number, in ascending order.
pub fn values(constants: &Constants, volume: &cull::Constants) -> Vec<(u64, i64)> {
    let mut factors: Vec<i64> = constants.rotation.as_flattened().iter().copied().map(i64::from).collect();
    factors.extend([constants.focal, constants.inverse_cell, constants.octave].map(i64::from));
    factors.extend(NORMALS.map(|[side, axis]| i64::from(volume.normal[side][axis])));
    let mut terms = constants.translation.to_vec();
    terms.extend([constants.z0, i64::from(constants.grid_bias) << 10]);
    terms.extend(volume.reach);
    terms.push(1 << (constants.coordinate_bits - 1));
    (0..).zip(factors).chain((32..).zip(terms)).collect()
}

/// Takes the constant of a number; whether there is one.
pub fn write(constants: &mut Constants, volume: &mut cull::Constants, number: u64, value: i64) -> bool {
    match number as usize {
        k @ 0..9 => constants.rotation[k / 3][k % 3] = value as i32,
        9 => constants.focal = value as u32,
        10 => constants.inverse_cell = value as u32,
        11 => constants.octave = value as u32,
        k @ 12..22 => {
            let [side, axis] = NORMALS[k - 12];
            volume.normal[side][axis] = value as i32;
        }
        k @ 32..35 => constants.translation[k - 32] = value,
        35 => constants.z0 = value,
        36 => constants.grid_bias = (value >> 10) as i32,
        k @ 37..43 => volume.reach[k - 37] = value,
        43 => constants.coordinate_bits = value.max(1).ilog2() + 1,
        _ => return false,
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_come_back() {
        let normal = std::array::from_fn(|side| {
            std::array::from_fn(
                |axis| if NORMALS.contains(&[side, axis]) { -(7 * side as i32 + axis as i32) } else { 0 },
            )
        });
        let volume = cull::Constants { normal, reach: [1, -2, 3, -4, 1 << 61, -(1 << 61)] };
        let constants = Constants {
            rotation: [[1 << 30, -2, 3], [4, -(1 << 30), 6], [-7, 8, 9]],
            translation: [(1 << 61) - 1, -5, 6],
            z0: 1 << 45,
            focal: u32::MAX,
            inverse_cell: 12,
            octave: 13,
            grid_bias: i32::MIN,
            coordinate_bits: 14,
        };
        let (mut back, mut sides) = RESET;
        for (number, value) in values(&constants, &volume) {
            assert!(write(&mut back, &mut sides, number, value), "{number}");
        }
        assert_eq!((back, sides), (constants, volume));
        assert!((22..32).chain(44..128).all(|number| !write(&mut back, &mut sides, number, 1)));
        assert_eq!((back, sides), (constants, volume));
    }
}
