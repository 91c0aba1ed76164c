// SPDX-License-Identifier: MIT OR Apache-2.0
//! What each block promises on its streams, beyond what every stream promises.

/// The promises of a block.
#[derive(Clone, Copy, Debug)]
pub struct Contract {
    /// Its name.
    pub block: &'static str,
    /// Requests and answers, where each request has one answer.
    pub exchange: Option<Exchange>,
    /// A formula for the payload.
    pub formula: Option<Formula>,
    /// Cycles from reset in which a beat can be made to wait.
    pub reach: u32,
}

/// Beats that ask, and beats that answer.
#[derive(Clone, Copy, Debug)]
pub struct Exchange {
    /// Whether an accepted beat asks, in Verilog.
    pub asks: &'static str,
    /// Whether a taken beat answers.
    pub answers: &'static str,
    /// Requests that are under way at the most.
    pub under_way: u32,
    /// Cycles in which requests are under way and `out_valid` does not stand, at the most; none where their number depends
    /// on the map.
    pub silence: Option<u32>,
    /// Cycles from reset that are looked at.
    pub cycles: u32,
    /// Whether memories and multipliers may answer anything: the handshake does not depend on them.
    pub cut: bool,
}

/// Says what the payload has to be.
#[derive(Clone, Copy, Debug)]
pub struct Formula {
    /// Verilog that declares what it needs, and asserts under labels that begin with `equal`.
    pub text: &'static str,
    /// What it covers.
    pub range: &'static str,
    /// Cycles from reset that are looked at; none to prove it for all time.
    pub cycles: Option<u32>,
}

const NONE: Contract = Contract { block: "", exchange: None, formula: None, reach: 16 };

/// The contracts of all blocks.
pub const CONTRACTS: [Contract; 10] = [
    Contract {
        block: "vertex_adder",
        exchange: Some(Exchange {
            asks: "1'b1",
            answers: "1'b1",
            under_way: 1,
            silence: Some(0),
            cycles: 40,
            cut: false,
        }),
        formula: Some(Formula {
            text: "
    // A ripple of full adders, lane by lane, is not how the block says it.
    localparam BITS = $bits(out_vertex) / 9;
    reg [$bits(out_vertex)-1:0] x, y;
    wire [$bits(out_vertex)-1:0] sum;
    reg known = 0;
    always @(posedge clock) begin
        if (reset) known <= 0;
        else if (asked) begin
            known <= 1;
            x <= in_vertex;
            y <= in_difference;
        end
    end
    genvar lane, bit_;
    generate for (lane = 0; lane < 9; lane = lane + 1) begin : lanes
        wire [BITS:0] carry;
        assign carry[0] = 1'b0;
        for (bit_ = 0; bit_ < BITS; bit_ = bit_ + 1) begin : bits
            wire a = x[lane * BITS + bit_];
            wire b = y[lane * BITS + bit_];
            assign carry[bit_ + 1] = (a & b) | (carry[bit_] & (a ^ b));
            assign sum[lane * BITS + bit_] = a ^ b ^ carry[bit_];
        end
    end endgenerate
    always @* if (known && out_valid) equal_sum: assert (out_vertex == sum);
",
            range: "all inputs",
            cycles: None,
        }),
        reach: 6,
    },
    Contract { block: "remesher", reach: 0, ..NONE },
    Contract { block: "strip_unit", ..NONE },
    Contract { block: "mip_build", ..NONE },
    Contract {
        block: "mip_fetch",
        exchange: Some(Exchange {
            asks: "in_kind >= 2",
            answers: "1'b1",
            under_way: 22,
            silence: Some(21),
            cycles: 31,
            cut: true,
        }),
        reach: 28,
        ..NONE
    },
    Contract { block: "sat_build", ..NONE },
    Contract {
        block: "sat_fetch",
        exchange: Some(Exchange {
            asks: "in_kind >= 2",
            answers: "1'b1",
            under_way: 12,
            silence: Some(18),
            cycles: 24,
            cut: true,
        }),
        reach: 30,
        ..NONE
    },
    Contract {
        block: "sat_fetch_parallel",
        exchange: Some(Exchange {
            asks: "in_kind >= 2",
            answers: "1'b1",
            under_way: 15,
            silence: Some(15),
            cycles: 20,
            cut: true,
        }),
        reach: 24,
        ..NONE
    },
    Contract {
        block: "sat_average",
        exchange: Some(Exchange {
            asks: "1'b1",
            answers: "1'b1",
            under_way: 1,
            silence: Some(27),
            cycles: 40,
            cut: true,
        }),
        formula: Some(Formula {
            text: "
    reg [9:0] sum;
    reg [3:0] area;
    reg known = 0;
    always @* small_: assume (!in_valid || (in_sum < 256 && in_area >= 1 && in_area < 8));
    always @(posedge clock) if (asked) begin
        known <= 1;
        sum <= in_sum;
        area <= in_area;
    end
    // q is the quotient exactly if area q <= 256 sum + floor(area / 2) < area (q + 1); nothing is divided.
    wire [31:0] numerator = 256 * sum + area / 2;
    always @* if (known && out_valid) begin
        equal_floor: assert (area * out_mean <= numerator);
        equal_next: assert (numerator < area * (out_mean + 33'd1));
    end
",
            range: "sums below 256, areas 1 to 7",
            cycles: Some(32),
        }),
        reach: 40,
    },
    Contract {
        block: "bisector",
        exchange: Some(Exchange {
            asks: "in_kind >= 2",
            answers: "out_end",
            under_way: 1,
            silence: None,
            cycles: 20,
            cut: false,
        }),
        reach: 24,
        ..NONE
    },
];

/// The contract of a block.
pub fn find(block: &str) -> Option<&'static Contract> {
    CONTRACTS.iter().find(|contract| contract.block == block)
}
