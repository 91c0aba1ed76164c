// SPDX-License-Identifier: MIT OR Apache-2.0
//! Height maps: every kind of PNG gives its samples or a sentence, and the formulas give what they say.

use image::{DynamicImage, ImageFormat};
use proptest::prelude::*;
use relief_models::map::{HeightMap, Limit, Procedural, Wrap, bank_words, levels, read, read_from};
use relief_models::mip_build::{Centring, Extremum, golden};
use relief_models::rules::Pyramids;

fn png(image: impl Into<DynamicImage>) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.into().write_to(&mut bytes, ImageFormat::Png).unwrap();
    bytes.into_inner()
}

fn grey16(width: u32, height: u32) -> Vec<u8> {
    png(image::ImageBuffer::from_fn(width, height, |i, j| image::Luma([(i * 4099 + j * 257) as u16])))
}

fn refusal(bytes: &[u8]) -> String {
    read_from(bytes, "map.png", &fits).unwrap_err().to_string()
}

/// Whether the default memory holds a map that is clamped.
fn fits(size: [usize; 2]) -> Result<(), String> {
    Limit::LARGEST.check(size, [Wrap::Clamp; 2], usize::MAX, false)
}

#[test]
fn map_16_bit_grey_is_taken_as_it_is() {
    let (map, warning) = read_from(&grey16(5, 3), "map.png", &fits).unwrap();
    assert_eq!((map.width, map.height, warning), (5, 3, None));
    assert_eq!(map.samples.len(), 15);
    assert_eq!([map.sample(0, 0), map.sample(4, 0), map.sample(1, 2)], [0, 4 * 4099, 4099 + 2 * 257]);
    assert_eq!(read_from(&grey16(1, 1), "map.png", &fits).unwrap().0.samples, [0]);
}

#[test]
fn map_8_bit_grey_is_scaled_with_a_warning() {
    let bytes = png(image::GrayImage::from_vec(2, 2, vec![0, 1, 128, 255]).unwrap());
    let (map, warning) = read_from(&bytes, "map.png", &fits).unwrap();
    assert_eq!(map.samples, [0, 257, 128 * 257, 65535]);
    let expected = "has 8 bits a sample, so 256 heights with steps of 257 in 65535; 16-bit grey is smooth";
    assert_eq!(warning.as_deref(), Some(expected));
}

#[test]
fn map_refuses_what_is_no_map() {
    let colour = "is a colour picture; a height map is 16-bit grey without alpha";
    assert_eq!(refusal(&png(image::RgbImage::new(2, 2))), format!("map.png: {colour}"));
    assert_eq!(refusal(&png(image::RgbaImage::new(2, 2))), format!("map.png: {colour}"));
    let alpha = "map.png: is grey with an alpha channel; a height map is 16-bit grey without alpha";
    assert_eq!(refusal(&png(image::GrayAlphaImage::new(2, 2))), alpha);
    let none = "map.png: is no PNG (its first bytes say so); a 16-bit grey PNG is expected";
    assert_eq!(refusal(b""), none);
    assert_eq!(refusal(b"P5 2 2 255 abcd and more than a header of it"), none);
    let mut empty = grey16(1, 1);
    empty[16..24].fill(0);
    assert_eq!(refusal(&empty), "map.png: is a map of 0 x 0 samples; at least 1 x 1 is expected");
    let limit = "map.png: is a map of 1025 x 512 samples and takes 175794 words in each of the four banks of the map memory, \
                 with its levels, beyond the limit of 131072; a smaller map is expected";
    assert_eq!(refusal(&grey16(1025, 512)), limit);
    let side =
        "map.png: is a map of 1 x 2048 samples and has a side beyond the limit of 2047; a smaller map is expected";
    assert_eq!(refusal(&grey16(1, 2048)), side);
    // A header that promises 2^62 samples costs nothing.
    let mut vast = grey16(1, 1);
    vast[16..24].fill(0x7F);
    assert!(refusal(&vast).contains("beyond the limit of 2047"), "{}", refusal(&vast));
}

