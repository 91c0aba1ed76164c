    always @* if (started) begin
        counted_answered_stage: assert (under_way == out_valid);
        answered_in_time: assert (silent == 0);
    end
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
