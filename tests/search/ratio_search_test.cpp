// The search by threshold rounds against the plain one in double; and packs against one lane at a time.

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/numeric/pack.h"
// Included after the packs:
#include "core/search/grid_search.h"
#include "core/search/ratio_search.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using testing::Random;
using F = Pack<float>;
constexpr double kFloatError = 1e-6;  // error of a quality

/// A star of `triangles` and then `quadrilaterals` around the origin, which sees all of their corners and lies away from the middle by up
/// to `aside`. Coordinates are floats.
Star<double> random_star(Random& random, int triangles, int quadrilaterals, double aside = 0.25) {
  const int count = triangles + quadrilaterals;
  const Vec2<double> hub{random(-aside, aside), random(-aside, aside)};
  const auto at = [&](double sector, double low, double high) {
    const double angle = 2 * M_PI * (sector + random(-0.3, 0.3)) / count, radius = random(low, high);
    return Vec2<double>{static_cast<float>(radius * std::cos(angle) - hub.x), static_cast<float>(radius * std::sin(angle) - hub.y)};
  };
  std::vector<Vec2<double>> ring;
  for (int i = 0; i < count; ++i) ring.push_back(at(i, 0.7, 1.0));
  Star<double> star;
  Vec2<double> low = ring[0], high = ring[0];
  const auto grow = [&](Vec2<double> p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  };
  for (int i = 0; i < count; ++i) {
    const Vec2<double> b = ring[static_cast<std::size_t>(i)], d = ring[static_cast<std::size_t>((i + 1) % count)];
    grow(b);
    if (i < triangles) {
      star.triangles.push_back({b, d, 1.0});
    } else {
      const Vec2<double> c = at(i + 0.5, 1.2, 1.8);
      grow(c);
      star.quadrilaterals.push_back({b, c, d, 1.0});
    }
  }
  star.box = high - low;
  return star;
}

/// Puts the star's numbers into slot `slot` of packs, or into plain floats.
void put(double from, std::size_t /*slot*/, float& to) { to = static_cast<float>(from); }
void put(double from, std::size_t slot, F& to) {
  alignas(64) float values[F::size];
  to.store_aligned(values);
  values[slot] = static_cast<float>(from);
  to = F::load_aligned(values);
}
template <class R>
void put(Vec2<double> from, std::size_t slot, Vec2<R>& to) {
  put(from.x, slot, to.x);
  put(from.y, slot, to.y);
}
template <class R>
void put(const Star<double>& from, std::size_t slot, Star<R>& to) {
  to.triangles.resize(from.triangles.size(), {{R(0), R(0)}, {R(0), R(0)}, R(1)});
  to.quadrilaterals.resize(from.quadrilaterals.size(), {{R(0), R(0)}, {R(0), R(0)}, {R(0), R(0)}, R(1)});
  for (std::size_t i = 0; i < from.triangles.size(); ++i) {
    put(from.triangles[i].b, slot, to.triangles[i].b);
    put(from.triangles[i].c, slot, to.triangles[i].c);
  }
  for (std::size_t i = 0; i < from.quadrilaterals.size(); ++i) {
    put(from.quadrilaterals[i].b, slot, to.quadrilaterals[i].b);
    put(from.quadrilaterals[i].c, slot, to.quadrilaterals[i].c);
    put(from.quadrilaterals[i].d, slot, to.quadrilaterals[i].d);
  }
  put(from.box, slot, to.box);
}
Star<float> in_float(const Star<double>& star) {
  Star<float> result;
  put(star, 0, result);
  return result;
}

template <Metric M, class R>
Candidate<R> rounds(const Star<R>& star, Vec2<R> box, int levels, double omega = 0.5) {
  std::array<RatioForm<R>, RatioSearch<R>::kMaxForms> forms;
  std::size_t count = 0;
  R cap = scalar::constant<R>(1e30);
  for (const auto& t : star.triangles) triangle_form(t, forms[count++]);
  for (const auto& q : star.quadrilaterals) {
    using scalar::min;
    cap = min(cap, quadrilateral_forms<M>(q, forms.data() + count));
    count += kQuadrilateralForms<M>;
  }
  RatioSearch<R> search;
  return search.search({forms.data(), count}, cap, box, levels, omega);
}

