// Contexts without a window: of an EGL device, or surfaceless. libEGL is loaded when it is needed, so that the program starts (and smooths)
// without it.

#include <array>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glad/egl.h>
#include <glad/gl.h>

#include "core/base/error.h"
#include "render/context.h"
#include "render/egl_order.h"

namespace dmoscope::render {
namespace {

constexpr std::string_view kWhatIsNeeded =
    "needed: OpenGL 4.5 through EGL (Debian packages libegl1 and libgl1-mesa-dri, or the graphics card's own driver)";

using Function = GLADapiproc;

class EglLibrary {
 public:
  EglLibrary() : library_(dlopen("libEGL.so.1", RTLD_NOW | RTLD_GLOBAL)) {
    if (library_ == nullptr) {
      const char* why = dlerror();
      throw Error(
          fmt::format("drawing without a window: libEGL.so.1 cannot be loaded ({}); {}", why == nullptr ? "unknown" : why, kWhatIsNeeded));
    }
    get_ = reinterpret_cast<Function (*)(const char*)>(dlsym(library_, "eglGetProcAddress"));
    if (get_ == nullptr) throw Error("drawing without a window: libEGL.so.1 has no eglGetProcAddress");
  }
  // The library is never closed: drivers below it keep threads and exit handlers of their own.

  static Function load(void* self, const char* name) {
    const auto* egl = static_cast<const EglLibrary*>(self);
    if (auto* found = reinterpret_cast<Function>(dlsym(egl->library_, name))) return found;
    return egl->get_(name);
  }
  [[nodiscard]] Function (*get() const)(const char*) { return get_; }

 private:
  void* library_;
  Function (*get_)(const char*) = nullptr;
};

class HeadlessContext final : public Context {
 public:
  HeadlessContext(EGLDisplay display, const std::string& origin, EglLibrary& egl) : display_(display) {
    EGLint major = 0, minor = 0;
    if (eglInitialize(display_, &major, &minor) != EGL_TRUE) fail("eglInitialize");
    gladLoadEGLUserPtr(display_, EglLibrary::load, &egl);
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) fail("eglBindAPI(EGL_OPENGL_API)");
    const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display_, wanted.data(), &config, 1, &count) != EGL_TRUE || count == 0) fail("eglChooseConfig");
    const std::array<EGLint, 7> attributes{
        EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, attributes.data());
    if (context_ == EGL_NO_CONTEXT) fail("eglCreateContext for OpenGL 4.5 core");
    try {
      make_current();
      if (gladLoadGL(reinterpret_cast<GLADloadfunc>(egl.get())) == 0) throw Error("OpenGL's functions cannot be loaded");
      adopt(origin);
    } catch (...) {
      release();
      throw;
    }
  }
  ~HeadlessContext() override { release(); }
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

  void make_current() override {
    eglBindAPI(EGL_OPENGL_API);
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) fail("eglMakeCurrent without a surface");
  }

 private:
  [[noreturn]] static void fail(std::string_view call) { throw Error(fmt::format("{} failed (0x{:04x})", call, eglGetError())); }
  // The display stays initialised: it is one for the whole process, and another context may live on it.
  void release() noexcept {
    if (eglGetCurrentContext() == context_) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
  }
  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

struct DeviceList {
  std::vector<EGLDeviceEXT> handles;
  std::vector<EglDevice> devices;
};

bool has_extension(EGLDeviceEXT device, std::string_view name) {
  const char* all = eglQueryDeviceStringEXT == nullptr ? nullptr : eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
  if (all == nullptr) return false;
  const std::string words = fmt::format(" {} ", all);
  return words.find(fmt::format(" {} ", name)) != std::string::npos;
}

EglDevice describe(EGLDeviceEXT handle) {
  EglDevice device;
  EGLAttrib number = 0;
  if (has_extension(handle, "EGL_NV_device_cuda") && eglQueryDeviceAttribEXT != nullptr &&
      eglQueryDeviceAttribEXT(handle, EGL_CUDA_DEVICE_NV, &number) == EGL_TRUE) {
    device.cuda = static_cast<int>(number);
  }
  device.software = has_extension(handle, "EGL_MESA_device_software");
  return device;
}

DeviceList query_devices() {
  DeviceList list;
  if (eglQueryDevicesEXT == nullptr || eglGetPlatformDisplayEXT == nullptr) return list;
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count) != EGL_TRUE) return list;
  for (EGLint i = 0; i < count; ++i) {
    list.handles.push_back(devices[static_cast<std::size_t>(i)]);
    list.devices.push_back(describe(list.handles.back()));
  }
  return list;
}

EGLDisplay display_of(const EglWay& way, const DeviceList& list) {
  if (eglGetPlatformDisplayEXT == nullptr) return EGL_NO_DISPLAY;
  if (!way.device) return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
  return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, list.handles[*way.device], nullptr);
}

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view{} : std::string_view{value};
}

}  // namespace

std::unique_ptr<Context> create_headless_context(std::optional<int> cuda_device) {
  static EglLibrary egl;
  gladLoadEGLUserPtr(EGL_NO_DISPLAY, EglLibrary::load, &egl);
  const DeviceList list = query_devices();
  const std::string_view forced = variable("DMOSCOPE_EGL"), software_forced = variable("LIBGL_ALWAYS_SOFTWARE");
  const bool software_wanted = !software_forced.empty() && software_forced != "0";
  std::vector<std::string> tried;
  std::unique_ptr<Context> software;
  for (const EglWay& way : egl_order(list.devices, forced, software_wanted ? std::nullopt : cuda_device)) {
    const EGLDisplay display = display_of(way, list);
    if (display == EGL_NO_DISPLAY) {
      tried.push_back(way.description + ": not offered");
      continue;
    }
    try {
      auto context = std::make_unique<HeadlessContext>(display, way.description, egl);
      if (!context->is_software()) return context;
      if (!software) software = std::move(context);
    } catch (const Error& error) {
      tried.push_back(fmt::format("{}: {}", way.description, error.what()));
    }
    if (software && software_wanted) break;  // software drawing was asked for; otherwise a graphics card may do better
  }
  if (software) {
    software->make_current();
    return software;
  }
  throw Error(fmt::format("drawing without a window is not possible here; tried {}; {}", fmt::join(tried, "; "), kWhatIsNeeded));
}

}  // namespace dmoscope::render
