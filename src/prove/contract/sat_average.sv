    wire busy = \block.s2_quotient.working_q ;
    wire [7:0] left = \block.s2_quotient.count_q ;
    always @* if (started) begin
        counted_answered_stages: assert (under_way == \block.s1_valid_q + busy + \block.s3_valid_q && under_way <= 1);
        counted_answered_steps: assert (\block.s2_quotient.last_q == (busy && left == 1) && (!busy || (left >= 1 && left <= 25)));
        answered_age: assert (under_way == 0 || out_valid || (busy ? silent + left <= 26 : silent == 0));
        answered_in_time: assert (silent <= 26);
    end
    // q is the quotient exactly if area q <= 256 sum + floor(area / 2) < area (q + 1); nothing is divided.
    reg [9:0] sum;
    reg [3:0] area;
    reg known = 0;
    always @* equal_small: assume (!in_valid || (in_sum < 256 && in_area >= 1 && in_area < 8));
    always @(posedge clock) if (asked) begin
        known <= 1;
        sum <= in_sum;
        area <= in_area;
    end
    wire [31:0] numerator = 256 * sum + area / 2;
    always @* if (known && out_valid) begin
        equal_floor: assert (area * out_mean <= numerator);
        equal_next: assert (numerator < area * (out_mean + 33'd1));
    end
