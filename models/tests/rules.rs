// SPDX-License-Identifier: MIT OR Apache-2.0
//! Rules for the height of a vertex: which of them crack a closed body, and how exact the exact footprint is.

use relief_models::draw::Assembled;
use relief_models::exact_footprint;
use relief_models::facing;
use relief_models::failures::{RULE_CELLS, RULES, rule_body, rule_rows};
use relief_models::filter_level::thresholds;
use relief_models::remesher::{BaseTriangle, Place, Setup, exact, observe};
use relief_models::rules::{ExtremumRule, FootprintRule, Ruled, Rules};
use relief_models::scene::parse;
use relief_models::step::{MAX_COMPONENTS, Vertex};
use relief_models::vertex_transform::lane;

#[test]
fn rules_crack_unless_all_base_triangles_agree() {
    let rows = rule_rows(&()).unwrap();
    assert_eq!(rows.len(), RULES.len() * RULE_CELLS.len());
    for row in &rows {
        let closure = row.closure;
        let of = format!("{} of {}", row.disputed, row.corners);
        let links = format!("{} of {} links", row.stepped, row.links);
        println!("{:>4} {:18} {:>8} {:>6} {of} {links}", row.cell_px, row.rules, closure.triangles, closure.cracks);
        assert_eq!((closure.rim, closure.dropped, closure.invalid), (0, 0, 0), "{row:?}");
        assert!(!row.is_broken(), "{row:?}");
    }
    let cracks =
        |rules: Rules| -> u64 { rows.iter().filter(|row| row.rules == rules).map(|row| row.closure.cracks).sum() };
    // An edge sees only its own direction, and lies lower than what is beside it: why the density is the rule even so.
    let steps = |footprint: FootprintRule| -> f64 {
        let of = rows.iter().filter(|row| row.rules == Rules { footprint, ..Rules::DEFAULT } && row.cell_px == 5.0);
        of.map(|row| row.stepped as f64 / row.links as f64).sum()
    };
    assert!(steps(FootprintRule::Exact) > 4.0 * steps(FootprintRule::Density));
    for rules in RULES {
        assert_eq!(cracks(rules) == 0, rules.keeps_closed(), "{rules}");
    }
}

/// What the f64 footprint of a place is made of: lanes, and the differences that count there.
fn exactly(
    base: &BaseTriangle,
    setup: &Setup,
    place: Place,
) -> Option<([f64; MAX_COMPONENTS], Vec<[f64; MAX_COMPONENTS]>)> {
    let lanes = base.data.map(|data| data.map(|lane| lane as f64));
    let combined =
        |weights: [f64; 3]| std::array::from_fn(|k| (0..3).map(|corner| weights[corner] * lanes[corner][k]).sum());
    let along = |edge: usize| {
        let edge = &setup.edges[edge];
        let mut weights = [0.0; 3];
        (weights[edge.high], weights[edge.low]) = (1.0 / f64::from(edge.segments), -1.0 / f64::from(edge.segments));
        combined(weights)
    };
    let differences = match place {
        Place::Corner(_) => return None,
        Place::Edge { edge, .. } => vec![along(edge.into())],
        Place::Interior { sweep, side } => {
            // Linear in the plane, so a step makes the same difference everywhere.
            let at = |sweep, side| exact::vertex(base, setup, Place::Interior { sweep, side });
            let here = at(sweep, side);
            let minus = |there: [f64; MAX_COMPONENTS]| std::array::from_fn(|k| there[k] - here[k]);
            vec![minus(at(sweep + 1, side)), minus(at(sweep, side + 1))]
        }
    };
    Some((exact::vertex(base, setup, place), differences))
}

