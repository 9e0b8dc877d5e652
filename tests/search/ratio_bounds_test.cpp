// Bounds of the mean ratio never exclude a place that reaches a value, and exclude most that do not.

#include "core/smooth/kernels/ratio_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/mesh/random.h"
#include "core/search/grid_search.h"

namespace dmoscope {
namespace {

using D = Pack<double>;
using F = Pack<float>;
using Bounds = composite::RatioBounds<Space, D, F>;

Vec3 random_point(dmoscope::Random& random, Vec3 size) {
  return {random.between(-size.x, size.x), random.between(-size.y, size.y), random.between(-size.z, size.z)};
}

/// A star around the origin and a copy for growth: its lengths times `stretch`, its corners away from the vertex by 1, give or take `jolt`.
struct Sample {
  VolumeStar<double> star;
  Vec3 stretch;
  Sample(dmoscope::Random& random, Vec3 by, double jolt) : stretch(by) {
    const auto jolted = [&](Vec3 corner) {
      const Vec3 p = corner + random_point(random, {jolt, jolt, jolt});
      return Vec3{p.x * by.x, p.y * by.y, p.z * by.z};
    };
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0})
        for (const double z : {-1.0, 1.0}) {
          Vec3 a = jolted({x, 0, 0}), b = jolted({0, y, 0}), c = jolted({0, 0, z});
          if (x * y * z < 0.0) std::swap(a, b);
          star.tetrahedra.push_back({a, b, c, 1.0});
          const Vec3 ab = a + b, bc = b + c, ca = c + a;
          star.hexahedra.push_back({{a, ab, b, c, ca, ab + c, bc}, 1.0});
          star.wedges.push_back({{a, b, c, a + c, bc}, 1.0});
          star.pyramids.push_back({{a, ab, b, c}, 1.0});
          star.tips.push_back({{c - a - b, c - a + b, c + a + b, c + a - b}, 1.0});
        }
  }
};

struct Worth {
  double least = 1.0;
  std::vector<double> qualities;
  void add(double quality) { qualities.push_back(quality); }
  /// A power mean of the qualities, by its exponent; the harmonic one with the steps that make a bad element count more.
  [[nodiscard]] double mean(double exponent) const {
    constexpr std::array kSteps{std::pair{0.4, 1e3}, std::pair{0.3, 16e3}, std::pair{0.2, 256e3}, std::pair{0.1, 4096e3}};
    double sum = 0.0;
    for (const double quality : qualities) {
      sum += std::pow(quality, exponent);
      for (const auto& [below, adds] : kSteps) sum += exponent == -1.0 && quality < below ? adds : 0.0;
    }
    return std::pow(sum / static_cast<double>(qualities.size()), 1.0 / exponent);
  }
};
struct Kind {
  MeanKind kind;
  double exponent;
};
constexpr std::array kKinds{Kind{MeanKind::Arithmetic, 1.0}, Kind{MeanKind::Harmonic, -1.0}, Kind{MeanKind::InverseSquare, -2.0}};
Worth worth_at(const VolumeStar<double>& star, Vec3 p) {
  Worth worth;
  VolumeStarView<double>(star).for_each<true>([&](const auto& element) {
    const auto shape = element.with(p);
    worth.least = std::min(worth.least, formulas::metric_around<Metric::MeanRatio>(shape, element.kMoving));
    worth.add(formulas::metric<Metric::MeanRatio>(shape));
  });
  return worth;
}
template <class Ideal, std::size_t N, class Corners>
double least_of_those_that_stay(const formulas::CorneredSolid<Vec3, Ideal, N, Corners>& solid, Index moving) {
  double least = 1.0;
  for (const CornerTable& c : Corners::kTable) {
    if (std::ranges::find(c, moving) != c.end()) continue;
    const Vec3 a = solid.at[c[0]], u = solid.at[c[1]] - a, v = solid.at[c[2]] - a, w = solid.at[c[3]] - a;
    least = std::min(least, formulas::Formula<Metric::MeanRatio>::corner<Ideal>(u, v, w, dot(cross(u, v), w)));
  }
  return least;
}
/// Values of the elements that are not tetrahedra.
std::vector<D> elsewhere(const VolumeStar<double>& star) {
  std::vector<D> result;
  lists_of(star).for_others(
      [&](const auto& element) { result.emplace_back(least_of_those_that_stay(element.with(Vec3{}), element.kMoving)); });
  return result;
}

