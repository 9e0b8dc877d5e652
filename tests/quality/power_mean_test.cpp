// Power means against their definition, and equality of packs and scalars to the bit.

#include "core/quality/power_mean.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/numeric/pack.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

std::vector<double> some_qualities() {
  testing::Random random(5);
  std::vector<double> all;
  for (int i = 0; i < 23; ++i) all.push_back(random(1e-4, 1.0));
  return all;
}

double mean_of(MeanKind kind, const std::vector<double>& qualities) {
  PowerMean<double> mean(kind);
  for (const double quality : qualities) mean.add(quality);
  return mean.value(static_cast<double>(qualities.size()));
}

double by_definition(double exponent, const std::vector<double>& qualities) {
  double sum = 0.0;
  for (const double quality : qualities) sum += std::pow(quality, exponent);
  return std::pow(sum / static_cast<double>(qualities.size()), 1.0 / exponent);
}

TEST(PowerMean, IsWhatItsExponentSays) {
  const auto all = some_qualities();
  std::vector<double> good = all;
  std::erase_if(good, [](double quality) { return quality < 0.4; });
  EXPECT_NEAR(mean_of(MeanKind::Arithmetic, all), by_definition(1.0, all), 1e-14);
  EXPECT_NEAR(mean_of(MeanKind::Harmonic, good), by_definition(-1.0, good), 1e-14);
  EXPECT_NEAR(mean_of(MeanKind::InverseSquare, all), by_definition(-2.0, all), 1e-14);
  double logs = 0.0;
  for (const double quality : all) logs += std::log(quality);
  EXPECT_NEAR(16.0 * std::log(mean_of(MeanKind::Geometric, all)), logs, 1e-10);
}

TEST(PowerMean, TheHarmonicOneIsNotRaisedByOneMoreBadElement) {
  for (const double level : {0.1, 0.2, 0.3, 0.4}) {
    // One element falls below a level; all others, of which some are below higher levels, become ideal.
    std::vector<double> from(12, level * 1.01), to(12, 1.0);
    to[5] = level * 0.99;
    EXPECT_EQ(std::ranges::count_if(from, [&](double quality) { return quality < level; }), 0);
    EXPECT_LT(mean_of(MeanKind::Harmonic, to), mean_of(MeanKind::Harmonic, from)) << level;
    EXPECT_GT(mean_of(MeanKind::Arithmetic, to), mean_of(MeanKind::Arithmetic, from)) << level;
    from[5] = level * 0.99;
    EXPECT_GT(mean_of(MeanKind::Harmonic, to), mean_of(MeanKind::Harmonic, from)) << level << ": it was below before";
  }
}

TEST(PowerMean, OfManyBadElementsIsStillAbove0) {
  const std::vector<double> bad(300, 1e-6);
  for (const MeanKind kind : kMeanKinds) EXPECT_GT(mean_of(kind, bad), 0.0) << name(kind);
}

TEST(PowerMean, SlotsOfAPackGetTheBitsOfScalars) {
  const auto all = some_qualities();
  for (const MeanKind kind : kMeanKinds) {
    PowerMean<Pack<double>> packed(kind);
    std::array<PowerMean<double>, Pack<double>::size> alone = [&]<std::size_t... I>(std::index_sequence<I...>) {
      return std::array{((void)I, PowerMean<double>(kind))...};
    }
    (std::make_index_sequence<Pack<double>::size>{});
    for (std::size_t i = 0; i + Pack<double>::size <= all.size(); ++i) {
      packed.add(Pack<double>::load_unaligned(all.data() + i));
      for (std::size_t k = 0; k < Pack<double>::size; ++k) alone[k].add(all[i + k]);
    }
    for (std::size_t k = 0; k < Pack<double>::size; ++k) EXPECT_EQ(packed.value(7.0).get(k), alone[k].value(7.0)) << name(kind);
  }
}

TEST(PowerMean, IsNamed) {
  for (const MeanKind kind : kMeanKinds) EXPECT_EQ(parse_choice<MeanKind>("mean", name(kind), kMeanNames), kind);
  EXPECT_THROW((void)parse_choice<MeanKind>("mean", "median", kMeanNames), UsageError);
}

}  // namespace
TEST(PowerMean, TotalsAndSlopesAreThoseOfTheMean) {
  for (const MeanKind kind : kMeanKinds) {
    const auto total = [kind](double mean) { return PowerMean<double>::total_of(kind, mean, 5.0); };
    PowerMean<double> five(kind);
    five.join(is_product(kind) ? total(0.6) : total(0.6) - five.total());
    EXPECT_NEAR(five.value(5.0), 0.6, 1e-15) << name(kind);
    EXPECT_EQ(total(0.7) < total(0.6), has_falling_total(kind)) << name(kind);
    EXPECT_NEAR(five.slope_of_total(5.0), std::abs(total(0.6001) - total(0.5999)) / 2e-4, 1e-4) << name(kind);
    const auto term = [kind](double quality) { return PowerMean<double>(kind).term(quality); };
    const double by_term = is_product(kind) ? 16.0 / term(0.6) : 1.0;
    EXPECT_NEAR(PowerMean<double>::slope(kind, 1.0 / 0.6), by_term * std::abs(term(0.6001) - term(0.5999)) / 2e-4, 1e-4) << name(kind);
  }
}

}  // namespace dmoscope