#[test]
fn exact_footprint_has_the_level_of_f64() {
    let (mut scene, format) = rule_body();
    let (mut worst, mut vertices, mut near, mut seen) = (0.0f64, 0u64, 0u64, [0u64; 9]);
    for cell_px in [1.0, 5.0, 20.0] {
        scene.remesh.cell_px = cell_px;
        scene.remesh.rules = Rules { footprint: FootprintRule::Exact, ..Rules::DEFAULT };
        let mut draw = scene.draw(&scene.objects[0], &scene.view(), &format).unwrap();
        draw.cull = false;
        for index in 0..draw.triangles.len() {
            let Assembled::Kept(base) = draw.assemble(index) else { panic!("base triangle {index} is gone") };
            let (ruled, setup) = (Ruled::new(&draw, &format, &base), Setup::new(&format, &base));
            let mut check = |vertex: &Vertex, place: Place| {
                let Some((lanes, differences)) = exactly(&base, &setup, place) else {
                    assert_eq!(ruled.request(vertex, place), draw.request(vertex));
                    return;
                };
                let golden = f64::from(ruled.footprint(vertex, place).unwrap()) / 65536.0;
                let exact = exact_footprint::exact(&lanes, &differences, &draw.axes);
                let level = |footprint: f64| {
                    thresholds((footprint * 65536.0) as u32).saturating_sub(1).min(draw.level.levels - 1)
                };
                let got = ruled.request(vertex, place).level;
                assert_eq!(got, level(golden));
                vertices += 1;
                seen[got as usize] += 1;
                if exact >= 1.0 {
                    worst = worst.max((golden / exact - 1.0).abs());
                }
                if got != level(exact) {
                    near += 1;
                    assert!((level(exact / 1.01)..=level(exact * 1.01)).contains(&got), "{golden} for {exact}");
                }
            };
            observe(&format, &base, &mut |step, rung| {
                if step.sends_left() {
                    check(&step.left_vertex, rung.next_left);
                }
                if step.sends_right() {
                    check(&step.right_vertex, rung.next_right);
                }
            });
        }
    }
    println!("{vertices} vertices, F off by {worst:.2e} of it, {near} levels differ at a threshold, by level {seen:?}");
    assert!(vertices > 50_000 && seen.iter().filter(|count| **count > 100).count() >= 4);
    assert!(near * 1000 < vertices && worst < 0.01);
}

#[test]
fn rules_tell_front_from_back() {
    let (scene, format) = rule_body();
    let mut draw = scene.draw(&scene.objects[0], &scene.view(), &format).unwrap();
    (draw.cull, draw.rules.extremum) = (false, ExtremumRule::Triangle);
    let focal = draw.displacement.focal;
    let (mut agree, mut all, mut backs) = (0, 0, 0);
    for index in 0..draw.triangles.len() {
        let Assembled::Kept(base) = draw.assemble(index) else { panic!("base triangle {index} is gone") };
        let is_back = Ruled::new(&draw, &format, &base).reads_minima(&base.data[0]);
        backs += u32::from(is_back);
        let corners = draw.triangles[index].map(|v| &scene.objects[0].mesh.vertices[v as usize]);
        for (corner, data) in corners.iter().zip(&base.data) {
            let (all_lanes, towards) = (draw.lanes.widen(data), (scene.camera.eye - corner.position).normalize());
            let facing = towards.dot(corner.normal.normalize());
            let away = facing::of_vertex(&all_lanes, focal);
            assert!(away == (facing <= 0.0) || facing.abs() < 1e-4, "{facing}");
            // To the left and above by up to 1/16 pixel: a sixteenth of 1 / f.
            let lanes = std::array::from_fn(|k| all_lanes[lane::NORMAL + k]);
            let cosine = facing::exact(lanes, [all_lanes[lane::X], all_lanes[lane::Y]], focal);
            assert!(away == (cosine >= 0.0) || cosine.abs() < 0.15 * 65536.0 / f64::from(focal), "{cosine}");
            all += 1;
            agree += u32::from(away == is_back);
        }
        // From inside of the sphere the other way round.
        let turned = BaseTriangle { corners: base.corners, data: [base.data[1], base.data[0], base.data[2]] };
        let turned_back = Ruled::new(&draw, &format, &turned).reads_minima(&base.data[0]);
        assert!(!(is_back && turned_back));
    }
    println!("{backs} base triangles of {} from the back; {agree} of {all} corners agree", draw.triangles.len());
    assert!(backs > 80 && agree * 10 > all * 8 && agree < all);
    // S is exactly 0 for a normal without length, and counts as away.
    let mut vertex = [0; MAX_COMPONENTS];
    (vertex[lane::X], vertex[lane::C]) = (1 << 20, 1 << 20);
    assert!(facing::of_vertex(&vertex, focal));
    vertex[lane::NORMAL + 2] = -1;
    assert!(!facing::of_vertex(&vertex, focal));
}

