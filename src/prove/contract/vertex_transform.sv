    // A vertex is under way from the end of its first round on: it waits for its second one, is in it, or has been sent.
    wire runs = \block.running_q ;
    wire [5:0] step = \block.step_q ;
    always @* if (started) begin
        counted_answered_stages: assert (under_way == (runs ? \block.older_q : \block.newer_q + \block.sent_q ));
        counted_answered_room_held_sent: assert (!(runs && \block.sent_q ));
        counted_answered_rests: assert (runs || step == 63);
        counted_answered_takes: assert (!runs || \block.taking_q == (step == 63 && \block.newer_q ));
        answered_waits: assert (under_way == 0 || out_valid || (runs ? silent <= step + 1 : silent == 0));
        answered_in_time: assert (silent <= 65);
    end
