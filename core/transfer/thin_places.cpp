#include "core/transfer/thin_places.h"

#include "core/base/same_bits.h"
#include "core/mesh/thin.h"
#include "core/transfer/mesh_place.h"

namespace dmoscope {
namespace {

/// A coordinate of the back: its own bits if neither the front's coordinate nor the difference between them has changed.
double behind(double front, double was_front, double way, double was_back) {
  return same_bits(front, was_front) && way == was_back - was_front ? was_back : front + way;
}

Vec3 in_single(Vec3 p) {
  const auto rounded = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  return {rounded(p.x), rounded(p.y), rounded(p.z)};
}

}  // namespace

std::vector<Vec3> places_with_back(const InputMesh& input, std::span<const Vec3> positions, ThreadPool* pool, Progress& progress) {
  constexpr std::size_t kGrain = 4096;
  std::vector<Vec3> places(positions.begin(), positions.end());
  const Mesh& mesh = input.mesh;
  if (!mesh.thin) return places;
  const std::vector<Index>& back = mesh.thin->back;
  const auto way_at = [&](Index v) { return mesh.positions[back[v]] - mesh.positions[v]; };
  const PlaceSearch<3> search(mesh, mesh.positions, input.topology, input.geometry);
  for_chunks(pool, positions.size(), kGrain, [&](std::size_t first, std::size_t last) {
    progress.check();
    for (auto v = static_cast<Index>(first); v < last; ++v) {
      if (back[v] == kNoIndex || back[v] == v || same_bits(positions[v], mesh.positions[v])) continue;
      const MeshPlace<3> place = search.at(v, positions[v]);
      const Vec3 one = way_at(place.corners[0]);
      Vec3 way = one;  // keeps a constant offset constant
      for (std::size_t k = 1; k < 3; ++k) way = way + place.weights[k] * (way_at(place.corners[k]) - one);
      const Vec3 to = positions[v], from = mesh.positions[v], was = mesh.positions[back[v]];
      const Vec3 at{behind(to.x, from.x, way.x, was.x), behind(to.y, from.y, way.y, was.y), behind(to.z, from.z, way.z, was.z)};
      places[back[v]] = mesh.single_precision ? in_single(at) : at;
    }
  });
  return places;
}

}  // namespace dmoscope
