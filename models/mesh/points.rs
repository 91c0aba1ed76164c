// SPDX-License-Identifier: MIT OR Apache-2.0
//! The vertices of a mesh on one lattice: exact differences, and coordinates as the file wrote them.
//!
//! Vertices are put on the coarsest lattice that holds them all: `1/S` for the text format, a power of ten for decimals,
//! a power of two for binary floats. Where every lattice coordinate is below 2^61 they are stored as `i64`: a
//! difference is then below 2^62, a product of two below 2^124 and a cross product below 2^125, so the whole normal of
//! a triangle is computed in `i128` without a check. Float files with rounding noise (1e-17 beside 1.0) do not fit:
//! they stay as mantissa and exponent, and differences are formed in [`Int`], slower and no less exact.

use super::exact::{Distance, Int, Radix, Scaled, Vector, cross};

/// Narrow coordinates are below this in magnitude.
pub(super) const NARROW_LIMIT: i64 = 1 << 61;

/// The lengths that one lattice step stands for.
#[derive(Clone, Copy, Debug)]
pub(super) enum Unit {
    /// `1 / (scale * refinement)`; the text format prints `coordinate / refinement` over `scale`.
    Fraction { scale: u64, refinement: u64 },
    /// `radix^exponent`.
    Power { radix: Radix, exponent: i16 },
}

#[derive(Debug)]
enum Store {
    Narrow(Vec<[i64; 3]>),
    /// `powers[i]` is `radix^i`; `lowest` is the exponent of the lattice step.
    Wide {
        values: Vec<[Scaled; 3]>,
        radix: Radix,
        lowest: i16,
        powers: Vec<Int>,
    },
}

/// The vertices of a mesh.
#[derive(Debug)]
pub(super) struct Points {
    store: Store,
    unit: Unit,
}

impl Points {
    /// Vertices that are on the lattice already; the caller has kept them below [`NARROW_LIMIT`].
    pub(super) fn from_lattice(vertices: Vec<[i64; 3]>, unit: Unit) -> Points {
        Points { store: Store::Narrow(vertices), unit }
    }

    /// Finds the lattice of `values`, and the narrow storage if it is wide enough.
    pub(super) fn from_scaled(values: Vec<[Scaled; 3]>, radix: Radix) -> Points {
        let exponents = || values.iter().flatten().filter(|number| number.mantissa != 0).map(|number| number.exponent);
        let (lowest, highest) = (exponents().min().unwrap_or(0), exponents().max().unwrap_or(0));
        let unit = Unit::Power { radix, exponent: lowest };
        let span = usize::from(highest.abs_diff(lowest));
        let factors: Vec<i64> = (0..=span as u32).map_while(|exponent| (radix as i64).checked_pow(exponent)).collect();
        let narrow = |number: &Scaled| {
            let shift = if number.mantissa == 0 { 0 } else { usize::from(number.exponent.abs_diff(lowest)) };
            number.mantissa.checked_mul(*factors.get(shift)?).filter(|value| value.abs() < NARROW_LIMIT)
        };
        let all: Option<Vec<[i64; 3]>> =
            values.iter().map(|[x, y, z]| Some([narrow(x)?, narrow(y)?, narrow(z)?])).collect();
        let store = match all {
            Some(vertices) => Store::Narrow(vertices),
            None => {
                let powers = (0..=span as u32).map(|exponent| Int::power(radix as u32, exponent)).collect();
                Store::Wide { values, radix, lowest, powers }
            }
        };
        Points { store, unit }
    }

    pub(super) fn len(&self) -> usize {
        match &self.store {
            Store::Narrow(vertices) => vertices.len(),
            Store::Wide { values, .. } => values.len(),
        }
    }

    fn lattice(&self, vertex: u32) -> Vector {
        match &self.store {
            Store::Narrow(vertices) => vertices[vertex as usize].map(Int::from),
            Store::Wide { values, lowest, powers, .. } => values[vertex as usize].map(|number| match number.mantissa {
                0 => Int::ZERO,
                mantissa => &Int::from(mantissa) * &powers[usize::from(number.exponent.abs_diff(*lowest))],
            }),
        }
    }

    /// `to - from`, in lattice steps.
    #[inline]
    pub(super) fn difference(&self, from: u32, to: u32) -> Vector {
        if let Store::Narrow(vertices) = &self.store {
            let (a, b) = (&vertices[from as usize], &vertices[to as usize]);
            return [Int::from(b[0] - a[0]), Int::from(b[1] - a[1]), Int::from(b[2] - a[2])];
        }
        let (a, b) = (self.lattice(from), self.lattice(to));
        [&b[0] - &a[0], &b[1] - &a[1], &b[2] - &a[2]]
    }

