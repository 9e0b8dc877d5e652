#ifdef DMOSCOPE_HAVE_CUDA

#include "gpu/cuda_module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/base/error.h"

namespace dmoscope::gpu {

/// Functions of the driver's library that a module needs.
class CudaModule::Driver {
 public:
  Driver() {
    // Never unloaded: the runtime keeps the library loaded, too.
    void* library = ::dlopen("libcuda.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) throw DeviceError(fmt::format("the CUDA driver's library: {}", ::dlerror()));
    get(library, error_name, "cuGetErrorName");
    get(library, load, "cuModuleLoadData");
    get(library, unload, "cuModuleUnload");
    get(library, find, "cuModuleGetFunction");
    get(library, launch, "cuLaunchKernel");
  }

  CUresult (*error_name)(CUresult, const char**) = nullptr;
  CUresult (*load)(CUmodule*, const void* image) = nullptr;
  CUresult (*unload)(CUmodule) = nullptr;
  CUresult (*find)(CUfunction*, CUmodule, const char* name) = nullptr;
  CUresult (*launch)(CUfunction, unsigned, unsigned, unsigned, unsigned, unsigned, unsigned, unsigned shared_bytes, CUstream,
                     void** arguments, void** extra) = nullptr;

  void check(CUresult result, const char* what) const {
    if (result == CUDA_SUCCESS) return;
    const char* name = nullptr;
    if (error_name(result, &name) != CUDA_SUCCESS || name == nullptr) name = "an unknown error";
    throw DeviceError(fmt::format("a formula's kernel could not be {}: {}", what, name));
  }

 private:
  template <class Function>
  static void get(void* library, Function& function, const char* name) {
    function = reinterpret_cast<Function>(::dlsym(library, name));
    if (function == nullptr) throw DeviceError(fmt::format("the CUDA driver's library has no {}", name));
  }
};

const CudaModule::Driver& CudaModule::driver() {
  static const Driver driver;
  return driver;
}

CudaModule::CudaModule(const std::string& ptx, const char* kernel) {
  driver().check(driver().load(&module_, ptx.c_str()), "loaded");
  if (const CUresult found = driver().find(&function_, module_, kernel); found != CUDA_SUCCESS) {
    (void)driver().unload(module_);
    driver().check(found, "found");
  }
}
CudaModule::~CudaModule() { (void)driver().unload(module_); }

void CudaModule::launch(std::size_t blocks, unsigned threads, void** arguments, CUstream stream) const {
  driver().check(driver().launch(function_, static_cast<unsigned>(blocks), 1, 1, threads, 1, 1, 0, stream, arguments, nullptr), "started");
}

}  // namespace dmoscope::gpu

#endif
