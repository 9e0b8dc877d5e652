// The smoother on nvcc's code of the kernels: the processor's bits, without a GPU.

#include <algorithm>
#include <array>

#include "core/run/device_picture.h"
#include "gpu/bodies.h"
#include "gpu/host_queue.h"
#include "tests/gpu/ptx/operations.h"
#include "tests/gpu/ptx/ptx_queue.h"
#include "tests/gpu/two_aims.h"
#include "tests/gpu/volumes.h"
#include "tests/smooth/zoo.h"

namespace dmoscope::gpu::ptx {
namespace {

using namespace gpu::testing;
using dmoscope::testing::Cells;
using dmoscope::testing::defined_for_all;
using dmoscope::testing::lattice;
using dmoscope::testing::Specimen;

class PtxTest : public ::testing::TestWithParam<Metric> {
 protected:
  void SetUp() override {
    if (kernels_folder().empty()) GTEST_SKIP() << "needs the kernels' PTX; built without a CUDA toolkit";
    kernels = std::make_shared<Kernels>(kernels_folder());
  }
  /// Some lanes alone, some in teams; some forwards, some backwards.
  [[nodiscard]] std::shared_ptr<Queue> teams(Schedule schedule = {}) const { return make_ptx_queue(kernels, {1U << 20U, schedule}); }
  [[nodiscard]] std::shared_ptr<Queue> singles(Schedule schedule = {}) const { return make_ptx_queue(kernels, {1, schedule}); }

