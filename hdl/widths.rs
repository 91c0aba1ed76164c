// SPDX-License-Identifier: MIT OR Apache-2.0
//! The width sets that the hardware offers. rust-hdl fixes widths at compile time, so each set is a module of concrete
//! block types; a scene picks one by name. To add a set, add a line to the macro call at the end.

/// The widths of one set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WidthSet {
    /// Name, as `--param` takes it.
    pub name: &'static str,
    /// What it is for.
    pub summary: &'static str,
    /// Components of a vertex, L.
    pub components: usize,
    /// Bits of a component outside the remesher, V.
    pub vertex_bits: usize,
    /// Fraction bits of the accumulators, g.
    pub guard_bits: usize,
    /// Bits of a signed grid coordinate, N.
    pub coordinate_bits: usize,
    /// Vertices in the column memory.
    pub column_depth: usize,
    /// Sides of maps go up to 2^side_bits texels; a side is a number of one bit more, M.
    pub side_bits: usize,
    /// The memory of a map's levels has 2^texel_bits words in four banks.
    pub texel_bits: usize,
    /// The memory of a summed-area table has 2^table_bits sums; two copies of it stand in `sat_fetch_parallel`.
    pub table_bits: usize,
    /// Bits of a sum in a summed-area table, B.
    pub sum_bits: usize,
    /// The lattice of the bisector has up to 2^K steps a side: maps of up to 2^K + 1 columns and rows.
    pub lattice_bits: usize,
    /// Bits of an error at a lattice vertex, E; one is enough for a split map.
    pub error_bits: usize,
}

impl WidthSet {
    /// Bits of a side, M.
    pub const fn side_width(&self) -> usize {
        self.side_bits + 1
    }
    /// Words in each of the four banks, and nodes in the memory of the pyramid builder.
    pub const fn bank_words(&self) -> usize {
        1 << (self.texel_bits - 2)
    }
    /// Words in the memory of a summed-area table.
    pub const fn table_words(&self) -> usize {
        1 << self.table_bits
    }
    /// Bits of an area, twice those of a side.
    pub const fn area_bits(&self) -> usize {
        2 * self.side_width()
    }
    /// Bits of an accumulator, W = V + g + 1.
    pub const fn accumulator_bits(&self) -> usize {
        self.vertex_bits + self.guard_bits + 1
    }
    /// Whether a set has the same vertices and the same grid: what runs on one gives the same bits on the other.
    pub const fn has_vertices_of(&self, other: &Self) -> bool {
        self.components == other.components
            && self.vertex_bits == other.vertex_bits
            && self.guard_bits == other.guard_bits
            && self.coordinate_bits == other.coordinate_bits
            && self.column_depth == other.column_depth
    }
    /// Smallest and largest grid coordinate.
    pub const fn coordinates(&self) -> (i32, i32) {
        (-(1 << (self.coordinate_bits - 1)), (1 << (self.coordinate_bits - 1)) - 1)
    }
}

