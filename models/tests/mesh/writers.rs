// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meshes as files of each format.

use std::fmt::Write;

use relief_models::mesh::{CheckOptions, Format, InputError, Mesh, Report, Source, check, read_from};

use crate::tilings::Tiling;

/// Reads bytes as a mesh.
pub fn parse(format: Format, bytes: &[u8], base: Option<(Format, &[u8])>) -> Result<Mesh, InputError> {
    let mut bytes = bytes;
    let source = Source { name: "mesh", format, size: 0, bytes: &mut bytes };
    match base {
        None => read_from(source, None, &()),
        Some((format, mut base)) => {
            let base = Source { name: "base", format, size: 0, bytes: &mut base };
            read_from(source, Some(base), &())
        }
    }
}

/// Reads and checks.
pub fn report(format: Format, bytes: &[u8], base: Option<(Format, &[u8])>) -> Result<Report, InputError> {
    parse(format, bytes, base).map(|mesh| check(&mesh, &CheckOptions::default(), &()))
}

fn fields(values: impl IntoIterator<Item = i64>) -> String {
    values.into_iter().map(|value| format!(" {value}")).collect()
}

pub fn text(tiling: &Tiling) -> String {
    let mut file = format!("# a tiling\nscale {}\n", tiling.scale);
    for (index, corners) in tiling.bases.iter().enumerate() {
        writeln!(file, "b {index}{}", fields(corners.as_flattened().iter().copied())).unwrap();
    }
    for (base, corners) in &tiling.triangles {
        writeln!(file, "t {base}{}", fields(corners.as_flattened().iter().copied())).unwrap();
    }
    file
}

/// Triangles in lattice units, with vertices of their own, in groups.
pub fn obj(tiling: &Tiling) -> String {
    let mut file = String::from("# a tiling\n");
    for (index, (base, corners)) in tiling.triangles.iter().enumerate() {
        for corner in corners {
            writeln!(file, "v{}", fields(*corner)).unwrap();
        }
        // Each of the ways in which a face may name its corners.
        let last = 3 * index + 3;
        match index % 3 {
            0 => writeln!(file, "g base_{base}\nf {} {} {}", last - 2, last - 1, last).unwrap(),
            1 => writeln!(file, "o base_{base}\nf -3//1 -2/7 -1/7/1 # relative").unwrap(),
            _ => {
                writeln!(file, "g base_{base} smooth\ns off\nf\t{}/1 {}/1  {}/1 \r", last - 2, last - 1, last).unwrap()
            }
        }
    }
    file
}

/// The base triangles in the same units.
pub fn base_obj(tiling: &Tiling) -> String {
    let mut file = String::new();
    for corners in &tiling.bases {
        for corner in corners {
            writeln!(file, "v{}", fields(corner.map(|value| value * tiling.scale))).unwrap();
        }
        file.push_str("f -3 -2 -1\n");
    }
    file
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ply {
    Ascii,
    Little,
    Big,
}

/// Triangles in lattice units with a face property `base`, and an element that nobody asked for.
pub fn ply(tiling: &Tiling, encoding: Ply) -> Vec<u8> {
    let count = tiling.triangles.len();
    let name = match encoding {
        Ply::Ascii => "ascii",
        Ply::Little => "binary_little_endian",
        Ply::Big => "binary_big_endian",
    };
    let mut file = format!(
        "ply\nformat {name} 1.0\ncomment a tiling\nelement note 1\nproperty list uchar char text\n\
         element vertex {}\nproperty double x\nproperty int y\nproperty double z\nproperty uchar red\n\
         element face {count}\nproperty list uchar uint vertex_indices\nproperty short base\nend_header\n",
        3 * count
    )
    .into_bytes();
    if encoding == Ply::Ascii {
        let mut body = String::from("2 104 105\n");
        for corner in tiling.triangles.iter().flat_map(|(_, corners)| corners) {
            writeln!(body, "{} {} {} 255", corner[0], corner[1], corner[2]).unwrap();
        }
        for (index, (base, _)) in tiling.triangles.iter().enumerate() {
            writeln!(body, "3 {} {} {} {base}", 3 * index, 3 * index + 1, 3 * index + 2).unwrap();
        }
        file.extend_from_slice(body.as_bytes());
        return file;
    }
    let mut push = |little: &[u8]| match encoding {
        Ply::Big => file.extend(little.iter().rev()),
        _ => file.extend_from_slice(little),
    };
    for byte in [2u8, b'h', b'i'] {
        push(&[byte]);
    }
    for [x, y, z] in tiling.triangles.iter().flat_map(|(_, corners)| corners) {
        push(&(*x as f64).to_le_bytes());
        push(&i32::try_from(*y).unwrap().to_le_bytes());
        push(&(*z as f64).to_le_bytes());
        push(&[255]);
    }
    for (index, (base, _)) in tiling.triangles.iter().enumerate() {
        push(&[3]);
        for corner in 0..3 {
            push(&(3 * index as u32 + corner).to_le_bytes());
        }
        push(&(*base as i16).to_le_bytes());
    }
    file
}
