// SPDX-License-Identifier: MIT OR Apache-2.0
//! What binds a block to its golden model. A new block implements [`Binding`] in the file of its name and joins
//! [`BLOCKS`]; everything else (scoreboard, co-simulation, command line, vectors) then works for it.

use crate::device::Device;
use relief_hdl::widths::{WIDTH_SETS, WidthSet};

/// Payload of one beat: the fields of the stream in port order, each padded to whole words, least significant first.
pub type Beat = Vec<u64>;

/// An output beat as the golden model expects it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expected {
    /// The payload.
    pub words: Beat,
    /// Ones where the payload means something; a vertex that no command sends does not.
    pub mask: Beat,
}

impl Expected {
    /// A beat of which every bit matters.
    pub fn whole(words: Beat) -> Self {
        let mask = vec![u64::MAX; words.len()];
        Self { words, mask }
    }
}

/// Takes input beats and tells the output beats that follow from each.
pub trait Model {
    /// Takes one beat and appends what it makes the block send.
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>);
}

/// A block, its golden model and its stimulus.
pub trait Binding: Sync {
    /// Name, which is the module's without `relief_`, and the file's in every room.
    fn name(&self) -> &'static str;
    /// One line.
    fn summary(&self) -> &'static str;
    /// Cycles from an input beat to the first output beat that follows from it.
    fn latency(&self) -> &'static str;
    /// Cycles between two beats.
    fn interval(&self) -> &'static str;
    /// Error bound against the exact result.
    fn error(&self) -> &'static str;
    /// Whether there is hardware at a width set; [`device`](Self::device) and the others are asked for no other.
    fn offered(&self, set: &WidthSet) -> bool {
        let _ = set;
        true
    }
    /// The hardware at a width set, reset and ready.
    fn device(&self, set: &WidthSet) -> Box<dyn Device>;
    /// The golden model at a width set.
    fn model(&self, set: &WidthSet) -> Box<dyn Model>;
    /// Random input beats, minimum and maximum values of every format among them; endless, and the same for a seed.
    fn random(&self, set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>>;
    /// What a line of a stimulus file holds, for its error messages.
    fn stimulus_format(&self) -> &'static str;
    /// The beat that the numbers of one stimulus line stand for.
    ///
    /// # Errors
    /// A sentence that says which number is wrong and what would be right.
    fn parse(&self, set: &WidthSet, numbers: &[i64]) -> Result<Beat, String>;
}

/// Every block, in the order of the pipeline.
pub const BLOCKS: &[&dyn Binding] = &[
    &crate::vertex_adder::VertexAdderBinding,
    &crate::strip_unit::StripUnitBinding,
    &crate::remesher::RemesherBinding,
    &crate::mip_build::MipBuildBinding,
    &crate::mip_fetch::MipFetchBinding,
    &crate::sat_build::SatBuildBinding,
    &crate::sat_fetch::SatFetchBinding,
    &crate::sat_fetch_parallel::SatFetchParallelBinding,
    &crate::sat_average::SatAverageBinding,
    &crate::bisector::BisectorBinding,
    &crate::reciprocal::ReciprocalBinding,
    &crate::rsqrt::RsqrtBinding,
    &crate::perspective_correct::PerspectiveCorrectBinding,
    &crate::filter_level::FilterLevelBinding,
    &crate::exact_footprint::ExactFootprintBinding,
    &crate::facing::FacingBinding,
    &crate::displace::DisplaceBinding,
    &crate::power::PowerBinding,
    &crate::face_normal::FaceNormalBinding,
    &crate::gradient_normal::GradientNormalBinding,
    &crate::light::LightBinding,
    &crate::vertex_transform::VertexTransformBinding,
    &crate::cull::CullBinding,
    &crate::clip::ClipBinding,
    &crate::displacement_pipeline::DisplacementPipelineBinding,
];

/// Every block with each of the width sets that it is offered at.
pub fn offers() -> impl Iterator<Item = (&'static dyn Binding, &'static WidthSet)> {
    BLOCKS.iter().flat_map(|block| offered_sets(*block).into_iter().map(|set| (*block, set)))
}

/// The width sets that a block is offered at, in their order.
pub fn offered_sets(block: &dyn Binding) -> Vec<&'static WidthSet> {
    WIDTH_SETS.iter().filter(|set| block.offered(set)).collect()
}