/// Whether the bounds allow a place in the middle slot of a pack of it and of its neighbours.
bool hopes(Bounds& bounds, Vec3 from_centre) {
  const auto along = [](double a) { return F(static_cast<float>(a)); };
  return xsimd::any(bounds.may_reach({along(from_centre.x), along(from_centre.y), along(from_centre.z)}));
}

struct Case {
  const char* name;
  Vec3 stretch;
  double jolt;
};
void PrintTo(const Case& each, std::ostream* out) { *out << each.name; }
class RatioBounds : public testing::TestWithParam<Case> {};
class CloseRatioBounds : public RatioBounds {};

/// Calls f(star, bounds, centre, place, half) for places within grids around the vertex and around other sound places.
template <class F>
void for_places(const Case& parameter, MeanKind kind, F f) {
  dmoscope::Random random(7);
  for (int trial = 0; trial < 30; ++trial) {
    const Sample sample(random, parameter.stretch, parameter.jolt);
    const std::vector<D> known = elsewhere(sample.star);
    Bounds bounds;
    bounds.take(lists_of(sample.star), kind, known.data());
    for (const double size : {0.5, 0.1, 0.02}) {
      const Vec3 half = size * sample.stretch, centre = random_point(random, 0.2 * sample.stretch);
      if (!(worth_at(sample.star, centre).least > 0.0)) continue;
      bounds.move_to({centre.x, centre.y, centre.z}, {half.x, half.y, half.z});
      for (int i = 0; i < 40; ++i) f(sample.star, bounds, centre, centre + random_point(random, half));
    }
  }
}

TEST_P(RatioBounds, LeaveHopeForWhatAPlaceReaches) {
  for (const Kind& each : kKinds) {
    int sound = 0;
    for_places(GetParam(), each.kind, [&](const auto& star, Bounds& bounds, Vec3 centre, Vec3 place) {
      const Worth worth = worth_at(star, place);
      if (!(worth.least > 0.0)) return;
      ++sound;
      bounds.set_needs(worth.least, worth.mean(each.exponent));
      EXPECT_TRUE(hopes(bounds, place - centre)) << name(each.kind);
      bounds.set_needs(worth.least, 0.0);
      EXPECT_TRUE(hopes(bounds, place - centre)) << name(each.kind);
    });
    EXPECT_GT(sound, 1000);
  }
}

TEST_P(CloseRatioBounds, LeaveNoneForMuchMore) {
  for (const Kind& each : kKinds) {
    int tried = 0, by_least = 0, by_mean = 0;
    for_places(GetParam(), each.kind, [&](const auto& star, Bounds& bounds, Vec3 centre, Vec3 place) {
      const Worth worth = worth_at(star, place);
      if (!(worth.least > 0.01)) return;
      ++tried;
      bounds.set_needs(1.001 * worth.least, 0.0);
      by_least += hopes(bounds, place - centre) ? 0 : 1;
      bounds.set_needs(0.0, worth.mean(each.exponent) + 0.02);
      by_mean += hopes(bounds, place - centre) ? 0 : 1;
    });
    EXPECT_GT(by_least, tried * 95 / 100) << name(each.kind);
    EXPECT_GT(by_mean, tried / 2) << name(each.kind);
  }
}

/// Inverted elements have no bound to reach.
TEST_P(CloseRatioBounds, LeaveNoneForInvertedElements) {
  int inverted = 0;
  for_places(GetParam(), MeanKind::Harmonic, [&](const auto& star, Bounds& bounds, Vec3 centre, Vec3 place) {
    if (!(worth_at(star, place).least < -1e-3)) return;
    ++inverted;
    bounds.set_needs(0.0, 0.0);
    EXPECT_FALSE(hopes(bounds, place - centre));
  });
  EXPECT_GT(inverted, 10);
}

