// SPDX-License-Identifier: MIT OR Apache-2.0
//! What is decided before any work: whether a scene fits the formats and the memory, how much will come of it, and what
//! may surprise.

use crate::remesher::format;
use relief_hdl::widths::{WIDTH_SETS, WidthSet};
use relief_models::digits::{rounded_up, short};
use relief_models::draw::{CameraView, Counts, Draw, DrawError};
use relief_models::map::Limit;
use relief_models::mesh::InputError;
use relief_models::mip_build::BuildSize;
use relief_models::remesher::Format;
use relief_models::scene::{Entry, Object, Scene};

/// Triangles beyond which a scene is refused: some minutes of work, and more than a gigabyte of mesh.
pub const MOST_TRIANGLES: u64 = 1 << 25;
/// Triangles that are worth a warning: half a minute.
const MANY_TRIANGLES: u64 = 1 << 22;
/// Triangles a second, roughly.
const SPEED: u64 = 300_000;

/// A scene that can be drawn.
pub struct Prepared<'a> {
    pub(super) scene: &'a Scene,
    pub(super) objects: Vec<PreparedObject<'a>>,
    /// About how many triangles will come of it.
    pub triangles: u64,
    /// What may surprise, sentence by sentence; that of the scene's reading not among it.
    pub warnings: Vec<String>,
}

/// An object that can be drawn.
pub(super) struct PreparedObject<'a> {
    pub(super) object: &'a Object,
    pub(super) size: BuildSize,
    pub(super) draw: Draw,
}

/// The smallest map memory that holds every map of a scene. Sets of other vertices are no choice: they would change the
/// picture. Where none is large enough, the largest, whose limits `prepare` then tells.
pub fn width_set(scene: &Scene) -> &'static WidthSet {
    let [default, ..] = WIDTH_SETS else { unreachable!("there is a default") };
    let mut sets: Vec<_> = WIDTH_SETS.iter().filter(|set| set.has_vertices_of(default)).collect();
    sets.sort_by_key(|set| set.texel_bits);
    let holds = |set: &WidthSet| {
        let limit = limit_of(set);
        scene.objects.iter().all(|object| {
            limit
                .check(
                    [object.map.width, object.map.height],
                    object.wrap,
                    scene.remesh.levels,
                    scene.remesh.rules.reads_both(),
                )
                .is_ok()
        })
    };
    sets.iter().find(|set| holds(set)).or(sets.last()).copied().unwrap_or(default)
}

/// What the map memory of a set holds.
fn limit_of(set: &WidthSet) -> Limit {
    Limit { side: (1 << set.side_width()) - 1, bank_words: set.bank_words() as u64 }
}

