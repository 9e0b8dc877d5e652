// DMO by formulas and targets on a device, with the host in the device's place: the processor's bits.

#include "core/smooth/execution/executor.h"
#include "gpu/host_queue.h"
#include "tests/gpu/defined.h"
#include "tests/gpu/meshes.h"

namespace dmoscope::gpu {
namespace {

using namespace testing;

std::string name_of_index(const ::testing::TestParamInfo<std::size_t>& tested) { return std::to_string(tested.param); }

class DefinedDeviceDmo : public ::testing::TestWithParam<std::size_t> {
 protected:
  [[nodiscard]] static std::string_view words() { return kDefinedMetrics[GetParam()]; }
};

TEST_P(DefinedDeviceDmo, SameBits) {
  std::size_t tried = 0;
  for (auto& specimen : defined_specimens()) {
    const auto input = volume_input_of(std::move(specimen.mesh));
    if (!is_for(words(), *input)) continue;
    SCOPED_TRACE(specimen.name);
    SCOPED_TRACE(words());
    const Metric metric = parse_metric(words());
    const int grid_points = input->is_volume() ? 5 : 8;
    const SearchParameters coarse{.grid_points = grid_points};
    expect_same_visits(make_host_queue({}), Subject(input), metric, coarse, 2);
    const std::size_t turn = (tried++ + GetParam()) % 3;
    if (turn == 0)
      expect_same_visits(make_host_queue({}), Subject(input), metric, {.grid_points = 4, .levels = 2, .precision = Precision::Double}, 1);
    if (turn == 1) expect_same_visits(make_host_queue({}), Subject(input), metric, coarse, 1, {.untangling = {.repair = true}});
    if (turn == 2) expect_same_visits(make_host_queue({}), Subject(input), metric, coarse, 2, {.untangling = {.attempt = false}});
  }
  EXPECT_GT(tried, 1U);
}

INSTANTIATE_TEST_SUITE_P(Metrics, DefinedDeviceDmo, ::testing::Range(std::size_t{0}, std::size(kDefinedMetrics)), name_of_index);

}  // namespace
}  // namespace dmoscope::gpu
