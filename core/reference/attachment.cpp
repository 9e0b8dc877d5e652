#include "core/reference/attachment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace dmoscope {

namespace {

/// Greatest distance of a vertex from the reference, as a share of the reference's size.
constexpr double kBeside = 1e-2;
/// Greatest distance of a vertex from a corner or a line, as a share of the least height of its faces; also that of a line from the edge
/// along it, as a share of the edge's length.
constexpr double kReach = 0.25, kReachOfFit = 0.5;  // kReachOfFit: where vertices are drawn to it, halfway to the next row

std::array<Index, 2> edge_of(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) { return std::sqrt(nearest_point(std::array{a, b, b}, p).square); }

/// Facet tree of a single patch.
FacetTree tree_of(std::vector<std::array<Vec3, 3>> triangles) {
  const std::vector<Index> patch_of(triangles.size(), 0);
  return {std::move(triangles), patch_of};
}

}  // namespace

Attachment::Attachment(const InputMesh& input, const ElementTable& faces, const InputMesh& reference, std::shared_ptr<const Facets> facets,
                       const CurveEnds& ends, double fit)
    : input_(input),
      reference_(reference),
      facets_(std::move(facets)),
      fits_(fit > 0.0),
      beside_(fits_ ? fit : kBeside * reference.geometry.size),
      reach_(input.mesh.vertex_count(), 0.0),
      longest_(input.mesh.vertex_count(), 0.0),
      corner_(input.mesh.vertex_count(), 0),
      corner_points_(input.mesh.vertex_count(), kNoIndex),
      line_of_(input.mesh.vertex_count(), kNoIndex) {
  find_lines(ends);
  measure_faces(faces);
  find_corners(ends);
  find_standing();
  find_edges();
}

double Attachment::share() const { return fits_ ? kReachOfFit : kReach; }

/// Finds the feature lines of the reference; lines between two vertices that do not slide are lines of one edge.
void Attachment::find_lines(const CurveEnds& ends) {
  lines_ = chains(ends);
  Edge last{kNoIndex, kNoIndex};
  for (const FacetSide& side : facets_->sides()) {
    const Edge edge{side.low, side.high};
    if (edge != last && !ends.slides(side.low) && !ends.slides(side.high)) lines_.push_back({{side.low, side.high}, false});
    last = edge;
  }
}

void Attachment::measure_faces(const ElementTable& faces) {
  std::vector<double> height(reach_.size(), std::numeric_limits<double>::infinity());  // by vertex, least height of its faces
  for (Index f = 0; f < faces.size(); ++f) {
    const auto c = faces.corners(f);
    const auto at = [&](std::size_t i) { return input_.mesh.positions[c[i]]; };
    double longest = 0.0;
    for (std::size_t i = 0; i < c.size(); ++i) {
      const std::size_t next = i + 1 < c.size() ? i + 1 : 0;
      edges_.push_back(edge_of(c[i], c[next]));
      longest = std::max(longest, length(at(next) - at(i)));
    }
    const double area = length(c.size() == 3 ? cross(at(1) - at(0), at(2) - at(0)) : 0.5 * cross(at(2) - at(0), at(3) - at(1)));
    for (const Index v : c) {
      height[v] = std::min(height[v], longest > 0.0 ? area / longest : 0.0);
      longest_[v] = std::max(longest_[v], longest);
    }
  }
  std::ranges::sort(edges_);
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  for (Index v = 0; v < reach_.size(); ++v)
    if (height[v] < std::numeric_limits<double>::infinity()) reach_[v] = std::clamp(share() * height[v], 1e-7 * beside_, beside_);
}

void Attachment::find_corners(const CurveEnds& ends) {
  std::vector<Index> corners;
  std::vector<std::array<Vec3, 3>> points;
  for (Index v = 0; v < ends.size(); ++v) {
    if (ends.slides(v) || ends.off(v)) continue;
    const Vec3 p = reference_.mesh.positions[v];
    corners.push_back(v);
    points.push_back({p, p, p});
  }
  if (corners.empty()) return;
  const FacetTree tree = tree_of(std::move(points));
  std::map<Index, std::pair<double, Index>> nearest;  // by corner, squared distance of the nearest vertex, and the vertex
  for (Index v = 0; v < reach_.size(); ++v) {
    if (reach_[v] == 0.0) continue;
    const auto found = tree.nearest(input_.mesh.positions[v], 0);
    const double reach = fits_ ? beside_ : reach_[v];
    if (!(found.point.square <= reach * reach)) continue;
    const auto [at, is_new] = nearest.try_emplace(corners[found.triangle], found.point.square, v);
    if (!is_new) at->second = std::min(at->second, std::pair(found.point.square, v));
  }
  for (const auto& [corner, found] : nearest) corner_[found.second] = 1, corner_points_[found.second] = corner;
}

