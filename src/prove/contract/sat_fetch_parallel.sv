    // A fetch stands in one stage, the youngest in the lowest bit, and moves on unless two sums wait at the end.
    wire [16:0] fetches = {\block.sent_valid_q , \block.s16_sends_q , \block.s15_sends_q , \block.s14_sends_q , \block.s13_sends_q , \block.s12_sends_q , \block.s11_sends_q , \block.corners.s10_fetch_q , \block.corners.s9_fetch_q , \block.corners.s8_fetch_q , \block.corners.s7_fetch_q , \block.corners.s6_fetch_q , \block.corners.s5_fetch_q , \block.corners.s4_fetch_q , \block.corners.s3_fetch_q , \block.corners.s2_fetch_q , \block.corners.s1_fetch_q };
    reg [7:0] number, age;
    integer stage;
    always @* begin
        number = \block.spare_valid_q ;
        age = 0;
        for (stage = 0; stage < 17; stage = stage + 1) if (fetches[stage]) begin
            number = number + 1;
            age = stage + 1;
        end
    end
    // The entries of a fetch go along with it, and the two differences. Nothing is subtracted here.
    localparam B = $bits(out_sum);
    wire [6*B-1:0] s14 = {{2*B{1'b0}}, \block.s14_entry_3_q , \block.s14_entry_2_q , \block.s14_entry_1_q , \block.s14_entry_0_q };
    reg [6*B-1:0] s15, s16, sent, spare;
    always @(posedge clock) begin
        if (\block.go ) s15 <= s14;
        if (\block.go ) s16 <= {\block.s15_upper_q , \block.s15_lower_q , s15[4*B-1:0]};
        if (\block.go ) spare <= s16;
        if (\block.out_free ) sent <= \block.spare_valid_q ? spare : s16;
    end
    `define entry(k, of) of[k * B +: B]
    always @* if (started) begin
        if (\block.s15_sends_q ) equal_lower: assert (\block.s15_lower_q + `entry(1, s15) == `entry(0, s15));
        if (\block.s15_sends_q ) equal_upper: assert (\block.s15_upper_q + `entry(3, s15) == `entry(2, s15));
        if (\block.s16_sends_q ) equal_s16: assert (\block.s16_sum_q + `entry(5, s16) == `entry(4, s16));
        if (\block.spare_valid_q ) equal_spare: assert (\block.spare_sum_q + `entry(5, spare) == `entry(4, spare));
        if (out_valid) equal_sum: assert (out_sum + `entry(5, sent) == `entry(4, sent));
    end
    always @* if (started) begin
        counted_answered_stages: assert (under_way == number);
        counted_answered_spare: assert (!\block.spare_valid_q || out_valid);
        counted_answered_room_moves: assert (\block.moves_q == !\block.spare_valid_q );
        answered_age: assert (under_way == 0 || silent < age);
        answered_in_time: assert (silent <= 16);
        room_spare: assert (!(\block.arrives && \block.go && \block.spare_valid_q ));
        reached_spare: cover (\block.spare_valid_q );
    end