#[test]
fn map_files_that_are_none() {
    let folder = tempfile::tempdir().unwrap();
    let missing = read(&folder.path().join("none.png"), &fits).unwrap_err();
    assert!(missing.message.starts_with("cannot be opened: "), "{missing}");
    assert_eq!(read(folder.path(), &fits).unwrap_err().message, "is a folder; a PNG file is expected");
    let path = folder.path().join("map.png");
    std::fs::write(&path, grey16(3, 3)).unwrap();
    assert_eq!(read(&path, &fits).unwrap().0.samples.len(), 9);
}

#[test]
fn map_formulas_at_any_size() {
    for kind in Procedural::ALL {
        for (width, height) in [(1, 1), (1, 7), (6, 1), (2, 2), (65, 33)] {
            let map = HeightMap::procedural(kind, width, height);
            assert_eq!((map.width, map.height, map.samples.len()), (width, height, width * height));
        }
        // Every formula but the board's uses the range, and none leaves it: saturation would show as a plateau.
        let map = HeightMap::procedural(kind, 257, 257);
        let (low, high) = (map.samples.iter().min().unwrap(), map.samples.iter().max().unwrap());
        assert!(*low < 100 && *high > 65400, "{kind:?}: {low} to {high}");
    }
    let peaks = HeightMap::procedural(Procedural::Peaks, 601, 601);
    assert_eq!(peaks.samples.iter().filter(|sample| matches!(sample, 0 | 65535)).count(), 0);
    let donut = HeightMap::procedural(Procedural::HalfDonut, 101, 101);
    assert_eq!([donut.sample(50, 50), donut.sample(80, 50), donut.sample(50, 20)], [0, 65535, 65535]);
    let board = HeightMap::procedural(Procedural::Checkerboard, 16, 16);
    assert_eq!([board.sample(1, 1), board.sample(2, 1), board.sample(2, 2)], [0, 65535, 0]);
    let cubic = HeightMap::procedural(Procedural::Cubic, 65, 65);
    assert!([[0, 0], [32, 32], [64, 0], [64, 64]].iter().all(|[i, j]| cubic.sample(*i, *j) == 32768));
    let dents = HeightMap::procedural(Procedural::Dents, 129, 129);
    assert_eq!([dents.sample(8, 8), dents.sample(16, 8), dents.sample(16, 16)], [0, 65535, 65535]);
    let peak = HeightMap::procedural(Procedural::Peak, 65, 33);
    assert_eq!((peak.sample(21, 11), peak.samples.iter().filter(|sample| **sample != 0).count()), (65535, 1));
    let waves = HeightMap::procedural(Procedural::Waves, 65, 5);
    assert!((0..9).all(|period| waves.sample(8 * period, 3) == 65535) && waves.sample(4, 0) == 0);
}

#[test]
fn map_cosine_is_periodic_and_constant_at_the_poles() {
    let map = HeightMap::procedural(Procedural::Cosine, 64, 33);
    for i in 0..64 {
        assert_eq!([map.sample(i, 0), map.sample(i, 32)], [32768, 32768]);
        // Eight periods in u, so the last column goes on with the first.
        assert!(map.sample(i, 8).abs_diff(map.sample((i + 8) % 64, 8)) <= 1);
    }
}

#[test]
fn map_formulas_have_these_bits_on_every_machine() {
    // FNV-1a over the samples: a platform's own sine would show here.
    let hash = |kind| {
        let map = HeightMap::procedural(kind, 61, 47);
        map.samples
            .iter()
            .fold(0xcbf2_9ce4_8422_2325u64, |hash, sample| (hash ^ u64::from(*sample)).wrapping_mul(0x0100_0000_01b3))
    };
    assert_eq!(Procedural::ALL.map(hash), FORMULA_HASHES);
}

const FORMULA_HASHES: [u64; 11] = [
    835349038433157863,
    3612065402848300647,
    466177306817342212,
    16846932114398764606,
    3143752065467054172,
    15525821467232479766,
    13376903685784047592,
    5545733903347877236,
    7932724087465426686,
    9896121419454550737,
    11077361696851008516,
];

