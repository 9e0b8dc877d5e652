// The fast search of a volume's star finds the candidate of a search of all of them, for any star, grid and processor; and stars stored by
// indices are those of the mesh.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/progress.h"
#include "core/input/input_mesh.h"
#include "core/mesh/random.h"
#include "core/search/grid_search.h"
#include "core/search/mesh_star.h"
#include "core/smooth/composite_visit.h"
#include "core/smooth/kernels/compiled/kernel_set.h"
#include "core/smooth/kernels/indexed_stars.h"
#include "core/smooth/kernels/volume_form.h"

namespace dmoscope {
namespace {

using Point = Vec3Of<float>;
using Form = volumes::MeanRatioForm<float>;

/// Elements around a vertex at the origin, and the forms of all of them.
class Sample {
 public:
  std::vector<Point> points;
  std::vector<Form> forms;

  template <class Element>
  void add(StarKind kind, const std::vector<Point>& others) {
    std::vector<std::uint16_t>& corners = corners_[static_cast<std::size_t>(kind)];
    for (const Point& p : others) {
      corners.push_back(static_cast<std::uint16_t>(points.size()));
      points.push_back(p);
    }
    if constexpr (std::is_same_v<Element, StarTetrahedron<float>>) {
      forms.push_back(volumes::tetrahedron_form(others[0], others[1], others[2]));
    } else {
      Element element{};
      if constexpr (requires { element.base; })
        std::ranges::copy(others, element.base.begin());
      else
        std::ranges::copy(others, element.others.begin());
      volumes::for_corner_forms(element.with(Point{}), element.kMoving, [this](const Form& form) { forms.push_back(form); });
    }
  }
  /// A sample with the places of the others times `by`, each then moved by up to `jolt` of its distance.
  [[nodiscard]] static Sample octants(dmoscope::Random& random, Vec3 by, double jolt, std::string_view kinds) {
    Sample sample;
    const auto jolted = [&](Vec3 corner) {
      const auto off = [&] { return random.between(-jolt, jolt); };
      return Vec3{(corner.x + off()) * by.x, (corner.y + off()) * by.y, (corner.z + off()) * by.z};
    };
    const auto narrow = [](Vec3 p) { return Point{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}; };
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0})
        for (const double z : {-1.0, 1.0}) {
          Vec3 a = jolted({x, 0, 0}), b = jolted({0, y, 0}), c = jolted({0, 0, z});
          if (x * y * z < 0.0) std::swap(a, b);
          const Vec3 ab = a + b, bc = b + c, ca = c + a;
          const auto list = [&](std::initializer_list<Vec3> corners) {
            std::vector<Point> result;
            for (const Vec3 corner : corners) result.push_back(narrow(corner));
            return result;
          };
          const auto has = [&](char kind) { return kinds.find(kind) != std::string_view::npos; };
          if (has('t')) sample.add<StarTetrahedron<float>>(StarKind::Tetrahedra, list({a, b, c}));
          if (has('h')) sample.add<StarHexahedron<float>>(StarKind::Hexahedra, list({a, ab, b, c, ca, ab + c, bc}));
          if (has('w')) sample.add<StarWedge<float>>(StarKind::Wedges, list({a, b, c, a + c, bc}));
          if (has('p')) sample.add<StarPyramid<float>>(StarKind::Pyramids, list({a, ab, b, c}));
          if (has('q')) sample.add<StarTip<float>>(StarKind::Tips, list({c - a - b, c - a + b, c + a + b, c + a - b}));
        }
    return sample;
  }
  [[nodiscard]] VolumeSearch search(int grid, int levels, double omega) {
    all_.clear();
    VolumeSearch task;
    for (std::size_t kind = 0; kind < kSolidKinds; ++kind) {
      all_.insert(all_.end(), corners_[kind].begin(), corners_[kind].end());
      task.star.counts[kind] = static_cast<std::uint8_t>(corners_[kind].size() / kOtherCorners[kind]);
    }
    task.star.corners = all_.data();
    task.others = points.data();
    Point low = points[0], high = points[0];
    for (const Point& p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    task.box = high - low;
    task.points = grid;
    task.levels = levels;
    task.omega = omega;
    return task;
  }
  [[nodiscard]] float rank(Point p) const {
    float least = std::numeric_limits<float>::max();
    for (const Form& form : forms) least = std::min(least, volumes::rank_of(form, p, dot(p, p)));
    return least;
  }

 private:
  std::array<std::vector<std::uint16_t>, kSolidKinds> corners_;
  std::vector<std::uint16_t> all_;
};

/// Searches all candidates, one after the other.
VolumeFound search_all(const Sample& sample, const VolumeSearch& task) {
  VolumeFound found;
  float best = sample.rank({});
  found.ready = best > volumes::kLeastRank;
  double omega = task.omega;
  for (int level = 0; found.ready && level < task.levels; ++level) {
    const CandidateGrid<float, Point> grid{found.offset, times(task.box, static_cast<float>(omega)), task.points};
    for (int i = 0; i < task.points; ++i)
      grid.for_slice(i, [&](int, Point p) {
        const float rank = sample.rank(p);
        if (rank > best) best = rank, found.offset = p;
      });
    omega *= 2.0 / (task.points - 1);
  }
  return found;
}

void expect_the_same(Sample& sample, int grid, int levels, double omega) {
  const VolumeSearch task = sample.search(grid, levels, omega);
  const VolumeFound expected = search_all(sample, task);
  for (const SimdLevel level : supported_simd_levels()) {
    const VolumeFound found = kernels(level).volume(Metric::MeanRatio).search(task);
    ASSERT_EQ(found.ready, expected.ready);
    ASSERT_TRUE(found.offset == expected.offset)
        << name(level) << ": " << found.offset.x << " " << found.offset.y << " " << found.offset.z << ", rank " << sample.rank(found.offset)
        << " instead of " << expected.offset.x << " " << expected.offset.y << " " << expected.offset.z << ", rank "
        << sample.rank(expected.offset);
  }
}

TEST(VolumeKernel, FindsWhatALookAtAllCandidatesFinds) {
  dmoscope::Random random(7);
  for (const char* kinds : {"t", "h", "w", "p", "q", "th", "thwpq"})
    for (const Vec3 by : {Vec3{1, 1, 1}, {1, 0.1, 1}, {0.03, 0.03, 1}, {1, 1, 0.002}, {1e-6, 1e-6, 1e-6}, {1e-3, 1, 1e-1}})
      for (const double jolt : {0.0, 0.05, 0.4, 0.7}) {
        for (int trial = 0; trial < (jolt > 0.0 ? 6 : 1); ++trial) {
          Sample sample = Sample::octants(random, by, jolt, kinds);
          expect_the_same(sample, 8, 3, 0.5);
          if (HasFatalFailure()) FAIL() << kinds << " times " << by.x << " " << by.y << " " << by.z << ", jolt " << jolt;
        }
      }
}
TEST(VolumeKernel, FindsItOnGridsOfAnySize) {
  dmoscope::Random random(8);
  for (const int grid : {2, 3, 5, 7, 13, 16, 33, 64})
    for (const int levels : {1, 2, 6, 16})
      for (const double omega : {0.01, 0.5, 1.0}) {
        if (grid > 16 && levels > 2) continue;
        for (const char* kinds : {"t", "hp"}) {
          Sample sample = Sample::octants(random, {1, 0.7, 0.3}, 0.4, kinds);
          expect_the_same(sample, grid, levels, omega);
          if (HasFatalFailure()) FAIL() << grid << " points, " << levels << " levels, omega " << omega;
        }
      }
}
TEST(VolumeKernel, FindsTheFirstOfManyThatAreEquallyGood) {
  // The vertex is off the middle of a star that is the same from all sides: four candidates beside the axis to the middle are alike.
  dmoscope::Random random(9);
  for (const int grid : {2, 4, 8}) {
    const Sample sample = Sample::octants(random, {1, 1, 1}, 0.0, "t");
    Sample moved;
    for (std::size_t i = 0; i + 2 < sample.points.size(); i += 3) {
      const Point off{0.25F, 0.0F, 0.0F};
      moved.add<StarTetrahedron<float>>(StarKind::Tetrahedra,
                                        {sample.points[i] - off, sample.points[i + 1] - off, sample.points[i + 2] - off});
    }
    expect_the_same(moved, grid, 3, 0.5);
  }
}
TEST(VolumeKernel, LeavesStarsToThePlainSearchThatAreInvertedOrNearlyFlat) {
  dmoscope::Random random(10);
  Sample inverted = Sample::octants(random, {1, 1, -1}, 0.1, "t"), flat = Sample::octants(random, {1, 1, 1e-5}, 0.1, "h");
  for (const SimdLevel level : supported_simd_levels())
    for (Sample* sample : {&inverted, &flat})
      EXPECT_FALSE(kernels(level).volume(Metric::MeanRatio).search(sample->search(8, 3, 0.5)).ready);
}

/// The least ranks of VolumeKernel, from the mesh's own elements.
template <Metric M>
double least_rank(const InputMesh& input, Index vertex, Vec3 place) {
  VolumeStar<double> star;
  gather_star(MeshStar<Space>(input.view<Space>(), input.mesh.positions, vertex), star);
  const Vec3 step = (1.0 / star.scale) * (place - input.mesh.positions[vertex]);
  return Objective<M, false, double, Value::Rank, VolumeStarView<double>>(VolumeStarView<double>(star))(step);
}

class Generated : public ::testing::TestWithParam<const char*> {
 public:
  static std::shared_ptr<const InputMesh> make() {
    Progress progress;
    return generate_input(GetParam(), progress);
  }
};
INSTANTIATE_TEST_SUITE_P(Kinds, Generated, ::testing::Values("tetrahedra 300 1", "hexahedra 300 1", "solids 300 1", "screw 300 1"));

TEST_P(Generated, StarsByIndicesAreThoseOfTheMesh) {
  const auto input = make();
  for (Index vertex = 0; vertex < input->mesh.positions.size(); ++vertex) {
    VolumeStar<double> expected;
    gather_star(MeshStar<Space>(input->view<Space>(), input->mesh.positions, vertex), expected);
    const IndexedStars stars(*input, Colouring{{vertex}, {0, 1}}, nullptr);
    const IndexedStars::Star star = stars.of(vertex);
    ASSERT_TRUE(star.fits);
    std::vector<Index> sorted(star.vertices.begin(), star.vertices.end());
    std::ranges::sort(sorted);
    EXPECT_EQ(std::ranges::adjacent_find(sorted), sorted.end()) << "a neighbour stands twice";
    const Vec3 origin = input->mesh.positions[vertex];
    const double inverse = 1.0 / expected.scale;
    const std::uint16_t* corner = star.elements.corners;
    const auto next = [&] {
      const Vec3 p = input->mesh.positions[star.vertices[*corner++]] - origin;
      return Vec3{p.x * inverse, p.y * inverse, p.z * inverse};
    };
    std::size_t kind = 0;
    expected.for_each_list([&](const auto& list) {
      ASSERT_EQ(star.elements.counts[kind++], list.size());
      for (const auto& element : list) {
        if constexpr (requires { element.others; }) {
          for (const Vec3& other : element.others) EXPECT_TRUE(next() == other);
        } else if constexpr (requires { element.base; }) {
          for (const Vec3& other : element.base) EXPECT_TRUE(next() == other);
        } else {
          for (const Vec3& other : {element.b, element.c, element.d}) EXPECT_TRUE(next() == other);
        }
      }
    });
  }
}
TEST_P(Generated, ComparisonsAreByTheLeastRankAndTheMeanOfTheElements) {
  const auto input = make();
  dmoscope::Random random(11);
  for (Index vertex = 0; vertex < input->mesh.positions.size(); vertex += 7) {
    const IndexedStars stars(*input, Colouring{{vertex}, {0, 1}}, nullptr);
    const IndexedStars::Star star = stars.of(vertex);
    std::vector<Vec3> others;
    for (const Index other : star.vertices) others.push_back(input->mesh.positions[other]);
    const Vec3 here = input->mesh.positions[vertex];
    const double size = 0.01 * input->geometry.size;
    const Vec3 there = here + Vec3{random.between(-size, size), random.between(-size, size), random.between(-size, size)};
    for (const SimdLevel level : supported_simd_levels()) {
      const VolumeComparison task{star.elements, others.data(), here, there};
      const BeforeAndAfter ratio = kernels(level).volume(Metric::MeanRatio).least_ranks(task);
      EXPECT_NEAR(ratio.before, least_rank<Metric::MeanRatio>(*input, vertex, here), 1e-12);
      EXPECT_NEAR(ratio.after, least_rank<Metric::MeanRatio>(*input, vertex, there), 1e-12);
      const BeforeAndAfter mean = kernels(level).volume(Metric::MeanRatio).means(task, MeanKind::Arithmetic);
      EXPECT_NEAR(mean.before,
                  mean_at_place<Metric::MeanRatio>(input->view<Space>(), input->mesh.positions, vertex, here, MeanKind::Arithmetic), 1e-12);
      EXPECT_NEAR(mean.after,
                  mean_at_place<Metric::MeanRatio>(input->view<Space>(), input->mesh.positions, vertex, there, MeanKind::Arithmetic),
                  1e-12);
      const BeforeAndAfter jacobian = kernels(level).volume(Metric::ScaledJacobian).least_ranks(task);
      EXPECT_NEAR(jacobian.before, least_rank<Metric::ScaledJacobian>(*input, vertex, here), 1e-12);
      EXPECT_NEAR(jacobian.after, least_rank<Metric::ScaledJacobian>(*input, vertex, there), 1e-12);
    }
  }
}

}  // namespace
}  // namespace dmoscope
