// Reads the inputs of one cycle after the other from standard input and answers with the outputs of each, in words of
// 64 bits, lowest first.

// harness [--limit SECONDS] [--vcd PATH FROM TO] [+verilator+...]
int main(int argc, char** argv) {
  const int answers = open_answers();
  VerilatedContext context;
  context.commandArgs(argc, argv);
  unsigned limit = 0;
#if VM_TRACE
  const char* dump_path = nullptr;
  uint64_t dump_from = 0, dump_to = 0;
#endif
  for (int i = 1; i < argc; ++i) {
    if (!strcmp(argv[i], "--limit") && i + 1 < argc) {
      limit = static_cast<unsigned>(strtoul(argv[++i], nullptr, 10));
#if VM_TRACE
    } else if (!strcmp(argv[i], "--vcd") && i + 3 < argc) {
      dump_path = argv[++i];
      dump_from = strtoull(argv[++i], nullptr, 10);
      dump_to = strtoull(argv[++i], nullptr, 10);
#endif
    }
  }
#if VM_TRACE
  if (dump_path) context.traceEverOn(true);
#endif
  Vdut dut(&context);
#if VM_TRACE
  VerilatedVcdC dump;
  if (dump_path) dut.trace(&dump, 99);
#endif

  std::vector<uint64_t> in((kChunk / kIn + 1) * kIn);
  std::vector<uint64_t> out((kChunk / kIn + 1) * kOut);
  char* const bytes = reinterpret_cast<char*>(in.data());
  size_t have = 0;  // bytes read and not yet used
  uint64_t cycle = 0;
  for (;;) {
    const ssize_t got = read(0, bytes + have, in.size() * sizeof(uint64_t) - have);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    have += static_cast<size_t>(got);
    const size_t count = have / (kIn * sizeof(uint64_t));
    if (count == 0) continue;
    // A design that never settles is ended by the alarm, and the reader sees by which signal.
    alarm(limit);
    for (size_t i = 0; i < count; ++i, ++cycle) {
      set_inputs(dut, &in[i * kIn]);
      @CLOCK_LOW@
      dut.eval();
      get_outputs(dut, &out[i * kOut]);
#if VM_TRACE
      const bool dumped = dump_path && cycle >= dump_from && cycle < dump_to;
      if (dumped && cycle == dump_from) dump.open(dump_path);
      // A cycle lasts 10: what an edge samples stands from its middle, and the edge comes at its end.
      if (dumped) dump.dump(10 * cycle + 5);
#endif
      @CLOCK_HIGH@
      dut.eval();
#if VM_TRACE
      if (dumped) dump.dump(10 * cycle + 10);
      if (dumped && cycle + 1 == dump_to) dump.close();
#endif
      if (context.gotFinish()) {
        fprintf(stderr, "the design called $finish in cycle %llu\n", static_cast<unsigned long long>(cycle));
        write_all(answers, out.data(), (i + 1) * kOut);
        return 3;
      }
    }
    alarm(0);
    if (!write_all(answers, out.data(), count * kOut)) return 4;
    const size_t used = count * kIn * sizeof(uint64_t);
    have -= used;
    memmove(bytes, bytes + used, have);
  }
#if VM_TRACE
  if (dump_path) dump.close();
#endif
  dut.final();
  return 0;
}
