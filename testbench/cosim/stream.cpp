// Plays beats through a design that has one input stream and one output stream, as fast as it takes them. Reads the
// input words of one beat after the other from standard input, offers each until it is taken, and takes every output
// beat as it comes. Answers with the cycle and the output words of each, in words of 64 bits, lowest first; the last
// answer has no beat: all ones, then the cycles. `@NAME@` is filled in for a design.

constexpr size_t kReset = @RESET@;        // word of `reset`
constexpr size_t kInValid = @IN_VALID@;   // word of `in_valid`
constexpr size_t kInReady = @IN_READY@;   // word of `in_ready`
constexpr size_t kOutValid = @OUT_VALID@; // word of `out_valid`
constexpr size_t kOutReady = @OUT_READY@; // word of `out_ready`

// stream PATIENCE DRAIN: cycles without a handshake after which a design hangs, and in which it is done. The answer to a
// beat that is not taken in time ends the program with 5.
int main(int argc, char** argv) {
  const int answers = open_answers();
  VerilatedContext context;
  context.commandArgs(argc, argv);
  if (argc < 3) return 2;
  const uint64_t patience = strtoull(argv[1], nullptr, 10);
  const uint64_t drain = strtoull(argv[2], nullptr, 10);
  Vdut dut(&context);

  std::vector<uint64_t> in((kChunk / kIn + 1) * kIn);
  std::vector<uint64_t> idle(kIn, 0);
  std::vector<uint64_t> out(kOut);
  std::vector<uint64_t> sent;
  sent.reserve(kChunk + 1 + kOut);
  char* const bytes = reinterpret_cast<char*>(in.data());
  size_t have = 0;      // bytes read
  size_t at = 0;        // words of them that were taken
  bool ended = false;   // there are no more
  uint64_t cycle = 0;
  uint64_t silent = 0;  // cycles since the last handshake

  // Two cycles of reset, which do not count.
  idle[kReset] = 1;
  for (int k = 0; k < 2; ++k) {
    set_inputs(dut, idle.data());
    @CLOCK_LOW@
    dut.eval();
    @CLOCK_HIGH@
    dut.eval();
  }
  idle[kReset] = 0;
  idle[kOutReady] = 1;

  for (;; ++cycle) {
    if ((at + kIn) * sizeof(uint64_t) > have && !ended) {
      const size_t used = at * sizeof(uint64_t);
      memmove(bytes, bytes + used, have - used);
      have -= used;
      at = 0;
      while (!ended && have < kIn * sizeof(uint64_t)) {
        const ssize_t got = read(0, bytes + have, in.size() * sizeof(uint64_t) - have);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) ended = true;
        else have += static_cast<size_t>(got);
      }
    }
    const bool offers = (at + kIn) * sizeof(uint64_t) <= have;
    uint64_t* const inputs = offers ? &in[at] : idle.data();
    if (offers) {
      inputs[kReset] = 0;
      inputs[kInValid] = 1;
      inputs[kOutReady] = 1;
    }
    // A design that never settles is ended by the alarm.
    if ((cycle & 0xffff) == 0) alarm(60);
    set_inputs(dut, inputs);
    @CLOCK_LOW@
    dut.eval();
    get_outputs(dut, out.data());
    @CLOCK_HIGH@
    dut.eval();
    ++silent;
    if (offers && out[kInReady]) {
      at += kIn;
      silent = 0;
    }
    if (out[kOutValid]) {
      silent = 0;
      sent.push_back(cycle);
      sent.insert(sent.end(), out.begin(), out.end());
      if (sent.size() >= kChunk) {
        if (!write_all(answers, sent.data(), sent.size())) return 4;
        sent.clear();
      }
    }
    if (offers ? silent >= patience : silent >= drain) break;
  }
  sent.push_back(~0ULL);
  sent.push_back(cycle + 1);
  sent.insert(sent.end(), kOut - 1, 0);
  if (!write_all(answers, sent.data(), sent.size())) return 4;
  dut.final();
  if ((at + kIn) * sizeof(uint64_t) <= have) {
    fprintf(stderr, "no handshake for %llu cycles up to cycle %llu\n", static_cast<unsigned long long>(patience),
            static_cast<unsigned long long>(cycle));
    return 5;
  }
  return 0;
}
