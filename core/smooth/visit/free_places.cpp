#include "core/smooth/visit/free_places.h"

#include <initializer_list>

namespace dmoscope {

namespace {

/// Mean of lengths.
class Mean {
 public:
  template <class Point>
  void add(Point p) {
    sum_ += std::sqrt(dot(p, p));
    count_ += 1.0;
  }
  [[nodiscard]] double value() const { return count_ > 0.0 ? sum_ / count_ : 0.0; }

 private:
  double sum_ = 0.0, count_ = 0.0;
};

}  // namespace

double mean_edge(const Star<double>& star) {
  Mean mean;
  for (const StarTriangle<double>& t : star.triangles) mean.add(t.b), mean.add(t.c);
  for (const StarQuadrilateral<double>& q : star.quadrilaterals) mean.add(q.b), mean.add(q.d);
  return mean.value();
}
double mean_edge(const VolumeStar<double>& star) {
  Mean mean;
  for (const auto& t : star.tetrahedra) mean.add(t.b), mean.add(t.c), mean.add(t.d);
  const auto add = [&mean](const auto& list, std::initializer_list<std::size_t> ends) {
    for (const auto& element : list)
      for (const std::size_t i : ends) mean.add(element.others[i - 1]);
  };
  add(star.hexahedra, {1, 3, 4});
  add(star.wedges, {1, 2, 3});
  add(star.pyramids, {1, 3, 4});
  for (const auto& tip : star.tips)
    for (const Vec3 p : tip.base) mean.add(p);
  return mean.value();
}

}  // namespace dmoscope