/// Refuses a width set that a block is not offered at.
///
/// # Errors
/// A sentence that names the sets that have it.
pub fn expect_offered(block: &dyn Binding, set: &WidthSet) -> Result<(), String> {
    if block.offered(set) {
        return Ok(());
    }
    let names: Vec<&str> = offered_sets(block).iter().map(|set| set.name).collect();
    let have = match &names[..] {
        [] => "no width set has it".to_owned(),
        [one] => format!("the width set {one} has it"),
        [all @ .., last] => format!("the width sets {} and {last} have it", all.join(", ")),
    };
    Err(format!("{} is not offered at {}; {have}", block.name(), set.name))
}

/// The block of a name.
pub fn find(name: &str) -> Option<&'static dyn Binding> {
    BLOCKS.iter().copied().find(|block| block.name() == name)
}

/// A small reproducible generator (SplitMix64, Steele et al. 2014): seeds travel in messages, so it never changes.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// A generator whose whole sequence follows from `seed`.
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }
    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// A number of `0..bound`.
    pub fn below(&mut self, bound: u64) -> u64 {
        ((u128::from(self.bits()) * u128::from(bound)) >> 64) as u64
    }
    /// True in `percent` of 100 calls.
    pub fn chance(&mut self, percent: u8) -> bool {
        self.below(100) < u64::from(percent)
    }
    /// A signed value of `bits` bits: one in sixteen is the minimum, the maximum, zero or minus one.
    pub fn signed(&mut self, bits: usize) -> i64 {
        let shift = 64 - bits as u32;
        match self.below(64) {
            0 => i64::MIN >> shift,
            1 => i64::MAX >> shift,
            2 => 0,
            3 => -1,
            _ => (self.bits() as i64) >> shift,
        }
    }
}

/// A beat of unsigned fields, each of one word: refuses a line of the wrong length, and a number that does not fit its
/// field. `fields` holds names and bits.
pub(crate) fn unsigned_fields(numbers: &[i64], fields: &[(&str, usize)]) -> Result<Beat, String> {
    if numbers.len() != fields.len() {
        return Err(format!("the line has {} numbers, and {} make a beat", numbers.len(), fields.len()));
    }
    for (at, (&number, (name, bits))) in numbers.iter().zip(fields).enumerate() {
        let most = (1i64 << bits) - 1;
        if !(0..=most).contains(&number) {
            return Err(format!("number {} ({name}) is {number}, which does not fit 0..={most}", at + 1));
        }
    }
    Ok(numbers.iter().map(|&number| number as u64).collect())
}

/// Packs signed lanes of `bits` bits into words, lane 0 lowest.
pub fn pack(lanes: &[i64], bits: usize) -> Beat {
    let mut words = vec![0; (lanes.len() * bits).div_ceil(64)];
    for (k, &lane) in lanes.iter().enumerate() {
        let (value, word, shift) = (lane as u64 & (u64::MAX >> (64 - bits)), k * bits / 64, k * bits % 64);
        words[word] |= value << shift;
        if shift + bits > 64 {
            words[word + 1] |= value >> (64 - shift);
        }
    }
    words
}

/// The signed lanes that [`pack`] packed.
pub fn unpack(words: &[u64], lanes: usize, bits: usize) -> Vec<i64> {
    (0..lanes)
        .map(|k| {
            let (word, shift) = (k * bits / 64, k * bits % 64);
            let mut value = words[word] >> shift;
            if shift + bits > 64 {
                value |= words[word + 1] << (64 - shift);
            }
            (value as i64) << (64 - bits) >> (64 - bits)
        })
        .collect()
}
