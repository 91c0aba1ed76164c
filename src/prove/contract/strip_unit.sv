    // The column memory: vertices in the block RAM, on their way from there, in the small memory and at the head; one may
    // be spoken for by the beat in s1.
    localparam DEPTH = `DEPTH;
    wire recalls = \block.s1_valid_q && \block.s1_recalls_q ;
    wire [3:0] behind = \block.column.queue_in_q - \block.column.queue_out_q ;
    always @* if (started) begin
        counted_stages: assert (under_way == (\block.s1_valid_q && \block.s1_sends_q ) + out_valid);
        counted_sends: assert (!\block.s1_sends_q || \block.s1_valid_q );
        room_counts: assert (\block.column.none_q == (\block.column.count_q == 0)
            && \block.column.one_q == (\block.column.count_q == 1) && \block.column.all_q == (\block.column.count_q == DEPTH));
        room_memory: assert (\block.column.count_q <= DEPTH && \block.column.unread_q <= DEPTH);
        room_unread: assert (\block.column.some_q == (\block.column.unread_q != 0));
        room_queue: assert (\block.column.used_q <= 15
            && behind + \block.column.s1_read_q + \block.column.s2_read_q == \block.column.used_q );
        room_reads: assert (!\block.column.room_q || \block.column.used_q <= 14);
        room_direct: assert (!\block.column.direct_q || (\block.column.room_q && !\block.column.some_q
            && !\block.column.s1_read_q && !\block.column.s2_read_q ));
        room_all: assert (\block.column.count_q + recalls
            == \block.column.unread_q + \block.column.used_q + \block.column.held_valid_q );
        room_recalls: assert (!\block.s1_recalls_q || \block.s1_valid_q );
        reached_recall: cover (recalls);
        reached_edge: cover (\block.s1_valid_q && \block.s1_from_edge_q );
        reached_fan: cover (\block.s1_valid_q && \block.s1_fans_q && \block.s1_sends_q );
        reached_memory: cover (\block.column.some_q );
        reached_two: cover (out_valid && out_first && out_second);
    end
    // A recall waits for its vertex: it comes from the block RAM in three cycles, and one more takes it to the head.
    reg [7:0] waiting = 0;
    always @(posedge clock) waiting <= recalls && !\block.column.held_valid_q ? waiting + 1 : 0;
    always @* if (started) begin
        answered_counts: assert (\block.column.some_q == (\block.column.unread_q != 0) && \block.column.used_q <= 15
            && behind + \block.column.s1_read_q + \block.column.s2_read_q == \block.column.used_q );
        answered_reads: assert (\block.column.room_q || \block.column.used_q >= 12);
        answered_all: assert (\block.column.count_q + recalls
            == \block.column.unread_q + \block.column.used_q + \block.column.held_valid_q );
        answered_flags: assert (\block.column.none_q == (\block.column.count_q == 0)
            && \block.column.one_q == (\block.column.count_q == 1) && \block.column.all_q == (\block.column.count_q == DEPTH)
            && \block.column.count_q <= DEPTH && \block.column.unread_q <= DEPTH);
        answered_direct: assert (!\block.column.direct_q || (\block.column.room_q && !\block.column.some_q
            && !\block.column.s1_read_q && !\block.column.s2_read_q ));
        answered_recalls: assert (!\block.s1_recalls_q || \block.s1_valid_q );
        answered_in_time: assert (waiting <= 5);
    end
