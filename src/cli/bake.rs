// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief bake`: prepares a height map for the hardware.

use std::io::{stderr, stdout};
use std::path::PathBuf;

use relief_models::bake::{self, Baked, Excess, Ground, Manifest, MapEntry, Tolerance};
use relief_models::bisector::{Lattice, MAX_SIDE};
use relief_models::map::{HeightMap, Wrap, levels, read_values};
use relief_models::mesh::Progress;
use relief_models::mip_build::{self, Centring, Extremum};
use relief_models::sat_build;
use relief_testbench::output::OutputFolder;

use super::{Meter, Outcome, Result, write_all};

/// Prepare a height map: split maps under a bound, saturated errors, pyramids, summed areas, normals
///
/// Writes a folder of pictures with a manifest, bake.json; docs/bake.md tells the format of each file. What is there of an
/// earlier run is replaced as a whole, and only when everything is done.
#[derive(clap::Args)]
pub struct Arguments {
    /// The map, a grey PNG of 2 x 2 to 4097 x 4097 samples, 16 bits or fewer
    map: PathBuf,
    /// What to prepare, separated by commas
    #[arg(long, value_enum, value_delimiter = ',', required = true)]
    what: Vec<What>,
    /// The bound of the split map, in units of the map: 20, 16.8 or 50/3
    #[arg(long, value_name = "E", allow_negative_numbers = true)]
    bound: Option<Tolerance>,
    /// How long to search for a smaller fitted mesh: quick, default, high, or a number of rounds
    #[arg(long, value_name = "EFFORT", default_value = "default", value_parser = effort)]
    effort: u32,
    /// Leave the heights of the split map as they are
    #[arg(long)]
    unfitted: bool,
    /// Samples of this value are void and are filled from round about
    #[arg(long, value_name = "VALUE", allow_negative_numbers = true)]
    void: Option<u16>,
    /// Units of the map between two samples, for the normals
    #[arg(long, value_name = "LENGTH", default_value = "1", value_parser = spacing, allow_negative_numbers = true)]
    spacing: f64,
    /// The folder
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum What {
    /// A bit a vertex of the lattice under a bound, with fitted heights
    Split,
    /// An error a vertex of the lattice, for every bound
    Errors,
    /// Maxima and minima of every level
    Mips,
    /// The summed-area table
    Sat,
    /// Three components a sample
    Normals,
}

/// Rounds of search of an effort.
pub fn effort(text: &str) -> std::result::Result<u32, String> {
    match text {
        "quick" => Ok(1),
        "default" => Ok(8),
        "high" => Ok(48),
        number => {
            number.parse().ok().filter(|rounds| *rounds <= 10_000).ok_or_else(|| {
                "quick (1 round), default (8), high (48), or a number from 0 to 10000 is expected".into()
            })
        }
    }
}

fn spacing(text: &str) -> std::result::Result<f64, String> {
    let sound = |spacing: &f64| (1e-6..=1e9).contains(spacing);
    text.parse().ok().filter(sound).ok_or_else(|| "a length from 0.000001 to 1000000000 is expected".into())
}

/// Bits of a sum: any rectangle of the largest map is exact.
const SUM_BITS: u32 = 41;

/// Reads, prepares, measures and writes.
pub fn run(arguments: &Arguments) -> Result {
    let wants = |what| arguments.what.contains(&what);
    let bound = match (wants(What::Split), arguments.bound) {
        (true, None) => {
            return Err("`--what split` needs a bound; for example --bound 16.8, in units of the map".into());
        }
        (false, Some(_)) => return Err("`--bound` is for `--what split`; errors serve every bound".into()),
        (_, bound) => bound,
    };
    let (map, entry) = read(arguments)?;
    let [width, height] = [map.width, map.height].map(|side| side as u32);
    let lattice = Lattice::of(width, height, false).ok_or("a map of 2 x 2 to 4097 x 4097 samples is expected")?;
    let folder = OutputFolder::open(&arguments.out)?;
    let meter = Meter::new();
    let prepared = prepare(arguments, (map, entry), lattice, bound, &meter);
    let Ok(baked) = prepared else {
        meter.finish();
        write_all(
            stderr(),
            "mismatch: the mesh does not keep its bound over the map; this is an error of the program\n",
        )?;
        return Ok(Outcome::Mismatch);
    };
    meter.phase("writing", 0);
    let written = baked.write(folder.path());
    meter.finish();
    written.map_err(|error| format!("{}: cannot be written: {error}", arguments.out.display()))?;
    folder.commit(bake::is_ours)?;
    write_all(stdout(), &table(arguments, &baked))?;
    Ok(Outcome::Agreed)
}

/// The map, its voids filled.
fn read(arguments: &Arguments) -> std::result::Result<(HeightMap, MapEntry), Box<dyn std::error::Error>> {
    let path = arguments.map.display();
    let (mut map, bits) = read_values(&arguments.map, MAX_SIDE)?;
    if bits < 16 {
        let most = (1u32 << bits) - 1;
        let warning =
            format!("{path}: has {bits} bits a sample, so heights are 0 to {most} in steps; 16-bit grey is smooth");
        write_all(stderr(), &format!("warning: {warning}\n"))?;
    }
    let mut filled = 0;
    if let Some(void) = arguments.void {
        let done = bake::fill(&mut map, void)
            .ok_or_else(|| format!("{path}: has no sample but voids, {void}; at least one height is expected"))?;
        filled = done.samples;
        let what =
            format!("{path}: {filled} samples are void ({void}), filled from their rim in {} rounds", done.rounds);
        write_all(stderr(), &format!("note: {what}\n"))?;
    }
    let name = arguments.map.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let (width, height, fnv1a) = (map.width, map.height, bake::hash(&map));
    Ok((map, MapEntry { name, width, height, bits, fnv1a, void: arguments.void, filled }))
}

/// Everything that is wanted; the error is a mesh that does not keep its bound.
fn prepare(
    arguments: &Arguments,
    (map, entry): (HeightMap, MapEntry),
    lattice: Lattice,
    bound: Option<Tolerance>,
    meter: &Meter,
) -> std::result::Result<Baked, Excess> {
    let wants = |what| arguments.what.contains(&what);
    let size = [map.width, map.height];
    let ground = Ground { lattice, samples: &map.samples };
    let manifest = Manifest {
        format: bake::FORMAT.into(),
        version: bake::VERSION,
        map: entry,
        levels: lattice.levels,
        mirrored: lattice.mirrored,
        split: None,
        errors: None,
        mips: None,
        sums: None,
        normals: None,
    };
    let (mut manifest, mut split, mut heights) = (manifest, None, None);
    if let Some(bound) = bound {
        let (flipped, bits, fitted) = if arguments.unfitted {
            meter.phase("splitting", 0);
            let heights = map.samples.iter().map(|&sample| u32::from(sample) << 4).collect();
            ([false; 2], bake::unfitted(&ground, bound), heights)
        } else {
            let (flipped, fit) = bake::fitted_from_best_corner(&map, &ground, bound, arguments.effort, meter);
            (flipped, fit.split, fit.heights)
        };
        meter.phase("measuring", 0);
        let samples = bake::flip(&map.samples, map.width, flipped);
        let measured = bake::measure(&Ground { samples: &samples, ..ground }, &bits, &fitted);
        if measured.missing != 0 || !measured.maximum.is_within(bound) {
            return Err(measured.maximum);
        }
        manifest.split = Some(bake::SplitEntry {
            bound: bound.to_string(),
            fitted: !arguments.unfitted,
            flipped,
            effort: (!arguments.unfitted).then_some(arguments.effort),
            triangles: measured.triangles,
            maximum: [measured.maximum.over, measured.maximum.under],
            maximum_decimal: measured.maximum.to_f64(),
        });
        (split, heights) = (Some(bits), Some(fitted));
    }
    let errors = wants(What::Errors).then(|| bake::saturated(&ground, meter));
    manifest.errors = errors.as_ref().map(|saturated| bake::ErrorsEntry {
        fraction_bits: saturated.fraction_bits,
        largest: saturated.errors.iter().copied().max().unwrap_or(0),
    });
    meter.phase("tables", 0);
    let wrap = [Wrap::Clamp; 2];
    let mips = wants(What::Mips).then(|| {
        let count = levels(size, wrap).len();
        [Extremum::Max, Extremum::Min].map(|extremum| {
            // A clamped map with samples has every pyramid.
            mip_build::golden(size[0], size[1], &map.samples, Centring::Node, wrap, extremum, count)
                .map_or_else(|_| Vec::new(), |pyramid| pyramid.levels)
        })
    });
    manifest.mips = mips.as_ref().map(|_| levels(size, wrap));
    let sums = wants(What::Sat).then(|| {
        let table = sat_build::golden(size[0], size[1], &map.samples, SUM_BITS);
        (0..=size[1]).flat_map(|y| (0..=size[0]).map(move |x| [x, y])).map(|[x, y]| table.at(x, y)).collect()
    });
    manifest.sums = wants(What::Sat).then_some(bake::SumsEntry { bits: SUM_BITS });
    let normals = wants(What::Normals).then(|| bake::normals(&map, arguments.spacing));
    manifest.normals = wants(What::Normals).then_some(bake::NormalsEntry { spacing: arguments.spacing });
    let errors = errors.map(|saturated| saturated.errors);
    Ok(Baked { manifest, lattice, map, split, heights, errors, mips, sums, normals })
}

fn table(arguments: &Arguments, baked: &Baked) -> String {
    let manifest = &baked.manifest;
    let mut rows =
        vec![("map", format!("{} x {} samples of {}", manifest.map.width, manifest.map.height, manifest.map.name))];
    if let Some(split) = &manifest.split {
        let how = split
            .effort
            .map_or("the map's heights".into(), |rounds| format!("fitted heights, {rounds} rounds of search"));
        rows.push(("triangles", format!("{} ({how})", split.triangles)));
        rows.push(("largest error", format!("{} (bound {})", split.maximum_decimal, split.bound)));
    }
    if let Some(errors) = &manifest.errors {
        let largest = f64::from(errors.largest) / f64::from(1u32 << errors.fraction_bits);
        rows.push(("errors", format!("up to {largest}, in units of 2^-{}", errors.fraction_bits)));
    }
    if let Some(sizes) = &manifest.mips {
        rows.push(("levels", format!("{} of maxima, {} of minima", sizes.len(), sizes.len())));
    }
    rows.push(("written to", arguments.out.display().to_string()));
    rows.into_iter().map(|(name, value)| format!("{name:14} {value}\n")).collect()
}
