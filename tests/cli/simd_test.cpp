// dmoscope smooth --simd: the same file, byte for byte, with any vector instructions.

#include "core/numeric/simd.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

TEST(Simd, SmoothWritesTheSameBytesWithAnyLevel) {
  const Folder folder;
  struct Job {
    std::string file;
    std::vector<std::string> metrics;
  };
  const Job jobs[] = {{"coast.14", {"mean-ratio", "max-angle", "rectangularity"}},
                      {"quads.vtk", {"mean-ratio", "mean-ratio-area", "scaled-jacobian"}},
                      {"mixed.vtk", {"mean-ratio", "mean-ratio-area", "scaled-jacobian"}},
                      {"tangled.obj", {"mean-ratio", "scaled-jacobian"}}};
  for (const auto& [file, metrics] : jobs)
    for (const std::string& metric : metrics) {
      std::string expected;
      for (const SimdLevel level : supported_simd_levels()) {
        const std::string output = folder / (std::string(name(level)) + "-" + file);
        const Output result =
            run({"smooth", sample(file), "-o", output, "--metric", metric, "--iterations", "10", "--simd", std::string(name(level))});
        ASSERT_EQ(result.code, 0) << result.err;
        const std::string bytes = read_file(output);
        if (expected.empty()) expected = bytes;
        EXPECT_NE(bytes, read_file(sample(file))) << "nothing was smoothed";
        EXPECT_TRUE(bytes == expected) << file << ", " << metric << ": " << name(level) << " and " << name(supported_simd_levels()[0]);
      }
    }
}

}  // namespace
}  // namespace dmoscope::test
