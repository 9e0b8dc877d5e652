#include "core/reference/facets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/reference/facet_walk.h"

namespace dmoscope {

namespace {

Vec3 unit(Vec3 a) {
  const double l = length(a);
  return l > 0.0 ? (1.0 / l) * a : Vec3{};
}

std::size_t next(std::size_t corner) { return corner == 2 ? 0 : corner + 1; }

}  // namespace

Facets::Facets(const Mesh& mesh, const ElementTable& faces, std::span<const Index> links) : points_(mesh.positions) {
  split(faces, links);
  facets_at_.assign(mesh.vertex_count(), 0);
  for (const Facet& facet : facets_)
    for (const Index v : facet.corners) ++facets_at_[v];
  find_patches();
  find_normals();
  find_sides();
  for (const Facet& facet : facets_) {
    const Vec3 a = points_[facet.corners[0]];
    twice_areas_.push_back(length(cross(points_[facet.corners[1]] - a, points_[facet.corners[2]] - a)));
  }
  std::vector<std::array<Vec3, 3>> triangles;
  std::vector<Index> patch_of;
  for (const Facet& facet : facets_) {
    triangles.push_back({points_[facet.corners[0]], points_[facet.corners[1]], points_[facet.corners[2]]});
    patch_of.push_back(facet.patch);
  }
  tree_ = FacetTree(std::move(triangles), patch_of);
}

void Facets::split(const ElementTable& faces, std::span<const Index> links) {
  struct Side {
    Index facet, corner;
  };
  std::vector<Side> side_of(faces.all_corners().size());  // by corner, the side whose edge leaves from it
  for (Index f = 0; f < faces.size(); ++f) {
    const auto c = faces.corners(f);
    const Index first = faces.offsets()[f], number = static_cast<Index>(facets_.size());
    first_of_.push_back(number);
    const auto add = [&](std::array<Index, 3> local) {
      facets_.push_back({{c[local[0]], c[local[1]], c[local[2]]}, {kNoIndex, kNoIndex, kNoIndex}});
    };
    if (c.size() == 3) {
      add({0, 1, 2});
      for (Index i = 0; i < 3; ++i) side_of[first + i] = {number, (i + 2) % 3};
      continue;
    }
    const Vec3 one = points_[c[2]] - points_[c[0]], other = points_[c[3]] - points_[c[1]];
    if (dot(one, one) <= dot(other, other)) {
      add({0, 1, 2}), add({0, 2, 3});
      facets_[number].across[1] = number + 1, facets_[number + 1].across[2] = number;
      side_of[first] = {number, 2}, side_of[first + 1] = {number, 0};
      side_of[first + 2] = {number + 1, 0}, side_of[first + 3] = {number + 1, 1};
    } else {
      add({0, 1, 3}), add({1, 2, 3});
      facets_[number].across[0] = number + 1, facets_[number + 1].across[1] = number;
      side_of[first] = {number, 2}, side_of[first + 3] = {number, 1};
      side_of[first + 1] = {number + 1, 2}, side_of[first + 2] = {number + 1, 0};
    }
  }
  for (std::size_t i = 0; i < links.size(); ++i)
    if (links[i] != kNoIndex) facets_[side_of[i].facet].across[side_of[i].corner] = side_of[links[i]].facet;
}

void Facets::find_patches() {
  Index patches = 0;
  std::vector<Index> waiting;
  for (Index start = 0; start < facets_.size(); ++start) {
    if (facets_[start].patch != kNoIndex) continue;
    facets_[start].patch = patches;
    waiting.push_back(start);
    while (!waiting.empty()) {
      const Index f = waiting.back();
      waiting.pop_back();
      for (const Index g : facets_[f].across) {
        if (g == kNoIndex || facets_[g].patch != kNoIndex) continue;
        facets_[g].patch = patches;
        waiting.push_back(g);
      }
    }
    ++patches;
  }
}

std::vector<Index> Facets::fan_at(Index facet, Index vertex) const {
  std::vector<Index> found{facet};
  bool around = false;
  for (const std::size_t way : {std::size_t{1}, std::size_t{2}}) {
    // Limits the steps: at a face with a repeated corner the way may lead round without coming back.
    for (Index f = facet; !around && found.size() <= facets_at_[vertex];) {
      const auto at = static_cast<std::size_t>(std::ranges::find(facets_[f].corners, vertex) - facets_[f].corners.begin());
      f = facets_[f].across[(at + way) % 3];
      around = f == facet;
      if (around || f == kNoIndex) break;
      found.push_back(f);
    }
  }
  std::ranges::sort(found);
  return found;
}

void Facets::find_normals() {
  normals_.resize(facets_.size());
  covers_once_.resize(facets_.size());
  const auto weighted = [this](Index f, Index vertex) {
    const auto& c = facets_[f].corners;
    const auto at = static_cast<std::size_t>(std::ranges::find(c, vertex) - c.begin());
    const Vec3 a = points_[c[next(at)]] - points_[vertex], b = points_[c[next(next(at))]] - points_[vertex], across = cross(a, b);
    return std::atan2(length(across), dot(a, b)) * unit(across);
  };
  std::vector<std::array<bool, 3>> known(facets_.size());
  for (Index f = 0; f < facets_.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (known[f][i]) continue;
      const Index vertex = facets_[f].corners[i];
      const std::vector<Index> around = fan_at(f, vertex);
      Vec3 sum;
      for (const Index g : around) sum = sum + weighted(g, vertex);
      const bool once = go_round_once(around, vertex, unit(sum));
      for (const Index g : around)
        for (std::size_t k = 0; k < 3; ++k)
          if (facets_[g].corners[k] == vertex) {
            normals_[g][k] = unit(sum), known[g][k] = true;
            covers_once_[g][k] = once;
          }
    }
  }
}

