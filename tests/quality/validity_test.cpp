// Validity of elements inside, against exact arithmetic: corners are whole numbers, determinants at places i / n too.

#include "core/quality/validity.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace dmoscope::validity_test {
namespace {

using testing::Random;
__extension__ using Whole = __int128;

struct Point {
  Whole x, y, z;
  friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Point operator*(Whole s, Point a) { return {s * a.x, s * a.y, s * a.z}; }
};
Whole determinant_of(Point a, Point b, Point c) {
  return a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) + a.z * (b.x * c.y - b.y * c.x);
}

/// A positive multiple of the determinant at (i, j, k) / n.
Whole exactly(const std::array<Point, 8>& p, Whole n, Whole i, Whole j, Whole k) {
  const auto mean = [n](Whole s, Whole t, Point a, Point b, Point c, Point d) {
    return (n - s) * (n - t) * a + s * (n - t) * b + (n - s) * t * c + s * t * d;
  };
  return determinant_of(mean(j, k, p[1] - p[0], p[2] - p[3], p[5] - p[4], p[6] - p[7]),
                        mean(i, k, p[3] - p[0], p[2] - p[1], p[7] - p[4], p[6] - p[5]),
                        mean(i, j, p[4] - p[0], p[5] - p[1], p[7] - p[3], p[6] - p[2]));
}
Whole exactly(const std::array<Point, 6>& p, Whole n, Whole i, Whole j, Whole k) {
  const Point along = (n - i - j) * (p[3] - p[0]) + i * (p[4] - p[1]) + j * (p[5] - p[2]);
  return determinant_of((n - k) * (p[1] - p[0]) + k * (p[4] - p[3]), (n - k) * (p[2] - p[0]) + k * (p[5] - p[3]), along);
}

constexpr std::array<Point, 8> kCube{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
constexpr std::array<Point, 6> kPrism{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};

struct Count {
  int valid = 0, inverted = 0, inside_alone = 0, undecided = 0;
};

/// Elements whose corners are displaced so far that half of them are invalid.
template <class Shape, std::size_t N>
Count expect_right(const std::array<Point, N>& ideal, int trials, double least_push, double greatest_push) {
  Random random(91);
  Count count;
  for (int trial = 0; trial < trials; ++trial) {
    std::array<Point, N> p;
    Shape shape;
    const double push = random(least_push, greatest_push);
    for (std::size_t c = 0; c < N; ++c) {
      const auto place = [&](Whole ideal_place) { return 1000 * ideal_place + static_cast<Whole>(std::lround(random(-push, push))); };
      p[c] = {place(ideal[c].x), place(ideal[c].y), place(ideal[c].z)};
      shape.at[c] = {static_cast<double>(p[c].x), static_cast<double>(p[c].y), static_cast<double>(p[c].z)};
    }
    const Validity found = validity_of(shape);
    const double corner = formulas::smallest_jacobian(shape);
    EXPECT_EQ(least_jacobian(shape) > 0.0, found.proved && corner > 0.0);
    if (found.proved) {
      ++count.valid;
      EXPECT_GT(corner, 0.0);
      if (trial % 8 != 0) continue;  // enough, for it takes long
      constexpr int kPlaces = 6;
      for (int i = 0; i <= kPlaces; ++i)
        for (int j = 0; j <= (N == 6 ? kPlaces - i : kPlaces); ++j)
          for (int k = 0; k <= kPlaces; ++k) EXPECT_GT(exactly(p, kPlaces, i, j, k), 0) << "said to be valid";
    } else if (found.least < 0.0) {
      ++count.inverted;
      count.inside_alone += corner > 0.0 ? 1 : 0;
      constexpr Whole kParts =
          N == 8 ? 1 << 9 : 1 << 20;  // pieces' corners are multiples of 1 / 256, their middles of 1 / 512; 128 bits are enough
      const auto part = [](double at) { return static_cast<Whole>(std::lround(at * static_cast<double>(kParts))); };
      EXPECT_LE(exactly(p, kParts, part(found.at.x), part(found.at.y), part(found.at.z)), 0) << "said not to be positive there";
    } else {
      ++count.undecided;
    }
  }
  return count;
}

TEST(Validity, OfHexahedraByExactArithmetic) {
  const Count count = expect_right<formulas::Hexahedron<Vec3>>(kCube, 60000, 300, 800);
  EXPECT_GT(count.valid, 10000);
  EXPECT_GT(count.inverted, 10000);
  EXPECT_GT(count.inside_alone, 200) << "that corners call sound";
  EXPECT_LT(count.undecided, 3);
}

TEST(Validity, OfWedgesByExactArithmetic) {
  const Count count = expect_right<formulas::Wedge<Vec3>>(kPrism, 60000, 200, 700);
  EXPECT_GT(count.valid, 10000);
  EXPECT_GT(count.inverted, 10000);
  EXPECT_GT(count.inside_alone, 50) << "that corners call sound";
  EXPECT_LT(count.undecided, 10);
}

/// Two opposite faces turned against each other, step by step: the determinant in the middle becomes zero at a quarter turn of each (faces
/// of half the diagonal h at height 1: 4 h^2 cos(turn)), long after those at the corners, or never.
TEST(Validity, OfFacesTurnedAgainstEachOther) {
  for (int step = 0; step < 180; ++step) {
    const double turn = step * M_PI / 180.0;
    formulas::Hexahedron<Vec3> hexahedron;
    for (std::size_t c = 0; c < 8; ++c) {
      const double angle = M_PI / 2 * static_cast<double>(c % 4) + (c < 4 ? 0.0 : turn);
      hexahedron.at[c] = {std::cos(angle), std::sin(angle), c < 4 ? 0.0 : 1.0};
    }
    double least = 1e9;  // over 21^3 places
    const auto& p = hexahedron.at;
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; j <= 20; ++j)
        for (int k = 0; k <= 20; ++k) {
          const double x = i / 20.0, y = j / 20.0, z = k / 20.0;
          const auto mean = [](double s, double t, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
            return (1 - s) * (1 - t) * a + s * (1 - t) * b + (1 - s) * t * c + s * t * d;
          };
          const Vec3 a = mean(y, z, p[1] - p[0], p[2] - p[3], p[5] - p[4], p[6] - p[7]);
          const Vec3 b = mean(x, z, p[3] - p[0], p[2] - p[1], p[7] - p[4], p[6] - p[5]);
          const Vec3 c = mean(x, y, p[4] - p[0], p[5] - p[1], p[7] - p[3], p[6] - p[2]);
          least = std::min(least, dot(a, cross(b, c)));
        }
    if (least > 0.02 || least <= 0.0) {
      EXPECT_EQ(validity_of(hexahedron).proved, least > 0.0) << step;
    }
  }
}