/// What the hardware does comes out of the general way, too, triangle by triangle; and other rules change heights.
#[test]
fn rules_of_the_hardware_are_golden() {
    let (mut scene, format) = rule_body();
    scene.remesh.cell_px = 5.0;
    let pyramids = scene.pyramids(&scene.objects[0]).unwrap();
    let mut draw = scene.draw(&scene.objects[0], &scene.view(), &format).unwrap();
    draw.cull = false;
    let collect = |draw: &relief_models::draw::Draw, general: bool| {
        let mut out = Vec::new();
        for index in 0..draw.triangles.len() {
            for piece in draw.assemble(index).pieces() {
                match general {
                    true => Ruled::new(draw, &format, piece).triangles((&pyramids).into(), &mut |t| out.push(t)),
                    false => {
                        relief_models::displacement_pipeline::golden(draw, &format, &pyramids, piece, &mut |t| {
                            out.push(t)
                        });
                    }
                }
            }
        }
        out
    };
    let hardware = collect(&draw, false);
    assert!(hardware.len() > 1000 && hardware == collect(&draw, true));
    for rules in RULES.into_iter().filter(|rules| *rules != Rules::DEFAULT) {
        draw.rules = rules;
        let other = collect(&draw, false);
        assert!(other.len() == hardware.len() && other != hardware, "{rules}");
        assert!(rules.refusal().is_some() || other == collect(&draw, true), "{rules}");
    }
}

#[test]
fn rules_are_read_from_a_scene_and_planning_refuses_those_of_golden() {
    let scene = |remesh: &str| {
        let text = format!(
            "[camera]\neye = [0, -2.6, 1.7]\n[remesh]\ncell_px = 4\n{remesh}\n[[object]]\nmesh = {{ kind = \"grid\" }}\nmap = {{ \
             kind = \"ramp\", size = [30, 9] }}\n"
        );
        parse(&text, "scene.toml", std::path::Path::new(""))
    };
    assert_eq!(scene("").unwrap().remesh.rules, Rules::DEFAULT);
    for rules in RULES {
        let (footprint, extremum) = (rules.footprint.name(), rules.extremum.name());
        let read = scene(&format!("footprint = \"{footprint}\"\nextremum = \"{extremum}\"")).unwrap();
        assert_eq!(read.remesh.rules, rules);
        assert_eq!(read.draw(&read.objects[0], &read.view(), &rule_body().1).unwrap().rules, rules);
        let planner = relief_models::plan::Planner::new(&read, &());
        assert_eq!(planner.err().map(|error| error.to_string()), rules.refusal());
    }
    let refusal = |remesh: &str| scene(remesh).unwrap().remesh.rules.refusal().unwrap();
    let golden_alone = "which no draw of the hardware has, for `relief stability` and `relief wagging`";
    assert_eq!(
        refusal("footprint = \"exact\""),
        format!("`footprint` is \"exact\", {golden_alone}; \"density\" is expected")
    );
    assert_eq!(
        refusal("extremum = \"triangle\""),
        format!("`extremum` is \"triangle\", {golden_alone}; \"vertex\" is expected")
    );
    let unknown = scene("extremum = \"most\"").unwrap_err().to_string();
    assert_eq!(unknown, "scene.toml:5: unknown variant `most`, expected one of `max`, `min`, `vertex`, `triangle`");
}
