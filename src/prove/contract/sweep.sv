    // Every state is reached, and so is every micro-operation.
    always @* if (started) begin
        reached_state_1: cover (\block.state_q == 1);
        reached_state_2: cover (\block.state_q == 2);
        reached_state_3: cover (\block.state_q == 3);
        reached_state_4: cover (\block.state_q == 4);
        reached_state_5: cover (\block.state_q == 5);
        reached_state_6: cover (\block.state_q == 6);
        reached_state_7: cover (\block.state_q == 7);
        reached_state_8: cover (\block.state_q == 8);
        reached_state_9: cover (\block.state_q == 9);
        reached_state_10: cover (\block.state_q == 10);
        reached_op_0: cover (op_valid && op_code == 0);
        reached_op_1: cover (op_valid && op_code == 1);
        reached_op_2: cover (op_valid && op_code == 2);
        reached_op_3: cover (op_valid && op_code == 3);
        reached_op_4: cover (op_valid && op_code == 4);
        reached_op_5: cover (op_valid && op_code == 5);
        reached_op_6: cover (op_valid && op_code == 6);
        reached_op_7: cover (op_valid && op_code == 7);
        held_moves: assert (!op_valid || moved);
    end
    // Nothing moves without room.
    reg moved = 0;
    always @(posedge clock) moved <= !reset && room;
    // A base triangle is over within so many cycles, whatever the registers held before: all those of up to 3 voxels, in the
    // plane of their corners A at (0, 0), B and C, with the longest edge from A to B.
    (* anyconst *) reg signed [5:0] s_b, s_c, d_b, d_c, n_ac, n_bc;
    wire signed [5:0] c_b = s_b - s_c;
    wire signed [5:0] rise = d_b - d_c;
    wire signed [5:0] d_bc = rise < 0 ? -rise : rise;
    wire signed [5:0] d_ab = d_b < 0 ? -d_b : d_b;
    reg [7:0] busy = 0;
    always @(posedge clock) busy <= reset || \block.state_q == 0 ? 0 : busy + 1;
    always @* begin
        answered_plane: assume (0 < s_b && s_b <= 3 && 0 <= s_c && s_c <= s_b && d_ab <= s_b && 0 <= d_c && s_b * d_c >= d_b * s_c);
        answered_edges: assume (d_c <= n_ac && s_c <= n_ac && n_ac <= s_b && d_bc <= n_bc && c_b <= n_bc && n_bc <= s_b);
        answered_record: assume (record_n_ab == s_b && record_n_ac == n_ac && record_n_bc == n_bc && record_s_b == s_b
            && record_s_c == s_c && record_d_b == d_b && record_d_c == d_c && record_roof == (d_c > d_b) && !record_point);
        answered_moves: assume (record_valid && room);
    end
    always @* if (started) answered_in_time: assert (busy < 24);
