    // Each state is left in time, and for a later one.
    always @* always_calm: assume (!(start && busy));
    reg [7:0] same = 0;
    reg [3:0] was = 0;
    wire [3:0] state = \block.state_q ;
    always @(posedge clock) begin
        was <= reset ? 0 : state;
        same <= reset || state == 0 || state != was ? 0 : same + 1;
    end
    always @* if (started) begin
        answered_steps: assert (\block.divider.last_q == (\block.divider.working_q && \block.divider.count_q == 1)
            && (!\block.divider.working_q || (\block.divider.count_q >= 1 && \block.divider.count_q <= 33)));
        answered_order: assert (state == was || state == 0 || state > was);
        answered_in_time: assert (same <= 45);
        reached_side_products: cover (state == 1);
        reached_side_quotient: cover (state == 2);
    end