struct Tally {
  int searches = 0, different = 0;
  double worst_loss = 0.0;
};

/// Compares the rounds in float with the plain search in double over `box`. Another candidate must not be worse; from the second level on a
/// tie may have led elsewhere, which the tally counts.
template <Metric M>
void compare(const Star<double>& star, Vec2<double> box, int levels, Tally& tally) {
  const Objective<M, false, double> objective(star);
  const auto expected = grid_search<double>(objective, box, {.levels = levels});
  const auto found = rounds<M>(in_float(star), Vec2<float>{static_cast<float>(box.x), static_cast<float>(box.y)}, levels);
  const Vec2<double> offset{found.offset.x, found.offset.y};
  const double quality = objective(offset);
  EXPECT_NEAR(found.objective, quality, 1e-5);
  EXPECT_GE(quality, objective({}) - kFloatError);
  ++tally.searches;
  const double spacing = std::max(box.x, box.y) * 0.5 / 7 * std::pow(2.0 / 7, levels - 1);
  if (std::hypot(offset.x - expected.offset.x, offset.y - expected.offset.y) <= 0.01 * spacing) return;
  if (std::fabs(expected.objective - quality) <= kFloatError) return;
  ++tally.different;
  tally.worst_loss = std::max(tally.worst_loss, expected.objective - quality);
  EXPECT_GT(levels, 1) << "on one grid only a tie may be decided otherwise: " << expected.objective << ", found " << quality;
}

template <class T>
class RatioSearchOf : public ::testing::Test {};
template <Metric M>
struct Of {
  static constexpr Metric kMetric = M;
};
using RatioMetrics = ::testing::Types<Of<Metric::MeanRatio>, Of<Metric::MeanRatioArea>>;
TYPED_TEST_SUITE(RatioSearchOf, RatioMetrics);

TYPED_TEST(RatioSearchOf, FindsWhatThePlainSearchFinds) {
  constexpr Metric kMetric = TypeParam::kMetric;
  Random random(71);
  Tally tally;
  const auto try_star = [&](int triangles, int quadrilaterals) {
    const Star<double> star = random_star(random, triangles, quadrilaterals);
    if (!(Objective<kMetric, false, double>(star)({}) > 1e-3)) return;
    for (int levels = 1; levels <= 5; ++levels) compare<kMetric>(star, star.box, levels, tally);
  };
  for (int trial = 0; trial < 1200; ++trial) try_star(3 + trial % 30, 0);
  for (int trial = 0; trial < 1200; ++trial) try_star(0, 3 + trial % 8);
  for (int trial = 0; trial < 600; ++trial) try_star(1 + trial % 16, 2 + trial % 5);
  EXPECT_GT(tally.searches, 10000);
  EXPECT_LE(tally.different, tally.searches / 1000);
  EXPECT_LE(tally.worst_loss, kMetric == Metric::MeanRatio ? 1e-4 : 3e-3);
}

/// A star of four almost square quadrilaterals, one of them drawn out to a kite.
Star<double> star_with_a_cap(Random& random) {
  const Vec2<double> hub{random(-0.6, 0.6), random(-0.6, 0.6)};
  const auto at = [&](double quarter, double radius) {
    const double angle = M_PI / 2 * (quarter + random(-0.1, 0.1));
    return Vec2<double>{static_cast<float>(radius * std::cos(angle) - hub.x), static_cast<float>(radius * std::sin(angle) - hub.y)};
  };
  std::vector<Vec2<double>> ring;
  for (int i = 0; i < 4; ++i) ring.push_back(at(i, 1.0));
  Star<double> star;
  for (std::size_t i = 0; i < 4; ++i)
    star.quadrilaterals.push_back({ring[i], at(static_cast<double>(i) + 0.5, i == 0 ? random(3.0, 4.0) : 1.4), ring[(i + 1) % 4], 1.0});
  star.box = {2.0, 2.0};
  return star;
}

