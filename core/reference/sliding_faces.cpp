#include "core/reference/sliding_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace dmoscope {

namespace {

/// Tolerance for a computed point to lie beside its facet, in roundings of a coordinate.
constexpr double kRoundings = 8.0;
/// Distance within which a point is on a facet, as a share of the mesh's size. The nearest point of a needle is no more accurate.
constexpr double kBeside = 1e-12;

double rounding_of(const InputMesh& input) {
  return kRoundings * (input.mesh.single_precision ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon());
}

double most(Vec3 p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

}  // namespace

SlidingFaces::SlidingFaces(const InputMesh& input, ElementTable faces, std::shared_ptr<const Facets> facets)
    : facets_(std::move(facets)), faces_(std::move(faces)), rounding_(rounding_of(input)), beside_(kBeside * input.geometry.size) {
  for (Index f = 0; f < faces_.size(); ++f) near_.push_back(facets_->first_of(f));
  index(input.mesh.vertex_count());
}

SlidingFaces::SlidingFaces(const InputMesh& input, ElementTable faces, std::shared_ptr<const Facets> facets, std::vector<Index> near,
                           double beside)
    : facets_(std::move(facets)),
      faces_(std::move(faces)),
      near_(std::move(near)),
      rounding_(rounding_of(input)),
      beside_(beside),
      is_own_(false) {
  index(input.mesh.vertex_count());
}

void SlidingFaces::index(Index vertices) {
  home_.assign(vertices, kNoIndex);
  offsets_.assign(vertices + std::size_t{1}, 0);
  for (const Index v : faces_.all_corners()) ++offsets_[v + std::size_t{1}];
  std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
  faces_at_.resize(faces_.all_corners().size());
  std::vector<Index> at(offsets_.begin(), offsets_.end() - 1);
  for (Index f = 0; f < faces_.size(); ++f)
    for (const Index v : faces_.corners(f)) faces_at_[at[v]++] = f;
}

std::optional<FacetPlace> SlidingFaces::place(Index vertex, Vec3 position, Index near) const {
  const Index home = home_[vertex];
  const auto [facet, point] = facets_->nearest(position, near == kNoIndex ? home : near);
  if (facet == kNoIndex) return std::nullopt;
  double largest = most(position);
  for (const Index corner : facets_->facets()[facet].corners) largest = std::max(largest, most(facets_->point(corner)));
  const double tolerance = std::max(rounding_ * largest, beside_);
  if (!(point.square <= tolerance * tolerance)) return std::nullopt;
  return FacetPlace{facet, point.weights};
}

}  // namespace dmoscope
