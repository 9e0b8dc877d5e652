#include "core/joint/face_watch.h"

#include <algorithm>

namespace dmoscope {

FaceWatch::FaceWatch(const Domain& domain, const DeviationBound& limit, std::span<const Vec3> positions)
    : domain_(domain), limit_(limit), begins_(positions.begin(), positions.end()), at_(begins_) {}

void FaceWatch::add(Index vertex, const std::optional<FacetPlace>& beneath) { of_[vertex] = {begins_[vertex], beneath, std::nullopt}; }

bool FaceWatch::allows(Index vertex, Vec3 there, const FacetPlace* beneath) {
  Begin& begin = of_.at(vertex);
  const FacetPlace* beneath_begin = begin.beneath ? &*begin.beneath : nullptr;
  if (!begin.fit) begin.fit = Overlay(domain_, room_).star(begins_, vertex, begin.position, beneath_begin, kNoFit);
  return limit_.allows_faces(at_, {vertex, begin.position, there, beneath_begin, beneath}, room_, begin.fit);
}

std::vector<Index> FaceWatch::around(Index vertex) const {
  const SlidingFaces& faces = domain_.faces();
  std::vector<Index> found;
  for (const Index face : faces.at(vertex)) {
    const auto corners = faces.table().corners(face);
    found.insert(found.end(), corners.begin(), corners.end());
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace dmoscope
