// SPDX-License-Identifier: MIT OR Apache-2.0
//! Files of many blocks, and the time that ten million triangles take.

use std::io::{BufWriter, Write};
use std::path::Path;
use std::sync::Mutex;
use std::time::Instant;

use relief_models::mesh::{CheckOptions, Format, Progress, check, read};

use crate::tilings::SQUARE;
use crate::writers::parse;

/// Corners of the triangles of a tiled square, `2 * n * n`, and their base triangles.
fn triangles(n: i64) -> impl Iterator<Item = (usize, [[i64; 3]; 3])> {
    (0..2).flat_map(move |base| {
        let [a, b, c] = SQUARE[base];
        let at = move |i: i64, j: i64| [0, 1, 2].map(|k| (a[k] * (n - i - j) + b[k] * i + c[k] * j) / 8);
        (0..n).flat_map(move |i| {
            (0..n - i).flat_map(move |j| {
                let upper = (i + j < n - 1).then(|| [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
                [Some([at(i, j), at(i + 1, j), at(i, j + 1)]), upper].into_iter().flatten().map(move |t| (base, t))
            })
        })
    })
}

fn write_text(n: i64, file: &mut impl Write) -> std::io::Result<()> {
    writeln!(file, "scale {n}\nb 0 0 0 0 1 0 0 0 1 0\nb 1 1 0 0 1 1 0 0 1 0")?;
    for (base, [a, b, c]) in triangles(n) {
        writeln!(file, "t {base} {} {} {} {} {} {} {} {} {}", a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2])?;
    }
    Ok(())
}

/// A square of `n * n` quads in two triangles each, as OBJ.
fn write_obj(n: i64, file: &mut impl Write) -> std::io::Result<()> {
    for y in 0..=n {
        for x in 0..=n {
            writeln!(file, "v {}.{:06} {}.{:06} 0.5", x / 10, x % 10 * 100_000, y / 10, y % 10 * 100_000)?;
        }
    }
    for (a, b, c, d) in quads(n) {
        writeln!(file, "f {} {} {}\nf {} {} {}", a + 1, b + 1, c + 1, a + 1, c + 1, d + 1)?;
    }
    Ok(())
}

/// The same as binary PLY.
fn write_ply(n: i64, file: &mut impl Write) -> std::io::Result<()> {
    let (vertices, faces) = ((n + 1) * (n + 1), 2 * n * n);
    write!(
        file,
        "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\n\
         property float z\nelement face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    )?;
    for y in 0..=n {
        for x in 0..=n {
            file.write_all(&[x as f32 * 0.1, y as f32 * 0.1, 0.5].map(f32::to_le_bytes).concat())?;
        }
    }
    for (a, b, c, d) in quads(n) {
        for corners in [[a, b, c], [a, c, d]] {
            file.write_all(&[3])?;
            file.write_all(&corners.map(|corner| (corner as i32).to_le_bytes()).concat())?;
        }
    }
    Ok(())
}

fn quads(n: i64) -> impl Iterator<Item = (i64, i64, i64, i64)> {
    let row = n + 1;
    (0..n).flat_map(move |y| (0..n).map(move |x| y * row + x)).map(move |a| (a, a + 1, a + row + 1, a + row))
}

#[test]
fn mesh_blocks_of_a_large_file_fit_together() {
    // About 7 MB of text and 8 MB of OBJ: several blocks each, with relative indices and lines counted across them.
    let n = 300;
    let mut text = Vec::new();
    write_text(n, &mut text).unwrap();
    let report = check(&parse(Format::Text, &text, None).unwrap(), &CheckOptions::default(), &());
    assert!(report.ok, "{report}");
    assert_eq!((report.triangles, report.vertices), (180_000, 90_601));
    text.extend_from_slice(b"t 0 0 0 oops\n");
    assert_eq!(
        parse(Format::Text, &text, None).unwrap_err().to_string(),
        "mesh:180004: field 5 `oops` is not an integer coordinate (over the scale)"
    );
    let mut obj = Vec::new();
    write_obj(n, &mut obj).unwrap();
    for _ in 0..150_000 {
        obj.extend_from_slice(b"v 7 8 9\nv 8 8 9\nv 7 9 9\n");
    }
    obj.extend_from_slice(b"v 100 0 0\nv 100 1 0\n");
    // A triangle from the last vertices of the file, and one with the very first.
    obj.extend_from_slice(format!("f -3 -4 -5\nf {} -2 -1\n", -(301 * 301 + 450_002)).as_bytes());
    let report = check(&parse(Format::Obj, &obj, None).unwrap(), &CheckOptions::default(), &());
    assert!(report.ok, "{report}");
    assert_eq!((report.triangles, report.boundary_edges), (180_002, 4 * 300 + 6));
    obj.extend_from_slice(b"f 1 2 600000\n");
    assert!(parse(Format::Obj, &obj, None).unwrap_err().to_string().starts_with("mesh:720606: field 4 `600000`"));
}

/// Prints the time of each phase.
#[derive(Default)]
struct Stopwatch(Mutex<Option<(&'static str, Instant)>>);

impl Stopwatch {
    fn next(&self, name: &'static str) {
        if let Some((before, start)) = self.0.lock().unwrap().replace((name, Instant::now())) {
            println!("    {:7.3} s {before}", start.elapsed().as_secs_f64());
        }
    }
}

impl Progress for Stopwatch {
    fn phase(&self, name: &'static str, _total: u64) {
        self.next(name);
    }
    fn advance(&self, _done: u64) {}
}

/// Writes ten million triangles in each format and times them; needs 1 GB of disk and a release build:
/// `cargo test --release -p relief-models --test mesh -- --ignored --nocapture ten_million`
#[test]
#[ignore = "takes a minute and a gigabyte"]
fn mesh_ten_million_triangles() {
    let folder = tempfile::tempdir().unwrap();
    let n = 2237;
    type Writer = fn(i64, &mut BufWriter<std::fs::File>) -> std::io::Result<()>;
    let writers: [(&str, Writer); 3] = [
        ("mesh.txt", |n, file| write_text(n, file)),
        ("mesh.obj", |n, file| write_obj(n, file)),
        ("mesh.ply", |n, file| write_ply(n, file)),
    ];
    for (name, write) in writers {
        let path = folder.path().join(name);
        let mut file = BufWriter::new(std::fs::File::create(&path).unwrap());
        write(n, &mut file).unwrap();
        file.into_inner().unwrap().sync_all().unwrap();
        time(&path);
        std::fs::remove_file(&path).unwrap();
    }
}

fn time(path: &Path) {
    let (start, watch) = (Instant::now(), Stopwatch::default());
    println!("{} of {} MB", path.file_name().unwrap().display(), std::fs::metadata(path).unwrap().len() >> 20);
    let report = check(&read(path, None, &watch).unwrap(), &CheckOptions::default(), &watch);
    watch.next("end");
    println!("    {:7.3} s all: {}", start.elapsed().as_secs_f64(), report.to_string().trim_end());
    assert!(report.ok && report.triangles == 10_008_338);
    assert!(start.elapsed().as_secs() < 30);
}
