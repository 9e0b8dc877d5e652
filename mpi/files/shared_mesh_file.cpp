#include "mpi/files/shared_mesh_file.h"

#include <array>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/mesh_io.h"

namespace dmoscope {
namespace {

struct Opener {
  std::string_view format;
  std::unique_ptr<SharedMeshFile> (*open)(const World&, const std::filesystem::path&);
};
constexpr std::array<Opener, 5> kOpeners{{{"vtu", open_shared_vtu},
                                          {"pvtu", open_shared_pvtu},
                                          {"obj", open_shared_obj},
                                          {"off", open_shared_off},
                                          {"fort14", open_shared_fort14}}};

const Opener& opener_of(const std::filesystem::path& path) {
  const FormatInfo* format = format_by_extension(path.extension().string());
  for (const Opener& one : kOpeners)
    if (format != nullptr && format->name == one.format) return one;
  throw UsageError(fmt::format(
      "{}: several ranks read and write .vtu, .pvtu, .obj, .off, .14 and .grd; dmoscope convert makes one of others", path.string()));
}

}  // namespace

std::unique_ptr<SharedMeshFile> open_shared(const World& world, const std::filesystem::path& path) {
  return opener_of(path).open(world, path);
}

void require_same_kind(const std::filesystem::path& input, const std::filesystem::path& output) {
  if (opener_of(input).format == opener_of(output).format) return;
  throw UsageError(fmt::format("{}: several ranks write the format that they have read, {}; dmoscope convert makes another of it",
                               output.string(), input.extension().string()));
}

}  // namespace dmoscope
