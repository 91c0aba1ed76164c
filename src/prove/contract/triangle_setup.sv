    // Each state is left in time, and for a later one; the last one waits for the sweep.
    always @* always_idle_units: assume (!units_busy);
    reg [7:0] same = 0;
    reg [3:0] was = 0;
    wire [3:0] state = \block.state_q ;
    always @(posedge clock) begin
        was <= reset ? 0 : state;
        same <= reset || state == 0 || (record_valid && !record_ready) || state != was ? 0 : same + 1;
    end
    always @* if (started) begin
        answered_order: assert (state == was || state == 0 || state > was);
        answered_states: assert (state < 15);
        answered_in_time: assert (same <= 8);
        reached_1: cover (state == 1);
        reached_2: cover (state == 2);
        reached_3: cover (state == 3);
        reached_4: cover (state == 4);
        reached_5: cover (state == 5);
        reached_6: cover (state == 6);
        reached_7: cover (state == 7);
        reached_8: cover (state == 8);
        reached_9: cover (state == 9);
        reached_10: cover (state == 10);
        reached_11: cover (state == 11);
        reached_12: cover (state == 12);
        reached_13: cover (state == 13);
        reached_14: cover (state == 14);
    end