macro_rules! width_sets {
    ($d:tt; $($name:ident $text:literal $summary:literal: L $l:literal, V $v:literal, g $g:literal, N $n:literal, depth $depth:literal, K $k:literal, sides $m:literal, texels $t:literal, table $table:literal, B $b:literal, lattice $lattice:literal, E $e:literal;)*) => {
        $(
            #[doc = $summary]
            pub mod $name {
                /// The widths.
                pub const SET: super::WidthSet = super::WidthSet {
                    name: $text,
                    summary: $summary,
                    components: $l,
                    vertex_bits: $v,
                    guard_bits: $g,
                    coordinate_bits: $n,
                    column_depth: $depth,
                    side_bits: $m,
                    texel_bits: $t,
                    table_bits: $table,
                    sum_bits: $b,
                    lattice_bits: $lattice,
                    error_bits: $e,
                };
                /// Vertex adder of the accumulators.
                pub type VertexAdder = crate::vertex_adder::VertexAdder<$l, { $v + $g + 1 }>;
                /// Strip unit.
                pub type StripUnit = crate::strip_unit::StripUnit<$l, $v, $k>;
                /// Pyramid builder.
                pub type MipBuild = crate::mip_build::MipBuild<{ $m + 1 }, { $t - 2 }, { $t - 3 }>;
                /// Fetch from pyramids.
                pub type MipFetch = crate::mip_fetch::MipFetch<{ $m + 1 }, { $t - 2 }>;
                /// Builder of summed-area tables.
                pub type SatBuild = crate::sat_build::SatBuild<{ $m + 1 }, $m, $b>;
                /// Fetch from summed-area tables, four cycles a result.
                pub type SatFetch = crate::sat_fetch::SatFetch<{ $m + 1 }, { $m + 3 }, { 2 * $m + 2 }, $table, $b>;
                /// Fetch from summed-area tables, one result a cycle.
                pub type SatFetchParallel =
                    crate::sat_fetch_parallel::SatFetchParallel<{ $m + 1 }, { $m + 3 }, { 2 * $m + 2 }, $table, $b>;
                /// Bisector.
                pub type Bisector =
                    crate::bisector::Bisector<{ $lattice + 1 }, { $lattice + 2 }, { 2 * $lattice - 2 }, $e>;
                /// Mean of a rectangle.
                pub type SatAverage = crate::sat_average::SatAverage<$b, { 2 * $m + 2 }, { 2 * $m + 4 }>;
                /// Remesher.
                pub type Remesher = crate::remesher::Remesher<
                    $l, $v, { $v + $g + 1 }, { $v + $g + 3 }, $n, { $n + 3 }, { 2 * $n + 3 }, { $v + $g + $n + 4 }, $k,
                >;
                /// Exact footprint, of lanes and accumulators.
                pub type ExactFootprint =
                    crate::exact_footprint::ExactFootprint<$v, { $v + $g + 1 }, { 2 * $v + $g + 1 }>;
                /// The whole datapath, offered at sets of nine components.
                pub type DisplacementPipeline = crate::displacement_pipeline::DisplacementPipeline<
                    $v, { $v + $g + 1 }, { $v + $g + 3 }, $n, { $n + 3 }, { 2 * $n + 3 }, { $v + $g + $n + 4 }, $k,
                    { $m + 1 }, { $t - 2 },
                >;
            }
        )*

        /// All width sets, the default one first.
        pub const WIDTH_SETS: &[WidthSet] = &[$($name::SET),*];

        /// Evaluates `$body` with the module of the width set called `$chosen` in scope as `$widths`: `Some`, or `None`
        /// when there is no such set.
        #[macro_export]
        macro_rules! with_width_set {
            ($d chosen:expr, $d widths:ident => $d body:expr) => {
                match $d chosen {
                    $($text => {
                        use $d crate::widths::$name as $d widths;
                        Some($d body)
                    })*
                    _ => None,
                }
            };
        }
    };
}

// `default` and `small` fit the 208 block RAMs of an ECP5-85k, block by block; `relief synth` tells. Sums of 32 bits hold any
// of 2^14 texels, and stand in 32 RAMs of one bit: in the 36 that a DP16KD is wide, they would need multiplexers behind it.
// Equal numbers are one type, so `large` and `position` cost little to compile.
width_sets! { $;
    default "default" "Nine components of 32 bits: position, normal, texture coordinates, 1/w; viewports to 4,096":
        L 9, V 32, g 13, N 14, depth 4096, K 13, sides 9, texels 17, table 14, B 32, lattice 8, E 16;
    large "large" "The same with larger maps, which need a larger part than an ECP5-85k":
        L 9, V 32, g 13, N 14, depth 4096, K 13, sides 10, texels 19, table 19, B 40, lattice 9, E 16;
    position "position" "Three components: the remesher alone, on geometry":
        L 3, V 32, g 13, N 14, depth 4096, K 13, sides 9, texels 17, table 14, B 32, lattice 8, E 1;
    terrain "terrain" "Five components of 28 bits: base meshes with one normal and one density of texels, 640 x 480":
        L 5, V 28, g 6, N 12, depth 512, K 10, sides 9, texels 17, table 14, B 32, lattice 8, E 16;
    terrain_large "terrain_large" "The same with the maps of `large`":
        L 5, V 28, g 6, N 12, depth 512, K 10, sides 10, texels 19, table 19, B 40, lattice 9, E 16;
    small "small" "Nine components of 24 bits for 640 x 480":
        L 9, V 24, g 10, N 11, depth 512, K 10, sides 8, texels 16, table 13, B 32, lattice 8, E 8;
    deep "deep" "Thirteen components, depth ranges to 2^15 voxels":
        L 13, V 32, g 16, N 17, depth 4096, K 13, sides 12, texels 20, table 20, B 40, lattice 12, E 16;
}
