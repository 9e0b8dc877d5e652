// The runtime's calls for OpenGL's buffers. The bytes of a mapped buffer are memory of the device, and go back into it when it is unmapped.

#include <fmt/format.h>

#include "tests/gpu/fake/machine.h"

#if __has_include(<GL/gl.h>)
#include <cuda_gl_interop.h>
#else
enum cudaGLDeviceList { cudaGLDeviceListAll = 1 };
#endif

using namespace dmoscope::gpu::fake;

namespace {

const void* current_context(const Machine& machine) { return machine.setup.gl == nullptr ? nullptr : machine.setup.gl->current_context(); }

/// Returns the resource, if it exists; checks the rule that its context is current on this thread.
cudaGraphicsResource* find(Machine& machine, cudaGraphicsResource_t handle, const char* call) {
  const auto found = machine.resources.find(handle);
  if (found == machine.resources.end()) {
    machine.breach(fmt::format("{} of a buffer that is not registered", call));
    return nullptr;
  }
  if (current_context(machine) != found->second->context)
    machine.breach(fmt::format("{} without the buffer's OpenGL context on this thread", call));
  return found->second.get();
}

cudaError_t map(Machine& machine, cudaGraphicsResource& resource, CUstream_st& stream) {
  if (resource.mapped != nullptr) {
    machine.breach("cudaGraphicsMapResources of what is mapped");
    return cudaErrorAlreadyMapped;
  }
  if (resource.device != stream.device) machine.breach("cudaGraphicsMapResources in a stream of another device");
  resource.mapped = machine.new_memory(resource.device, resource.bytes);  // the former content is lost
  resource.stream = &stream;
  return cudaSuccess;
}

cudaError_t unmap(Machine& machine, cudaGraphicsResource& resource, CUstream_st& stream) {
  if (resource.mapped == nullptr) {
    machine.breach("cudaGraphicsUnmapResources of what is not mapped");
    return cudaErrorNotMapped;
  }
  if (resource.stream != &stream) machine.breach("cudaGraphicsUnmapResources in another stream than the one that mapped");
  machine.run(stream);
  if (machine.lost == cudaSuccess && current_context(machine) == resource.context) {
    machine.arena.open();
    machine.setup.gl->write(resource.buffer, {static_cast<const std::byte*>(resource.mapped), resource.bytes});
    machine.arena.close();
  }
  machine.forget_memory(resource.device, resource.mapped);
  resource.mapped = nullptr;
  return cudaSuccess;
}

/// Calls act for each of them; returns the first error.
template <class Act>
cudaError_t for_each(Machine& machine, int count, cudaGraphicsResource_t* handles, cudaStream_t stream, const char* call, const Act& act) {
  if (machine.forbidden_in_capture(call)) return cudaErrorStreamCaptureUnsupported;
  const auto found = machine.find(stream, call, Machine::Of::AnyDevice);
  if (found == nullptr) return cudaErrorInvalidResourceHandle;
  cudaError_t status = cudaSuccess;
  for (int i = 0; i < count; ++i) {
    cudaGraphicsResource* const resource = find(machine, handles[i], call);
    const cudaError_t one = resource == nullptr ? cudaErrorInvalidResourceHandle : act(machine, *resource, *found);
    if (status == cudaSuccess) status = one;
  }
  return status;
}

}  // namespace

extern "C" {

cudaError_t cudaGLGetDevices(unsigned* count, int* devices, unsigned capacity, cudaGLDeviceList /*list*/) {
  return call("cudaGLGetDevices", [&](const Machine& machine) {
    if (current_context(machine) == nullptr) return cudaErrorInvalidGraphicsContext;
    if (machine.setup.drawing < 0) return cudaErrorNoDevice;
    *count = 1;
    if (capacity > 0) devices[0] = machine.setup.drawing;
    return cudaSuccess;
  });
}

cudaError_t cudaGraphicsGLRegisterBuffer(cudaGraphicsResource_t* resource, unsigned buffer, unsigned flags) {
  return call("cudaGraphicsGLRegisterBuffer", [&](Machine& machine) {
    const void* const context = current_context(machine);
    if (context == nullptr) {
      machine.breach("cudaGraphicsGLRegisterBuffer without an OpenGL context on this thread");
      return cudaErrorInvalidGraphicsContext;
    }
    if (!machine.setup.gl->size_of(buffer)) {
      machine.breach("cudaGraphicsGLRegisterBuffer of a buffer that does not exist");
      return cudaErrorInvalidValue;
    }
    const int device = this_thread().device;
    if (device != machine.setup.drawing) machine.breach("cudaGraphicsGLRegisterBuffer with a device that does not draw");
    if (flags != cudaGraphicsRegisterFlagsWriteDiscard) machine.breach("cudaGraphicsGLRegisterBuffer for more than to be overwritten");
    for (const auto& [handle, other] : machine.resources)
      if (other->buffer == buffer && other->context == context) machine.breach("cudaGraphicsGLRegisterBuffer twice");
    auto made = std::make_unique<cudaGraphicsResource>();
    made->device = device;
    made->buffer = buffer;
    made->context = context;
    made->bytes = *machine.setup.gl->size_of(buffer);
    *resource = made.get();
    machine.resources[made.get()] = std::move(made);
    return cudaSuccess;
  });
}

cudaError_t cudaGraphicsUnregisterResource(cudaGraphicsResource_t handle) {
  return giving_back("cudaGraphicsUnregisterResource", [&](Machine& machine) {
    cudaGraphicsResource* const resource = find(machine, handle, "cudaGraphicsUnregisterResource");
    if (resource == nullptr) return cudaErrorInvalidResourceHandle;
    if (resource->mapped != nullptr) machine.breach("cudaGraphicsUnregisterResource of what is mapped");
    if (machine.setup.gl == nullptr || !machine.setup.gl->size_of(resource->buffer))
      machine.breach("cudaGraphicsUnregisterResource after the buffer was deleted");
    machine.resources.erase(handle);
    return cudaSuccess;
  });
}

cudaError_t cudaGraphicsMapResources(int count, cudaGraphicsResource_t* resources, cudaStream_t stream) {
  return call("cudaGraphicsMapResources",
              [&](Machine& machine) { return for_each(machine, count, resources, stream, "cudaGraphicsMapResources", map); });
}
cudaError_t cudaGraphicsUnmapResources(int count, cudaGraphicsResource_t* resources, cudaStream_t stream) {
  return giving_back("cudaGraphicsUnmapResources",
                     [&](Machine& machine) { return for_each(machine, count, resources, stream, "cudaGraphicsUnmapResources", unmap); });
}
cudaError_t cudaGraphicsResourceGetMappedPointer(void** memory, std::size_t* bytes, cudaGraphicsResource_t handle) {
  return call("cudaGraphicsResourceGetMappedPointer", [&](Machine& machine) {
    const cudaGraphicsResource* const resource = find(machine, handle, "cudaGraphicsResourceGetMappedPointer");
    if (resource == nullptr) return cudaErrorInvalidResourceHandle;
    if (resource->mapped == nullptr) {
      machine.breach("cudaGraphicsResourceGetMappedPointer of what is not mapped");
      return cudaErrorNotMapped;
    }
    *memory = resource->mapped;
    *bytes = resource->bytes;
    return cudaSuccess;
  });
}

}  // extern "C"