TEST(Validity, DependsNeitherOnSizeNorOnPlace) {
  Random random(92);
  for (int trial = 0; trial < 3000; ++trial) {
    formulas::Hexahedron<Vec3> small, large, far;
    for (std::size_t c = 0; c < 8; ++c) {
      const auto place = [&](Whole ideal) { return static_cast<double>(ideal) + std::round(random(-300, 300)) / 1024.0; };
      small.at[c] = {place(kCube[c].x), place(kCube[c].y), place(kCube[c].z)};
      far.at[c] = small.at[c] + Vec3{1e9, -2e9, 3e9};
      large.at[c] = 0x1p300 * small.at[c];
      small.at[c] = 0x1p-300 * small.at[c];
    }
    const bool valid = validity_of(large).proved;
    EXPECT_EQ(validity_of(small).proved, valid);
    EXPECT_EQ(validity_of(far).proved, valid) << "these differences are exact";
  }
}

TEST(Validity, FlatAndShrunkAndNoNumbers) {
  formulas::Hexahedron<Vec3> flat, point, none;
  for (std::size_t c = 0; c < 8; ++c) {
    flat.at[c] = {static_cast<double>(kCube[c].x), static_cast<double>(kCube[c].y), 0.0};
    none.at[c] = {static_cast<double>(kCube[c].x), static_cast<double>(kCube[c].y), static_cast<double>(kCube[c].z)};
  }
  EXPECT_TRUE(validity_of(none).proved);
  none.at[3].x = std::nan("");
  EXPECT_FALSE(validity_of(flat).proved);
  EXPECT_FALSE(validity_of(point).proved);
  EXPECT_FALSE(validity_of(none).proved);
  EXPECT_FALSE(validity_of(formulas::Wedge<Vec3>{}).proved);
}

}  // namespace
}  // namespace dmoscope::validity_test
