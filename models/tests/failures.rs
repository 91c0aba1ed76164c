// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scenes on which displacement is known to fail: none cracks, what is left out is counted, and a crack is noticed.

use relief_models::closure::{Closure, closure};
use relief_models::draw::Assembled;
use relief_models::failures::{FailureScene, Outcome, outcome, scenes};

fn named(name: &str) -> FailureScene {
    scenes().into_iter().find(|scene| scene.name == name).unwrap_or_else(|| panic!("no scene {name}"))
}

#[test]
fn failure_scenes_never_crack() {
    for failure in scenes() {
        let Outcome { whole, drawn, deviation } = outcome(&failure).unwrap();
        println!("{:20} whole {whole:?}\n   drawn {drawn:?}\n {deviation:?}", failure.name);
        assert_eq!((whole.cracks, drawn.cracks), (0, 0), "{}: {whole:?} {drawn:?}", failure.name);
        assert!(whole.triangles >= drawn.triangles && drawn.triangles > 0, "{}: {whole:?} {drawn:?}", failure.name);
        // A vertex has a place in integers where it has one in f64.
        assert_eq!(deviation.flags, 0, "{}: {deviation:?}", failure.name);
        let all = failure.scene.objects[0].mesh.triangles.len() as u64;
        for Closure { assembled, .. } in [whole, drawn] {
            let gone = assembled.culled.total() + assembled.dropped.total();
            assert_eq!(assembled.kept + gone, all, "{}", failure.name);
        }
        // Open for a reason only if something is gone, or has a rim.
        let nothing_gone = whole.assembled.cut + whole.assembled.dropped.total() + whole.invalid == 0;
        assert!(!nothing_gone || whole.dropped == 0, "{}: {whole:?}", failure.name);
    }
}

/// The scenes fail where they are meant to.
#[test]
fn failure_scenes_have_their_weakness() {
    let of = |name: &str| outcome(&named(name)).unwrap();
    let whole = |name: &str| of(name).whole;
    assert!(whole("across z0").assembled.cut > 0);
    let eye = whole("displaced to the eye");
    assert!(eye.invalid > 1000 && eye.triangles > 1000, "{eye:?}");
    let wide = whole("beyond 8192 pixels").assembled;
    assert!(wide.cut > 0 && wide.dropped.near > 0, "{wide:?}");
    for closed in ["seam and poles", "coarse voxels", "overlapping layers", "16 x 16 pixels", "4096 x 4096 pixels"] {
        let body = whole(closed);
        assert_eq!((body.rim, body.dropped, body.invalid), (0, 0, 0), "{closed}: {body:?}");
    }
    assert_eq!(of("magnified").deviation.highest, 0);
    assert!(of("minified").deviation.highest > 4);
    let narrow = of("grid too narrow");
    assert!(narrow.drawn.assembled.dropped.grid > 0 && narrow.drawn.assembled.kept > 0, "{narrow:?}");
    // 24 bits show at a depth ratio of 10,000, and 32 do not.
    let (wide, narrow) = (of("ratio 10,000").deviation, of("vertices too narrow").deviation);
    assert!(narrow.max > 10.0 * wide.max && wide.max < 0.1, "{wide:?} {narrow:?}");
}

/// A height that depends on the triangle opens the mesh, and is counted: one side of the seam asks for other texels.
#[test]
fn closure_notices_a_crack() {
    let failure = named("seam and poles");
    let (scene, object) = (&failure.scene, &failure.scene.objects[0]);
    let mut draw = scene.draw(object, &scene.view(), &failure.format).unwrap();
    draw.cull = false;
    let pyramid = scene.pyramid(object).unwrap();
    assert_eq!(closure(&draw, &failure.format, &pyramid).cracks, 0);
    // u = 1 is the last column of vertices: half a texel off.
    let period = 1u64 << (32 - draw.axes[0].texel_bits);
    for record in &mut draw.records {
        let last = u64::from(record.texel[0]) >= u64::from(draw.axes[0].size) * period - 1;
        record.texel[0] -= if last { (period / 2) as u32 } else { 0 };
    }
    let cracked = closure(&draw, &failure.format, &pyramid);
    assert!(cracked.cracks > 10 && cracked.rim + cracked.dropped == 0, "{cracked:?}");
    // At a cut base triangle, too: its copy of a corner asks for other texels.
    let across = named("across z0");
    let (scene, object) = (&across.scene, &across.scene.objects[0]);
    let mut draw = scene.draw(object, &scene.view(), &across.format).unwrap();
    draw.cull = false;
    let pyramid = scene.pyramid(object).unwrap();
    let cut =
        (0..draw.triangles.len()).find(|k| matches!(draw.assemble(*k), Assembled::Cut(pieces) if pieces.len() > 1));
    let (cut, copy) = (cut.unwrap(), draw.records.len() as u32);
    assert_eq!(closure(&draw, &across.format, &pyramid).cracks, 0);
    for k in 0..3 {
        let mut record = draw.records[draw.triangles[cut][k] as usize];
        record.texel[1] ^= 1 << 27;
        draw.records.push(record);
        draw.triangles[cut][k] = copy + k as u32;
    }
    let cracked = closure(&draw, &across.format, &pyramid);
    assert!(cracked.cracks > 10, "{cracked:?}");
    let (scene, object) = (&failure.scene, &failure.scene.objects[0]);
    let pyramid = scene.pyramid(object).unwrap();
    // A base triangle that is gone leaves open edges for a reason.
    let mut draw = scene.draw(object, &scene.view(), &failure.format).unwrap();
    draw.cull = false;
    draw.triangles.remove(40);
    let torn = closure(&draw, &failure.format, &pyramid);
    assert!(torn.cracks == 0 && torn.rim > 3, "{torn:?}");
}
