// Vertices around which nothing has moved since their last visit are skipped, whatever moves them: the same bits as if all were visited.

#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/mesh/generate.h"
#include "core/smooth/execution/method_table.h"
#include "tests/smooth/promises.h"

namespace dmoscope {
namespace {
namespace rest {

using testing::input;
using testing::make_run;

struct Rested {
  const char* sample;
  Index size;
  bool slides;
};
constexpr Rested kAll[] = {{"random", 150, false}, {"mixed", 150, true},          {"tangled", 150, false},     {"can", 150, true},
                           {"solids", 60, false},  {"tangled-solids", 130, true}, {"nested-solids", 100, true}};

class RestingMethods : public ::testing::TestWithParam<MethodInfo> {};

TEST_P(RestingMethods, PassOverVerticesThatCannotMove) {
  constexpr int kIterations = 40;
  std::uint64_t searched = 0;
  const MethodInfo method = GetParam();
  Progress progress;
  for (const auto& [sample, size, slides] : kAll) {
    const auto mesh = input(generate_mesh(sample, size, 3, progress));
    if (mesh->is_volume() && method.planar_only) continue;
    RunParameters parameters;
    parameters.method = method.name;
    if (!mesh->is_volume()) parameters.search.precision = Precision::Double;  // also a rule for single vertices
    if (slides) parameters.boundary = BoundaryRule::Slide;
    dmoscope::Run resting = make_run(mesh, parameters, 3), anew = make_run(mesh, parameters);
    for (int i = 0; i < kIterations; ++i) {
      resting.iterate(1, progress);
      anew.iterate(1, progress);
      anew.rest();  // the next smoother knows of no vertex that stayed
      ASSERT_TRUE(same_bits(resting.positions(), anew.positions())) << method.name << " on " << sample << ", iteration " << i;
      const IterationRecord &one = resting.history().records().back(), &other = anew.history().records().back();
      EXPECT_EQ(one.moved, other.moved);
      EXPECT_LE(one.searched, other.searched);
      searched += other.searched - one.searched;
    }
  }
  if (method.optimises && !method.has_directions) {
    EXPECT_GT(searched, 0U) << method.name;
  }
}

std::vector<MethodInfo> by_single_vertices() {
  std::vector<MethodInfo> all(method_table().begin(), method_table().end());
  std::erase_if(all, [](const MethodInfo& method) { return method.joint; });
  return all;
}
std::string name_of(const ::testing::TestParamInfo<MethodInfo>& tested) {
  std::string name(tested.param.name);
  std::erase(name, '-');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Rest, RestingMethods, ::testing::ValuesIn(by_single_vertices()), name_of);

}  // namespace rest
}  // namespace
}  // namespace dmoscope
