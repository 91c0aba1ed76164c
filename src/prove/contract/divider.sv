    // Any division in range, by / and % of positive numbers.
    localparam Q = $bits(low);
    localparam N = $bits(high) + Q + 1;
    wire signed [N-1:0] given = $signed({high, low});
    wire signed [N-1:0] limit = $signed(divisor);
    wire signed [N-1:0] beyond = limit <<< Q;
    always @* always_in_range: assume (limit > 0 && limit < (1 << ($bits(high) - 2)) && given >= -beyond && given < beyond);
    // Made positive: x + y 2^Q, which leaves the lower Q bits of the quotient as they are.
    reg [N-1:0] x, y;
    reg known = 0;
    always @(posedge clock) begin
        if (reset || done) known <= !reset;
        if (start && !busy) begin
            known <= 0;
            x <= given + beyond;
            y <= limit;
        end
    end
    wire [$bits(x)-1:0] whole = x / y;
    wire [$bits(x)-1:0] rest = x % y;
    reg [7:0] waited = 0;
    always @(posedge clock) waited <= !reset && busy ? waited + 1 : 0;
    always @* if (started) begin
        if (known) equal_quotient: assert (quotient == whole[Q-1:0] && remainder == rest);
        answered_steps: assert (\block.last_q == (busy && \block.count_q == 1)
            && (busy ? \block.count_q >= 1 && waited + \block.count_q == Q + 1 : \block.count_q == 0));
        answered_in_time: assert (waited <= Q + 1);
        reached_result: cover (known);
        reached_negative: cover (known && x < (y << Q));
    end
