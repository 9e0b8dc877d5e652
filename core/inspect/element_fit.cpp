#include "core/inspect/element_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/base/thread_pool.h"
#include "core/mesh/edges.h"
#include "core/reference/hold.h"
#include "core/reference/overlay.h"

namespace dmoscope {

namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kFaceGrain = 256;  // faces that a thread takes at once

/// Raises value to the greater of the two; any number is greater than NaN.
void raise(float& value, double other) {
  const auto rounded = static_cast<float>(other);
  if (!std::isnan(rounded) && !(value >= rounded)) value = rounded;
}

/// Lays faces, at the vertices' positions, over the facets beneath them.
class FaceLayer {
 public:
  FaceLayer(const Domain& domain, PositionView positions)
      : domain_(domain), faces_(domain.faces()), facets_(faces_.facets()), positions_(positions), overlay_(domain, room_) {}

  [[nodiscard]] Fit fit(Index face) {
    const auto c = faces_.table().corners(face);
    if (faces_.are_own() && std::ranges::all_of(c, [this](Index v) { return positions_[v] == facets_.point(v); })) return {};
    find_starts(face);
    find_stretches(face);
    if (c.size() == 3) return lay(c[0], c[1], c[2]);
    const Vec3 one = positions_[c[2]] - positions_[c[0]], other = positions_[c[3]] - positions_[c[1]];
    const std::size_t first = dot(one, one) <= dot(other, other) ? 0 : 1;  // one end of the shorter diagonal
    const Fit here = lay(c[first], c[first + 1], c[first + 2]), there = lay(c[first], c[first + 2], c[(first + 3) % 4]);
    return {std::max(here.deviation, there.deviation), 0.0, std::min(here.least_cosine, there.least_cosine)};
  }

 private:
  /// Finds facets near the face: beneath its corners, and beneath its place in the input.
  void find_starts(Index face) {
    starts_.clear();
    const auto c = faces_.table().corners(face);
    for (const Index v : c) {
      if (domain_.on_surface(v)) {
        if (const auto place = faces_.place(v, positions_[v])) starts_.push_back(place->facet);
      } else if (domain_.on_curve(v)) {
        if (const auto place = domain_.curves().place(v, positions_[v])) add_sides(v, *place, face);
      }
    }
    const auto [first, count] = faces_.beneath(face);
    for (Index i = 0; i < count; ++i) starts_.push_back(first + i);
  }
  void add_sides(Index v, double place, Index face) {
    for (const auto& ends : domain_.curves().edges_at(v, place)) {
      if (ends.first == kNoIndex) continue;
      for (const FacetSide& side : facets_.sides_of(ends.first, ends.second))
        if (facets_.facets()[side.facet].patch == faces_.patch_of(face)) starts_.push_back(side.facet);
    }
  }
  /// Finds the stretches of curves along the face's edges.
  void find_stretches(Index face) {
    stretches_.clear();
    const auto c = faces_.table().corners(face);
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Index a = c[i], b = c[i + 1 < c.size() ? i + 1 : 0];
      const Index slider = domain_.on_curve(a) ? a : b, other = slider == a ? b : a;
      if (!domain_.on_curve(slider)) continue;
      const auto stretch = domain_.curves().stretch_to(slider, positions_[slider], other, positions_[other]);
      if (stretch) stretches_.push_back(*stretch);
    }
  }
  [[nodiscard]] Fit lay(Index a, Index b, Index c) {
    for (const Index start : starts_) {
      const Fit fit = overlay_.triangle({positions_[a], positions_[b], positions_[c]}, start, stretches_);
      if (fit.deviation < kNoFit.deviation) return fit;
    }
    return kNoFit;
  }

  const Domain& domain_;
  const SlidingFaces& faces_;
  const Facets& facets_;
  PositionView positions_;
  OverlayRoom room_;
  Overlay overlay_;
  std::vector<Index> starts_;
  std::vector<Curves::Stretch> stretches_;
};

bool is_face(const ElementTable& elements, ElementFace at, std::span<const Index> corners) {
  const auto vertices = vertices_of(elements, at);
  return std::ranges::all_of(corners, [&](Index v) { return std::ranges::find(vertices, v) != vertices.end(); });
}

