    // Beats wait in the queue; others are on their way through sweep, walkers and commands, which nothing stops.
    wire [7:0] coming = \block.sweep.out_valid_q + \block.walkers.s0_valid_q + \block.walkers.s1_valid_q
        + \block.walkers.s2_valid_q + \block.walkers.s3_valid_q + \block.commands.sent_valid_q
        + \block.queue.write_valid_q ;
    wire [7:0] waiting = \block.queue.waiting_q ;
    wire [3:0] between = \block.queue.write_place_q - \block.queue.read_place_q ;
    always @* if (started) begin
        counted_answered_queue: assert (under_way == waiting + \block.queue.held_q + \block.queue.write_valid_q
            && waiting + coming <= 16);
        counted_answered_room_any: assert (\block.queue.any_q == (waiting != 0));
        counted_answered_room_credit: assert (!\block.queue.has_room_q || waiting <= 7);
        answered_in_time: assert (silent <= 2);
        room_queue: assert (waiting <= 16 && between == waiting[3:0]
            && \block.queue.next_place_q == \block.queue.write_place_q + {3'd0, \block.queue.write_valid_q });
        room_coming: assert (waiting + coming <= 16);
    end
