#pragma once
// Meshes for tests of devices.

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/base/error.h"
#include "core/input/input_mesh.h"
#include "core/io/mesh_io.h"
#include "core/mesh/plane.h"
#include "tests/support/sanitized.h"

namespace dmoscope::gpu::testing {

/// The meshes of a folder that can be smoothed, planar ones or volumes, in the order of their names.
inline std::vector<std::shared_ptr<const InputMesh>> meshes_below(const std::filesystem::path& folder, std::size_t most_vertices,
                                                                  bool volumes = false) {
  std::vector<std::filesystem::path> files;
  if (std::filesystem::exists(folder))
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<std::shared_ptr<const InputMesh>> meshes;
  for (const auto& file : files) {
    Progress progress;
    try {
      Mesh mesh = read_mesh(file, {progress});
      if (mesh.vertex_count() > most_vertices || classify(mesh).shape != (volumes ? Shape::Volume : Shape::Planar)) continue;
      meshes.push_back(prepare_input(std::move(mesh), file, Need::Smoothing, progress));
    } catch (const Error&) {
      continue;  // not a mesh
    }
  }
  return meshes;
}

[[nodiscard]] inline std::vector<std::shared_ptr<const InputMesh>> bundled_meshes() {
  return meshes_below(std::filesystem::path(DMOSCOPE_SOURCE_DIR) / "resources/samples", std::size_t{1} << 30U);
}
[[nodiscard]] inline std::vector<std::shared_ptr<const InputMesh>> shared_meshes() {
  return meshes_below(std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes", dmoscope::testing::kSanitized ? 3000 : 30000);
}
[[nodiscard]] inline std::vector<std::shared_ptr<const InputMesh>> shared_volumes(std::size_t most_vertices) {
  return meshes_below(std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes", most_vertices, true);
}

}  // namespace dmoscope::gpu::testing
