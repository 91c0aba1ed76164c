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
        held_room: assert (!op_valid || moved);
    end
    // Nothing moves without room.
    reg moved = 0;
    always @(posedge clock) moved <= !reset && room;