/// Prepares a scene for a width set.
///
/// # Errors
/// It does not fit, has rules that the hardware does not have, or would take too long.
pub fn prepare<'a>(scene: &'a Scene, set: &WidthSet) -> Result<Prepared<'a>, InputError> {
    if let Some(refusal) = scene.remesh.rules.refusal() {
        return Err(scene.source.error(Entry::Remesh, refusal));
    }
    let view = scene.view();
    let mut prepared = Prepared { scene, objects: Vec::new(), triangles: 0, warnings: Vec::new() };
    let mut all = Counts::default();
    for (at, object) in scene.objects.iter().enumerate() {
        let refuse = |problem: String| scene.source.error(Entry::Object(at), problem);
        let name = &object.map_name;
        let (width, height) = (object.map.width, object.map.height);
        limit_of(set)
            .check([width, height], object.wrap, scene.remesh.levels, scene.remesh.rules.reads_both())
            .map_err(|problem| refuse(format!("the map {name} of {width} x {height} samples {problem}")))?;
        let draw = scene.draw(object, &view, &format(set)).map_err(|cause| match cause {
            DrawError::Focal { .. } | DrawError::Extent { .. } => scene.source.error(Entry::Camera, cause),
            DrawError::Format { .. } => {
                let fits = |other: &&WidthSet| scene.draw(object, &view, &format(other)).is_ok();
                refuse(format!("width set {}: {cause}; {}", set.name, sets_that(fits)))
            }
            _ => refuse(cause.to_string()),
        })?;
        let (counts, triangles) = amount(&draw);
        prepared.triangles += triangles;
        all.add(&counts);
        let mut warnings = warnings_of(scene, object, &draw, &counts);
        warnings.extend(beyond_grid(scene, object, &view, set, &counts));
        let warnings = warnings.into_iter().map(|warning| scene.source.error(Entry::Object(at), warning).to_string());
        prepared.warnings.extend(warnings);
        prepared.objects.push(PreparedObject { object, size: scene.levels(object), draw });
    }
    let triangles = rounded_up(prepared.triangles as f64) as u64;
    if prepared.triangles > MOST_TRIANGLES {
        let what =
            format!("about {triangles} triangles would come of this scene, beyond the limit of {MOST_TRIANGLES}");
        return Err(scene.source.error(Entry::Remesh, format!("{what}; {} is expected", remedy(scene, set))));
    }
    if prepared.triangles > MANY_TRIANGLES {
        let seconds = rounded_up((prepared.triangles / SPEED) as f64) as u64;
        let what = format!("about {triangles} triangles will come of this scene, which takes {seconds} s or so");
        let less = "a greater `cell_px` makes it less";
        prepared.warnings.push(scene.source.error(Entry::Remesh, format!("{what}; {less}")).to_string());
    }
    if all.kept == 0 {
        let reasons = all.culled.named().into_iter().filter(|(_, count)| *count > 0);
        let mut reasons: Vec<_> = reasons.map(|(name, count)| format!("{count} beyond the {name} side")).collect();
        if all.dropped.near > 0 {
            reasons.push(format!("{} nearer than `near` / 16 or behind the eye", all.dropped.near));
        }
        if all.dropped.lane + all.dropped.grid > 0 {
            reasons.push(format!("{} beyond the voxel grid", all.dropped.lane + all.dropped.grid));
        }
        let what = format!("nothing of the scene is in view ({} of what can be seen)", reasons.join(", "));
        let warning = format!("{what}; a `target` on an object is what shows it");
        prepared.warnings.push(scene.source.error(Entry::Camera, warning).to_string());
    }
    Ok(prepared)
}

/// What becomes of the base triangles, and about how many triangles they become.
fn amount(draw: &Draw) -> (Counts, u64) {
    let (mut counts, mut triangles) = (Counts::default(), 0);
    for index in 0..draw.triangles.len() {
        let assembled = draw.assemble(index);
        counts.count(&assembled);
        triangles += assembled.pieces().iter().map(|piece| piece.estimate()).sum::<u64>();
    }
    (counts, triangles)
}

fn warnings_of(scene: &Scene, object: &Object, draw: &Draw, counts: &Counts) -> Vec<String> {
    let mut warnings = Vec::new();
    if object.has_seam() && !draw.seams_are_exact() {
        let near = short(rounded_up(draw.exact_seams_near()));
        warnings.push(format!(
            "the seam of its map may open, because the object reaches too far away for `near` {}; a `near` of at least \
             {near} keeps it closed",
            short(scene.camera.near)
        ));
    }
    let (all, gone) = (draw.triangles.len(), counts.cut + counts.dropped.near);
    if !draw.cull && gone > 0 {
        warnings.push(format!(
            "{gone} of its {all} base triangles are cut, at `near` / 16 from the eye or 8190 pixels off the middle of the \
             picture, so the mesh is open there; an `eye` farther away keeps them whole"
        ));
    }
    warnings
}

/// What the grid does not reach, how many bits would, and who has them.
fn beyond_grid(scene: &Scene, object: &Object, view: &CameraView, set: &WidthSet, counts: &Counts) -> Option<String> {
    let (all, beyond) = (object.mesh.triangles.len(), counts.dropped.lane + counts.dropped.grid);
    if beyond == 0 {
        return None;
    }
    let bits = set.coordinate_bits;
    let left = |coordinate_bits: usize| {
        let format = Format { coordinate_bits: coordinate_bits as u32, ..format(set) };
        scene.draw(object, view, &format).map_or(u64::MAX, |draw| amount(&draw).0.dropped.grid)
    };
    let wider = (bits + 1..=24).find(|bits| left(*bits) == 0).map(|needed| {
        let enough = |set: &&WidthSet| set.coordinate_bits >= needed && scene.draw(object, view, &format(set)).is_ok();
        format!(", or {needed} bits of a grid coordinate: {}", sets_that(enough))
    });
    Some(format!(
        "{beyond} of its {all} base triangles are left out, because the voxel grid of {bits} bits does not reach them; a \
         greater `cell_px` is what reaches farther{}",
        wider.unwrap_or_default()
    ))
}

