#pragma once
// State of the stand-ins. Only for sources of this folder that implement the runtime, not for tests.

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <tuple>
#include <unordered_map>
#include <vector>

#include <cuda_runtime_api.h>

#include "tests/gpu/fake/arena.h"
#include "tests/gpu/fake/runtime.h"
#include "tests/gpu/ptx/ptx_queue.h"

// Types behind the runtime's handles, which are pointers to these.
struct Step {
  std::function<void()> run;
  const void* pinned = nullptr;  // the host's memory that it writes or reads
};
struct CUgraph_st {
  std::vector<Step> steps;
};
struct CUgraphExec_st {
  std::vector<Step> steps;
};

struct CUstream_st {
  int device = 0;
  std::deque<Step> waiting{};
  std::size_t asked = 0, done = 0;  // numbers of steps
  int priority = 0;
  std::unique_ptr<CUgraph_st> capture{};
  std::thread::id capturing{};
  bool invalid = false;                        // state of the capture
  std::shared_ptr<CUstream_st> forked_from{};  // the stream whose capture has this one's work, too; null: none
  std::size_t kept = 0;                        // number of its steps in captures
  bool joined = false;                         // whether that one waits for all of its work

  /// The graph that keeps its work; null: work is done.
  [[nodiscard]] CUgraph_st* kept_in() const { return forked_from != nullptr ? forked_from->capture.get() : capture.get(); }
};
struct CUevent_st {
  int device = 0;
  std::shared_ptr<CUstream_st> stream{};  // the stream it was recorded in; null: none
  std::size_t after = 0;                  // number of its steps before the event
  std::size_t after_kept = 0;
  const CUgraph_st* kept_in = nullptr;  // the capture of the stream at that time
};
struct cudaGraphicsResource {
  int device = 0;
  std::uint32_t buffer = 0;
  const void* context = nullptr;
  void* mapped = nullptr;
  std::size_t bytes = 0;
  CUstream_st* stream = nullptr;
};

namespace dmoscope::gpu::fake {

/// State of each thread of the host.
struct ThreadState {
  unsigned setup = 0;  // the set_up() that it belongs to
  int device = 0;
  cudaError_t last = cudaSuccess;
  int captures = 0;                          // captures that it began and has not ended
  std::shared_ptr<CUstream_st> unprotected;  // copies from or to ordinary memory that were not waited for yet
  std::vector<std::tuple<dim3, dim3, std::size_t, cudaStream_t>> configurations;
};
[[nodiscard]] ThreadState& this_thread();

struct Allocation {
  int device = 0;
  std::size_t bytes = 0;
};

class Machine {
 public:
  /// The machine of all stand-ins, which as functions of C have no other access to it.
  [[nodiscard]] static Machine& get();

  void set_up(Equipment setup);

  /// Begins a call: counts it and returns the error with which it must fail, or cudaSuccess.
  [[nodiscard]] cudaError_t enter(const char* name);
  /// Ends a call: its error becomes the thread's last error.
  cudaError_t leave(cudaError_t status);
  void breach(const std::string& what);
  /// Checks the rule that the call must not be made during a capture. Returns whether the thread captures.
  [[nodiscard]] bool forbidden_in_capture(const char* name);

  /// The devices whose streams are allowed. Null stands for the current device's default stream. Work is asked of the current device's
  /// streams alone.
  enum class Of { CurrentDevice, AnyDevice };
  [[nodiscard]] std::shared_ptr<CUstream_st> find(cudaStream_t stream, const char* call, Of of = Of::CurrentDevice);
  /// Adds a step, to be done, or to be kept if the stream is captured.
  void ask(CUstream_st& stream, Step step);
  /// Does the steps before number `until`.
  void run(CUstream_st& stream, std::size_t until);
  void run(CUstream_st& stream) { run(stream, stream.asked); }
  /// Does the steps of all streams of a device.
  void run_all(int device);
  cudaError_t launch(const void* function, dim3 grid, dim3 block, void** arguments, std::size_t shared, cudaStream_t stream);

  /// Returns whether the memory is wholly a device's; if not, notes a breach.
  bool require_device_memory(const void* memory, std::size_t bytes, int device, const char* call);
  /// The piece of memory of cudaMallocHost that contains these bytes; null: none.
  [[nodiscard]] const void* pinned_with(const void* memory, std::size_t bytes) const;
  [[nodiscard]] void* new_memory(int device, std::size_t bytes);
  void forget_memory(int device, const void* memory);

  std::recursive_mutex mutex;
  Equipment setup;
  std::map<const void*, Allocation> memory;                   // memory of devices
  std::map<const std::byte*, std::vector<std::byte>> pinned;  // memory of the host
  std::map<cudaStream_t, std::shared_ptr<CUstream_st>> streams;
  std::map<int, std::shared_ptr<CUstream_st>> default_streams;
  std::map<cudaEvent_t, std::unique_ptr<CUevent_st>> events;
  std::map<cudaGraph_t, std::unique_ptr<CUgraph_st>> graphs;
  std::map<cudaGraphExec_t, std::unique_ptr<CUgraphExec_st>> executables;
  std::map<cudaGraphicsResource_t, std::unique_ptr<cudaGraphicsResource>> resources;
  std::unordered_map<const void*, std::string> functions;  // the host's address -> mangled name
  Arena arena;

  std::vector<std::string> called, broken;
  std::set<int> used;         // devices with a context
  std::size_t fail_call = 0;  // number of the call to fail; 0: none
  int fail_code = 0;
  bool failed = false;
  cudaError_t lost = cudaSuccess;
  Totals totals;

 private:
  /// Describes what is wrong with a launch; empty: nothing.
  [[nodiscard]] std::string fault_of(const ptx::Entry& entry, dim3 grid, dim3 block, std::size_t shared, const CUstream_st& stream);
  void run_kernel(const ptx::Entry& entry, const std::vector<std::byte>& parameters, dim3 grid, dim3 block, int device);

  std::map<int, ptx::GlobalMemory> global_;
  std::set<std::pair<int, std::string>> loaded_;  // kernels that a device has loaded
  unsigned setups_ = 0;
  friend ThreadState& this_thread();
};

/// Makes a call: locks the machine, fails if it must, and makes the result the thread's last error.
template <class Body>
cudaError_t call(const char* name, const Body& body) {
  Machine& machine = Machine::get();
  const std::scoped_lock lock(machine.mutex);
  if (const cudaError_t status = machine.enter(name); status != cudaSuccess) return machine.leave(status);
  return machine.leave(body(machine));
}
/// Makes a call that frees something, which it does even if it fails: nobody could try again.
template <class Body>
cudaError_t giving_back(const char* name, const Body& body) {
  Machine& machine = Machine::get();
  const std::scoped_lock lock(machine.mutex);
  const cudaError_t status = machine.enter(name), done = body(machine);
  return machine.leave(status != cudaSuccess ? status : done);
}

}  // namespace dmoscope::gpu::fake
