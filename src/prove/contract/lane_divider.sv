    // Any division in range, by / and % of positive numbers. The divisor stands a cycle after the start, the numerator two.
    localparam Q = $bits(low);
    localparam N = $bits(high) + Q + 1;
    reg [1:0] begun = 0;
    reg [2:0] ended = 0;
    wire signed [N-1:0] given = $signed({high, low});
    wire signed [N-1:0] limit = $signed(divisor);
    reg signed [N-1:0] y;
    wire signed [N-1:0] beyond = y <<< Q;
    always @* always_divisor: assume (!begun[0] || (limit > 0 && limit < (1 << ($bits(high) - 2))));
    always @* always_numerator: assume (!begun[1] || (given >= -beyond && given < beyond));
    // A division may begin two cycles behind `done`.
    always @* always_calm: assume (!(start && (done || ended[0])));
    // Made positive: x + y 2^Q, which leaves the lower Q bits of the quotient as they are.
    reg [N-1:0] x;
    always @(posedge clock) begin
        begun <= reset ? 0 : {begun[0], start && !busy};
        ended <= reset ? 0 : {ended[1:0], done};
        if (begun[0]) y <= limit;
        if (begun[1]) x <= given + beyond;
    end
    wire [N-1:0] whole = x / y;
    wire [N-1:0] rest = x % y;
    reg [7:0] waited = 0;
    always @(posedge clock) waited <= !reset && busy ? waited + 1 : 0;
    always @* if (started) begin
        if (ended[2]) equal_quotient: assert (quotient == whole[Q-1:0] && remainder == rest);
        answered_steps: assert (\block.last_q == (busy && \block.count_q == 1)
            && (busy ? \block.count_q >= 1 && waited + \block.count_q == Q + 1 : \block.count_q == 0));
        answered_in_time: assert (waited <= Q + 1);
        reached_result: cover (ended[2]);
        reached_negative: cover (ended[2] && x < (y << Q));
    end
