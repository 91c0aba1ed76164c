// SPDX-License-Identifier: MIT OR Apache-2.0
// Holds up a stream at random: a beat that was shown stays until it is taken. Between two blocks, for simulation only.
`default_nettype none

module relief_stall_gate #(
    parameter [31:0] SEED = 32'd1,
    parameter [6:0] CLOSED = 7'd0 // of 128 cycles, about
) (
    input  wire clock,
    input  wire reset,
    input  wire source_valid,
    output wire source_ready,
    output wire sink_valid,
    input  wire sink_ready
);
    // Xorshift (Marsaglia 2003).
    reg  [31:0] state_q;
    wire [31:0] first = state_q ^ (state_q << 13);
    wire [31:0] second = first ^ (first >> 17);
    wire [31:0] third = second ^ (second << 5);
    reg open_q;
    assign sink_valid = source_valid && open_q;
    assign source_ready = sink_ready && open_q;
    always @(posedge clock) begin
        if (reset) begin
            state_q <= SEED;
            open_q <= 1'b0;
        end else begin
            state_q <= third;
            open_q <= (sink_valid && !sink_ready) || third[30:24] >= CLOSED;
        end
    end
endmodule

`default_nettype wire
