    // Whatever node is looked at: the extrema of all that went into it since it was fresh are what is read.
    (* anyconst *) reg [$bits(address)-1:0] node;
    always @* begin
        // Extrema depend on the order of the values alone, and there are few of them.
        equal_few: assume (max < 8 && min < 8);
        always_apart: assume (!(op && read));
        always_early: assume (!(read && (busy || was_busy)));
    end
    reg was_busy = 0;
    always @(posedge clock) was_busy <= busy;
    reg known = 0;
    reg [15:0] most, least;
    reg [3:0] asked_for = 0;
    reg [31:0] expected_1, expected_2, expected_3, expected_4;
    always @(posedge clock) if (reset) begin
        known <= 0;
        asked_for <= 0;
    end else begin
        if (op && address == node) begin
            known <= known || fresh;
            most <= fresh || max >= most ? max : most;
            least <= fresh || min <= least ? min : least;
        end
        asked_for <= {asked_for[2:0], read && known && \block.read_at_q == node};
        {expected_4, expected_3, expected_2, expected_1} <= {expected_3, expected_2, expected_1, most, least};
    end
    // What an op makes of the node is written six cycles later.
    reg [4:0] knew = 0;
    reg [159:0] made;
    always @(posedge clock) begin
        knew <= reset ? 0 : {knew[3:0], known};
        made <= {made[127:0], most, least};
    end
    always @* if (started) begin
        if (\block.s6_op_q && \block.s6_address_q == node && knew[4]) equal_written: assert (\block.s6_word_q == made[159:128]);
        if (asked_for[3]) equal_extrema: assert (word_valid && word == expected_4);
        reached_node: cover (asked_for[3] && expected_4[31:16] != expected_4[15:0]);
    end
