#include "gpu/nvrtc.h"

#include <algorithm>
#include <array>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/base/error.h"

namespace dmoscope::gpu {

namespace {

/// Names of the toolkits' libraries, which contain their major versions, from the newest on. The last is that of the toolkit that dmoscope
/// was built with.
std::vector<std::string> library_names() {
  std::vector<std::string> names{"libnvrtc.so.13", "libnvrtc.so.12", "libnvrtc.so"};
#ifdef DMOSCOPE_NVRTC_FOLDER
  names.emplace_back(DMOSCOPE_NVRTC_FOLDER "/libnvrtc.so");
#endif
  return names;
}

}  // namespace

/// Functions of the library, as nvrtc.h of any toolkit declares them.
class Nvrtc::Library {
 public:
  using Program = struct NvrtcProgram*;
  explicit Library(void* library) : library_(library) {
    complete_ = get(version, "nvrtcVersion") && get(error_text, "nvrtcGetErrorString") &&
                get(count_of_archs, "nvrtcGetNumSupportedArchs") && get(archs, "nvrtcGetSupportedArchs") &&
                get(create, "nvrtcCreateProgram") && get(destroy, "nvrtcDestroyProgram") && get(compile, "nvrtcCompileProgram") &&
                get(log_size, "nvrtcGetProgramLogSize") && get(log, "nvrtcGetProgramLog") && get(ptx_size, "nvrtcGetPTXSize") &&
                get(ptx, "nvrtcGetPTX");
  }
  ~Library() { (void)::dlclose(library_); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  [[nodiscard]] bool complete() const noexcept { return complete_; }

  int (*version)(int* major, int* minor) = nullptr;
  const char* (*error_text)(int status) = nullptr;
  int (*count_of_archs)(int* count) = nullptr;
  int (*archs)(int* archs) = nullptr;
  int (*create)(Program*, const char* source, const char* name, int headers, const char* const* texts, const char* const* names) = nullptr;
  int (*destroy)(Program*) = nullptr;
  int (*compile)(Program, int count, const char* const* options) = nullptr;
  int (*log_size)(Program, std::size_t*) = nullptr;
  int (*log)(Program, char*) = nullptr;
  int (*ptx_size)(Program, std::size_t*) = nullptr;
  int (*ptx)(Program, char*) = nullptr;

 private:
  template <class Function>
  [[nodiscard]] bool get(Function& function, const char* name) {
    function = reinterpret_cast<Function>(::dlsym(library_, name));
    return function != nullptr;
  }
  void* library_;
  bool complete_ = false;
};

namespace {

/// A program being compiled.
template <class Library>
class Compilation {
 public:
  Compilation(const Library& library, const std::string& source, std::span<const SourceHeader> headers) : library_(library) {
    std::vector<const char*> texts, names;
    for (const SourceHeader& header : headers) {
      texts.push_back(header.text.c_str());
      names.push_back(header.name.c_str());
    }
    check(library_.create(&program_, source.c_str(), "formula.cu", static_cast<int>(headers.size()), texts.data(), names.data()));
  }
  ~Compilation() { (void)library_.destroy(&program_); }
  Compilation(const Compilation&) = delete;
  Compilation& operator=(const Compilation&) = delete;

  [[nodiscard]] std::string compile(std::span<const char* const> options) {
    if (const int status = library_.compile(program_, static_cast<int>(options.size()), options.data()); status != 0)
      throw DeviceError(fmt::format("NVRTC: {}: {}", library_.error_text(status), text(library_.log_size, library_.log)));
    return text(library_.ptx_size, library_.ptx);
  }

 private:
  void check(int status) const {
    if (status != 0) throw DeviceError(fmt::format("NVRTC: {}", library_.error_text(status)));
  }
  template <class Size, class Get>
  [[nodiscard]] std::string text(Size size_of, Get get) const {
    std::size_t size = 0;
    check(size_of(program_, &size));
    std::string found(size, '\0');
    check(get(program_, found.data()));
    while (!found.empty() && found.back() == '\0') found.pop_back();
    return found;
  }
  const Library& library_;
  typename Library::Program program_ = nullptr;
};

}  // namespace

Nvrtc::Nvrtc(std::unique_ptr<Library> library) : library_(std::move(library)) {
  int major = 0, minor = 0;
  (void)library_->version(&major, &minor);
  version_ = 1000 * major + 10 * minor;
  description_ = fmt::format("NVRTC {}.{}", major, minor);
}
Nvrtc::~Nvrtc() = default;

const Nvrtc* Nvrtc::find(int newest) {
  static const std::vector<std::unique_ptr<const Nvrtc>> all = [] {
    std::vector<std::unique_ptr<const Nvrtc>> found;
    for (const std::string& name : library_names()) {
      void* opened = ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
      if (opened == nullptr) continue;
      auto library = std::make_unique<Library>(opened);
      if (library->complete()) found.emplace_back(new Nvrtc(std::move(library)));
    }
    return found;
  }();
  const auto found = std::ranges::find_if(all, [newest](const auto& each) { return each->version_ <= newest; });
  return found == all.end() ? nullptr : found->get();
}

std::string Nvrtc::compile(const std::string& source, std::span<const SourceHeader> headers, int capability) const {
  int count = 0;
  std::vector<int> known;
  if (library_->count_of_archs(&count) == 0 && count > 0) {
    known.resize(static_cast<std::size_t>(count));
    if (library_->archs(known.data()) != 0) known.clear();
  }
  std::erase_if(known, [capability](int each) { return each > capability; });
  if (!known.empty()) capability = *std::ranges::max_element(known);
  const std::string architecture = fmt::format("--gpu-architecture=compute_{}", capability);
  // All flags of gpu/CMakeLists.txt that change results.
  const std::array<const char*, 5> options{architecture.c_str(), "--std=c++20", "--fmad=false", "--device-as-default-execution-space",
                                           "--diag-suppress=1097"};  // warning about attributes of other compilers
  return Compilation(*library_, source, headers).compile(options);
}

}  // namespace dmoscope::gpu
