// SPDX-License-Identifier: MIT OR Apache-2.0
//! What each block promises on its streams, and what parts of blocks promise that a solver sees through alone.
//!
//! The promises are Verilog (`src/prove/contract/*.sv`) in a module round the block (`wrapper`): labels begin with the
//! names of its properties, and `\block.x ` is the signal `x` of the block, or of an instance within it.

use relief_hdl::mip_build::ExtremaMemory;
use relief_hdl::primitives::Divider;
use relief_hdl::remesher::{EdgeSetup, InteriorSetup, LaneDivider, Sweep, TriangleSetup};
use relief_hdl::verilog::{Emission, EmitError, emit};

use super::Property;

/// The promises of a block, or of a part.
#[derive(Clone, Copy, Debug)]
pub struct Contract {
    /// Its name.
    pub name: &'static str,
    /// A part is emitted alone, at widths of its own; a block at the width set that is asked for.
    pub part: Option<Part>,
    /// Requests and answers, where the block counts them.
    pub exchange: Option<Exchange>,
    /// Assertions and covers.
    pub text: &'static str,
    /// How the assertions are proved.
    pub claims: &'static [Claim],
    /// Cycles from reset in which all covers are reached; 0 where that takes longer than a solver sees.
    pub reach: u32,
    /// Properties that hold whatever memories and multipliers answer.
    pub cut: &'static [Property],
    /// Instances in the top module that may send anything: what is proved holds whatever they do.
    pub loose: &'static [&'static str],
    /// Properties that are not proved, and why.
    pub open: &'static [(Property, &'static str)],
    /// Faults in the block itself, for properties that no wire round it can break.
    pub faults: &'static [Fault],
}

/// A part, at widths of its own.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// The block that it is of.
    pub of: &'static str,
    /// Its widths, in words.
    pub widths: &'static str,
    /// Its Verilog.
    pub emit: fn() -> Result<Emission, EmitError>,
}

/// Beats that ask, and beats that answer.
#[derive(Clone, Copy, Debug)]
pub struct Exchange {
    /// When a request begins, in Verilog.
    pub asks: &'static str,
    /// Whether a taken beat answers.
    pub answers: &'static str,
}

/// A property that the text asserts.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// Which.
    pub property: Property,
    /// Cycles from reset that are looked at.
    pub cycles: u32,
    /// Steps of an induction; none where it does not close.
    pub induction: Option<u32>,
    /// What it covers, where that is not everything.
    pub range: &'static str,
}

/// A change of the emitted text that breaks a property.
#[derive(Clone, Copy, Debug)]
pub struct Fault {
    /// The property.
    pub property: Property,
    /// The module, without the prefix that all have.
    pub module: &'static str,
    /// A piece of its text, and what comes instead.
    pub change: (&'static str, &'static str),
}

const fn induction(property: Property, steps: u32) -> Claim {
    Claim { property, cycles: steps + 1, induction: Some(steps), range: "" }
}

const fn bounded(property: Property, cycles: u32, range: &'static str) -> Claim {
    Claim { property, cycles, induction: None, range }
}

const fn fault(property: Property, module: &'static str, from: &'static str, to: &'static str) -> Fault {
    Fault { property, module, change: (from, to) }
}

const STREAM: &[Claim] = &[induction(Property::Counted, 3), induction(Property::Answered, 3)];

const NONE: Contract = Contract {
    name: "",
    part: None,
    exchange: Some(Exchange { asks: "asked", answers: "1'b1" }),
    text: "",
    claims: STREAM,
    reach: 16,
    cut: &[Property::Counted, Property::Answered, Property::Room],
    loose: &[],
    open: &[],
    faults: &[],
};

const FETCH: Contract = Contract {
    exchange: Some(Exchange { asks: "asked && in_kind >= 2", answers: "1'b1" }),
    cut: &[Property::Held, Property::Counted, Property::Answered, Property::Equal, Property::Room],
    ..NONE
};

/// A straight pipeline, all of whose handshake is a `Flow`.
const PIPELINE: Contract = Contract {
    text: concat!(
        "    wire [$bits(\\block.flow.sending_q )-1:0] sending = \\block.flow.sending_q ;\n",
        include_str!("contract/pipeline.sv")
    ),
    claims: &[induction(Property::Counted, 3), induction(Property::Answered, 3), induction(Property::Room, 3)],
    cut: &[Property::Held, Property::Counted, Property::Answered, Property::Room, Property::Reached],
    ..NONE
};

const PART: Contract = Contract { exchange: None, cut: &[], ..NONE };