/// Whether the facets around a vertex go round it once, seen from the tip of a normal.
bool Facets::go_round_once(std::span<const Index> around, Index vertex, Vec3 normal) const {
  if (normal == Vec3{}) return false;
  const Plane plane = tangent_plane(normal);
  double angle = 0.0;
  for (const Index g : around) {
    const auto& c = facets_[g].corners;
    const auto at = static_cast<std::size_t>(std::ranges::find(c, vertex) - c.begin());
    const Vec2<double> a = plane.project(points_[c[next(at)]] - points_[vertex]),
                       b = plane.project(points_[c[next(next(at))]] - points_[vertex]);
    if (!(cross(a, b) > 0.0)) return false;
    angle += std::atan2(cross(a, b), dot(a, b));
  }
  return angle < 1.5 * 2.0 * std::numbers::pi;
}

void Facets::find_sides() {
  for (Index f = 0; f < facets_.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (facets_[f].across[i] != kNoIndex) continue;
      const Index a = facets_[f].corners[next(i)], b = facets_[f].corners[next(next(i))];
      sides_.push_back({std::min(a, b), std::max(a, b), f, static_cast<Index>(i)});
    }
  }
  std::ranges::sort(sides_);
}

std::span<const FacetSide> Facets::sides_of(Index a, Index b) const {
  const Index low = std::min(a, b), high = std::max(a, b);
  const auto first = std::lower_bound(sides_.begin(), sides_.end(), FacetSide{low, high, 0, 0});
  const auto last = std::upper_bound(first, sides_.end(), FacetSide{low, high, kNoIndex, kNoIndex});
  return {first, last};
}

std::vector<Index> Facets::whole_fans() const {
  std::vector<Index> one(facets_at_.size(), kNoIndex);
  for (Index f = 0; f < facets_.size(); ++f)
    for (const Index v : facets_[f].corners) one[v] = f;
  for (Index v = 0; v < one.size(); ++v)
    if (one[v] != kNoIndex && fan_at(one[v], v).size() != facets_at_[v]) one[v] = kNoIndex;
  return one;
}

Vec3 Facets::at(const FacetPlace& place) const {
  const auto& c = facets_[place.facet].corners;
  for (std::size_t i = 0; i < 3; ++i)
    if (place.weights[i] == 1.0) return points_[c[i]];
  const Vec3 a = points_[c[0]];
  return a + place.weights[1] * (points_[c[1]] - a) + place.weights[2] * (points_[c[2]] - a);  // keeps shared coordinates exactly
}

Vec3 Facets::normal(const FacetPlace& place) const {
  const auto& n = normals_[place.facet];
  return unit(place.weights[0] * n[0] + place.weights[1] * n[1] + place.weights[2] * n[2]);
}

std::array<Vec2<double>, 3> Facets::from_above(Index facet, const Plane& plane, Vec3 origin) const {
  std::array<Vec2<double>, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = plane.project(points_[facets_[facet].corners[i]] - origin);
  return corners;
}

std::optional<FacetPlace> Facets::walk(Index facet, const Plane& plane, Vec3 origin, Vec2<double> target, double least_cosine) const {
  return walk_facets(*this, facet, target, least_cosine, [&](Index f) { return from_above(f, plane, origin); });
}

}  // namespace dmoscope