/// The names of the width sets for which something holds, as the end of a sentence.
fn sets_that(hold: impl Fn(&&WidthSet) -> bool) -> String {
    let names: Vec<_> = WIDTH_SETS.iter().filter(hold).map(|set| set.name).collect();
    match names[..] {
        [] => "no width set of the list has it".into(),
        [one] => format!("the width set {one} has it"),
        _ => format!("the width sets {} have it", names.join(", ")),
    }
}

/// What would make a scene small enough: tried, not guessed.
fn remedy(scene: &Scene, set: &WidthSet) -> String {
    let view = scene.view();
    let fits = |view: &CameraView| {
        let mut triangles = 0;
        for object in &scene.objects {
            match scene.draw(object, view, &format(set)) {
                Ok(draw) => triangles += amount(&draw).1,
                Err(_) => return false,
            }
            if triangles > MOST_TRIANGLES {
                return false;
            }
        }
        true
    };
    let mut ways = Vec::new();
    let cells = (1..).map(|k| view.cell_px * f64::powi(1.25, k)).take_while(|cell| *cell <= 64.0).map(rounded_up);
    if let Some(cell_px) = cells.into_iter().find(|cell| fits(&CameraView { cell_px: *cell, ..view })) {
        ways.push(format!("a `cell_px` of {}", short(cell_px)));
    }
    let farthest = (0.5 * view.far).min((view.target - view.eye).length());
    let nears = (1..).map(|k| view.near * f64::from(1u32 << k)).take_while(|near| *near <= farthest).take(16);
    if let Some(near) = nears.into_iter().find(|near| fits(&CameraView { near: *near, ..view })) {
        ways.push(format!("a `near` of {}", short(near)));
    }
    ways.push("an `eye` farther from the surface".to_owned());
    ways.join(", or ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use relief_hdl::widths::{large, small};
    use relief_models::scene::parse;
    use std::path::Path;

    /// The scene's reader cannot see the hardware, so it has its limit as a constant.
    #[test]
    fn prepare_and_the_reader_of_scenes_have_one_limit() {
        assert_eq!(limit_of(&large::SET), Limit::LARGEST);
    }

    /// Each map by its side, or by what it takes with its levels, in the smallest set that holds it.
    #[test]
    fn prepare_takes_the_smallest_width_set_that_holds_every_map() {
        let object = SCENE.split_once("[[object]]").unwrap().1;
        for (sizes, name) in [
            (vec!["300, 9"], "default"),
            (vec!["1023, 20"], "default"),
            (vec!["1024, 20"], "large"),
            (vec!["312, 312"], "default"),
            (vec!["313, 313"], "large"),
            (vec!["9, 9", "403, 344", "9, 9"], "large"),
        ] {
            let mut text = SCENE.replace("300, 9", sizes[0]);
            for size in &sizes[1..] {
                text += &format!("[[object]]{}", object.replace("300, 9", size));
            }
            let scene = parse(&text, "scene.toml", Path::new("")).unwrap();
            let set = width_set(&scene);
            assert_eq!(set.name, name, "{sizes:?}");
            assert!(prepare(&scene, set).is_ok(), "{sizes:?}");
        }
        // Minima besides.
        for (side, name) in [(278, "default"), (279, "large"), (558, "large")] {
            let text = SCENE.replace("300, 9", &format!("{side}, {side}"));
            let scene = text.replace("cell_px = 4", "cell_px = 4\nextremum = \"vertex\"");
            let scene = parse(&scene, "scene.toml", Path::new("")).unwrap();
            assert_eq!(width_set(&scene).name, name, "{side}");
            assert!(prepare(&scene, width_set(&scene)).is_ok(), "{side}");
        }
        let text = SCENE.replace("300, 9", "559, 559").replace("cell_px = 4", "cell_px = 4\nextremum = \"vertex\"");
        let scene = parse(&text, "scene.toml", Path::new("")).unwrap();
        let refusal = prepare(&scene, width_set(&scene)).err().unwrap().to_string();
        assert!(refusal.contains("with maxima and minima of its levels, beyond the limit of 131072"), "{refusal}");
        let mut scene = parse(SCENE, "scene.toml", Path::new("")).unwrap();
        scene.objects[0].map = relief_models::map::HeightMap::procedural(relief_models::map::Procedural::Ramp, 2050, 3);
        assert_eq!(width_set(&scene), &large::SET);
    }

    const SCENE: &str = "[camera]\neye = [0, -2.6, 1.7]\n[remesh]\ncell_px = 4\n[[object]]\nmesh = { kind = \"grid\" }\nmap \
                         = { kind = \"ramp\", size = [300, 9] }\n";

    /// What a smaller width set cannot hold is refused there, too.
    #[test]
    fn prepare_refuses_what_another_width_set_cannot_hold() {
        let scene = parse(SCENE, "scene.toml", Path::new("")).unwrap();
        let small = small::SET;
        assert!(prepare(&scene, &WIDTH_SETS[0]).is_ok());
        // A side of 9 bits goes to 511.
        assert!(prepare(&scene, &small).is_ok());
        let scene = parse(&SCENE.replace("300", "512"), "scene.toml", Path::new("")).unwrap();
        let error = prepare(&scene, &small).err().unwrap().to_string();
        let expected = "scene.toml:5: [[object]] 1: the map ramp of 512 x 9 samples has a side beyond the limit of 511; a \
                        smaller map is expected";
        assert_eq!(error, expected);
    }

    /// The hardware has one footprint, and no choice by base triangle.
    #[test]
    fn prepare_refuses_rules_that_the_hardware_does_not_have() {
        for (rule, expected) in [("footprint = \"exact\"", "density"), ("extremum = \"triangle\"", "vertex")] {
            let text = SCENE.replace("cell_px = 4", &format!("cell_px = 4\n{rule}"));
            let scene = parse(&text, "scene.toml", Path::new("")).unwrap();
            let error = prepare(&scene, &WIDTH_SETS[0]).err().unwrap().to_string();
            let (field, value) = rule.split_once(" = ").unwrap();
            let expected = format!(
                "scene.toml:3: [remesh] `{field}` is {value}, which no draw of the hardware has, for `relief stability` and \
                 `relief wagging`; \"{expected}\" is expected"
            );
            assert_eq!(error, expected);
        }
    }

    /// A map that the builder cannot count, past all checks: the sentence names entry, block, beat, cycle and both sides.
    #[test]
    fn render_names_the_first_mismatch() {
        let set = &WIDTH_SETS[0];
        let mut scene = parse(SCENE, "scene.toml", Path::new("")).unwrap();
        let ramp = relief_models::map::Procedural::Ramp;
        scene.objects[0].map = relief_models::map::HeightMap::procedural(ramp, 2050, 3);
        let object = &scene.objects[0];
        let draw = scene.draw(object, &scene.view(), &format(set)).unwrap();
        let (wrap, centring) = (object.wrap, relief_models::mip_build::Centring::Node);
        let size = BuildSize { width: 2050, height: 3, wrap, centring, levels: 3, poles: false };
        let objects = vec![PreparedObject { object, size, draw }];
        let prepared = Prepared { scene: &scene, objects, triangles: 0, warnings: Vec::new() };
        let mut pipeline = crate::pipeline::Pipeline::new(set);
        let mut obj = Vec::new();
        let error = crate::frame::render(&prepared, &mut pipeline, None, &mut obj, &()).err().unwrap();
        assert!(error.is_mismatch());
        let sentence = error.to_string();
        let start = "scene.toml:5: [[object]] 1: mip_build differs from its golden model: beat 0, cycle ";
        let end = ", port out_valid: expected no beat, got a beat too many";
        assert!(sentence.starts_with(start) && sentence.ends_with(end), "{sentence}");
    }
}
