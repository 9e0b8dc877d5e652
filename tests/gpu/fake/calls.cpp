// The calls of the CUDA runtime that gpu makes, in place of the runtime's own. A call that is missing here links the runtime, which then
// defines them all twice: the linker says so.

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "tests/gpu/fake/machine.h"

using namespace dmoscope::gpu::fake;

namespace {

bool is_device(const Machine& machine, int device) {
  return device >= 0 && static_cast<std::size_t>(device) < machine.setup.devices.size();
}
const FakeDevice& device_of(const Machine& machine, int device) { return machine.setup.devices[static_cast<std::size_t>(device)]; }

cudaError_t count_devices(const Machine& machine) {
  if (machine.setup.driver == 0) return cudaErrorInsufficientDriver;
  return machine.setup.devices.empty() ? cudaErrorNoDevice : cudaSuccess;
}

template <class Map, class Handle>
cudaError_t give_back(Machine& machine, Map& live, Handle handle, const char* call, const char* what) {
  if (live.erase(handle) != 0) return cudaSuccess;
  machine.breach(fmt::format("{} of a {} that does not exist", call, what));
  return cudaErrorInvalidResourceHandle;
}

/// Whether a device has yet to read or write this piece of the host's memory. Null: no piece.
bool is_waited_for(const Machine& machine, const void* pinned) {
  if (pinned == nullptr) return false;
  for (const auto& [handle, stream] : machine.streams)
    if (std::ranges::any_of(stream->waiting, [&](const Step& step) { return step.pinned == pinned; })) return true;
  return false;
}

/// Asks for a copy between a device's memory and the host's, which is read or written when the step is done.
cudaError_t copy_later(Machine& machine, void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind, cudaStream_t handle) {
  const auto stream = machine.find(handle, "cudaMemcpyAsync");
  if (stream == nullptr) return cudaErrorInvalidResourceHandle;
  const bool up = kind == cudaMemcpyHostToDevice;
  if (!up && kind != cudaMemcpyDeviceToHost) return cudaErrorInvalidValue;
  if (!machine.require_device_memory(up ? to : from, bytes, stream->device, "a copy")) return cudaErrorInvalidValue;
  const void* const pinned = machine.pinned_with(up ? from : to, bytes);
  if (pinned == nullptr) {
    if (stream->kept_in() != nullptr) {
      machine.breach("a copy of ordinary memory in a capture");
      return cudaErrorStreamCaptureUnsupported;
    }
    this_thread().unprotected = stream;
  }
  if (up) {
    std::vector<std::byte> then(static_cast<const std::byte*>(from), static_cast<const std::byte*>(from) + bytes);
    machine.ask(*stream, {[&machine, to, from, then = std::move(then)] {
                            if (std::memcmp(from, then.data(), then.size()) != 0) machine.breach("memory was changed before it was copied");
                            std::memcpy(to, from, then.size());
                          },
                          pinned});
  } else {
    if (stream->kept_in() == nullptr && !is_waited_for(machine, pinned))
      std::memset(to, 0xcd, bytes);  // makes a read before the copy visible
    machine.ask(*stream, {[to, from, bytes] { std::memcpy(to, from, bytes); }, pinned});
  }
  return cudaSuccess;
}

/// Whether the event was recorded in a capture that is still under way.
bool is_kept(const Machine& machine, const CUevent_st& event) {
  return event.kept_in != nullptr &&
         std::ranges::any_of(machine.streams, [&](const auto& stream) { return stream.second->capture.get() == event.kept_in; });
}

/// Captures a stream that waits for a captured one together with it; if it was captured before, the other is joined to it.
cudaError_t wait_in_capture(Machine& machine, const std::shared_ptr<CUstream_st>& stream, const CUevent_st& event) {
  if (!is_kept(machine, event)) {
    machine.breach("a capture waits for what is not captured");
    return cudaErrorStreamCaptureIsolation;
  }
  if (stream->kept_in() == nullptr) {
    if (!stream->waiting.empty()) machine.breach("a stream joins a capture while it has work to do");
    stream->forked_from = event.stream->forked_from != nullptr ? event.stream->forked_from : event.stream;
    stream->joined = false;
  } else if (stream->kept_in() != event.kept_in) {
    machine.breach("a capture waits for another one");
    return cudaErrorStreamCaptureMerge;
  } else if (event.stream->forked_from == stream) {
    event.stream->joined = event.after_kept == event.stream->kept;
  }
  return cudaSuccess;
}

/// Ends the capture of the streams that were captured with `origin`. Returns whether their work was waited for.
bool join_all(Machine& machine, const std::shared_ptr<CUstream_st>& origin) {
  bool all = true;
  for (const auto& [handle, stream] : machine.streams)
    if (stream->forked_from == origin) {
      all = all && stream->joined;
      stream->forked_from.reset();
    }
  return all;
}

cudaError_t free_on_host(Machine& machine, void* memory) {
  if (machine.forbidden_in_capture("cudaFreeHost")) return cudaErrorStreamCaptureUnsupported;
  if (machine.lost == cudaSuccess && is_waited_for(machine, memory))
    machine.breach("cudaFreeHost of memory that a device has yet to write");
  return give_back(machine, machine.pinned, static_cast<const std::byte*>(memory), "cudaFreeHost", "piece of memory");
}

}  // namespace

