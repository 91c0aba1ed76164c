// Plays beats through a design that has one input stream and one output stream, as fast as it takes them, or with idle
// cycles and stalls at random. Reads the input words of one beat after the other from standard input, offers each until it
// is taken, and takes the output beats. Answers with the cycle and the output words of each, in words of 64 bits, lowest first; the last
// answer has no beat: all ones, then the cycles. `@NAME@` is filled in for a design.

constexpr size_t kReset = @RESET@;        // word of `reset`
constexpr size_t kInValid = @IN_VALID@;   // word of `in_valid`
constexpr size_t kInReady = @IN_READY@;   // word of `in_ready`
constexpr size_t kOutValid = @OUT_VALID@; // word of `out_valid`
constexpr size_t kOutReady = @OUT_READY@; // word of `out_ready`

// Whether a stream is open in a cycle: all but `percent` of them, by xorshift (Marsaglia 2003).
class Gate {
 public:
  Gate(uint64_t percent, uint64_t seed) : percent_(percent), state_(seed * 2 + 1) {}
  bool opens() {
    if (percent_ == 0) return true;
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return (state_ >> 32) % 100 >= percent_;
  }

 private:
  uint64_t percent_;
  uint64_t state_;
};

// stream PATIENCE DRAIN PERCENT SEED: cycles without a handshake after which a design hangs, and in which it is done; cycles
// of a hundred in which no beat is offered, or none is taken. A beat that is not taken in time ends the program with 5.
int main(int argc, char** argv) {
  const int answers = open_answers();
  VerilatedContext context;
  context.commandArgs(argc, argv);
  if (argc < 5) return 2;
  const uint64_t patience = strtoull(argv[1], nullptr, 10);
  const uint64_t drain = strtoull(argv[2], nullptr, 10);
  const uint64_t percent = strtoull(argv[3], nullptr, 10);
  const uint64_t seed = strtoull(argv[4], nullptr, 10);
  Gate offering(percent, seed);
  Gate taking(percent, seed + 1);
  bool shown = false;  // the beat was offered, and stays
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
    const bool has_beat = (at + kIn) * sizeof(uint64_t) <= have;
    const bool offers = has_beat && (shown || offering.opens());
    const bool takes = taking.opens();
    shown = offers;
    uint64_t* const inputs = offers ? &in[at] : idle.data();
    if (offers) {
      inputs[kReset] = 0;
      inputs[kInValid] = 1;
    }
    inputs[kOutReady] = takes ? 1 : 0;
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
      shown = false;
      silent = 0;
    }
    if (takes && out[kOutValid]) {
      silent = 0;
      sent.push_back(cycle);
      sent.insert(sent.end(), out.begin(), out.end());
      if (sent.size() >= kChunk) {
        if (!write_all(answers, sent.data(), sent.size())) return 4;
        sent.clear();
      }
    }
    if (has_beat ? silent >= patience : silent >= drain) break;
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
