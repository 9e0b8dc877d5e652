#include "core/search/mesh_star.h"

namespace dmoscope {

namespace {

struct Gatherer {
  Star<double>& out;
  void operator()(const StarTriangle<double>& t) const { out.triangles.push_back(t); }
  void operator()(const StarQuadrilateral<double>& q) const { out.quadrilaterals.push_back(q); }
};

struct SolidGatherer {
  VolumeStar<double>& out;
  void operator()(const StarTetrahedron<double>& t) const { out.tetrahedra.push_back(t); }
  void operator()(const StarHexahedron<double>& h) const { out.hexahedra.push_back(h); }
  void operator()(const StarWedge<double>& w) const { out.wedges.push_back(w); }
  void operator()(const StarPyramid<double>& p) const { out.pyramids.push_back(p); }
  void operator()(const StarTip<double>& p) const { out.tips.push_back(p); }
};

}  // namespace

void gather_star(const MeshStar<Plane>& star, Star<double>& out) {
  out.triangles.clear();
  out.quadrilaterals.clear();
  out.box = star.box();
  out.scale = star.scale();
  star.for_each<true>(Gatherer{out});
}

void gather_star(const MeshStar<Space>& star, VolumeStar<double>& out) {
  out.for_each_list([](auto& list) { list.clear(); });
  out.box = star.box();
  out.scale = star.scale();
  star.for_each<true>(SolidGatherer{out});
}

}  // namespace dmoscope