extern "C" {

// Devices.

cudaError_t cudaDriverGetVersion(int* version) {
  return call("cudaDriverGetVersion", [&](const Machine& machine) {
    *version = machine.setup.driver;
    return cudaSuccess;
  });
}
cudaError_t cudaGetDeviceCount(int* count) {
  return call("cudaGetDeviceCount", [&](const Machine& machine) {
    const cudaError_t status = count_devices(machine);
    if (status == cudaSuccess) *count = static_cast<int>(machine.setup.devices.size());
    return status;
  });
}
cudaError_t cudaGetDeviceProperties(cudaDeviceProp* properties, int device) {
  return call("cudaGetDeviceProperties", [&](const Machine& machine) {
    if (!is_device(machine, device)) return cudaErrorInvalidDevice;
    const FakeDevice& found = device_of(machine, device);
    *properties = {};
    found.name.copy(properties->name, sizeof properties->name - 1);
    properties->major = found.major;
    properties->minor = found.minor;
    properties->totalGlobalMem = found.memory;
    properties->multiProcessorCount = found.multiprocessors;
    return cudaSuccess;
  });
}
cudaError_t cudaGetDevice(int* device) {
  return call("cudaGetDevice", [&](const Machine& machine) {
    *device = this_thread().device;
    return count_devices(machine);
  });
}
cudaError_t cudaSetDevice(int device) {
  return call("cudaSetDevice", [&](Machine& machine) {
    if (!is_device(machine, device)) return cudaErrorInvalidDevice;
    ThreadState& thread = this_thread();
    if (thread.device != device && machine.forbidden_in_capture("cudaSetDevice")) return cudaErrorStreamCaptureUnsupported;
    if (const int refused = device_of(machine, device).refuses; refused != 0) return static_cast<cudaError_t>(refused);
    thread.device = device;
    machine.used.insert(device);
    return cudaSuccess;
  });
}

// Errors.

cudaError_t cudaGetLastError() {
  Machine& machine = Machine::get();
  const std::scoped_lock lock(machine.mutex);
  const cudaError_t status = machine.enter("cudaGetLastError");
  const cudaError_t last = std::exchange(this_thread().last, cudaSuccess);
  return status != cudaSuccess ? status : last;
}
const char* cudaGetErrorName(cudaError_t error) {
  switch (static_cast<int>(error)) {
    case kOutOfMemory:
      return "cudaErrorMemoryAllocation";
    case kDriverTooOld:
      return "cudaErrorInsufficientDriver";
    case kUnavailable:
      return "cudaErrorDevicesUnavailable";
    case kNoDevice:
      return "cudaErrorNoDevice";
    case kNoKernelImage:
      return "cudaErrorNoKernelImageForDevice";
    case kWrongPtxVersion:
      return "cudaErrorUnsupportedPtxVersion";
    case kOperatingSystem:
      return "cudaErrorOperatingSystem";
    case kIllegalAddress:
      return "cudaErrorIllegalAddress";
    case kTimeout:
      return "cudaErrorLaunchTimeout";
    default:
      return "cudaErrorOfAnotherKind";
  }
}
const char* cudaGetErrorString(cudaError_t error) {
  switch (static_cast<int>(error)) {
    case kOutOfMemory:
      return "out of memory";
    case kDriverTooOld:
      return "CUDA driver version is insufficient for CUDA runtime version";
    case kUnavailable:
      return "CUDA-capable device(s) is/are busy or unavailable";
    case kNoDevice:
      return "no CUDA-capable device is detected";
    case kNoKernelImage:
      return "no kernel image is available for execution on the device";
    case kWrongPtxVersion:
      return "the provided PTX was compiled with an unsupported toolchain.";
    case kOperatingSystem:
      return "OS call failed or operation not supported on this OS";
    case kIllegalAddress:
      return "an illegal memory access was encountered";
    case kTimeout:
      return "the launch timed out and was terminated";
    default:
      return "an error of another kind";
  }
}

// Memory.

cudaError_t cudaMalloc(void** memory, std::size_t bytes) {
  return call("cudaMalloc", [&](Machine& machine) {
    if (machine.forbidden_in_capture("cudaMalloc")) return cudaErrorStreamCaptureUnsupported;
    const int device = this_thread().device;
    std::size_t used = 0;
    for (const auto& [begin, piece] : machine.memory) used += piece.device == device ? piece.bytes : 0;
    const std::size_t all = device_of(machine, device).memory;
    void* const made = bytes > all - used ? nullptr : machine.new_memory(device, bytes);
    if (made == nullptr) return cudaErrorMemoryAllocation;
    machine.memory[made] = {device, bytes};
    *memory = made;
    return cudaSuccess;
  });
}
cudaError_t cudaFree(void* memory) {
  return giving_back("cudaFree", [&](Machine& machine) {
    if (machine.forbidden_in_capture("cudaFree")) return cudaErrorStreamCaptureUnsupported;
    const auto found = machine.memory.find(memory);
    if (found == machine.memory.end()) return give_back(machine, machine.memory, memory, "cudaFree", "piece of memory");
    machine.run_all(found->second.device);  // waits for the device
    machine.forget_memory(found->second.device, memory);
    machine.memory.erase(found);
    return cudaSuccess;
  });
}
cudaError_t cudaMallocHost(void** memory, std::size_t bytes) {
  return call("cudaMallocHost", [&](Machine& machine) {
    if (machine.forbidden_in_capture("cudaMallocHost")) return cudaErrorStreamCaptureUnsupported;
    std::vector<std::byte> made(bytes, std::byte{0xcd});
    *memory = made.data();
    machine.pinned[made.data()] = std::move(made);
    return cudaSuccess;
  });
}
cudaError_t cudaFreeHost(void* memory) {
  return giving_back("cudaFreeHost", [&](Machine& machine) { return free_on_host(machine, memory); });
}
cudaError_t cudaMemGetInfo(std::size_t* free, std::size_t* total) {
  return call("cudaMemGetInfo", [&](const Machine& machine) {
    *total = *free = device_of(machine, this_thread().device).memory;
    for (const auto& [begin, piece] : machine.memory) *free -= piece.device == this_thread().device ? piece.bytes : 0;
    return cudaSuccess;
  });
}
cudaError_t cudaMemcpy(void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind) {
  return call("cudaMemcpy", [&](Machine& machine) {
    if (machine.forbidden_in_capture("cudaMemcpy")) return cudaErrorStreamCaptureUnsupported;
    const cudaError_t status = copy_later(machine, to, from, bytes, kind, nullptr);
    machine.run(*machine.find(nullptr, "cudaMemcpy"));
    this_thread().unprotected.reset();
    return status != cudaSuccess ? status : machine.lost;
  });
}
cudaError_t cudaMemcpyAsync(void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind, cudaStream_t stream) {
  return call("cudaMemcpyAsync", [&](Machine& machine) { return copy_later(machine, to, from, bytes, kind, stream); });
}
cudaError_t cudaMemsetAsync(void* memory, int value, std::size_t bytes, cudaStream_t handle) {
  return call("cudaMemsetAsync", [&](Machine& machine) {
    const auto stream = machine.find(handle, "cudaMemsetAsync");
    if (stream == nullptr) return cudaErrorInvalidResourceHandle;
    if (!machine.require_device_memory(memory, bytes, stream->device, "a memset")) return cudaErrorInvalidValue;
    machine.ask(*stream, {[=] { std::memset(memory, value, bytes); }});
    return cudaSuccess;
  });
}

// Streams and events.

cudaError_t cudaStreamCreateWithPriority(cudaStream_t* stream, unsigned flags, int priority) {
  return call("cudaStreamCreateWithPriority", [&](Machine& machine) {
    if (machine.forbidden_in_capture("cudaStreamCreateWithPriority")) return cudaErrorStreamCaptureUnsupported;
    if (flags != cudaStreamNonBlocking) machine.breach("a stream that waits for the default one");
    const auto made = std::make_shared<CUstream_st>(CUstream_st{.device = this_thread().device, .priority = priority});
    machine.streams[made.get()] = made;
    *stream = made.get();
    return cudaSuccess;
  });
}
cudaError_t cudaStreamCreateWithFlags(cudaStream_t* stream, unsigned flags) { return cudaStreamCreateWithPriority(stream, flags, 0); }
cudaError_t cudaDeviceGetStreamPriorityRange(int* least, int* greatest) {
  return call("cudaDeviceGetStreamPriorityRange", [&](const Machine&) {
    *least = 0;
    *greatest = -5;
    return cudaSuccess;
  });
}
cudaError_t cudaStreamDestroy(cudaStream_t stream) {
  return giving_back("cudaStreamDestroy", [&](Machine& machine) {
    if (const auto found = machine.streams.find(stream); found != machine.streams.end()) {
      if (found->second->kept_in() != nullptr) machine.breach("cudaStreamDestroy in a capture");
      machine.run(*found->second);  // the work asked for is done all the same
    }
    return give_back(machine, machine.streams, stream, "cudaStreamDestroy", "stream");
  });
}
cudaError_t cudaStreamSynchronize(cudaStream_t handle) {
  return giving_back("cudaStreamSynchronize", [&](Machine& machine) {
    if (machine.forbidden_in_capture("cudaStreamSynchronize")) return cudaErrorStreamCaptureUnsupported;
    const auto stream = machine.find(handle, "cudaStreamSynchronize", Machine::Of::AnyDevice);
    if (stream == nullptr) return cudaErrorInvalidResourceHandle;
    machine.run(*stream);
    if (this_thread().unprotected == stream) this_thread().unprotected.reset();
    return machine.lost;
  });
}
cudaError_t cudaStreamWaitEvent(cudaStream_t handle, cudaEvent_t event, unsigned /*flags*/) {
  return call("cudaStreamWaitEvent", [&](Machine& machine) {
    const auto stream = machine.find(handle, "cudaStreamWaitEvent");
    const auto found = machine.events.find(event);
    if (found == machine.events.end()) machine.breach("cudaStreamWaitEvent for an event that does not exist");
    if (stream == nullptr || found == machine.events.end()) return cudaErrorInvalidResourceHandle;
    if (stream->kept_in() != nullptr || is_kept(machine, *found->second)) return wait_in_capture(machine, stream, *found->second);
    if (const auto other = found->second->stream; other != nullptr)
      machine.ask(*stream, {[&machine, other, after = found->second->after] { machine.run(*other, after); }});
    return cudaSuccess;
  });
}
cudaError_t cudaEventCreateWithFlags(cudaEvent_t* event, unsigned /*flags*/) {
  return call("cudaEventCreateWithFlags", [&](Machine& machine) {
    auto made = std::make_unique<CUevent_st>(CUevent_st{.device = this_thread().device});
    *event = made.get();
    machine.events[made.get()] = std::move(made);
    return cudaSuccess;
  });
}
cudaError_t cudaEventRecord(cudaEvent_t event, cudaStream_t handle) {
  return call("cudaEventRecord", [&](Machine& machine) {
    const auto stream = machine.find(handle, "cudaEventRecord");
    const auto found = machine.events.find(event);
    if (found == machine.events.end()) machine.breach("cudaEventRecord of an event that does not exist");
    if (stream == nullptr || found == machine.events.end()) return cudaErrorInvalidResourceHandle;
    if (found->second->device != stream->device) machine.breach("cudaEventRecord of an event of another device");
    found->second->stream = stream;
    found->second->after_kept = stream->kept;
    found->second->kept_in = stream->kept_in();
    found->second->after = stream->asked;
    return cudaSuccess;
  });
}
cudaError_t cudaEventSynchronize(cudaEvent_t event) {
  return giving_back("cudaEventSynchronize", [&](Machine& machine) {
    if (machine.forbidden_in_capture("cudaEventSynchronize")) return cudaErrorStreamCaptureUnsupported;
    const auto found = machine.events.find(event);
    if (found == machine.events.end()) {
      machine.breach("cudaEventSynchronize with an event that does not exist");
      return cudaErrorInvalidResourceHandle;
    }
    if (const auto stream = found->second->stream; stream != nullptr) machine.run(*stream, found->second->after);
    return machine.lost;
  });
}
cudaError_t cudaEventDestroy(cudaEvent_t event) {
  return giving_back("cudaEventDestroy",
                     [&](Machine& machine) { return give_back(machine, machine.events, event, "cudaEventDestroy", "event"); });
}

// Graphs.

cudaError_t cudaStreamBeginCapture(cudaStream_t handle, cudaStreamCaptureMode mode) {
  return call("cudaStreamBeginCapture", [&](Machine& machine) {
    const auto stream = handle == nullptr ? nullptr : machine.find(handle, "cudaStreamBeginCapture");
    if (stream == nullptr || stream->kept_in() != nullptr) {
      machine.breach("cudaStreamBeginCapture of a stream that cannot be captured");
      return cudaErrorIllegalState;
    }
    if (mode != cudaStreamCaptureModeThreadLocal) machine.breach("a capture that forbids other threads their work");
    stream->capture = std::make_unique<CUgraph_st>();
    stream->capturing = std::this_thread::get_id();
    stream->invalid = false;
    ++this_thread().captures;
    return cudaSuccess;
  });
}
cudaError_t cudaStreamEndCapture(cudaStream_t handle, cudaGraph_t* graph) {
  bool fails = true;  // ends the capture, but there is no graph
  *graph = nullptr;
  const cudaError_t status = giving_back("cudaStreamEndCapture", [&](Machine& machine) {
    const auto stream = machine.find(handle, "cudaStreamEndCapture", Machine::Of::AnyDevice);
    if (stream == nullptr || stream->capture == nullptr || stream->capturing != std::this_thread::get_id()) {
      machine.breach("cudaStreamEndCapture where this thread captures nothing");
      return cudaErrorIllegalState;
    }
    --this_thread().captures;
    const bool all_joined = join_all(machine, stream);
    auto made = std::move(stream->capture);
    if (!all_joined && !stream->invalid && machine.lost == cudaSuccess) return cudaErrorStreamCaptureUnjoined;
    if (stream->invalid || machine.lost != cudaSuccess) return cudaErrorStreamCaptureInvalidated;
    fails = false;
    *graph = made.get();
    machine.graphs[made.get()] = std::move(made);
    return cudaSuccess;
  });
  if (status != cudaSuccess && !fails) {
    Machine::get().graphs.erase(*graph);
    *graph = nullptr;
  }
  return status;
}
cudaError_t cudaGraphInstantiate(cudaGraphExec_t* executable, cudaGraph_t graph, unsigned long long /*flags*/) {
  return call("cudaGraphInstantiate", [&](Machine& machine) {
    const auto found = machine.graphs.find(graph);
    if (found == machine.graphs.end()) {
      machine.breach("cudaGraphInstantiate of a graph that does not exist");
      return cudaErrorInvalidValue;
    }
    auto made = std::make_unique<CUgraphExec_st>(CUgraphExec_st{found->second->steps});
    *executable = made.get();
    machine.executables[made.get()] = std::move(made);
    return cudaSuccess;
  });
}
cudaError_t cudaGraphUpload(cudaGraphExec_t executable, cudaStream_t handle) {
  return call("cudaGraphUpload", [&](Machine& machine) {
    const bool exists = machine.executables.contains(executable);
    if (!exists) machine.breach("cudaGraphUpload of a graph that does not exist");
    return machine.find(handle, "cudaGraphUpload") != nullptr && exists ? cudaSuccess : cudaErrorInvalidResourceHandle;
  });
}
cudaError_t cudaGraphDestroy(cudaGraph_t graph) {
  return giving_back("cudaGraphDestroy",
                     [&](Machine& machine) { return give_back(machine, machine.graphs, graph, "cudaGraphDestroy", "graph"); });
}
cudaError_t cudaGraphExecDestroy(cudaGraphExec_t executable) {
  return giving_back("cudaGraphExecDestroy", [&](Machine& machine) {
    return give_back(machine, machine.executables, executable, "cudaGraphExecDestroy", "executable graph");
  });
}
cudaError_t cudaGraphLaunch(cudaGraphExec_t executable, cudaStream_t handle) {
  return call("cudaGraphLaunch", [&](Machine& machine) {
    const auto stream = machine.find(handle, "cudaGraphLaunch");
    const auto found = machine.executables.find(executable);
    if (found == machine.executables.end()) machine.breach("cudaGraphLaunch of a graph that does not exist");
    if (stream == nullptr || found == machine.executables.end()) return cudaErrorInvalidResourceHandle;
    for (const Step& step : found->second->steps) machine.ask(*stream, step);
    return cudaSuccess;
  });
}

// Kernels.

cudaError_t cudaLaunchKernel(const void* function, dim3 grid, dim3 block, void** arguments, std::size_t shared, cudaStream_t stream) {
  return call("cudaLaunchKernel", [&](Machine& machine) { return machine.launch(function, grid, block, arguments, shared, stream); });
}

}  // extern "C"
