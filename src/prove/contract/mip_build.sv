    // Nodes that were asked for: on their way from either memory, in the small memory, and at its head.
    wire [3:0] coming = \block.odd_levels.s1_read_q + \block.odd_levels.s2_read_q + \block.odd_levels.s3_read_q + \block.odd_levels.s4_read_q
        + \block.even_levels.s1_read_q + \block.even_levels.s2_read_q + \block.even_levels.s3_read_q + \block.even_levels.s4_read_q ;
    wire [2:0] kept = \block.feed_in_q - \block.feed_out_q ;
    wire [2:0] state = \block.state_q ;
    wire [4:0] next_level = \block.level_q + 5'd1;
    wire folds = next_level != \block.levels_q ;
    always @* if (started) begin
        counted_answered_stages: assert (under_way == out_valid + \block.spare_valid_q );
        counted_answered_held_spare: assert (!\block.spare_valid_q || out_valid);
        answered_in_time: assert (silent == 0);
        // While a map is taken, nothing waits at the output: the error that a beat of it may be comes with no node.
        held_map: assert (!(\block.level_q == 0 && state >= 1 && state <= 3)
            || (!out_valid && !\block.spare_valid_q ));
        held_levels: assert (state < 3 || next_level <= \block.levels_q );
        held_flush: assert (state != 5 || next_level < \block.levels_q );
        held_folds: assert (!(state >= 2 && state <= 4 || state == 1 && \block.measured_q != 0)
            || \block.folds_q == folds || (\block.level_q != 0 && !\block.feed_valid_q ));
        held_states: assert (state < 6 && (state == 0 || state > 2 || \block.level_q == 0));
        held_room_above: assert (\block.above_map_q == (\block.level_q != 0));
        room_spare: assert (!(\block.sends && \block.spare_valid_q ));
        room_feed: assert (\block.level_q == 0 || \block.feed_room_q + coming + kept + \block.feed_valid_q == 8);
        room_places: assert (\block.level_q == 0 || \block.feed_free_q == (\block.feed_room_q != 0));
        room_level: assert (!\block.advance || coming == 0);
        reached_measure: cover (state == 1);
        reached_check: cover (state == 2);
        reached_run: cover (state == 3);
        reached_poles: cover (state == 4);
        reached_flush: cover (state == 5);
        reached_level: cover (\block.level_q == 2);
    end
