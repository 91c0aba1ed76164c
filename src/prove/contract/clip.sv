    // A triangle is under way from its third vertex until the last one of its polygon is taken.
    wire [4:0] state = \block.state_q ;
    always @* if (started) begin
        counted_held_state: assert (state <= 28);
        counted_taken: assert (\block.taking_q == (state == 1));
        counted_held_sent: assert (\block.sent_q == (state == 28));
        counted_stages: assert (under_way == (state > 1));
    end