#[test]
fn map_levels_and_words() {
    use Wrap::{Clamp, Repeat};
    assert_eq!(levels([1, 1], [Clamp, Clamp]), [[1, 1]]);
    assert_eq!(levels([5, 4], [Clamp, Clamp]), [[5, 4], [3, 3], [2, 2]]);
    // A period of 6 cannot be halved twice.
    assert_eq!(levels([12, 9], [Repeat, Clamp]), [[12, 9], [6, 5]]);
    // Two samples of a clamp axis stay two.
    assert_eq!(levels([2, 2], [Clamp, Clamp]), [[2, 2]]);
    for (size, wrap) in [([403, 344], [Clamp, Clamp]), ([512, 257], [Repeat, Clamp]), ([7, 1], [Clamp, Clamp])] {
        let (samples, count) = (vec![0; size[0] * size[1]], levels(size, wrap).len());
        let both = [Extremum::Max, Extremum::Min]
            .map(|extremum| golden(size[0], size[1], &samples, Centring::Node, wrap, extremum, count).unwrap());
        assert_eq!(bank_words(size, wrap, usize::MAX, false), both[0].bank_words() as u64, "{size:?}");
        assert_eq!(bank_words(size, wrap, usize::MAX, true), Pyramids::from(&both).bank_words() as u64, "{size:?}");
    }
    assert!(
        bank_words([625, 625], [Clamp, Clamp], usize::MAX, false) <= 131_072
            && bank_words([626, 626], [Clamp, Clamp], usize::MAX, false) > 131_072
    );
    // What fits the memory fits the builder's, too, which holds level 1.
    for (width, height) in (1..200).flat_map(|w| [(w * 10, 1), (w * 10, 2_621_440 / (w * 200)), (w, w * 10), (w, w)]) {
        for wrap in [[Clamp, Clamp], [Repeat, Clamp], [Repeat, Repeat]] {
            if Limit::LARGEST.check([width, height], wrap, usize::MAX, false).is_ok()
                && let Some([w, h]) = levels([width, height], wrap).get(1)
            {
                assert!(w * h <= 131_072, "{width} x {height}");
            }
        }
    }
}

/// At most 64 samples.
fn small([width, height]: [usize; 2]) -> Result<(), String> {
    if width.saturating_mul(height) <= 64 { Ok(()) } else { Err("is too large for a test".into()) }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn map_reader_survives_any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..200), good_head in 0usize..40) {
        let good = grey16(3, 2);
        for head in [&[][..], &good[..good_head.min(good.len())]] {
            if let Err(error) = read_from(&[head, &bytes].concat(), "map.png", &small) {
                prop_assert!(error.message.len() > 20, "{}", error);
            }
        }
    }

    #[test]
    fn map_reader_survives_damaged_files(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0u8..4), 1..5),
    ) {
        let mut bytes = grey16(9, 7);
        for (index, byte, how) in changes {
            let place = index.index(bytes.len().max(1));
            match how {
                _ if bytes.is_empty() => {}
                0 => bytes[place] = byte,
                1 => bytes.insert(place, byte),
                2 => drop(bytes.remove(place)),
                _ => bytes.truncate(place),
            }
        }
        match read_from(&bytes, "map.png", &small) {
            Ok((map, _)) => prop_assert_eq!(map.samples.len(), map.width * map.height),
            Err(error) => prop_assert!(error.message.len() > 20, "{}", error),
        }
    }

    #[test]
    fn map_reader_refuses_every_truncation(length in any::<prop::sample::Index>()) {
        let bytes = grey16(9, 7);
        let whole = read_from(&bytes, "map.png", &small).unwrap().0;
        match read_from(&bytes[..length.index(bytes.len())], "map.png", &small) {
            // Only what follows the samples may be missing.
            Ok((map, _)) => prop_assert_eq!(map, whole),
            Err(error) => prop_assert!(error.message.contains("expected"), "{}", error),
        }
    }
}

#[test]
fn map_unrolled_ends_as_it_begins() {
    let map = HeightMap { width: 3, height: 2, samples: vec![1, 2, 3, 4, 5, 6] };
    let rows =
        |wrap| map.unrolled(wrap).samples.chunks(map.unrolled(wrap).width).map(<[u16]>::to_vec).collect::<Vec<_>>();
    assert_eq!(map.unrolled([Wrap::Clamp; 2]), map);
    assert_eq!(rows([Wrap::Repeat, Wrap::Clamp]), [[1, 2, 3, 1], [4, 5, 6, 4]]);
    assert_eq!(rows([Wrap::Repeat; 2]), [[1, 2, 3, 1], [4, 5, 6, 4], [1, 2, 3, 1]]);
    assert_eq!(map.with_poles().samples, [3, 3, 3, 6, 6, 6]);
}
