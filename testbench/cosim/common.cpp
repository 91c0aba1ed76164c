// What every driver of a design begins with: ports as words of 64 bits, lowest first, and answers on a pipe of their own.
// `@NAME@` is filled in for a design.

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "Vdut.h"
#include "verilated.h"
#if VM_TRACE
#include "verilated_vcd_c.h"
#endif

// Verilator asks for it when a design has no context.
double sc_time_stamp() { return 0; }

namespace {

constexpr size_t kIn = @IN@;    // words of the inputs of a cycle
constexpr size_t kOut = @OUT@;  // words of the outputs of a cycle
constexpr size_t kChunk = 8192; // words moved at once

inline void set_inputs(Vdut& dut, const uint64_t* in) {
@SET@}

inline void get_outputs(Vdut& dut, uint64_t* out) {
@GET@}

bool write_all(int file, const uint64_t* words, size_t count) {
  const char* from = reinterpret_cast<const char*>(words);
  size_t left = count * sizeof(uint64_t);
  while (left > 0) {
    const ssize_t written = write(file, from, left);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    from += written;
    left -= static_cast<size_t>(written);
  }
  return true;
}

// The file that answers go to: what the design prints must not mix with them.
int open_answers() {
  const int answers = dup(1);
  dup2(2, 1);
#ifdef F_SETPIPE_SZ
  // Larger pipes mean fewer switches between the two processes; where that is not allowed, it goes on without.
  (void)fcntl(0, F_SETPIPE_SZ, 1 << 20);
  (void)fcntl(answers, F_SETPIPE_SZ, 1 << 20);
#endif
  return answers;
}

}  // namespace

