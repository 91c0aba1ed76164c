    // Each state is left in time, and for a later one.
    always @* always_calm: assume (!(start && busy));
    reg [7:0] same = 0;
    reg [3:0] was = 0;
    wire [3:0] state = \block.state_q ;
    // `begun` has no reset, and is right a cycle after it.
    reg settled = 0;
    always @(posedge clock) settled <= started;
    always @(posedge clock) begin
        was <= reset ? 0 : state;
        same <= reset || state == 0 || state != was ? 0 : same + 1;
    end
    always @* if (started) begin
        answered_runs: assert (\block.running_q == \block.divider.working_q
            && !(\block.divider.working_q && \block.finished_q ) && (state != 0 || !\block.running_q )
            && (!settled || \block.begun_q == \block.divider.begun_q ) && (!\block.due_q || state != 0));
        // The edge of a state is ahead, or has been taken up.
        answered_ahead: assert (state == 0 || \block.ahead_q ==
            (\block.running_q || \block.finished_q ? state : state - 4'd1));
        answered_due: assert (!(\block.due_q && (\block.running_q || \block.finished_q )));
        answered_steps: assert (\block.divider.last_q == (\block.divider.working_q && \block.divider.count_q == 1)
            && (!\block.divider.working_q || (\block.divider.count_q >= 1 && \block.divider.count_q <= 8)));
        answered_order: assert (state == was || state == 0 || state > was);
        answered_in_time: assert (same <= 15);
        reached_first: cover (state == 1);
        reached_second: cover (state == 2);
        reached_third: cover (state == 3);
    end
