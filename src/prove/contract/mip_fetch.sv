    // A fetch stands in one stage, the youngest in the lowest bit, and moves on unless two values wait at the end.
    wire [20:0] fetches = {\block.sent_valid_q , \block.sending_q , \block.s2_sends_q , \block.s1_fetches_q };
    reg [7:0] number, age;
    integer stage;
    always @* begin
        number = \block.spare_valid_q ;
        age = 0;
        for (stage = 0; stage < 21; stage = stage + 1) if (fetches[stage]) begin
            number = number + 1;
            age = stage + 1;
        end
    end
    always @* if (started) begin
        counted_answered_stages: assert (under_way == number);
        counted_answered_spare: assert (!\block.spare_valid_q || out_valid);
        counted_answered_room_moves: assert (\block.moves_q == !\block.spare_valid_q );
        answered_age: assert (under_way == 0 || silent < age);
        answered_in_time: assert (silent <= 20);
        room_spare: assert (!(\block.arrives && \block.spare_valid_q ));
        reached_spare: cover (\block.spare_valid_q );
    end
