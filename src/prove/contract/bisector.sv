    // Beats in the outlet, and on their way there, which nothing stops; leaves in the queue.
    wire [4:0] beats = \block.outlet.tail_q - \block.outlet.head_q ;
    wire [4:0] leaves = \block.queue.tail_q - \block.queue.head_q ;
    wire [6:0] coming = {\block.vertices.s7_sent_q ,
        \block.vertices.s6_sends_q || \block.vertices.s6_end_q , \block.vertices.s5_sends_q || \block.vertices.s5_end_q ,
        \block.vertices.s4_sends_q || \block.vertices.s4_end_q , \block.vertices.s3_sends_q || \block.vertices.s3_end_q ,
        \block.vertices.s2_sends_q || \block.vertices.s2_end_q , \block.vertices.s1_sends_q || \block.vertices.s1_end_q };
    wire [4:0] all = beats + coming[0] + coming[1] + coming[2] + coming[3] + coming[4] + coming[5] + coming[6];
    always @* if (started) begin
        counted_most: assert (under_way <= 1);
        room_outlet: assert (beats <= 16 && all <= 16);
        room_least: assert (beats <= \block.outlet.held_q + 1 && \block.outlet.held_q <= 16);
        room_moves: assert (!\block.moves_q || \block.outlet.held_q <= 4);
        room_queue: assert (leaves <= 16);
        room_leaves: assert (leaves <= \block.queue.held_q + 1 && \block.queue.held_q <= 16);
        room_credit: assert (!\block.queue.has_room_q || \block.queue.held_q <= 8);
        room_credit_before: assert (!\block.had_room_q || \block.queue.held_q <= 9);
        room_walks: assert (\block.rests_q || (\block.moves_q && \block.queue.held_q <= 9));
        reached_triangle: cover (out_valid && !out_end);
        reached_blank: cover (\block.blank_q );
        reached_steals: cover (\block.walk.robs_2 );
        reached_leaf: cover (\block.walk.s7_leaf_q );
    end
