// SPDX-License-Identifier: MIT OR Apache-2.0
//! The maps on which methods fail: claims hold there in hardware, and a claim that does not hold is noticed.

use relief_models::failures::{RULE_CELLS, RULES, scenes};
use relief_models::map::{HeightMap, Procedural};
use relief_models::mesh::Progress;
use relief_testbench::method::{Borders, Engine, Goal, METHODS, Method, MethodError, Tessellation, Uniform, Verdict};
use relief_testbench::stability::{BASE_GRID, Row, maps, rows};
use std::process::Command;

/// A method that claims more than it keeps, or whose mesh has a hole.
struct Liar {
    hole: bool,
}

impl Method for Liar {
    fn name(&self) -> &'static str {
        "liar"
    }
    fn summary(&self) -> &'static str {
        "says that a grid is exact"
    }
    fn has_hardware(&self) -> bool {
        false
    }
    fn goals(&self, map: &HeightMap, count: usize) -> Vec<Goal> {
        Uniform.goals(map, count)
    }
    fn tessellate_within(
        &self,
        map: &HeightMap,
        borders: Borders,
        _: Goal,
        engine: Engine,
        progress: &dyn Progress,
    ) -> Result<Tessellation, MethodError> {
        let mut made = Uniform.tessellate_within(map, borders, Goal::Triangles(64), engine, progress)?;
        if self.hole {
            made.mesh.triangles.truncate(made.mesh.triangles.len() - 1);
        } else {
            made.claim = Some(0.0);
        }
        Ok(made)
    }
}

#[test]
fn stability_notices_a_broken_claim_and_a_hole() {
    let found = rows(&[&Liar { hole: false }], Engine::Golden, &()).unwrap();
    let broken: Vec<&str> = found.iter().filter(|row| row.is_broken()).map(|row| row.map).collect();
    assert!(broken.contains(&"peak") && broken.contains(&"waves") && broken.contains(&"noise"), "{broken:?}");
    // A plane is a plane.
    assert!(!broken.contains(&"constant") && !broken.contains(&"all maximum"), "{broken:?}");
    let found = rows(&[&Liar { hole: true }], Engine::Golden, &()).unwrap();
    assert!(found.iter().all(Row::is_broken), "{found:?}");
}

#[test]
fn stability_shows_where_grids_see_nothing() {
    let found = rows(&[&Uniform], Engine::Golden, &()).unwrap();
    let error = |name: &str| {
        let row = found.iter().find(|row| row.map == name && row.goal == Goal::Triangles(BASE_GRID)).unwrap();
        row.result.as_ref().unwrap().max
    };
    // All of the range, where the grid has the frequency of the map.
    assert_eq!(["waves", "dents", "peak"].map(error), [65535.0; 3]);
    assert!(error("paraboloid") < 0.02 * 65535.0 && error("ramp") <= 1.0);
}

#[test]
fn stability_fails_for_no_method_in_hardware() {
    let output = Command::new(env!("CARGO_BIN_EXE_relief")).args(["stability", "--engine", "rust"]).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{text}{}", String::from_utf8_lossy(&output.stderr));
    for map in maps() {
        assert!(
            text.contains(&format!("{}, {} x {}: {}\n", map.name, map.map.width, map.map.height, map.why)),
            "{text}"
        );
    }
    let count = maps().len();
    // The remesher cannot keep 2 % on 3 columns of noise.
    let meshes = 2 * count * METHODS.len() - 1;
    let expected = format!("{meshes} meshes, 1 refused: {} claims hold, 0 broken\n", 4 * count);
    let (text, frames) = text.split_once(&expected).unwrap_or_else(|| panic!("{text}"));
    // Every scene ran as hardware, and none cracks.
    let scenes = scenes();
    for scene in &scenes {
        assert!(frames.contains(&format!("\n{}: {}\n  {}\n", scene.name, scene.why, scene.does)), "{frames}");
    }
    assert_eq!(frames.matches(" cycles, hardware = golden\n").count(), scenes.len(), "{frames}");
    let (_, rules) = frames.split_once(&format!("\n{} scenes, 0 with cracks\n", scenes.len())).unwrap();
    let compared = RULES.len() * RULE_CELLS.len();
    assert!(rules.ends_with(&format!("\n{compared} rows, 0 with cracks where the rule forbids them\n")), "{rules}");
    for rule in RULES {
        let rows = rules.lines().filter(|line| line.contains(&format!(" {rule} ")));
        let cracks = rows.map(|line| line.split_whitespace().nth(6).unwrap().parse::<u64>().unwrap());
        assert_eq!(cracks.collect::<Vec<_>>().iter().all(|cracks| *cracks == 0), rule.keeps_closed(), "{rules}");
    }
    // The document has what the command prints.
    let document = include_str!("../docs/stability.md");
    for line in rules.lines().filter(|line| line.starts_with("  ")) {
        assert!(document.contains(line), "{line}");
    }
    // Every bisection ran as hardware.
    let drawn = text.lines().filter(|line| line.trim_start().starts_with("bisector")).map(|line| {
        let cells: Vec<&str> = line.split_whitespace().collect();
        cells[cells.len() - 2].parse::<u64>().is_ok_and(|cycles| cycles > 10)
    });
    assert_eq!(drawn.collect::<Vec<_>>(), vec![true; 4 * count]);
}

#[test]
fn stability_verdict_is_of_the_mesh() {
    let map = HeightMap::procedural(Procedural::Noise, 9, 9);
    let made = Uniform.tessellate(&map, Goal::Triangles(2), Engine::Golden, &()).unwrap();
    let max = made.measure(&map, &()).unwrap().heights.max;
    let verdict = |claim| Tessellation { claim, ..made.clone() }.measure(&map, &()).unwrap().verdict;
    assert_eq!(verdict(None), Verdict::NoClaim);
    assert_eq!(verdict(Some(max)), Verdict::Holds { slack: 0.0 });
    assert_eq!(verdict(Some(max + 1.5)), Verdict::Holds { slack: max + 1.5 - max });
    assert_eq!(verdict(Some(max - 0.001)), Verdict::Broken);
}
