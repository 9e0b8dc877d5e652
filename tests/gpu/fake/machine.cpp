#include "tests/gpu/fake/machine.h"

#include <algorithm>
#include <cstring>
#include <exception>

#include <fmt/format.h>

namespace dmoscope::gpu::fake {

namespace {

/// Whether an error is permanent, as the runtime documents.
bool is_for_ever(int code) { return code >= kIllegalAddress; }
constexpr std::size_t kMostParameterBytes = 4096;  // limit for a kernel, on every device

/// Whether a call may come between a copy of ordinary memory and the wait for it, if it succeeds.
bool may_come_before_the_wait(std::string_view name) { return name == "cudaSetDevice" || name == "cudaStreamSynchronize"; }

}  // namespace

ThreadState& this_thread() {
  thread_local ThreadState state;
  if (const unsigned now = Machine::get().setups_; state.setup != now) {
    state = {};
    state.setup = now;
  }
  return state;
}

Machine& Machine::get() {
  static Machine machine;
  return machine;
}

void Machine::set_up(Equipment wanted) {
  setup = std::move(wanted);
  ++setups_;
  for (const auto& [handle, stream] : streams) stream->waiting.clear();
  memory.clear(), pinned.clear(), streams.clear(), default_streams.clear(), events.clear(), graphs.clear(), executables.clear();
  resources.clear(), called.clear(), broken.clear(), used.clear(), global_.clear(), loaded_.clear();
  arena.clear();
  fail_call = 0;
  failed = false;
  lost = cudaSuccess;
}

cudaError_t Machine::enter(const char* name) {
  called.emplace_back(name);
  ++totals.calls;
  ThreadState& thread = this_thread();
  const bool fails = lost == cudaSuccess && fail_call != 0 && --fail_call == 0;
  if (thread.unprotected != nullptr && lost == cudaSuccess &&
      (!may_come_before_the_wait(name) || (fails && name != std::string_view("cudaStreamSynchronize")))) {
    breach(fmt::format("{} {} while a copy of ordinary memory of the host is under way", name, fails ? "fails" : "is called"));
    run(*std::exchange(thread.unprotected, nullptr));  // before that memory is gone
  }
  if (fails) {
    failed = true;
    ++totals.failures;
    if (is_for_ever(fail_code)) lost = static_cast<cudaError_t>(fail_code);
    return static_cast<cudaError_t>(fail_code);
  }
  return lost;
}

cudaError_t Machine::leave(cudaError_t status) {
  if (status != cudaSuccess) this_thread().last = status;
  return status;
}

void Machine::breach(const std::string& what) { broken.push_back(what); }

bool Machine::forbidden_in_capture(const char* name) {
  if (this_thread().captures == 0) return false;
  breach(fmt::format("{} in a capture", name));
  for (const auto& [handle, stream] : streams)
    if (stream->capture != nullptr && stream->capturing == std::this_thread::get_id()) stream->invalid = true;
  return true;
}

std::shared_ptr<CUstream_st> Machine::find(cudaStream_t stream, const char* call, Of of) {
  const int device = this_thread().device;
  if (stream == nullptr) {
    auto& made = default_streams[device];
    if (made == nullptr) made = std::make_shared<CUstream_st>(CUstream_st{.device = device});
    return made;
  }
  const auto found = streams.find(stream);
  if (found == streams.end()) {
    breach(fmt::format("{} is given a stream that does not exist", call));
    return nullptr;
  }
  if (found->second->device != device && of == Of::CurrentDevice)
    breach(fmt::format("{} is given a stream of device {} while {} is current", call, found->second->device, device));
  return found->second;
}

void Machine::ask(CUstream_st& stream, Step step) {
  if (CUgraph_st* const kept_in = stream.kept_in()) {
    kept_in->steps.push_back(std::move(step));
    ++stream.kept;
    stream.joined = false;
  } else {
    stream.waiting.push_back(std::move(step));
    ++stream.asked;
  }
}

void Machine::run(CUstream_st& stream, std::size_t until) {
  arena.open();
  while (stream.done < until && !stream.waiting.empty()) {
    const Step step = std::move(stream.waiting.front());
    stream.waiting.pop_front();
    ++stream.done;
    if (lost == cudaSuccess) step.run();
  }
  arena.close();
}
void Machine::run_all(int device) {
  for (const auto& [handle, stream] : streams)
    if (stream->device == device) run(*stream);
  for (const auto& [number, stream] : default_streams)
    if (number == device) run(*stream);
}

std::string Machine::fault_of(const ptx::Entry& entry, dim3 grid, dim3 block, std::size_t shared, const CUstream_st& stream) {
  const std::size_t threads = std::size_t{block.x} * block.y * block.z;
  if (threads == 0 || threads > entry.most_threads) return fmt::format("blocks of {} threads, of up to {}", threads, entry.most_threads);
  if (grid.x == 0 || grid.x > 0x7fffffffU || grid.y != 1 || grid.z != 1 || block.y != 1 || block.z != 1)
    return fmt::format("a grid of {} x {} x {} blocks", grid.x, grid.y, grid.z);
  if (shared != 0) return "shared memory that no kernel asks for";
  if (entry.parameter_bytes > kMostParameterBytes) return fmt::format("{} bytes of parameters", entry.parameter_bytes);
  if (stream.device != this_thread().device) return "a stream of another device";
  return "";
}

cudaError_t Machine::launch(const void* function, dim3 grid, dim3 block, void** arguments, std::size_t shared, cudaStream_t handle) {
  const auto stream = find(handle, "a launch");
  const auto named = functions.find(function);
  if (stream == nullptr || named == functions.end()) return cudaErrorInvalidResourceHandle;
  const int device = stream->device;
  if (setup.devices[static_cast<std::size_t>(device)].too_old) return cudaErrorNoKernelImageForDevice;
  static ptx::Kernels kernels(ptx::kernels_folder());  // read once for all machines
  const ptx::Entry& entry = kernels.find(ptx::demangled(named->second.c_str()));
  if (const std::string fault = fault_of(entry, grid, block, shared, *stream); !fault.empty()) {
    breach(fmt::format("a launch of {} with {}", entry.name, fault));
    return cudaErrorInvalidConfiguration;
  }
  // Loading a kernel may wait for all of the device, which a capture forbids.
  if (loaded_.insert({device, entry.name}).second && stream->kept_in() != nullptr)
    breach(fmt::format("{} is launched for the first time in a capture", entry.name));
  ++totals.launches;
  std::vector<std::byte> parameters(entry.parameter_bytes);
  for (std::size_t i = 0; i < entry.parameters.size(); ++i)
    std::memcpy(parameters.data() + entry.parameters[i], arguments[i], entry.parameter_sizes[i]);
  ask(*stream,
      {[this, &entry, parameters = std::move(parameters), grid, block, device] { run_kernel(entry, parameters, grid, block, device); }});
  return cudaSuccess;
}

void Machine::run_kernel(const ptx::Entry& entry, const std::vector<std::byte>& parameters, dim3 grid, dim3 block, int device) {
  try {
    ptx::run_blocks(entry, global_[device], parameters, grid.x, {.together = setup.together, .backwards = setup.together}, block.x);
  } catch (const ptx::Fault& fault) {
    breach(fault.what());
    lost = cudaErrorIllegalAddress;
    return;
  }
  if (setup.devices[static_cast<std::size_t>(device)].flushes && entry.name.find("probe_kernel") != std::string::npos) {
    float* out = nullptr;
    std::memcpy(&out, parameters.data() + entry.parameters.at(1), sizeof out);
    out[1] = 0.0F;  // see Values in gpu/probe.cu
  }
}

bool Machine::require_device_memory(const void* wanted, std::size_t bytes, int device, const char* call) {
  if (global_[device].holds(reinterpret_cast<std::uintptr_t>(wanted), bytes)) return true;
  breach(fmt::format("{} of {} bytes beside what was allocated on device {}", call, bytes, device));
  return false;
}

const void* Machine::pinned_with(const void* wanted, std::size_t bytes) const {
  for (const auto& [begin, content] : pinned)
    if (ptx::Extent{reinterpret_cast<std::uintptr_t>(begin), content.size()}.holds(reinterpret_cast<std::uintptr_t>(wanted), bytes))
      return begin;
  return nullptr;
}

void* Machine::new_memory(int device, std::size_t bytes) {
  arena.open();
  void* const made = arena.take(bytes);
  arena.close();
  if (made != nullptr) global_[device].add(made, bytes);
  return made;
}
void Machine::forget_memory(int device, const void* old) { (void)global_[device].remove(old); }

// Queries of tests.

void set_up(Equipment setup) {
  Machine& machine = Machine::get();
  const std::scoped_lock lock(machine.mutex);
  machine.set_up(std::move(setup));
}
void fail_at(std::size_t number, int code) {
  Machine& machine = Machine::get();
  const std::scoped_lock lock(machine.mutex);
  machine.fail_call = number;
  machine.fail_code = code;
  machine.failed = false;
}
bool has_failed() { return Machine::get().failed; }
std::vector<std::string> calls() { return Machine::get().called; }
std::vector<std::string> breaches() { return Machine::get().broken; }
Totals totals() { return Machine::get().totals; }

std::vector<int> priorities() {
  std::vector<int> found;
  for (const auto& [handle, stream] : Machine::get().streams) found.push_back(stream->priority);
  std::ranges::sort(found);
  return found;
}
std::set<int> devices_used() { return Machine::get().used; }

std::vector<std::string> leaks() {
  const Machine& machine = Machine::get();
  std::vector<std::string> found;
  const auto tell = [&found](const char* what, const auto& left) {
    if (!left.empty()) found.push_back(fmt::format("{} of {}", left.size(), what));
  };
  tell("the pieces of device memory", machine.memory);
  tell("the pieces of host memory", machine.pinned);
  tell("the streams", machine.streams);
  tell("the events", machine.events);
  tell("the graphs", machine.graphs);
  tell("the executable graphs", machine.executables);
  tell("the resources of OpenGL", machine.resources);
  return found;
}

}  // namespace dmoscope::gpu::fake