/// If the corner opposite to the vertex is the worst, many candidates are equally good: the first of them is chosen.
TEST(RatioSearch, TakesTheFirstOfAllCandidatesAtTheCap) {
  Random random(72);
  int capped = 0, same = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Star<double> star = star_with_a_cap(random);
    const Objective<Metric::MeanRatio, false, double> objective(star);
    if (!(objective({}) > 1e-3)) continue;
    double cap = 1;
    for (const auto& q : star.quadrilaterals) {
      const auto bc = q.c - q.b, cd = q.d - q.c;
      cap = std::min(cap, 2 * cross(bc, cd) / (dot(bc, bc) + dot(cd, cd)));
    }
    const auto expected = grid_search<double>(objective, star.box, {.levels = 1});
    if (objective({}) >= cap || std::fabs(expected.objective - cap) > 1e-12) continue;
    ++capped;
    const auto found = rounds<Metric::MeanRatio>(in_float(star), in_float(star).box, 1);
    EXPECT_NEAR(found.objective, cap, kFloatError);
    if (std::hypot(found.offset.x - expected.offset.x, found.offset.y - expected.offset.y) < 1e-4)
      ++same;
    else
      EXPECT_NEAR(objective({found.offset.x, found.offset.y}), cap, kFloatError) << "a candidate at the very edge";
  }
  EXPECT_GT(capped, 50);
  EXPECT_GE(same, capped - capped / 50);
}

/// Columns of a GPU's lane, which keeps other tables than the processor, and after a level's first round looks only at columns that may
/// hold something.
template <std::size_t N>
void expect_the_same_of_a_lane(Random& random, int trials) {
  for (int trial = 0; trial < trials; ++trial) {
    Star<float> star = in_float(random_star(random, N, 0, trial % 2 == 0 ? 0.25 : 0.6));
    const float stretch = trial % 3 == 0 ? 1.0F : static_cast<float>(std::pow(10.0, random(-3.0, 3.0)));
    const auto stretched = [stretch](Vec2<float> p) { return Vec2<float>{p.x * stretch, p.y}; };
    for (StarTriangle<float>& t : star.triangles) t = {stretched(t.b), stretched(t.c), 1.0F};
    star.box = stretched(star.box);
    std::array<RatioForm<float>, N> forms;
    for (std::size_t i = 0; i < N; ++i) triangle_form(star.triangles[i], forms[i]);
    if (!std::ranges::all_of(forms, [](const RatioForm<float>& form) { return form.n0 > 0.0F; })) continue;
    const auto expected = rounds<Metric::MeanRatio>(star, star.box, 3);
    RatioSearch<float, N, Tables::Rows> lane;
    const auto found = lane.search(std::span<RatioForm<float>, N>(forms), 1e30F, star.box, 3, 0.5);
    EXPECT_EQ(found.offset.x, expected.offset.x) << N << " triangles, stretched " << stretch;
    EXPECT_EQ(found.offset.y, expected.offset.y) << N << " triangles, stretched " << stretch;
    EXPECT_EQ(found.objective, expected.objective);
  }
}

TEST(RatioSearch, ALaneFindsTheSameBits) {
  Random random(77);
  expect_the_same_of_a_lane<4>(random, 4000);
  expect_the_same_of_a_lane<5>(random, 4000);
  expect_the_same_of_a_lane<6>(random, 4000);
  expect_the_same_of_a_lane<7>(random, 4000);
  expect_the_same_of_a_lane<8>(random, 4000);
}

