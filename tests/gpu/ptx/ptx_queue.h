#pragma once
// A device that runs nvcc's code of the kernels instruction by instruction on the host: slow, and exact.

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

/// Demangles a name: "_Z3addPff" -> "add(float*, float)". Throws Fault for another name.
[[nodiscard]] std::string demangled(const char* name);

/// Folder of the PTX of one compute capability, whose number is the folder's name: the one that the environment variable DMOSCOPE_PTX
/// names, else the one that CMake was given. Empty: the build found no CUDA toolkit.
[[nodiscard]] std::filesystem::path kernels_folder();

/// The kernels in a folder's .ptx files.
class Kernels {
 public:
  /// Reads the folder. Throws Fault if it has no kernels.
  explicit Kernels(const std::filesystem::path& folder);
  [[nodiscard]] const std::vector<EntryText>& texts() const noexcept { return texts_; }
  /// Finds the kernel, decoded at the first call. Throws Fault if there is not exactly one.
  [[nodiscard]] const Entry& find(Work work, Metric metric, const DefinedTask& defined);
  /// Finds a kernel by its name as a compiler prints it.
  [[nodiscard]] const Entry& find(const std::string& name);

  struct Name {
    std::string text;  // text of the form that a compiler prints
    std::size_t team = 1;
    std::size_t each = 1;  // size of a lane's share of the work
  };
  /// The name of the kernel for a kind of work, chosen as gpu/cuda_launch.cuh does.
  [[nodiscard]] static Name name_of(Work work, Metric metric, const DefinedTask& defined);

 private:
  std::vector<EntryText> texts_;
  std::unordered_map<std::string, std::size_t> by_name_;  // demangled -> index into texts_
  std::unordered_map<std::string, Entry> decoded_;
};

struct PtxDevice {
  std::size_t lanes_at_once = 4096;
  Schedule schedule{};    // with races: these forget a launch when it is done, or all that were asked for at once
  bool compiles = false;  // whether NVRTC compiles formulas, if it is there
  std::map<Work, std::uint64_t>* instructions = nullptr;  // raised by the number of each launch's lanes; null: not counted
};
/// Makes a queue on the simulated device. Faults become DeviceErrors.
[[nodiscard]] std::shared_ptr<Queue> make_ptx_queue(std::shared_ptr<Kernels> kernels, const PtxDevice& device = {});

}  // namespace dmoscope::gpu::ptx
