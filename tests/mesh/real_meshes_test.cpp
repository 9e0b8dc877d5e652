// Real meshes, if they are there: numbers counted by an independent script.

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/input/input_mesh.h"

namespace dmoscope {
namespace {

struct Known {
  const char* path;
  std::size_t free;
  std::size_t inverted;
};

TEST(RealMeshes, FreeVerticesAndInvertedElements) {
  const std::filesystem::path folder = std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shared meshes beside this checkout";
  for (const Known& known : {Known{"ocean/east.14", 8429, 0},
                             {"ocean/bahamas.14", 770, 0},
                             {"tri/shashkov.vtk", 3969, 0},
                             {"tri/tangled_tri.vtk", 20, 5},
                             {"quad/tangled_quad.vtk", 16, 2},
                             {"quad/su2_primitiveVenturi.su2", 3220, 0},
                             {"quad/shest_grid32.vtk", 961, 9},
                             {"mixed2d/overt_hyb_1.vtk", 4800, 0},
                             {"tri/vemesh_random_triangles.off", 86, 0}}) {
    SCOPED_TRACE(known.path);
    Progress progress;
    const auto input = load_input(folder / known.path, Need::Smoothing, progress);
    std::size_t free = 0;
    for (Index v = 0; v < input->mesh.vertex_count(); ++v) {
      free += input->topology.boundary()[v] == 0 && !input->topology.star(v).empty() ? 1 : 0;
    }
    EXPECT_EQ(free, known.free);
    EXPECT_EQ(input->report.inverted_elements.size(), known.inverted);
  }
}

}  // namespace
}  // namespace dmoscope