TEST(RatioSearch, ColumnsThatMayHoldMoreAreNeverLeftOut) {
  Random random(78);
  int left_out = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::array<float, 8> largest;
    RoundColumns columns;
    EXPECT_EQ(columns.bits(), 0xffU);
    for (float& m : largest) columns.keep(m = static_cast<float>(random(-0.2, 1.0) * std::pow(10.0, random(-6.0, 1.0))));
    const float least = trial % 4 == 0 ? largest[static_cast<std::size_t>(trial / 4 % 8)] : static_cast<float>(random(-0.05, 0.5));
    columns.take_those_above(least);
    for (std::size_t i = 0; i < 8; ++i) {
      const bool looked_at = (columns.bits() >> i & 1U) != 0;
      if (largest[i] > least) {
        EXPECT_TRUE(looked_at) << largest[i] << " above " << least;
      }
      if (least > 0.0F && largest[i] < 0.98F * least) {
        EXPECT_FALSE(looked_at) << largest[i] << " far below " << least;
      }
      left_out += looked_at ? 0 : 1;
    }
    columns.keep(1e9F);  // a later round's value is not kept
    columns.take_those_above(1e6F);
    EXPECT_EQ(columns.bits(), 0U);
  }
  EXPECT_GT(left_out, 4000);
}

TEST(RatioSearch, BoxesWithoutWidthOrHeight) {
  Random random(73);
  for (int trial = 0; trial < 200; ++trial) {
    const Star<double> star = random_star(random, 3 + trial % 8, trial % 3);
    const Objective<Metric::MeanRatio, false, double> objective(star);
    if (!(objective({}) > 1e-3)) continue;
    Tally tally;
    const auto stays = rounds<Metric::MeanRatio>(in_float(star), Vec2<float>{0, 0}, 3);
    EXPECT_EQ(stays.offset.x, 0.0F);
    EXPECT_EQ(stays.offset.y, 0.0F);
    EXPECT_NEAR(stays.objective, objective({}), kFloatError);
    compare<Metric::MeanRatio>(star, {star.box.x, 0}, 1, tally);
    compare<Metric::MeanRatio>(star, {0, star.box.y}, 1, tally);
    EXPECT_EQ(rounds<Metric::MeanRatio>(in_float(star), Vec2<float>{in_float(star).box.x, 0}, 3).offset.y, 0.0F);
    EXPECT_EQ(rounds<Metric::MeanRatio>(in_float(star), Vec2<float>{0, in_float(star).box.y}, 3).offset.x, 0.0F);
  }
}

/// The lower index wins between two candidates that mirror each other.
TEST(RatioSearch, TiesGoToTheLowestIndex) {
  Random random(76);
  for (int trial = 0; trial < 100; ++trial) {
    const double x = static_cast<float>(random(0.3, 0.6)), y = static_cast<float>(random(0.7, 1.0)),
                 right = static_cast<float>(random(0.8, 1.0));
    // A ring that is its own mirror image over the x axis, drawn out along y, and the same over the y axis.
    const Vec2<double> ring[] = {{right, 0}, {x, y}, {-x, y}, {-0.3, 0}, {-x, -y}, {x, -y}};
    for (const bool turned : {false, true}) {
      Star<double> star;
      const auto at = [&](std::size_t i) { return turned ? Vec2<double>{-ring[i % 6].y, ring[i % 6].x} : ring[i % 6]; };
      for (std::size_t i = 0; i < 6; ++i) star.triangles.push_back({at(i), at(i + 1), 1.0});
      star.box = turned ? Vec2<double>{2 * y, right + 0.6} : Vec2<double>{right + 0.6, 2 * y};
      const auto found = rounds<Metric::MeanRatio>(in_float(star), in_float(star).box, 1);
      const auto expected = grid_search<double>(Objective<Metric::MeanRatio, false, double>(star), star.box, {.levels = 1});
      EXPECT_LT(turned ? found.offset.x : found.offset.y, 0.0F) << "the lower of the two lines next to the axis";
      // In double the lattice's lines are not exact mirror images of each other: either may win.
      EXPECT_NEAR(std::fabs(found.offset.x), std::fabs(expected.offset.x), 1e-6);
      EXPECT_NEAR(std::fabs(found.offset.y), std::fabs(expected.offset.y), 1e-6);
    }
  }
}

