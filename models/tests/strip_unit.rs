// SPDX-License-Identifier: MIT OR Apache-2.0
//! Properties of the golden strip unit: the step port's table, and the exact reference on streams that no remesher sends.

use proptest::prelude::*;
use relief_models::step::{Kind, LeftCommand, RightCommand, Step, Vertex};
use relief_models::strip_unit::{StripUnit, exact, golden};

/// A vertex that carries `id`; the odd components stay zero.
fn vertex(id: i64) -> Vertex {
    std::array::from_fn(|c| if c % 2 == 0 { id + c as i64 } else { 0 })
}

fn beat(kind: Kind, left: LeftCommand, right: RightCommand, ids: [i64; 2]) -> Step {
    let (left_vertex, right_vertex) = (vertex(ids[0]), vertex(ids[1]));
    Step { kind, left, right, swap: false, last: false, left_vertex, right_vertex }
}

fn start(ids: [i64; 2]) -> Step {
    beat(Kind::Start, LeftCommand::Set, RightCommand::Set, ids)
}

fn step(left: LeftCommand, right: RightCommand, ids: [i64; 2]) -> Step {
    beat(Kind::Step, left, right, ids)
}

/// Triangles of `steps` by the vertices' names.
fn ids(depth: usize, steps: &[Step]) -> Vec<[i64; 3]> {
    golden(depth, steps).map(|triangle| triangle.map(|v| v[0])).collect()
}

#[test]
fn strip_unit_example_of_the_documentation() {
    let steps = [
        start([1, 2]),
        step(LeftCommand::Set, RightCommand::Ref, [3, 0]),
        step(LeftCommand::Ref, RightCommand::Set, [0, 4]),
    ];
    assert_eq!(ids(0, &steps), [[1, 2, 3], [2, 4, 3]]);
}

#[test]
fn strip_unit_swaps_the_winding() {
    let swapped = |step: Step| Step { swap: true, ..step };
    // Only a Start loads the bit: the step after it says the opposite and is not heard.
    let steps = [swapped(start([1, 2])), step(LeftCommand::Set, RightCommand::Set, [3, 4])];
    assert_eq!(ids(0, &steps), [[1, 3, 2], [2, 3, 4]]);
    let steps = [start([1, 2]), swapped(step(LeftCommand::Set, RightCommand::Set, [3, 4]))];
    assert_eq!(ids(0, &steps), [[1, 2, 3], [2, 4, 3]]);
}

#[test]
fn strip_unit_init_continues_from_the_start_register() {
    let steps = [
        start([1, 2]),
        step(LeftCommand::Set, RightCommand::Set, [3, 4]),
        beat(Kind::Init, LeftCommand::Ref, RightCommand::Set, [0, 5]),
        step(LeftCommand::Set, RightCommand::Ref, [6, 0]),
    ];
    assert_eq!(ids(0, &steps)[2..], [[2, 5, 6]]);
}

#[test]
fn strip_unit_fan_pins_the_left_vertex() {
    let steps = [
        start([1, 2]),
        step(LeftCommand::Set, RightCommand::Edge, [3, 4]),
        beat(Kind::Fan, LeftCommand::Edge, RightCommand::Ref, [0, 0]),
        step(LeftCommand::Set, RightCommand::Ref, [5, 0]),
        beat(Kind::Fan, LeftCommand::Set, RightCommand::Ref, [6, 0]),
        step(LeftCommand::Set, RightCommand::Ref, [7, 0]),
    ];
    assert_eq!(ids(0, &steps)[2..], [[4, 3, 5], [6, 5, 7]]);
}

#[test]
fn strip_unit_left_reads_the_edge_before_right_writes_it() {
    let steps = [
        start([1, 2]),
        step(LeftCommand::Ref, RightCommand::Edge, [0, 3]),
        step(LeftCommand::Edge, RightCommand::Edge, [0, 4]),
    ];
    // (1, 3, 3) and (3, 4, 3) have two equal vertices and are dropped.
    assert_eq!(ids(0, &steps), [[2, 3, 1]]);
    let mut unit = StripUnit::new(0);
    let output = steps.map(|step| unit.accept(&step))[2];
    assert_eq!((output.next_left, output.next_right), (vertex(3), vertex(4)));
    assert!(!output.first_valid && !output.second_valid);
}

#[test]
fn strip_unit_recalls_in_the_order_of_storing() {
    let steps = [
        start([1, 2]),
        step(LeftCommand::Ref, RightCommand::Store, [0, 3]),
        step(LeftCommand::Ref, RightCommand::Store, [0, 4]),
        beat(Kind::Init, LeftCommand::Ref, RightCommand::Set, [0, 5]),
        step(LeftCommand::Recall, RightCommand::Store, [0, 6]),
        step(LeftCommand::Recall, RightCommand::Ref, [0, 0]),
    ];
    assert_eq!(ids(3, &steps)[2..], [[2, 5, 3], [5, 6, 3], [3, 6, 4]]);
}

/// Vertices are told apart by their sending: equal data does not make a triangle degenerate, and a copy does.
#[test]
fn strip_unit_drops_by_identity_and_not_by_data() {
    let steps = [start([1, 1]), step(LeftCommand::Set, RightCommand::Ref, [1, 0])];
    assert_eq!(ids(0, &steps), [[1, 1, 1]]);
    let steps = [
        start([1, 2]),
        step(LeftCommand::Ref, RightCommand::Edge, [0, 3]),
        step(LeftCommand::Edge, RightCommand::Ref, [0, 0]),
    ];
    assert_eq!(ids(0, &steps).len(), 1);
}

