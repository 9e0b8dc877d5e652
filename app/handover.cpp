#include "app/handover.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "core/base/error.h"

namespace dmoscope::app {
namespace {

/// Environment of the processes of a launcher: Open MPI, MPICH and Intel MPI, PMIx (srun).
struct Launcher {
  const char* rank;
  const char* size;
};
constexpr std::array kLaunchers{Launcher{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"}, Launcher{"PMI_RANK", "PMI_SIZE"},
                                Launcher{"PMIX_RANK", "SLURM_STEP_NUM_TASKS"}};

/// Whether this process is alone and does the job itself, but for words that dmoscope-mpi alone understands.
bool is_alone(const char* size, char** argv) {
  if (size == nullptr || std::string_view(size) != "1") return false;
  for (; *argv != nullptr; ++argv)
    if (std::string_view(*argv).starts_with("--partition")) return false;
  return true;
}

}  // namespace

void hand_over_to_mpi(char** argv) {
  for (const Launcher& launcher : kLaunchers) {
    const char* const rank = std::getenv(launcher.rank);
    const char* const size = std::getenv(launcher.size);
    if (rank == nullptr) continue;
    if (is_alone(size, argv)) return;
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / "dmoscope-mpi";
    if (!error) ::execv(program.c_str(), argv);
    if (std::string_view(rank) != "0") std::exit(2);
    throw UsageError(fmt::format(
        "{} processes of dmoscope were started together (mpirun, srun), and this build has no dmoscope-mpi beside it ({}): each "
        "would do the whole job. Start one alone, or build with MPI (libopenmpi-dev)",
        size != nullptr ? size : "several", program.string()));
  }
}

}  // namespace dmoscope::app