TEST(Pack, SumsAreTheBitsOfPlainSums) {
  Random random(77);
  for (int trial = 0; trial < 20000; ++trial) {
    alignas(64) float a[F::size], b[F::size], sum[F::size];
    for (std::size_t i = 0; i < F::size; ++i) {
      a[i] = static_cast<float>(random(-1, 1) * std::exp2(random(-60, 60)));
      b[i] = static_cast<float>(random(-1, 1) * std::exp2(random(-60, 60)));
    }
    scalar::Sum<F>::of(F::load_aligned(a), F::load_aligned(b)).store_aligned(sum);
    for (std::size_t i = 0; i < F::size; ++i) EXPECT_EQ(std::bit_cast<std::uint32_t>(sum[i]), std::bit_cast<std::uint32_t>(a[i] + b[i]));
  }
}

void expect_same_bits(const Candidate<F>& pack, std::size_t slot, const Candidate<float>& one) {
  EXPECT_EQ(std::bit_cast<std::uint32_t>(pack.offset.x.get(slot)), std::bit_cast<std::uint32_t>(one.offset.x));
  EXPECT_EQ(std::bit_cast<std::uint32_t>(pack.offset.y.get(slot)), std::bit_cast<std::uint32_t>(one.offset.y));
  EXPECT_EQ(std::bit_cast<std::uint32_t>(pack.objective.get(slot)), std::bit_cast<std::uint32_t>(one.objective));
}

/// Stars of one form, as many as a pack has slots, searched together by search(star in R).
template <class Search>
void expect_lanes_alike(Random& random, int triangles, int quadrilaterals, Search search) {
  std::vector<Star<double>> stars;
  Star<F> together{{}, {}, {F(0.0F), F(0.0F)}, 1.0};
  for (std::size_t slot = 0; slot < F::size; ++slot) {
    stars.push_back(random_star(random, triangles, quadrilaterals));
    put(stars.back(), slot, together);
  }
  const Candidate<F> found = search(together);
  for (std::size_t slot = 0; slot < F::size; ++slot) expect_same_bits(found, slot, search(in_float(stars[slot])));
}

TYPED_TEST(RatioSearchOf, GivesEverySlotOfAPackTheBitsOfOneLane) {
  Random random(74);
  for (int trial = 0; trial < 1000; ++trial) {
    const int quadrilaterals = trial % 3 == 0 ? 0 : 2 + trial % 5, triangles = trial % 3 == 1 ? 0 : 3 + trial % 14;
    if (triangles + quadrilaterals < 3) continue;
    expect_lanes_alike(random, triangles, quadrilaterals, [&]<class R>(const Star<R>& star) {
      return rounds<TypeParam::kMetric>(star, star.box, 1 + trial % 5, 0.3 + 0.1 * (trial % 4));
    });
  }
}

TEST(GridSearch, GivesEverySlotOfAPackTheBitsOfOneLane) {
  Random random(75);
  for (const MetricInfo& entry : metric_table())
    formulas::with_planar_metric(entry.metric, [&]<Metric M>() {
      for (int trial = 0; trial < 60; ++trial) {
        const int quadrilaterals = entry.defined_for(ElementKind::Quadrilateral) ? trial % 4 : 0;
        const SearchParameters parameters{.grid_points = 5 + trial % 5, .levels = 1 + trial % 4};
        expect_lanes_alike(random, 3 + trial % 6, quadrilaterals, [&]<class R>(const Star<R>& star) {
          return grid_search<R>(Objective<M, false, R, Value::Rank>(star), star.box, parameters);
        });
      }
    });
}

}  // namespace
}  // namespace dmoscope
