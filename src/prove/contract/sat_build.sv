    wire [2:0] texels = {\block.s3_valid_q , \block.s2_valid_q , \block.s1_valid_q };
    wire [1:0] age = texels[2] ? 3 : texels[1] ? 2 : texels[0];
    always @* if (started) begin
        counted_answered_stages: assert (under_way == texels[0] + texels[1] + texels[2]);
        answered_age: assert (under_way == 0 || silent < age);
        answered_in_time: assert (silent <= 2);
        reached_last: cover (out_valid && out_last);
        reached_active: cover (\block.active_q );
    end