  std::shared_ptr<Kernels> kernels;
};

Subject subject_of(Mesh mesh) {
  Progress progress;
  return Subject(prepare_input(std::move(mesh), {}, Need::Smoothing, progress));
}

/// The zoo, and meshes for the remaining paths: exact visits of tilted planes and of single precision.
std::vector<Specimen> specimens() {
  using dmoscope::testing::mapped;
  std::vector<Specimen> all = dmoscope::testing::zoo();
  for (const Cells cells : {Cells::Triangles, Cells::Mixed}) {
    const Mesh tangled = lattice(8, 0.9, 46, cells);
    all.push_back({"tangled, tilted", mapped(tangled, [](Vec3 p) { return Vec3{0.6 * p.x + 7, p.y - 3, 0.8 * p.x + 2}; })});
    Mesh single = mapped(tangled, [](Vec3 p) { return Vec3{static_cast<float>(p.x), static_cast<float>(p.y), 0}; });
    single.single_precision = true;
    all.push_back({"tangled, single precision", std::move(single)});
  }
  return all;
}

class PtxDmo : public PtxTest {
 protected:
  void expect_same(const std::shared_ptr<Queue>& queue, Specimen specimen, int iterations) {
    const Metric metric = GetParam();
    if (!defined_for_all(metric, specimen.mesh)) return;
    SCOPED_TRACE(specimen.name);
    const Subject subject = subject_of(std::move(specimen.mesh));
    expect_same_visits(queue, subject, metric, specimen.search, iterations);
  }
};

TEST_P(PtxDmo, SameBitsInTeams) {
  for (Specimen& specimen : specimens()) expect_same(teams(), std::move(specimen), 2);
}
TEST_P(PtxDmo, SameBitsAlone) {
  for (Specimen& specimen : specimens()) expect_same(singles({.together = true, .backwards = true}), std::move(specimen), 2);
}

/// Independence of the order of lanes, which the bits of one order cannot show.
TEST_P(PtxDmo, NoLaneMinglesInAnothersWork) {
  Races races;
  const auto queues = {teams({.races = &races}), singles({.races = &races})};
  for (const std::shared_ptr<Queue>& queue : queues) {
    expect_same(queue, {"mixed", lattice(18, 0.5, 95, Cells::Mixed)}, 2);
    expect_same(queue, {"tangled", lattice(8, 0.9, 46)}, 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Metrics, PtxDmo, every_metric(), name_of_metric);

/// Volumes, always in teams.
class PtxVolumeDmo : public PtxTest {
 protected:
  void expect_same(const SearchParameters& parameters, Schedule schedule, std::size_t size = 64) {
    for (const VolumeSample& sample : volume_samples(size)) {
      if (!defined_for_all(GetParam(), sample.input->mesh)) continue;
      SCOPED_TRACE(sample.name);
      expect_same_visits(teams(schedule), Subject(sample.input), GetParam(), parameters, 2);
    }
  }
};

TEST_P(PtxVolumeDmo, SameBitsInFloat) { expect_same({}, {}); }
TEST_P(PtxVolumeDmo, SameBitsInDouble) {
  expect_same({.grid_points = 6, .precision = Precision::Double}, {.together = true, .backwards = true});
}

TEST_P(PtxVolumeDmo, NoTeamMinglesInAnothersWork) {
  Races races;
  expect_same({}, {.races = &races}, 32);
}

INSTANTIATE_TEST_SUITE_P(Metrics, PtxVolumeDmo, every_volume_metric(), name_of_metric);

/// Each first metric with the mean, and with some second aims: on some of the meshes, each kind of aims on some of these.
class PtxTwoAims : public PtxTest {};

TEST_P(PtxTwoAims, SameBits) {
  std::size_t turn = 0;
  for (Specimen& specimen : specimens()) {
    if (++turn % 3 != static_cast<std::size_t>(GetParam()) % 3 || !defined_for_all(GetParam(), specimen.mesh)) continue;
    SCOPED_TRACE(specimen.name);
    const Subject subject = subject_of(std::move(specimen.mesh));
    const auto queue = teams({.together = turn % 2 == 0, .backwards = turn % 2 == 0});
    expect_same_mean(queue, subject, GetParam(), specimen.search);
    expect_same_combinations(queue, subject, GetParam(), specimen.search, 5, turn);
  }
}
TEST_P(PtxTwoAims, NoTeamMinglesInAnothersWork) {
  Races races;
  const Subject subject = subject_of(lattice(8, 0.6, 96));
  if (!defined_for_all(GetParam(), subject.input->mesh)) return;
  expect_same_mean(teams({.races = &races}), subject, GetParam(), {});
  expect_same_combinations(teams({.races = &races}), subject, GetParam(), {}, 4);
}

INSTANTIATE_TEST_SUITE_P(Metrics, PtxTwoAims, every_metric(), name_of_metric);

class PtxVolumeTwoAims : public PtxTest {};

TEST_P(PtxVolumeTwoAims, SameBits) {
  std::size_t turn = 0;
  for (const VolumeSample& sample : volume_samples(64)) {
    if (!defined_for_all(GetParam(), sample.input->mesh) || ++turn % 4 != 1) continue;
    SCOPED_TRACE(sample.name);
    Races races;
    const auto queue = teams({.together = turn % 2 == 0, .backwards = turn % 2 == 0, .races = &races});
    expect_same_mean(queue, Subject(sample.input), GetParam(), {.grid_points = 6, .levels = 2});
    expect_same_combinations(queue, Subject(sample.input), GetParam(), {.grid_points = 4, .levels = 2}, 2, turn);
  }
}

INSTANTIATE_TEST_SUITE_P(Metrics, PtxVolumeTwoAims, every_volume_metric(), name_of_metric);

/// Pictures made by the kernels and by their source compiled for the host.
class PtxPicture : public PtxTest {};
INSTANTIATE_TEST_SUITE_P(Shown, PtxPicture, ::testing::Values(Metric::MeanRatio, Metric::ScaledJacobian, Metric::MinAngle));

TEST_P(PtxPicture, IsThatOfTheHost) {
  const Subject subject = subject_of(lattice(12, 0.9, 71, Cells::Mixed));  // with inverted elements, and of two kinds
  const Vec2<double> origin{3.25, -1.5};
  const std::vector<Index> wanted{7, 0, static_cast<Index>(subject.input->mesh.vertex_count() - 1), 7};
  struct Seen {
    std::vector<Vec2<float>> points;
    std::vector<float> shades;
    std::vector<Vec3> some;
    ElementSummary summary;
  };
  const auto see = [&](const std::shared_ptr<Queue>& queue) {
    const auto smoother = make_device_dmo(queue, subject.task(Metric::MeanRatio));
    std::vector<Vec3> positions = subject.input->mesh.positions;
    smoother->visit(0, subject.visits(), positions, nullptr);
    const auto picture = smoother->picture(GetParam());
    Seen seen{std::vector<Vec2<float>>(positions.size()), std::vector<float>(subject.input->mesh.elements.size()),
              picture->positions(wanted), picture->summary()};
    picture->download(seen.points, seen.shades, origin);
    return seen;
  };
  const Seen here = see(make_host_queue({})), there = see(teams());
  for (std::size_t v = 0; v < here.points.size(); ++v) {
    ASSERT_EQ(here.points[v].x, there.points[v].x) << v;
    ASSERT_EQ(here.points[v].y, there.points[v].y) << v;
  }
  for (std::size_t e = 0; e < here.shades.size(); ++e) ASSERT_EQ(here.shades[e], there.shades[e]) << e;
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_TRUE(same(here.some[i], there.some[i])) << i;
  EXPECT_EQ(here.summary.histogram.counts, there.summary.histogram.counts);
  EXPECT_EQ(here.summary.histogram.below, there.summary.histogram.below);
  EXPECT_EQ(here.summary.histogram.above, there.summary.histogram.above);
  EXPECT_GT(here.summary.statistics.inverted, 0U);
  EXPECT_EQ(here.summary.statistics.inverted, there.summary.statistics.inverted);
  ASSERT_EQ(there.summary.worst.size(), 1U);
  EXPECT_EQ(here.summary.worst.at(0).element, there.summary.worst[0].element);
}

class PtxText : public PtxTest {};
INSTANTIATE_TEST_SUITE_P(Any, PtxText, ::testing::Values(Metric::MeanRatio));

/// Arithmetic has the processor's bits only if every operation rounds as IEEE 754 requires, and none is fused.
TEST_P(PtxText, NothingIsApproximate) {
  for (const EntryText& entry : kernels->texts())
    for (const char* const unwanted : {"fma.rn.f32", ".ftz", ".approx", ".full", "mad.rn", ".sat", "call"})
      EXPECT_EQ(entry.text.find(unwanted), std::string::npos) << unwanted << " in " << entry.name;
}

constexpr std::array kVisits{"bodies5Visit",           "bodies11VisitVolume",   "bodies14VisitComposite",
                             "bodies14PrepareDefined", "bodies13SearchDefined", "bodies15UntangleDefined",
                             "bodies13SettleDefined",  "bodies12VisitTargets",  "bodies13SearchTargets"};

/// Kernels are complete: nvcc turns one whose body it takes for the host's into an empty one, or into an infinite loop.
TEST_P(PtxText, KernelsAreWhole) {
  std::size_t visits = 0;
  for (const EntryText& text : kernels->texts()) {
    const Entry entry = decode(text);
    const bool is_visit = std::ranges::any_of(kVisits, [&](const char* name) { return entry.name.find(name) != std::string::npos; });
    visits += is_visit ? 1 : 0;
    EXPECT_GT(entry.code.size(), is_visit ? 500U : 10U) << entry.name;
    for (std::size_t i = 0; i < entry.code.size(); ++i)
      EXPECT_FALSE(entry.code[i].run == kJump.run && entry.code[i].offset == static_cast<std::int64_t>(i)) << entry.name;
  }
  std::size_t expected = 0;
  for (const MetricInfo& metric : metric_table())
    if (metric.metric != Metric::Condition)  // the mean ratio in the plane
      expected += formulas::with_planar_metric(metric.metric, []<Metric M>() { return kIsRatio<M>; }) ? 5 : 3;  // fans have two more
  for (const MetricInfo& metric : metric_table()) expected += metric.defined_for(ElementKind::Tetrahedron) ? 2 : 0;
  expected += 2 * 5 + 2 * 3;  // by formulas in the plane and in space, two searches in each; by targets that are crossed and not
  EXPECT_EQ(visits, expected);
}

}  // namespace
}  // namespace dmoscope::gpu::ptx