#[test]
fn strip_unit_recall_from_nothing_is_an_error_that_stays() {
    let mut unit = StripUnit::new(2);
    unit.accept(&start([1, 2]));
    let output = unit.accept(&step(LeftCommand::Recall, RightCommand::Store, [0, 3]));
    assert!(unit.error() && !output.first_valid && output.second_valid);
    assert_eq!((output.next_left, output.next_right, unit.stored()), (vertex(1), vertex(3), 1));
    unit.accept(&start([1, 2]));
    assert!(unit.error());
    assert_eq!(unit.stored(), 0);
}

#[test]
fn strip_unit_store_into_a_full_memory_is_an_error_that_stays() {
    let mut unit = StripUnit::new(1);
    unit.accept(&start([1, 2]));
    unit.accept(&step(LeftCommand::Ref, RightCommand::Store, [0, 3]));
    assert!(!unit.error());
    // Full before the beat, though the recall of the same beat makes room.
    let output = unit.accept(&step(LeftCommand::Recall, RightCommand::Store, [0, 4]));
    assert!(unit.error());
    assert_eq!((unit.stored(), output.next_left, output.next_right), (0, vertex(3), vertex(4)));
}

fn any_left() -> impl Strategy<Value = LeftCommand> {
    prop::sample::select(vec![LeftCommand::Ref, LeftCommand::Set, LeftCommand::Recall, LeftCommand::Edge])
}

fn any_right() -> impl Strategy<Value = RightCommand> {
    prop::sample::select(vec![RightCommand::Ref, RightCommand::Set, RightCommand::Store, RightCommand::Edge])
}

/// Beats with any command, as a broken sender might send them.
fn any_beats() -> impl Strategy<Value = Vec<Step>> {
    let kind = prop_oneof![
        8 => Just(Kind::Step), 1 => Just(Kind::Start), 2 => Just(Kind::Init), 1 => Just(Kind::Fan)
    ];
    let value = prop_oneof![Just(i64::MIN), Just(i64::MAX), any::<i64>()];
    let one = (kind, any_left(), any_right(), any::<bool>(), value.clone(), value);
    prop::collection::vec(one, 0..200).prop_map(|beats| {
        beats
            .into_iter()
            .map(|(kind, left, right, swap, l, r)| Step {
                kind,
                left,
                right,
                swap,
                last: false,
                left_vertex: [l; 16],
                right_vertex: [r; 16],
            })
            .collect()
    })
}

/// The beats made legal: a Start first, the commands that their kind allows, nothing recalled or referred to that is not
/// there, and vertices numbered in the order of sending.
fn legal(beats: Vec<Step>) -> Vec<Step> {
    let (mut stored, mut edge, mut sent) = (0, false, 0);
    let mut number = |sends: bool| {
        sent += i64::from(sends);
        [if sends { sent } else { 0 }; 16]
    };
    let first = start([0, 0]);
    [first]
        .into_iter()
        .chain(beats)
        .map(|mut beat| {
            match beat.kind {
                Kind::Start => (beat.left, beat.right, stored) = (LeftCommand::Set, RightCommand::Set, 0),
                Kind::Init => (beat.left, beat.right) = (LeftCommand::Ref, RightCommand::Set),
                Kind::Fan => {
                    beat.left = if edge { LeftCommand::Edge } else { LeftCommand::Set };
                    beat.right = RightCommand::Ref;
                }
                Kind::Step => {
                    match beat.left {
                        LeftCommand::Recall if stored > 0 => stored -= 1,
                        LeftCommand::Edge if edge => {}
                        LeftCommand::Recall | LeftCommand::Edge => beat.left = LeftCommand::Set,
                        LeftCommand::Ref | LeftCommand::Set => {}
                    }
                    stored += usize::from(beat.right == RightCommand::Store);
                    edge |= beat.right == RightCommand::Edge;
                }
            }
            beat.left_vertex = number(beat.sends_left());
            beat.right_vertex = number(beat.sends_right());
            beat
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2_000, ..ProptestConfig::default() })]

    #[test]
    fn strip_unit_matches_exact_on_any_legal_stream(beats in any_beats()) {
        let steps = legal(beats);
        let indices: Vec<_> = golden(steps.len(), &steps).map(|triangle| triangle.map(|v| v[0] as usize - 1)).collect();
        prop_assert_eq!(Some(indices), exact(&steps));
    }

    #[test]
    fn strip_unit_survives_any_stream(beats in any_beats(), depth in 0..4usize) {
        let mut unit = StripUnit::new(depth);
        let mut error = false;
        for beat in &beats {
            let output = unit.accept(beat);
            prop_assert!(unit.error() || !error, "the error flag was cleared");
            prop_assert!(unit.stored() <= depth);
            prop_assert!(beat.kind == Kind::Step || !(output.first_valid || output.second_valid));
            prop_assert!(beat.left != LeftCommand::Ref || !output.first_valid);
            prop_assert!(beat.right != RightCommand::Ref || !output.second_valid);
            error = unit.error();
        }
    }
}