/// Finds the vertices on each line, with corners at its ends.
void Attachment::find_standing() {
  standing_.resize(lines_.size());
  std::vector<std::array<Vec3, 3>> segments;
  std::vector<std::pair<Index, std::size_t>> segment_of;
  std::multimap<Index, std::pair<Index, double>> ends_at;  // by corner, the lines that end there, with the place on them
  for (Index l = 0; l < lines_.size(); ++l) {
    const auto& points = lines_[l].points;
    const std::size_t count = points.size() - (lines_[l].closed ? 0 : 1);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 a = reference_.mesh.positions[points[i]], b = reference_.mesh.positions[points[(i + 1) % points.size()]];
      segments.push_back({a, b, b});
      segment_of.emplace_back(l, i);
    }
    ends_at.emplace(points.front(), std::pair(l, 0.0));
    if (!lines_[l].closed) ends_at.emplace(points.back(), std::pair(l, static_cast<double>(count)));
  }
  if (segments.empty()) return;
  const FacetTree tree = tree_of(std::move(segments));
  for (Index v = 0; v < reach_.size(); ++v) {
    if (reach_[v] == 0.0) continue;
    if (corner_[v] != 0) {
      const auto [first, last] = ends_at.equal_range(corner_points_[v]);
      for (auto at = first; at != last; ++at) standing_[at->second.first].push_back({at->second.second, v});
      continue;
    }
    const auto found = tree.nearest(input_.mesh.positions[v], 0);
    if (!(found.point.square <= reach_[v] * reach_[v])) continue;
    const auto [line, segment] = segment_of[found.triangle];
    line_of_[v] = line;
    standing_[line].push_back({static_cast<double>(segment) + found.point.weights[1] + found.point.weights[2], v});
  }
  for (auto& standing : standing_) std::ranges::sort(standing);
}

/// Whether the line between two places is near enough to the straight edge between them.
bool Attachment::runs_along(const FeatureLine& line, const Standing& from, const Standing& to) const {
  const Vec3 a = input_.mesh.positions[from.vertex], b = input_.mesh.positions[to.vertex];
  const double most = share() * length(b - a);
  const auto count = static_cast<double>(line.points.size());
  const double last = to.along > from.along ? to.along : to.along + count;
  for (double i = std::floor(from.along) + 1.0; i < last; i += 1.0)
    if (!(distance_to_segment(reference_.mesh.positions[line.points[static_cast<std::size_t>(std::fmod(i, count))]], a, b) <= most))
      return false;
  return true;
}

void Attachment::find_edges() {
  for (Index l = 0; l < lines_.size(); ++l) {
    const auto& standing = standing_[l];
    const std::size_t count = standing.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (i + 1 == count && (!lines_[l].closed || count < 3)) break;
      const Standing &from = standing[i], &to = standing[(i + 1) % count];
      const Edge edge = edge_of(from.vertex, to.vertex);
      if (std::ranges::binary_search(edges_, edge) && runs_along(lines_[l], from, to)) along_.push_back(edge);
    }
  }
  std::ranges::sort(along_);
}

bool Attachment::is_along(Index a, Index b) const { return std::ranges::binary_search(along_, edge_of(a, b)); }

Vec3 Attachment::middle_of(const ElementTable& faces, Index face) const {
  const auto c = faces.corners(face);
  Vec3 sum{};
  for (const Index v : c) sum = sum + input_.mesh.positions[v];
  return (1.0 / static_cast<double>(c.size())) * sum;
}

