    // A beat stands in one stage, the youngest in the lowest bit, and moves on unless two results wait at the end.
    // `sending`, declared by the contract, has the stages before the result.
    localparam N = $bits(sending);
    wire [N:0] beats = {\block.flow.sent_valid_q , sending};
    wire waits = under_way != 0 && !out_valid;
    // How many beats are further than each stage, carried along with it; below the first one, all are. That the count of one
    // stage and of the next differ by its beat is local, so that an induction closes at any length.
    reg [8*N-1:0] ahead;
    wire [8*N+7:0] further = {ahead, under_way};
    // The cycles of a silence, as far as they go: then a beat is at least as far.
    reg [N:0] silence = 0;
    reg follows, reaches, some;
    integer stage;
    always @(posedge clock) begin
        for (stage = 0; stage < N; stage = stage + 1)
            ahead[8*stage +: 8] <=
                reset ? 0 : (\block.flow.moves_q ? further[8*stage +: 8] : ahead[8*stage +: 8]) - answer;
        silence <= reset || !waits ? 0 : {silence[N-1:0], 1'b1};
    end
    always @* begin
        follows = ahead[8*N-1 -: 8] == \block.flow.sent_valid_q + \block.flow.spare_valid_q ;
        for (stage = 0; stage < N; stage = stage + 1)
            if (further[8*stage +: 8] != further[8*stage+8 +: 8] + beats[stage]) follows = 0;
        reaches = 1;
        some = 0;
        for (stage = N; stage > 0; stage = stage - 1) begin
            some = some || beats[stage];
            if (silence[stage-1] && !some) reaches = 0;
        end
    end
    always @* if (started) begin
        counted_stages: assert (follows);
        counted_spare: assert (!\block.flow.spare_valid_q || out_valid);
        counted_moves: assert (\block.flow.moves_q == !\block.flow.spare_valid_q );
        answered_stages: assert (follows);
        answered_spare: assert (!\block.flow.spare_valid_q || out_valid);
        answered_moves: assert (\block.flow.moves_q == !\block.flow.spare_valid_q );
        answered_reaches: assert (reaches);
        answered_in_time: assert (!silence[N]);
        room_spare: assert (!(\block.flow.arrives && \block.flow.spare_valid_q ));
        room_moves: assert (\block.flow.moves_q == !\block.flow.spare_valid_q );
        reached_spare: cover (\block.flow.spare_valid_q );
    end