/// The element's face that each face of the surface is: first those of the boundary, then those of interfaces, as far as these slide.
std::vector<ElementFace> owners_of(const InputMesh& input, const ElementTable& faces) {
  std::vector<ElementFace> owners;
  const auto boundary = input.faces.boundary();
  const bool slides = !boundary.empty() && faces.size() >= boundary.size() && is_face(input.mesh.elements, boundary[0], faces.corners(0));
  if (slides) owners.assign(boundary.begin(), boundary.end());
  for (Index e = 0; e < input.mesh.elements.size() && owners.size() < faces.size(); ++e) {
    const auto across = input.faces.of(e);
    for (Index f = 0; f < across.size(); ++f)
      if (across[f] != kNoIndex && across[f] > e && input.interfaces.between(e, across[f])) owners.push_back({e, f});
  }
  return owners;
}

ElementFit fit_in_space(const InputMesh& input, const Domain& domain, PositionView positions, ThreadPool* pool) {
  const ElementTable& faces = domain.faces().table();
  std::vector<float> deviation(faces.size(), kNone), tilt(faces.size(), kNone);
  for_chunks(pool, faces.size(), kFaceGrain, [&](std::size_t begin, std::size_t end) {
    FaceLayer layer(domain, positions);
    for (std::size_t f = begin; f < end; ++f) {
      const Fit fit = layer.fit(static_cast<Index>(f));
      if (fit.deviation == kNoFit.deviation) continue;
      deviation[f] = static_cast<float>(fit.deviation);
      tilt[f] = static_cast<float>(std::acos(std::clamp(fit.least_cosine, -1.0, 1.0)) / kDegree);
    }
  });
  if (input.is_surface()) return {std::move(deviation), std::move(tilt)};
  const std::size_t count = input.mesh.elements.size();
  ElementFit fit{std::vector<float>(count, kNone), std::vector<float>(count, kNone)};
  const std::vector<ElementFace> owners = owners_of(input, faces);
  for (std::size_t f = 0; f < owners.size(); ++f) {
    const Index other = input.faces.of(owners[f].element)[owners[f].face];  // element beyond an interface
    for (const Index e : {owners[f].element, other}) {
      if (e == kNoIndex) continue;
      raise(fit.deviation[e], static_cast<double>(deviation[f]));
      raise(fit.tilt[e], static_cast<double>(tilt[f]));
    }
  }
  return fit;
}

ElementFit fit_in_plane(const InputMesh& input, const Domain& domain, PositionView positions) {
  ElementFit fit{std::vector<float>(input.mesh.elements.size(), kNone), {}};
  for_each_edge(input.mesh, input.topology, [&](const Edge& /*edge*/, std::span<const EdgeSide> sides) {
    if (sides.size() == 1) raise(fit.deviation[sides[0].element], 0.0);
  });
  const Curves& curves = domain.curves();
  for (Index v = 0; v < input.mesh.vertex_count(); ++v) {
    if (!domain.on_curve(v)) continue;
    const auto place = curves.place(v, positions[v]);
    const auto beside = place ? curves.neighbours(v, *place, positions) : std::nullopt;
    if (!beside) continue;
    const double before = curves.deviation(v, beside->place_before, *place, positions[beside->before], positions[v]);
    const double after = curves.deviation(v, *place, beside->place_after, positions[v], positions[beside->after]);
    for (const Incidence& at : input.topology.star(v)) {
      const auto c = input.mesh.elements.corners(at.element);
      if (std::ranges::find(c, beside->before) != c.end()) raise(fit.deviation[at.element], before);
      if (std::ranges::find(c, beside->after) != c.end()) raise(fit.deviation[at.element], after);
    }
  }
  return fit;
}

}  // namespace

ElementFit element_fit(const InputMesh& input, const Domain& domain, PositionView positions, ThreadPool* pool) {
  return input.in_space() ? fit_in_space(input, domain, positions, pool) : fit_in_plane(input, domain, positions);
}

}  // namespace dmoscope