    /// `(b - a) x (c - a)`: the normal of a triangle, twice as long as its area.
    #[inline]
    pub(super) fn normal(&self, [a, b, c]: [u32; 3]) -> Vector {
        if let Store::Narrow(vertices) = &self.store {
            let (a, b, c) = (&vertices[a as usize], &vertices[b as usize], &vertices[c as usize]);
            let (u, v) = ([b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]);
            // |u|, |v| < 2^62, see the head of the file.
            let component =
                |i: usize, j: usize| i128::from(u[i]) * i128::from(v[j]) - i128::from(u[j]) * i128::from(v[i]);
            return [component(1, 2), component(2, 0), component(0, 1)].map(Int::Small);
        }
        cross(&self.difference(a, b), &self.difference(a, c))
    }

    /// Whether `vertex` is inside the segment and not at its ends.
    pub(super) fn is_strictly_inside(&self, vertex: u32, [a, b]: [u32; 2]) -> bool {
        // Dropping what is outside the box of the segment is exact, and cheap where the storage is narrow.
        if let Store::Narrow(vertices) = &self.store {
            let (p, a, b) = (&vertices[vertex as usize], &vertices[a as usize], &vertices[b as usize]);
            if (0..3).any(|k| p[k] < a[k].min(b[k]) || p[k] > a[k].max(b[k])) {
                return false;
            }
        }
        if vertex == a || vertex == b {
            return false;
        }
        let (along, offset) = (self.difference(a, b), self.difference(a, vertex));
        if !super::exact::is_zero(&cross(&along, &offset)) {
            return false;
        }
        let (position, length) = (super::exact::dot(&offset, &along), super::exact::dot(&along, &along));
        position > Int::ZERO && position < length
    }

    /// A length of the object in lattice steps.
    pub(super) fn in_steps(&self, numerator: u64, denominator: u64) -> Distance {
        let (numerator, denominator) = (Int::from(numerator), Int::from(denominator));
        match self.unit {
            Unit::Fraction { scale, refinement } => {
                Distance { numerator: &(&numerator * &Int::from(scale)) * &Int::from(refinement), denominator }
            }
            Unit::Power { radix, exponent } => {
                let power = Int::power(radix as u32, exponent.unsigned_abs().into());
                if exponent < 0 {
                    Distance { numerator: &numerator * &power, denominator }
                } else {
                    Distance { numerator, denominator: &denominator * &power }
                }
            }
        }
    }

    fn scaled(&self, value: i64) -> Scaled {
        match self.unit {
            Unit::Fraction { .. } => Scaled::from_integer(value, Radix::Ten),
            Unit::Power { radix, exponent } => {
                let number = Scaled::from_integer(value, radix);
                Scaled { exponent: if value == 0 { 0 } else { number.exponent + exponent }, ..number }
            }
        }
    }

    /// Coordinates in one unit for all vertices, to a few roundings of a double. For searching, never for deciding.
    pub(super) fn approximate(&self, vertex: u32) -> [f64; 3] {
        match &self.store {
            Store::Narrow(vertices) => vertices[vertex as usize].map(|value| value as f64),
            Store::Wide { values, radix, .. } => values[vertex as usize].map(|number| number.approximate(*radix)),
        }
    }

    /// A vertex for a person, in the digits that can be searched for in the file.
    pub(super) fn display(&self, vertex: u32) -> String {
        let list = |fields: [String; 3]| format!("({})", fields.join(" "));
        match (&self.store, self.unit) {
            (Store::Narrow(vertices), Unit::Fraction { scale, refinement }) => {
                let (coordinates, refinement) = (vertices[vertex as usize], refinement as i64);
                if coordinates.iter().any(|value| value % refinement != 0) {
                    return list(
                        coordinates.map(|value| format!("{}", value as f64 / scale as f64 / refinement as f64)),
                    );
                }
                let text = list(coordinates.map(|value| (value / refinement).to_string()));
                if scale == 1 { text } else { format!("{text}/{scale}") }
            }
            (Store::Narrow(vertices), Unit::Power { radix, .. }) => {
                list(vertices[vertex as usize].map(|value| self.scaled(value).display(radix)))
            }
            (Store::Wide { values, radix, .. }, _) => {
                list(values[vertex as usize].map(|number| number.display(*radix)))
            }
        }
    }
}