/// A planar star: triangles and quadrilaterals around the origin, the latter with corners that no place of the vertex changes.
Star<double> planar_star(dmoscope::Random& random, double stretch) {
  constexpr int kAround = 6;
  std::vector<Vec2<double>> ring;
  for (int i = 0; i < kAround; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kAround + random.between(-0.2, 0.2), away = random.between(0.6, 1.4);
    ring.push_back({away * std::cos(angle), stretch * away * std::sin(angle)});
  }
  Star<double> star;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2<double> b = ring[i], c = ring[(i + 1) % ring.size()];
    star.triangles.push_back({b, c, 1.0});
    star.quadrilaterals.push_back({b, times(b + c, random.between(0.6, 1.2)), c, 1.0});
  }
  return star;
}

TEST(PlanarRatioBounds, LeaveHopeForWhatAPlaceReachesAndNoneForMore) {
  dmoscope::Random random(8);
  int sound = 0, by_least = 0;
  std::array<int, kKinds.size()> tried{}, by_mean{};
  for (int trial = 0; trial < 900; ++trial) {
    const auto which = static_cast<std::size_t>(trial / 300);
    const MeanKind kind = kKinds[which].kind;
    const double exponent = kKinds[which].exponent;
    const Star<double> star = planar_star(random, trial % 2 == 0 ? 1.0 : 0.05);
    composite::RatioBounds<Plane, D, F> bounds;
    bounds.take(lists_of(star), kind, nullptr);
    const double half = trial % 3 == 0 ? 0.3 : 0.05;
    const Vec2<double> centre{random.between(-0.1, 0.1), random.between(-0.1, 0.1) * (trial % 2 == 0 ? 1.0 : 0.05)};
    const auto worth_of = [&star](Vec2<double> p) {
      Worth worth;
      StarView<double>(star).for_each<true>([&](const auto& element) {
        const double quality = formulas::metric<Metric::MeanRatio>(element.with(p));
        worth.least = std::min(worth.least, quality);
        worth.add(quality);
      });
      return worth;
    };
    if (!(worth_of(centre).least > 0.0)) continue;
    bounds.move_to({centre.x, centre.y, 0.0}, {half, half, 0.0});
    for (int i = 0; i < 40; ++i) {
      const Vec2<double> way{random.between(-half, half), random.between(-half, half)};
      const Worth worth = worth_of(centre + way);
      if (!(worth.least > 0.01)) continue;
      ++sound;
      const auto hopes = [&](double least, double mean) {
        bounds.set_needs(least, mean);
        return xsimd::any(bounds.may_reach({F(static_cast<float>(way.x)), F(static_cast<float>(way.y))}));
      };
      EXPECT_TRUE(hopes(worth.least, worth.mean(exponent))) << name(kind);
      by_least += hopes(1.001 * worth.least, 0.0) ? 0 : 1;
      ++tried[which];
      by_mean[which] += hopes(0.0, worth.mean(exponent) + 1e-3) ? 0 : 1;
    }
  }
  EXPECT_GT(sound, 1000);
  EXPECT_GT(by_least, sound * 4 / 5);          // a corner across the vertex may be the worst
  EXPECT_GT(by_mean[0], tried[0] * 95 / 100);  // the line that bounds it is the mean itself
  for (const std::size_t which : {1U, 2U}) EXPECT_GT(by_mean[which], tried[which] / 3) << name(kKinds[which].kind);
}

constexpr auto name_of = [](const auto& each) { return std::string(each.param.name); };
INSTANTIATE_TEST_SUITE_P(Stars, RatioBounds,
                         testing::Values(Case{"Regular", {1, 1, 1}, 0.05}, Case{"Jolted", {1, 1, 1}, 0.3}, Case{"Flat", {1, 1, 1e-3}, 0.2},
                                         Case{"Needle", {1e-4, 1, 1e-4}, 0.2}, Case{"Tiny", {1e-6, 1e-6, 1e-6}, 0.2},
                                         Case{"Large", {1e5, 1e5, 1e5}, 0.2}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Stars, CloseRatioBounds,
                         testing::Values(Case{"Regular", {1, 1, 1}, 0.05}, Case{"Jolted", {1, 1, 1}, 0.3}, Case{"Long", {1, 1, 3}, 0.2},
                                         Case{"Tiny", {1e-6, 1e-6, 1e-6}, 0.2}),
                         name_of);

}  // namespace
}  // namespace dmoscope
