    // The column memory: vertices in the block RAM, on their way from there, in the small memory and at the head; one may
    // be spoken for by the beat in s1.
    localparam DEPTH = `DEPTH;
    wire recalls = \block.s1_valid_q && \block.s1_recalls_q ;
    wire [3:0] behind = \block.column.queue_in_q - \block.column.queue_out_q ;
    always @* if (started) begin
        counted_stages: assert (under_way == (\block.s1_valid_q && \block.s1_sends_q ) + out_valid);
        counted_equal_sends: assert (!\block.s1_sends_q || \block.s1_valid_q );
        room_answered_equal_counts: assert (\block.column.none_q == (\block.column.count_q == 0)
            && \block.column.one_q == (\block.column.count_q == 1) && \block.column.all_q == (\block.column.count_q == DEPTH)
            && \block.column.count_q <= DEPTH);
        room_answered_unread: assert (\block.column.some_q == (\block.column.unread_q != 0) && \block.column.unread_q <= DEPTH);
        room_answered_queue: assert (\block.column.used_q <= 15
            && behind + \block.column.s1_read_q + \block.column.s2_read_q == \block.column.used_q );
        room_reads: assert (!\block.column.room_q || \block.column.used_q <= 14);
        room_answered_direct: assert (!\block.column.direct_q || (\block.column.room_q && !\block.column.some_q
            && !\block.column.s1_read_q && !\block.column.s2_read_q ));
        room_answered_all: assert (\block.column.count_q + recalls
            == \block.column.unread_q + \block.column.used_q + \block.column.held_valid_q );
        room_answered_equal_recalls: assert (!\block.s1_recalls_q || \block.s1_valid_q );
        answered_reads: assert (\block.column.room_q || \block.column.used_q >= 12);
        answered_in_time: assert (waiting <= 5);
        reached_recall: cover (recalls);
        reached_edge: cover (\block.s1_valid_q && \block.s1_from_edge_q );
        reached_fan: cover (\block.s1_valid_q && \block.s1_fans_q && \block.s1_sends_q );
        reached_memory: cover (\block.column.some_q );
        reached_two: cover (out_valid && out_first && out_second);
    end
    // A recall waits for its vertex: it comes from the block RAM in three cycles, and one more takes it to the head.
    reg [7:0] waiting = 0;
    always @(posedge clock) waiting <= recalls && !\block.column.held_valid_q ? waiting + 1 : 0;

    // Which triangles there are: one sending, any, is watched on its way through the registers and the column memory. Two
    // vertices are the same sending if that holds of both or of neither, whichever is watched; different ones, if never of both.
    wire step = in_kind == 0;
    wire sends_left = in_kind == 1 || (step && in_left == 1) || (in_kind == 3 && in_left != 3);
    wire sends_right = in_kind == 1 || in_kind == 2 || (step && in_right != 0);
    wire pops = step && in_left == 2 && \block.column.count_q != 0;
    wire stores = step && in_right == 2 && \block.column.count_q != DEPTH;
    (* anyseq *) wire watch;
    (* anyseq *) wire watch_right;
    // After reset the registers hold the same.
    (* anyconst *) reg from_reset;
    reg watched, left, right, start, edge_held, stored;
    reg [15:0] place;
    wire new_left = sends_left && !watched && watch && !watch_right;
    wire new_right = sends_right && !watched && watch && watch_right;
    wire next_left = in_left == 1 ? new_left : in_left == 3 ? edge_held : pops ? stored && place == 0 : left;
    wire moves_left = step && (in_left == 1 || in_left == 3 || pops);
    wire moves_right = step && in_right != 0;
    always @(posedge clock) if (reset) begin
        {watched, left, right, start, edge_held} <= {5{from_reset}};
        stored <= 0;
    end else if (asked) begin
        watched <= watched || new_left || new_right;
        case (in_kind)
            0: begin
                left <= next_left;
                if (moves_right) right <= new_right;
                if (in_right == 3) edge_held <= new_right;
                if (stores && new_right) place <= \block.column.count_q - pops;
                else place <= place - pops;
                stored <= (stored && !(pops && place == 0)) || (stores && new_right);
            end
            1: {left, right, start, stored} <= {new_left, new_right, new_right, 1'b0};
            2: {left, right, start} <= {start, new_right, new_right};
            3: {left, right} <= {in_left == 3 ? edge_held : new_left, left};
        endcase
    end
    `define same(flag, a, b) (flag ? (a) == (b) : !((a) && (b)))
    always @* if (started) begin
        equal_unseen: assert (watched || {left, right, start, edge_held, stored} == 0);
        equal_stored: assert (!stored || (place < \block.column.count_q && !left && !start && !edge_held));
        equal_left_right: assert (`same(\block.left_is_right_q , left, right));
        equal_left_edge: assert (`same(\block.left_is_edge_q , left, edge_held));
        equal_right_edge: assert (`same(\block.right_is_edge_q , right, edge_held));
        equal_start_edge: assert (`same(\block.start_is_edge_q , start, edge_held));
        equal_right_stored: assert (\block.right_stored_q && \block.column.count_q != 0
            ? right == (stored && place == \block.column.count_q - 1) : !(right && stored));
        if (asked && step) begin
            equal_next_right: assert (`same(\block.next_is_right , next_left, right));
            if (moves_left) equal_next_left: assert (`same(\block.next_is_left , next_left, left));
            equal_first: assert (\block.first == (moves_left
                && !\block.left_is_right_q && !\block.next_is_right && !\block.next_is_left ));
            equal_second: assert (\block.second == (moves_right && !\block.next_is_right ));
        end
    end

    // What a beat does to the vertices, whatever the column memory answers.
    localparam BITS = $bits(out_left);
    reg [1:0] kind, to_left, to_right;
    reg [BITS-1:0] given_left, given_right, l, r, s, e, was_l, was_r;
    reg does_first, does_second, does_last, does_pop, does_fail, swap, failed, was_first, was_second, was_last, was_swap;
    wire moves = \block.moves && \block.s1_valid_q ;
    wire [BITS-1:0] set_left = kind == 2 ? s : kind == 1 || to_left == 1 ? given_left : to_left == 3 ? e
        : kind == 3 ? given_left : does_pop ? \block.column.head : l;
    always @(posedge clock) begin
        if (reset) {l, r, s, e, swap, failed} <= 0;
        else if (moves) begin
            l <= set_left;
            r <= kind == 3 ? l : kind == 0 && to_right == 0 ? r : given_right;
            if (kind == 1 || kind == 2) s <= given_right;
            if (kind == 0 && to_right == 3) e <= given_right;
            {was_l, was_r, was_swap, failed} <= {l, r, swap, failed || does_fail};
            {was_first, was_second, was_last} <= {does_first, does_second, does_last};
        end
        if (asked && !reset) begin
            {kind, to_left, to_right, given_left, given_right} <= {in_kind, in_left, in_right, in_left_vertex, in_right_vertex};
            {does_pop, does_first, does_second, does_last} <= {pops, \block.first , \block.second , in_last};
            does_fail <= step && (in_left == 2 && !pops || in_right == 2 && !stores);
            if (in_kind == 1) swap <= in_swap;
        end
    end
    always @* if (started) begin
        equal_vertices: assert (\block.left_q == l && \block.right_q == r && \block.start_q == s && \block.edge_held_q == e);
        equal_swap: assert (\block.swap_q == swap);
        equal_error: assert (error == failed && \block.s1_fails_q == (\block.s1_valid_q && does_fail));
        if (\block.s1_valid_q ) begin
            equal_s1_sends: assert (\block.s1_sends_q == (does_first || does_second || does_last)
                && \block.s1_first_q == does_first && \block.s1_second_q == does_second && \block.s1_last_q == does_last);
            equal_s1_left: assert (\block.s1_left_moves_q == (kind != 0 || to_left == 1 || to_left == 3 || does_pop)
                && \block.s1_left_vertex_q == given_left && \block.s1_recalls_q == does_pop && (!does_pop || (kind == 0 && to_left == 2))
                && \block.s1_from_start_q == (kind == 2) && \block.s1_from_edge_q == ((kind == 0 || kind == 3) && to_left == 3));
            equal_s1_right: assert (\block.s1_right_moves_q == (kind != 0 || to_right != 0)
                && \block.s1_right_vertex_q == given_right && \block.s1_fans_q == (kind == 3)
                && \block.s1_start_moves_q == (kind == 1 || kind == 2)
                && \block.s1_edge_moves_q == (kind == 0 && to_right == 3));
        end else equal_s1_rests: assert (!\block.s1_left_moves_q && !\block.s1_right_moves_q && !\block.s1_start_moves_q
            && !\block.s1_edge_moves_q );
        if (out_valid) equal_sent: assert (out_left == was_l && out_right == was_r && out_next_left == l && out_next_right == r
            && out_first == was_first && out_second == was_second && out_last == was_last && out_swap == was_swap);
    end
