// The methods on real meshes, if they are there: minima that implementations by others reached.

#include <filesystem>

#include <gtest/gtest.h>

#include "tests/smooth/promises.h"

namespace dmoscope {
namespace {

struct Known {
  const char* method;
  const char* mesh;
  std::uint64_t iterations;
  double least, most;  // bounds of the minimum
};

class RealMeshes : public ::testing::TestWithParam<Known> {};

TEST_P(RealMeshes, EndNearWhereOthersDid) {
  const Known& known = GetParam();
  const std::filesystem::path file = std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes" / known.mesh;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no shared meshes beside this checkout";
  Progress progress;
  dmoscope::Run run = testing::make_run(load_input(file, Need::Smoothing, progress), {.method = known.method});
  run.iterate(known.iterations, progress);
  EXPECT_GE(run.statistics().minimum, known.least);
  EXPECT_LE(run.statistics().minimum, known.most);
}

INSTANTIATE_TEST_SUITE_P(
    MeanRatio, RealMeshes,
    ::testing::Values(Known{"laplace", "ocean/east.14", 10, 0.643, 0.663}, Known{"laplace", "ocean/bahamas.14", 50, 0.54, 0.60},
                      Known{"laplace", "tri/shashkov.vtk", 2000, 0.036, 0.038}, Known{"smart-laplace", "ocean/bahamas.14", 50, 0.73, 0.77},
                      Known{"dvr", "ocean/east.14", 10, 0.79, 0.8166}, Known{"dvr", "ocean/bahamas.14", 50, 0.76, 0.78},
                      Known{"dvr", "tri/shashkov.vtk", 300, 0.02, 0.15}, Known{"angle-based", "ocean/east.14", 10, 0.56, 0.60},
                      Known{"angle-based", "ocean/bahamas.14", 50, 0.64, 0.70}, Known{"pattern-search", "ocean/east.14", 10, 0.806, 0.8166},
                      Known{"pattern-search", "ocean/bahamas.14", 50, 0.755, 0.775},
                      Known{"active-set", "ocean/east.14", 10, 0.816, 0.8166}, Known{"active-set", "ocean/bahamas.14", 50, 0.765, 0.78}),
    [](const auto& test) {
      std::string name = std::string(test.param.method) + "_" + std::filesystem::path(test.param.mesh).stem().string();
      std::erase(name, '-');
      return name;
    });

}  // namespace
}  // namespace dmoscope
