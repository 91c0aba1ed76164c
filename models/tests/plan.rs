// SPDX-License-Identifier: MIT OR Apache-2.0
//! Plans keep their bound, and nothing in them can be less.

use relief_models::plan::{Breaks, Plan, PlanError, Planner, Widths};
use relief_models::remesher::Format;
use relief_models::scene::{Scene, parse, read};
use std::path::Path;

fn scene(name: &str) -> Scene {
    read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes").join(name)).unwrap()
}

fn plan(name: &str, bound: f64) -> Plan {
    let scene = scene(name);
    Planner::new(&scene, &()).unwrap().plan(bound).unwrap()
}

/// Every choice is shown to be the least: by what breaks, or because it is at the end of its range.
#[test]
fn plan_keeps_its_bound_and_one_less_does_not() {
    for (name, bound) in
        [("jacksboro.toml", 0.1), ("jacksboro_far.toml", 0.02), ("sphere.toml", 0.1), ("dents.toml", 0.5)]
    {
        let plan = plan(name, bound);
        assert!(plan.planned.deviation.max <= bound && plan.planned.deviation.vertices > 10_000, "{name}: {plan:?}");
        for choice in &plan.choices {
            match choice.breaks {
                Breaks::Error(px) => assert!(px > bound, "{name}: {choice:?}"),
                Breaks::Least => {
                    assert!(choice.name == "levels" && choice.value == 1 || choice.value == 0, "{name}: {choice:?}")
                }
                _ => {}
            }
        }
        let breaks = |name: &str| plan.choices.iter().find(|choice| choice.name == name).unwrap().breaks;
        assert!(matches!(breaks("components"), Breaks::Components(_)), "{name}");
        assert!(matches!(breaks("bits of a grid coordinate"), Breaks::Grid(_)), "{name}");
        assert!(matches!(breaks("column memory"), Breaks::Again(_)), "{name}");
    }
}

/// A flat base mesh has one normal and one density, so five components are left; a body needs all nine. A map that repeats
/// keeps its seam.
#[test]
fn plan_leaves_out_what_does_not_vary() {
    let widths = |name: &str, bound| plan(name, bound).widths;
    assert_eq!(widths("jacksboro.toml", 0.1).format.components, 5);
    assert_eq!(widths("cylinder.toml", 0.1).format.components, 8);
    assert_eq!(widths("sphere.toml", 0.1).format.components, 9);
    // From afar the coarse levels are read.
    assert_eq!(widths("jacksboro.toml", 0.1).levels, 1);
    assert_eq!(widths("jacksboro_far.toml", 0.1).levels, 2);
    let sphere = plan("sphere.toml", 0.5);
    assert_eq!(sphere.choices[1].breaks, Breaks::Seam);
}

/// A looser bound never takes more bits of an accumulator.
#[test]
fn plan_grows_with_what_is_asked() {
    let scene = scene("dents.toml");
    let planner = Planner::new(&scene, &()).unwrap();
    let bits: Vec<u32> = [0.005, 0.02, 0.1, 0.5, 2.0]
        .map(|bound| planner.plan(bound).unwrap().widths.format.accumulator_bits())
        .to_vec();
    assert!(bits.is_sorted_by(|a, b| a >= b) && bits[0] > bits[4] + 4, "{bits:?}");
}

/// The measured error is that of the widths alone: whole lanes come within the bound of the datapath.
#[test]
fn plan_measures_the_whole_formats_within_the_bound_of_the_datapath() {
    for name in ["jacksboro.toml", "cylinder.toml", "jacksboro_close.toml"] {
        let scene = scene(name);
        let format = Format { components: 9, vertex_bits: 32, guard_bits: 13, coordinate_bits: 14, column_depth: 4096 };
        let trial = Planner::new(&scene, &()).unwrap().try_widths(&Widths { format, levels: 15 }).unwrap();
        let deviation = trial.deviation;
        assert!(deviation.max <= 0.016 && deviation.rms() < 0.003 && deviation.levels == 0, "{name}: {deviation:?}");
        assert_eq!((deviation.flags, trial.beyond_grid, trial.seams), (0, 0, true), "{name}");
    }
}

#[test]
fn plan_says_what_cannot_be_kept() {
    let planner_of = |text: &str| {
        let scene = parse(text, "scene.toml", Path::new("")).unwrap();
        Planner::new(&scene, &()).and_then(|planner| planner.plan(0.001))
    };
    let object = "[[object]]\nmesh = { kind = \"grid\" }\nmap = { kind = \"peaks\", size = [64, 64] }\n";
    let error = planner_of(&format!("[camera]\neye = [0, -2, 1]\n{object}")).unwrap_err();
    let PlanError::Bound { least, .. } = error else { panic!("{error}") };
    assert!(least > 0.001 && error.to_string().contains(&format!("it is {least:.4} px")), "{error}");
    let away = format!("[camera]\neye = [0, -2, 1]\ntarget = [0, -4, 1]\n{object}");
    assert!(matches!(planner_of(&away).unwrap_err(), PlanError::Nothing));
    let near = format!("[camera]\neye = [0, -2, 1]\nnear = 1e-9\nfar = 1\n{object}");
    assert!(matches!(planner_of(&near).unwrap_err(), PlanError::Draw(0, _)));
}
