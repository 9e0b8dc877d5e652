#include "core/search/mesh_star.h"

namespace dmoscope {

namespace {

struct Gatherer {
  Star<double>& out;
  void operator()(const StarTriangle<double>& t) const { out.triangles.push_back(t); }
  void operator()(const StarQuadrilateral<double>& q) const { out.quadrilaterals.push_back(q); }
};

}  // namespace

void gather_star(const MeshStar& star, Star<double>& out) {
  out.triangles.clear();
  out.quadrilaterals.clear();
  out.box = star.box();
  out.scale = star.scale();
  star.for_each<true>(Gatherer{out});
}

}  // namespace dmoscope