/// For each patch of the mesh, the patch of the reference over which most of its area lies. `near`: by face, the facet nearest to its
/// middle.
std::vector<Index> Attachment::patches_beneath(const ElementTable& faces, const Facets& own, std::span<const Index> near) const {
  std::map<std::pair<Index, Index>, double> areas;  // areas by patch of the mesh and patch of the reference
  for (Index f = 0; f < faces.size(); ++f)
    areas[{own.facets()[own.first_of(f)].patch, facets_->facets()[near[f]].patch}] += own.twice_area(own.first_of(f));
  std::vector<Index> beneath;
  std::vector<double> most;
  for (const auto& [patches, area] : areas) {
    const auto [patch, of_reference] = patches;
    if (beneath.size() <= patch) beneath.resize(patch + std::size_t{1}, of_reference), most.resize(patch + std::size_t{1}, -1.0);
    if (area > most[patch]) most[patch] = area, beneath[patch] = of_reference;
  }
  return beneath;
}

/// The nearest facet of a patch, if it is farther than the nearest facet of all by no more than `most`; else the latter.
FacetTree::Nearest Attachment::nearest_of(const FacetTree& all, Vec3 p, Index near, Index of_patch, double most) const {
  const FacetTree::Nearest nearest = all.nearest(p, near);
  const FacetTree::Nearest wanted = facets_->nearest(p, of_patch);
  return std::sqrt(wanted.point.square) <= std::sqrt(nearest.point.square) + most ? wanted : nearest;
}

OntoLines Attachment::take_lines() {
  OntoLines onto{std::move(lines_), std::move(line_of_), beside_};
  for (Index v = 0; v < corner_.size(); ++v)
    if (corner_[v] != 0) onto.corners.emplace_back(v, reference_.mesh.positions[corner_points_[v]]);
  return onto;
}

SlidingFaces Attachment::lay(ElementTable faces, const Facets& own, CurveEnds& ends) const {
  std::vector<std::array<Vec3, 3>> triangles;
  std::vector<Index> one_of(facets_->facets().size(), kNoIndex);  // by patch of the reference, one facet
  for (const Facet& facet : facets_->facets()) {
    one_of[facet.patch] = static_cast<Index>(triangles.size());
    triangles.push_back({facets_->point(facet.corners[0]), facets_->point(facet.corners[1]), facets_->point(facet.corners[2])});
  }
  const FacetTree all = tree_of(std::move(triangles));
  std::vector<Index> near;
  for (Index f = 0; f < faces.size(); ++f) near.push_back(all.nearest(middle_of(faces, f), near.empty() ? 0 : near.back()).triangle);
  const std::vector<Index> beneath = patches_beneath(faces, own, near);
  const auto patch_of = [&](Index f) { return own.facets()[own.first_of(f)].patch; };

  std::vector<double> alike(beneath.size(), 0.0);
  for (Index f = 0; f < faces.size(); ++f) {
    const auto c = faces.corners(f);
    near[f] = nearest_of(all, middle_of(faces, f), near[f], one_of[beneath[patch_of(f)]], kReach * longest_[c[0]]).triangle;
    const auto at = [&](std::size_t i) { return input_.mesh.positions[c[i]]; };
    const auto& facet = facets_->facets()[near[f]].corners;
    const Vec3 a = facets_->point(facet[0]);
    const Vec3 across = c.size() == 3 ? cross(at(1) - at(0), at(2) - at(0)) : cross(at(2) - at(0), at(3) - at(1));
    const Vec3 beneath_it = cross(facets_->point(facet[1]) - a, facets_->point(facet[2]) - a);
    const double size = length(beneath_it);
    if (size > 0.0) alike[patch_of(f)] += dot(across, beneath_it) / size;
  }
  for (Index f = 0; f < faces.size(); ++f)
    if (alike[patch_of(f)] < 0.0) faces.flip(f);

  SlidingFaces laid(input_, std::move(faces), facets_, std::move(near), beside_);
  const std::vector<Index> fan = own.whole_fans();
  for (Index v = 0; v < ends.size(); ++v) {
    if (!ends.off(v) || laid.at(v).empty() || fan[v] == kNoIndex) continue;
    const Index patch = beneath[own.facets()[fan[v]].patch];
    const Index beside = laid.beneath(laid.at(v).front()).first;
    const auto found = nearest_of(all, input_.mesh.positions[v], beside, one_of[patch], kReach * longest_[v]);
    if (found.point.square <= beside_ * beside_)
      laid.carry(v, found.triangle);
    else
      ends.hold(v, HeldOn::Unmatched);
  }
  return laid;
}

}  // namespace dmoscope
