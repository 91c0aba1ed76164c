    // A fetch stands in a stage of the corners; in the last of them for four cycles, while its entries go ahead.
    wire [14:0] fetches = {\block.s15_sends_q ,
        \block.s14_sends_q && \block.s14_phase_q == 3, \block.s13_sends_q && \block.s13_phase_q == 3,
        \block.s12_sends_q && \block.s12_phase_q == 3, \block.s11_sends_q && \block.s11_phase_q == 3,
        \block.corners.s10_fetch_q , \block.corners.s9_fetch_q , \block.corners.s8_fetch_q ,
        \block.corners.s7_fetch_q , \block.corners.s6_fetch_q , \block.corners.s5_fetch_q , \block.corners.s4_fetch_q ,
        \block.corners.s3_fetch_q , \block.corners.s2_fetch_q , \block.corners.s1_fetch_q };
    reg [7:0] number, age;
    integer stage;
    always @* begin
        number = 0;
        age = 0;
        for (stage = 0; stage < 15; stage = stage + 1) if (fetches[stage]) begin
            number = number + 1;
            age = stage < 9 ? stage + 1 : stage == 9 ? 10 + \block.phase_q : stage + 4;
        end
    end
    // The entries of a fetch as they come to the sum, and how many have come.
    reg [$bits(out_sum)-1:0] e0, e1, e2, e3;
    reg [2:0] have;
    wire [$bits(out_sum)-1:0] sum = \block.s15_sum_q ;
    always @(posedge clock) begin
        if (\block.moves && \block.s14_sends_q ) begin
            case (\block.s14_phase_q )
                0: e0 <= \block.s14_entry_q ;
                1: e1 <= \block.s14_entry_q ;
                2: e2 <= \block.s14_entry_q ;
                3: e3 <= \block.s14_entry_q ;
            endcase
            have <= \block.s14_phase_q + 1;
        end
        if (reset) have <= 0;
    end
    // The phase that comes behind each stage.
    wire [1:0] behind_11 = \block.phase_q ;
    wire [1:0] behind_12 = \block.s11_sends_q ? \block.s11_phase_q : behind_11;
    wire [1:0] behind_13 = \block.s12_sends_q ? \block.s12_phase_q : behind_12;
    wire [1:0] behind_14 = \block.s13_sends_q ? \block.s13_phase_q : behind_13;
    wire [1:0] behind_15 = \block.s14_sends_q ? \block.s14_phase_q : behind_14;
    always @* if (started) begin
        counted_answered_stages: assert (under_way == number);
        counted_answered_phase: assert (\block.corners.s10_fetch_q || \block.phase_q == 0);
        answered_age: assert (under_way == 0 || silent < age);
        answered_in_time: assert (silent <= 17);
        // Nothing is subtracted here.
        if (out_valid) equal_sum: assert (have == 4 && out_sum + e1 + e2 == e0 + e3);
        equal_parts: assert ((have != 1 || sum == e0) && (have != 2 || sum + e1 == e0) && (have != 3 || sum + e1 + e2 == e0)
            && (have != 4 || sum + e1 + e2 == e0 + e3) && have <= 4);
        equal_s15: assert (have[1:0] == behind_15);
        equal_s14: assert (!\block.s14_sends_q || 2'(\block.s14_phase_q + 1) == behind_14);
        equal_s13: assert (!\block.s13_sends_q || 2'(\block.s13_phase_q + 1) == behind_13);
        equal_s12: assert (!\block.s12_sends_q || 2'(\block.s12_phase_q + 1) == behind_12);
        equal_s11: assert (!\block.s11_sends_q || 2'(\block.s11_phase_q + 1) == behind_11);
        reached_phase_1: cover (\block.phase_q == 1);
        reached_phase_2: cover (\block.phase_q == 2);
        reached_phase_3: cover (\block.phase_q == 3);
    end
