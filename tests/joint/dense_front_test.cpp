// Elimination of columns of dense fronts, against the textbook.

#include "core/joint/dense_front.h"

#include <cmath>
#include <initializer_list>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

/// Random front.
struct Front {
  Front(std::size_t rows, std::size_t columns, std::uint64_t seed)
      : height(rows), width(columns), pivots(rows * columns), rest((rows - columns) * (rows - columns)) {
    testing::Random random(seed);
    for (std::size_t j = 0; j < height; ++j)
      for (std::size_t i = j; i < height; ++i) at(i, j) = i == j ? 2.0 + static_cast<double>(height) : random(-1.0, 1.0);
  }
  [[nodiscard]] DenseFront dense() { return {height, width, pivots.data(), rest.data()}; }
  double& at(std::size_t i, std::size_t j) { return j < width ? pivots[j * height + i] : rest[(j - width) * (height - width) + i - width]; }
  bool eliminate_at(SimdLevel level, ThreadPool* pool = nullptr) {
    std::vector<double> room;
    return eliminate(dense(), room, level, pool);
  }
  void eliminate_plainly() {
    for (std::size_t k = 0; k < width; ++k) {
      for (std::size_t i = height; i-- > k;) at(i, k) /= std::sqrt(at(k, k));
      for (std::size_t j = k + 1; j < height; ++j)
        for (std::size_t i = j; i < height; ++i) at(i, j) -= at(i, k) * at(j, k);
    }
  }
  [[nodiscard]] std::vector<double> lower_half() {
    std::vector<double> result;
    for (std::size_t j = 0; j < height; ++j)
      for (std::size_t i = j; i < height; ++i) result.push_back(at(i, j));
    return result;
  }
  std::size_t height, width;
  std::vector<double> pivots, rest;
};

void expect_near(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-14 * (10.0 + std::fabs(b[i]))) << i;
}

void expect_eliminates(std::size_t height, std::size_t width) {
  SCOPED_TRACE(::testing::Message() << width << " columns of " << height);
  Front plain(height, width, height * 1000 + width);
  Front baseline = plain;
  plain.eliminate_plainly();
  ASSERT_TRUE(baseline.eliminate_at(SimdLevel::Baseline));
  const std::vector<double> result = baseline.lower_half();
  expect_near(result, plain.lower_half());
  for (const SimdLevel level : supported_simd_levels()) {
    Front front(height, width, height * 1000 + width);
    ASSERT_TRUE(front.eliminate_at(level));
    EXPECT_EQ(front.lower_half(), result) << name(level);
  }
}

TEST(DenseFront, EliminatesAsTheTextbookDoes) {
  for (std::size_t height = 1; height <= 50; ++height)
    for (std::size_t width = 1; width <= height; ++width) expect_eliminates(height, width);
  for (const std::size_t height : std::initializer_list<std::size_t>{64, 129, 300})
    for (const std::size_t width : std::initializer_list<std::size_t>{1, 8, 16, 63, 64}) expect_eliminates(height, width);
  expect_eliminates(256, 256);
  expect_eliminates(300, 257);
  expect_eliminates(611, 523);
}

TEST(DenseFront, HasTheSameBitsForAnyThreads) {
  for (const auto& [height, width] : std::initializer_list<std::pair<std::size_t, std::size_t>>{{700, 523}, {701, 100}, {513, 513}}) {
    Front alone(height, width, 9);
    ASSERT_TRUE(alone.eliminate_at(SimdLevel::Baseline));
    for (const unsigned threads : {2U, 3U, 5U}) {
      ThreadPool pool(threads);
      for (const SimdLevel level : supported_simd_levels()) {
        Front front(height, width, 9);
        ASSERT_TRUE(front.eliminate_at(level, &pool));
        EXPECT_EQ(front.lower_half(), alone.lower_half()) << threads << " threads, " << name(level);
      }
    }
  }
}

TEST(DenseFront, RefusesABadPivotAnywhere) {
  for (const SimdLevel level : supported_simd_levels())
    for (std::size_t bad = 0; bad < 40; ++bad)
      for (const double pivot : {0.0, -1.0, std::nan("")}) {
        Front front(45, 40, 1);
        front.at(bad, bad) = pivot;
        EXPECT_FALSE(front.eliminate_at(level)) << bad;
      }
}

}  // namespace
}  // namespace dmoscope
