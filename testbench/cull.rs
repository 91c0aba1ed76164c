// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds culling to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, unsigned_fields};
use crate::device::Device;
use crate::stepped::Stepped;
use relief_hdl::cull::Cull;
use relief_hdl::widths::WidthSet;
use relief_models::cull::{Corner, Verdict, verdict};
use relief_models::vertex_transform::OutOfRange;

/// Culling, the same at every width set.
#[derive(Clone, Copy, Debug)]
pub struct CullBinding;

struct Golden;

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        let corner = |k: usize| {
            let failure = [None, Some(OutOfRange::Lane), Some(OutOfRange::Grid), None][beat[6 + k] as usize];
            Corner { outcode: beat[k] as u8, outside: beat[3 + k] as u8, failure }
        };
        expected.push(Expected::whole(match verdict([0, 1, 2].map(corner), beat[9] == 1) {
            Verdict::Kept => vec![0, 0],
            Verdict::Culled(reason) => vec![1, reason as u64],
            Verdict::Cut => vec![2, 0],
            Verdict::Dropped(OutOfRange::Lane) => vec![3, 1],
            Verdict::Dropped(OutOfRange::Grid) => vec![3, 2],
        }));
    }
}

/// The beat of a base triangle's corners.
pub(crate) fn corners_beat(corners: [Corner; 3], culls: bool) -> Beat {
    let status = |corner: &Corner| match corner.failure {
        _ if corner.outside & 1 == 1 => 3,
        None => 0,
        Some(OutOfRange::Lane) => 1,
        Some(OutOfRange::Grid) => 2,
    };
    let of = |field: fn(&Corner) -> u64| corners.each_ref().map(field);
    let (outcodes, outside) = (of(|corner| corner.outcode.into()), of(|corner| corner.outside.into()));
    [&outcodes[..], &outside, &corners.each_ref().map(status), &[culls.into()]].concat()
}

/// Often one bit in common, few planes and few failures: otherwise everything would be cut.
fn draw(random: &mut Random) -> Beat {
    let common = if random.chance(40) { 1 << random.below(6) } else { 0 };
    let outcode: [u64; 3] = std::array::from_fn(|_| common | (random.bits() & random.bits() & random.bits() & 63));
    let cut = random.chance(30);
    let outside: [u64; 3] = std::array::from_fn(|_| if cut { random.bits() & random.bits() & 31 } else { 0 });
    // Behind z0 is a plane and a status.
    let status = outside.map(|planes| if planes & 1 == 1 { 3 } else { [0, 0, 0, 1, 2][random.below(5) as usize] });
    [&outcode[..], &outside, &status, &[u64::from(random.chance(80))]].concat()
}

impl Binding for CullBinding {
    fn name(&self) -> &'static str {
        "cull"
    }
    fn summary(&self) -> &'static str {
        "whether a base triangle is culled, has to be cut, is dropped, or goes on"
    }
    fn latency(&self) -> &'static str {
        "3"
    }
    fn interval(&self) -> &'static str {
        "1"
    }
    fn error(&self) -> &'static str {
        "0; never culls what is visible"
    }
    fn device(&self, _set: &WidthSet) -> Box<dyn Device> {
        Box::new(Stepped::new(Cull::default()))
    }
    fn model(&self, _set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden)
    }
    fn random(&self, _set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        let mut random = Random::new(seed);
        Box::new(std::iter::repeat_with(move || draw(&mut random)))
    }
    fn stimulus_format(&self) -> &'static str {
        "outcodes, outside and status of three corners each; 1 if the draw culls"
    }
    fn parse(&self, _set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        let mut fields = vec![("outcode", 6); 3];
        fields.extend([("outside", 5); 3]);
        fields.extend([("status", 2); 3]);
        fields.push(("culls", 1));
        let beat = unsigned_fields(numbers, &fields)?;
        match (0..3).find(|k| (beat[6 + k] == 3) != (beat[3 + k] & 1 == 1)) {
            Some(k) => {
                Err(format!("corner {k} is behind z0 by its status or by bit 0 of its outside, but not by both"))
            }
            None => Ok(beat),
        }
    }
}
