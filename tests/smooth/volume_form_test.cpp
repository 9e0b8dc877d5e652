// The forms that replace elements in the fast search have the elements' values, at any place of the vertex.

#include "core/smooth/kernels/volume_form.h"

#include <gtest/gtest.h>

#include "core/mesh/random.h"

namespace dmoscope {
namespace {

Vec3 random_point(dmoscope::Random& random, double size) {
  return {random.between(-size, size), random.between(-size, size), random.between(-size, size)};
}

TEST(VolumeForm, OfATetrahedronIsItsRank) {
  dmoscope::Random random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 b = random_point(random, 1), c = random_point(random, 1), d = random_point(random, 1), p = random_point(random, 0.5);
    const double rank = formulas::rank<Metric::MeanRatio>(formulas::Tetrahedron<Vec3>(p, b, c, d));
    EXPECT_NEAR(volumes::rank_of(volumes::tetrahedron_form(b, c, d), p, dot(p, p)), rank, 1e-12);
  }
}

/// An ideal element with its corner `moving` at the origin and all others jolted.
template <class Element>
void expect_least_form_to_be_the_rank(const Element& ideal) {
  dmoscope::Random random(4);
  for (Index moving = 0; moving < ideal.at.size(); ++moving)
    for (int trial = 0; trial < 100; ++trial) {
      Element element = ideal;
      for (Vec3& corner : element.at) corner = corner - ideal.at[moving] + random_point(random, 0.3);
      element.at[moving] = {};
      const Vec3 p = random_point(random, 0.3);
      double least = std::numeric_limits<double>::infinity();
      std::size_t count = 0;
      volumes::for_corner_forms(element, moving, [&](const volumes::MeanRatioForm<double>& form) {
        least = std::min(least, volumes::rank_of(form, p, dot(p, p)));
        ++count;
      });
      element.at[moving] = p;
      EXPECT_NEAR(least, formulas::rank_around<Metric::MeanRatio>(element, moving), 1e-12) << "corner " << moving;
      EXPECT_EQ(count, ideal.at.size() == 5 && moving < 4 ? 3U : 4U) << "corners that have an edge to corner " << moving;
    }
}
TEST(VolumeForm, OfTheCornersOfAnyOtherElementAreItsRank) {
  expect_least_form_to_be_the_rank(
      formulas::Hexahedron<Vec3>{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}});
  const double height = std::sqrt(0.75);
  expect_least_form_to_be_the_rank(
      formulas::Wedge<Vec3>{{{{0, 0, 0}, {1, 0, 0}, {0.5, height, 0}, {0, 0, 1}, {1, 0, 1}, {0.5, height, 1}}}});
  expect_least_form_to_be_the_rank(formulas::Pyramid<Vec3>{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, std::sqrt(0.5)}}}});
}

}  // namespace
}  // namespace dmoscope
