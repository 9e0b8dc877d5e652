#pragma once
// A device whose kernels are what nvcc made of them, run instruction by instruction on the host: slow, and exact.

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "gpu/defined/defined_task.h"
#include "gpu/queue.h"
#include "tests/gpu/ptx/reader.h"
#include "tests/gpu/ptx/warp.h"

namespace dmoscope::gpu::ptx {

/// "_Z3addPff" -> "add(float*, float)". Throws Fault where it is no such name.
[[nodiscard]] std::string demangled(const char* name);

/// Where the build put the PTX of one compute capability, whose number is the folder's name: the one that the environment variable
/// DMOSCOPE_PTX names, else the one that CMake was given. Empty: the build found no CUDA toolkit.
[[nodiscard]] std::filesystem::path kernels_folder();

/// The kernels in a folder's .ptx files.
class Kernels {
 public:
  /// Throws Fault where there is none.
  explicit Kernels(const std::filesystem::path& folder);
  [[nodiscard]] const std::vector<EntryText>& texts() const noexcept { return texts_; }
  /// Decoded when it is first asked for. Throws Fault where there is not exactly one.
  [[nodiscard]] const Entry& find(Work work, Metric metric, const DefinedTask& defined);
  /// By its name as a compiler prints it.
  [[nodiscard]] const Entry& find(const std::string& name);

  struct Name {
    std::string text;  // as a compiler prints it
    std::size_t team = 1;
    std::size_t each = 1;  // how much of the work a lane does
  };
  /// The name of the kernel that does some work, chosen as gpu/cuda_launch.cuh does.
  [[nodiscard]] static Name name_of(Work work, Metric metric, const DefinedTask& defined);

 private:
  std::vector<EntryText> texts_;
  std::unordered_map<std::string, std::size_t> by_name_;  // demangled -> place in texts_
  std::unordered_map<std::string, Entry> decoded_;
};

struct PtxDevice {
  std::size_t lanes_at_once = 4096;
  Schedule schedule{};    // with races: they forget what a launch did when it is done, or all that were asked for at once
  bool compiles = false;  // formulas, by NVRTC, where that is
  std::map<Work, std::uint64_t>* instructions = nullptr;  // counted up by what each launch's lanes did; null: nobody asks
};
/// Faults become DeviceErrors.
[[nodiscard]] std::shared_ptr<Queue> make_ptx_queue(std::shared_ptr<Kernels> kernels, const PtxDevice& device = {});

}  // namespace dmoscope::gpu::ptx
