#pragma once
// Simulated devices, on which the stand-ins for the CUDA runtime's calls (calls.cpp) work, and the settings and queries of tests. Work is
// kept until something waits for it, kernels are the PTX that nvcc made of them, and breaches of the rules in the runtime's documentation
// are described in words: see breaches().

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace dmoscope::gpu::fake {

/// The runtime's numbers of the errors that tests name. From Lost on they end the device: every call after them fails, too.
enum Code : int {
  kOutOfMemory = 2,
  kDriverTooOld = 35,
  kUnavailable = 46,
  kNoDevice = 100,
  kNoKernelImage = 209,
  kWrongPtxVersion = 222,
  kOperatingSystem = 304,
  kIllegalAddress = 700,
  kTimeout = 702
};

struct FakeDevice {
  std::string name = "Stand-in";
  int major = 9, minor = 0;
  std::size_t memory = std::size_t{1} << 30U;
  int multiprocessors = 1;  // each takes 256 lanes at once
  int refuses = 0;          // the error with which it refuses to be used
  bool too_old = false;     // there is no kernel for it
  bool flushes = false;     // subnormals become zero
};

/// OpenGL, as far as the runtime asks it; tests that draw have one.
class OpenGl {
 public:
  OpenGl() = default;
  OpenGl(const OpenGl&) = delete;
  OpenGl& operator=(const OpenGl&) = delete;
  virtual ~OpenGl() = default;
  /// The context of the calling thread; null: none is current.
  [[nodiscard]] virtual const void* current_context() = 0;
  /// Size of a buffer in bytes; none if there is no such buffer.
  [[nodiscard]] virtual std::optional<std::size_t> size_of(std::uint32_t buffer) = 0;
  virtual void write(std::uint32_t buffer, std::span<const std::byte> content) = 0;
};

/// Setup of new devices; the program must not use objects of the old ones any more.
struct Equipment {
  std::vector<FakeDevice> devices{FakeDevice{}};
  int driver = 13000;     // its version; 0: none is installed
  int drawing = 0;        // the device that OpenGL draws on; negative: none
  OpenGl* gl = nullptr;   // null: no context is current anywhere
  bool together = false;  // whether a warp's lanes count as active at once, see ptx::Schedule
};
void set_up(Equipment setup);

/// Makes call number `call` from now on, the next being 1, fail with `code`.
void fail_at(std::size_t call, int code);
/// Whether the call of fail_at() was reached.
[[nodiscard]] bool has_failed();
/// The names of all calls since set_up(), in their order, without those that only translate an error into words.
[[nodiscard]] std::vector<std::string> calls();
/// Breaches of the rules since set_up().
[[nodiscard]] std::vector<std::string> breaches();
/// Objects that were made and not destroyed since set_up().
[[nodiscard]] std::vector<std::string> leaks();
/// Priorities of the existing streams, ascending: the most urgent first.
[[nodiscard]] std::vector<int> priorities();
/// The devices that were current on a thread since set_up(): each has taken memory and time for it.
[[nodiscard]] std::set<int> devices_used();
/// Number of all calls of this process's tests so far, and of failures on demand.
struct Totals {
  std::size_t calls = 0, failures = 0, launches = 0;
};
[[nodiscard]] Totals totals();

}  // namespace dmoscope::gpu::fake
