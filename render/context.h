#pragma once
// An OpenGL 4.5 core context, of a window or of none.

#include <memory>
#include <optional>
#include <string>

namespace dmoscope::render {

/// A context that everything in this module draws with. It must be current on the calling thread whenever an object of this module
/// that owns OpenGL things (Framebuffer, PlanarScene, ...) is made, used or destroyed, and it must outlive them.
class Context {
 public:
  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  virtual ~Context() = default;

  /// Makes the context current on the calling thread. Throws Error.
  virtual void make_current() = 0;
  /// Waits until everything that was drawn is there. The context must be current.
  void finish();
  /// Name of the renderer, for the status bar and `info`: "OpenGL 4.5, llvmpipe (LLVM 15.0.6, 256 bits), surfaceless EGL".
  [[nodiscard]] const std::string& description() const noexcept { return description_; }
  /// True when the processor draws (llvmpipe, softpipe, swrast): big meshes are then slow, see Scene::suggested_detail.
  [[nodiscard]] bool is_software() const noexcept { return software_; }

 protected:
  /// Takes over a context that was just made current and whose functions are loaded: checks that it is 4.5 or newer (else Error that says
  /// which version there is and which is needed), fills the description, and in debug builds turns OpenGL's messages on.
  void adopt(const std::string& origin);

 private:
  std::string description_;
  bool software_ = false;
};

/// A context without window or display server: on the device that smooths, if `cuda_device` is CUDA's number of one that EGL knows; else
/// surfaceless EGL (Mesa), or an EGL device (NVIDIA) where that draws on the processor. The environment variable DMOSCOPE_EGL chooses one
/// instead: "surfaceless", "device:N" or "cuda:N". It is current on return. Throws Error that says what was tried, which packages are
/// missing and which OpenGL version is needed.
[[nodiscard]] std::unique_ptr<Context> create_headless_context(std::optional<int> cuda_device = {});

}  // namespace dmoscope::render
