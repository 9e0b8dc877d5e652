// Contexts without a window: surfaceless EGL, else an EGL device. libEGL is looked for when it is needed, so that the
// program starts (and smooths) where it is not installed.

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

std::vector<std::pair<EGLDisplay, std::string>> device_displays() {
  std::vector<std::pair<EGLDisplay, std::string>> found;
  if (eglQueryDevicesEXT == nullptr || eglGetPlatformDisplayEXT == nullptr) return found;
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count) != EGL_TRUE) return found;
  for (EGLint i = 0; i < count; ++i) {
    EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr);
    if (display != EGL_NO_DISPLAY) found.emplace_back(display, fmt::format("EGL device {}", i));
  }
  return found;
}

}  // namespace

std::unique_ptr<Context> create_headless_context() {
  static EglLibrary egl;
  gladLoadEGLUserPtr(EGL_NO_DISPLAY, EglLibrary::load, &egl);
  std::vector<std::string> tried;
  std::unique_ptr<Context> software;
  const auto attempt = [&](EGLDisplay display, const std::string& origin) -> std::unique_ptr<Context> {
    try {
      auto context = std::make_unique<HeadlessContext>(display, origin, egl);
      if (!context->is_software()) return context;
      if (!software) software = std::move(context);
    } catch (const Error& error) {
      tried.push_back(fmt::format("{}: {}", origin, error.what()));
    }
    return nullptr;
  };
  EGLDisplay surfaceless = EGL_NO_DISPLAY;
  if (eglGetPlatformDisplayEXT != nullptr) surfaceless = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
  if (surfaceless == EGL_NO_DISPLAY) {
    tried.emplace_back("surfaceless EGL: not offered");
  } else if (auto context = attempt(surfaceless, "surfaceless EGL")) {
    return context;
  }
  // Software drawing was asked for, or a graphics card may do better.
  const char* forced = std::getenv("LIBGL_ALWAYS_SOFTWARE");
  if (software == nullptr || forced == nullptr || std::string_view(forced) == "0") {
    for (const auto& [display, origin] : device_displays()) {
      if (auto context = attempt(display, origin)) return context;
    }
  }
  if (software) {
    software->make_current();
    return software;
  }
  throw Error(fmt::format("drawing without a window is not possible here; tried {}; {}", fmt::join(tried, "; "), kWhatIsNeeded));
}

}  // namespace dmoscope::render