/// All contracts: those of the blocks, then those of parts.
pub const CONTRACTS: [Contract; 32] = [
    Contract {
        name: "vertex_adder",
        text: include_str!("contract/vertex_adder.sv"),
        claims: &[induction(Property::Counted, 3), induction(Property::Answered, 3), induction(Property::Equal, 3)],
        reach: 6,
        cut: &[],
        ..NONE
    },
    Contract {
        name: "remesher",
        exchange: Some(Exchange { asks: r"\block.queue.in_valid ", answers: "1'b1" }),
        text: include_str!("contract/remesher.sv"),
        claims: &[induction(Property::Counted, 3), induction(Property::Answered, 3), induction(Property::Room, 3)],
        reach: 0,
        faults: &[
            fault(Property::Answered, "step_queue", "held_d = 1'b1", "held_d = held_q"),
            fault(Property::Room, "step_queue", "waiting_q < 5'd7", "waiting_q < 5'd15"),
        ],
        ..NONE
    },
    Contract {
        name: "strip_unit",
        exchange: Some(Exchange { asks: r"asked && (\block.first || \block.second || in_last)", answers: "1'b1" }),
        text: include_str!("contract/strip_unit.sv"),
        claims: &[
            induction(Property::Counted, 3),
            induction(Property::Answered, 8),
            induction(Property::Equal, 3),
            induction(Property::Room, 3),
        ],
        reach: 26,
        cut: &[Property::Counted, Property::Answered, Property::Equal, Property::Room, Property::Reached],
        faults: &[
            fault(Property::Answered, "column_memory", "room_d = used_q < 5'd14", "room_d = 1'b0"),
            fault(Property::Equal, "strip_unit", "right_stored_q && column_single", "right_stored_q"),
            fault(Property::Room, "column_memory", "used_q < 5'd14", "used_q < 5'd16"),
        ],
        ..NONE
    },
    Contract {
        name: "mip_build",
        exchange: Some(Exchange { asks: r"\block.sends ", answers: "1'b1" }),
        text: include_str!("contract/mip_build.sv"),
        claims: &[induction(Property::Counted, 3), induction(Property::Answered, 3), bounded(Property::Room, 30, "")],
        reach: 50,
        cut: &[Property::Held, Property::Counted, Property::Answered, Property::Room, Property::Reached],
        faults: &[
            fault(
                Property::Answered,
                "mip_build",
                "sent_valid_d = spare_valid_q || sends",
                "sent_valid_d = spare_valid_q",
            ),
            fault(Property::Room, "mip_build", "feed_free_d = feed_room_q != 4'd1", "feed_free_d = 1'b1"),
        ],
        ..NONE
    },
    Contract {
        name: "mip_fetch",
        text: include_str!("contract/mip_fetch.sv"),
        claims: &[induction(Property::Counted, 3), induction(Property::Answered, 3), induction(Property::Room, 3)],
        reach: 28,
        faults: &[fault(Property::Room, "mip_fetch", "moves_d = !spare_behind", "moves_d = 1'b1")],
        ..FETCH
    },
    Contract {
        name: "sat_build",
        exchange: Some(Exchange { asks: r"asked && in_kind == 1 && \block.active_q ", answers: "1'b1" }),
        text: include_str!("contract/sat_build.sv"),
        faults: &[fault(Property::Answered, "sat_build", "s3_valid_d = s2_valid_q", "s3_valid_d = 1'b0")],
        ..NONE
    },
    Contract {
        name: "sat_fetch",
        text: include_str!("contract/sat_fetch.sv"),
        claims: &[induction(Property::Counted, 3), induction(Property::Answered, 3), induction(Property::Equal, 3)],
        reach: 30,
        ..FETCH
    },
    Contract {
        name: "sat_fetch_parallel",
        text: include_str!("contract/sat_fetch_parallel.sv"),
        claims: &[
            induction(Property::Counted, 3),
            induction(Property::Answered, 3),
            induction(Property::Equal, 3),
            induction(Property::Room, 3),
        ],
        reach: 26,
        faults: &[fault(Property::Room, "sat_fetch_parallel", "moves_d = !spare_behind", "moves_d = 1'b1")],
        ..FETCH
    },
    Contract {
        name: "sat_average",
        text: include_str!("contract/sat_average.sv"),
        claims: &[
            induction(Property::Counted, 3),
            induction(Property::Answered, 3),
            bounded(Property::Equal, 32, "sums below 256, areas 1 to 7"),
        ],
        reach: 40,
        ..NONE
    },
    Contract {
        name: "bisector",
        exchange: Some(Exchange { asks: "asked && in_kind >= 2", answers: "out_end" }),
        text: include_str!("contract/bisector.sv"),
        claims: &[bounded(Property::Counted, 24, ""), induction(Property::Room, 3)],
        reach: 45,
        cut: &[Property::Room, Property::Reached],
        open: &[(
            Property::Held,
            "not proved: no induction closes, and its first beat is further from reset than the solver sees; the tests see it",
        )],
        faults: &[fault(Property::Room, "bisector_queue", "{!held_q[3]} && {!held_q[4]}", "{!held_q[4]}")],
        ..NONE
    },
    Contract {
        name: "reciprocal",
        reach: 25,
        faults: &[fault(Property::Room, "flow_17_of_32", "moves_d = !spare_behind", "moves_d = 1'b1")],
        ..PIPELINE
    },
    Contract {
        name: "rsqrt",
        reach: 32,
        faults: &[fault(Property::Room, "flow_24_of_32", "moves_d = !spare_behind", "moves_d = 1'b1")],
        ..PIPELINE
    },
    Contract {
        name: "perspective_correct",
        reach: 48,
        faults: &[fault(Property::Room, "flow_40_of_58", "moves_d = !spare_behind", "moves_d = 1'b1")],
        ..PIPELINE
    },
    Contract {
        name: "filter_level",
        reach: 72,
        faults: &[fault(Property::Room, "flow_64_of_36", "moves_d = !spare_behind", "moves_d = 1'b1")],
        ..PIPELINE
    },
    Contract {
        name: "exact_footprint",
        // A vertex stands before the flow for its eight products.
        text: concat!(
            "    wire [$bits(\\block.flow.sending_q )+$bits(\\block.s2_factors.before_q )-1:0] sending =\n",
            "        {\\block.flow.sending_q , \\block.s2_factors.before_q };\n",
            include_str!("contract/pipeline.sv")
        ),
        reach: 70,
        faults: &[fault(Property::Room, "flow_43_of_36", "moves_d = !spare_behind", "moves_d = 1'b1")],
        ..PIPELINE
    },
    Contract {
        name: "facing",
        reach: 19,
        faults: &[fault(Property::Room, "flow_11_of_1", "moves_d = !spare_behind", "moves_d = 1'b1")],
        ..PIPELINE
    },
    Contract {
        name: "displace",
        reach: 96,
        faults: &[fault(Property::Room, "flow_88_of_102", "moves_d = !spare_behind", "moves_d = 1'b1")],
        ..PIPELINE
    },
    Contract {
        name: "power",
        reach: 36,
        faults: &[fault(Property::Room, "flow_28_of_17", "moves_d = !spare_behind", "moves_d = 1'b1")],
        ..PIPELINE
    },
    Contract {
        name: "face_normal",
        reach: 89,
        faults: &[fault(Property::Room, "flow_81_of_54", "moves_d = !spare_behind", "moves_d = 1'b1")],
        ..PIPELINE
    },
    Contract {
        name: "gradient_normal",
        reach: 80,
        faults: &[fault(Property::Room, "flow_72_of_54", "moves_d = !spare_behind", "moves_d = 1'b1")],
        ..PIPELINE
    },
    Contract {
        name: "light",
        // Its first stages stand before the flow.
        text: concat!(
            "    wire [$bits(\\block.flow.sending_q )+$bits(\\block.before_q )-1:0] sending =\n",
            "        {\\block.flow.sending_q , \\block.before_q };\n",
            include_str!("contract/pipeline.sv")
        ),
        reach: 153,
        faults: &[fault(Property::Room, "flow_100_of_24", "moves_d = !spare_behind", "moves_d = 1'b1")],
        ..PIPELINE
    },
    Contract {
        name: "vertex_transform",
        exchange: Some(Exchange {
            asks: r"asked && in_kind != 0 && \block.running_q && \block.begun_q ",
            answers: "1'b1",
        }),
        text: include_str!("contract/vertex_transform.sv"),
        claims: &[induction(Property::Counted, 3), induction(Property::Answered, 3), induction(Property::Room, 3)],
        reach: 0,
        cut: &[Property::Held, Property::Counted, Property::Answered, Property::Room],
        faults: &[
            fault(Property::Answered, "vertex_transform", "sent_d = older_q", "sent_d = 1'b0"),
            fault(Property::Room, "vertex_transform", "{!sent_q} || out_ready", "1'b1"),
        ],
        ..NONE
    },
    Contract {
        name: "cull",
        reach: 10,
        faults: &[fault(Property::Room, "flow_2_of_5", "moves_d = !spare_behind", "moves_d = 1'b1")],
        ..PIPELINE
    },
    Contract {
        name: "clip",
        exchange: Some(Exchange { asks: r"asked && \block.next_vertices_q == 2", answers: "out_last" }),
        text: include_str!("contract/clip.sv"),
        claims: &[induction(Property::Counted, 3)],
        reach: 0,
        cut: &[Property::Held, Property::Counted],
        ..NONE
    },
    Contract {
        name: "displacement_pipeline",
        exchange: None,
        claims: &[],
        reach: 0,
        cut: &[],
        loose: &["assembly", "remesher", "passer", "skip", "vertices", "strip_unit", "shading", "counters"],
        ..NONE
    },
    Contract {
        name: "divider",
        part: Some(Part {
            of: "sat_average",
            widths: "quotients of 4 bits, remainders of 6",
            emit: || emit(&Divider::<1, 4, 6>::default()),
        }),
        text: include_str!("contract/divider.sv"),
        claims: &[
            bounded(Property::Equal, 9, "all numerators and divisors in range"),
            induction(Property::Answered, 3),
        ],
        faults: &[
            fault(Property::Equal, "divider_1x4_by_6", "minus_y_d = -divisor", "minus_y_d = ~divisor"),
            fault(Property::Answered, "divider_1x4_by_6", "count_q == 8'd2", "count_q == 8'd1"),
        ],
        ..PART
    },
    Contract {
        name: "lane_divider",
        part: Some(Part {
            of: "remesher",
            widths: "quotients of 4 bits, remainders of 6",
            emit: || emit(&LaneDivider::<1, 4, 6>::default()),
        }),
        text: include_str!("contract/lane_divider.sv"),
        claims: &[
            bounded(Property::Equal, 12, "all numerators and divisors in range"),
            induction(Property::Answered, 3),
        ],
        faults: &[
            fault(Property::Equal, "lane_divider_1x4_by_6", "near_minus_d = -divisor", "near_minus_d = ~divisor"),
            fault(Property::Answered, "lane_divider_1x4_by_6", "count_q == 8'd2", "count_q == 8'd1"),
        ],
        ..PART
    },
    Contract {
        name: "extrema_memory",
        part: Some(Part { of: "mip_build", widths: "2 nodes", emit: || emit(&ExtremaMemory::<1>::default()) }),
        text: include_str!("contract/extrema_memory.sv"),
        claims: &[bounded(Property::Equal, 13, "all operations, values below 8")],
        faults: &[fault(Property::Equal, "extrema_memory_1", "s2_fourth_q || s2_fifth_q", "s2_fourth_q")],
        ..PART
    },
    Contract {
        name: "edge_setup",
        part: Some(Part {
            of: "remesher",
            widths: "a component of 4 bits, quotients of 7",
            emit: || emit(&EdgeSetup::<1, 4, 7, 9, 6>::default()),
        }),
        text: include_str!("contract/edge_setup.sv"),
        claims: &[induction(Property::Answered, 18)],
        reach: 40,
        faults: &[fault(Property::Answered, "edge_setup", "finished_d = divider_done", "finished_d = 1'b0")],
        ..PART
    },
    Contract {
        name: "interior_setup",
        part: Some(Part {
            of: "remesher",
            widths: "a component of 28 bits, quotients of 32",
            emit: || emit(&InteriorSetup::<1, 28, 32, 6, 9, 38>::default()),
        }),
        text: include_str!("contract/interior_setup.sv"),
        claims: &[induction(Property::Answered, 48)],
        reach: 24,
        faults: &[fault(Property::Answered, "interior_setup", "finished_d = divider_done", "finished_d = 1'b0")],
        ..PART
    },
    Contract {
        name: "triangle_setup",
        part: Some(Part {
            of: "remesher",
            widths: "coordinates of 3 bits, a component of 4",
            emit: || emit(&TriangleSetup::<1, 4, 3, 6, 9>::default()),
        }),
        text: include_str!("contract/triangle_setup.sv"),
        claims: &[induction(Property::Answered, 12)],
        reach: 40,
        faults: &[fault(Property::Answered, "triangle_setup", "round_q + 3'd1", "round_q")],
        ..PART
    },
    Contract {
        name: "sweep",
        part: Some(Part { of: "remesher", widths: "scalars of 6 bits", emit: || emit(&Sweep::<6>::default()) }),
        text: include_str!("contract/sweep.sv"),
        claims: &[
            induction(Property::Held, 3),
            bounded(Property::Answered, 27, "all base triangles of up to 3 voxels"),
        ],
        reach: 24,
        faults: &[
            fault(Property::Held, "sweep", "out_valid_d = 1'b0", "out_valid_d = out_valid_q"),
            fault(
                Property::Answered,
                "sweep",
                "last_column_d = columns_q == 6'sd2",
                "last_column_d = columns_q == 6'sd1",
            ),
        ],
        ..PART
    },
];

/// The contract of a block or a part.
pub fn find(name: &str) -> Option<&'static Contract> {
    CONTRACTS.iter().find(|contract| contract.name == name)
}
