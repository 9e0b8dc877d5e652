#include "core/reference/kind_facts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/mesh/edges.h"
#include "core/reference/hold.h"

namespace dmoscope {

namespace {

constexpr std::string_view kAsleep = "nothing slides there now: it counts from 'boundary slide' or 'interfaces slide' on";

bool between_materials(const InputMesh& input, Index v) {
  const auto star = input.topology.star(v);
  return std::ranges::any_of(star, [&](const Incidence& at) { return input.interfaces.between(star[0].element, at.element); });
}

/// Whether a vertex slides under some rule for boundary and interfaces.
bool could_slide(const InputMesh& input, Index v) {
  if (input.topology.star(v).empty()) return false;
  return input.is_surface() || input.topology.boundary()[v] != 0 || between_materials(input, v);
}

/// The faces at an edge, and whether each runs it from a to b.
std::vector<std::pair<Index, bool>> faces_at_edge(const SlidingFaces& faces, Index a, Index b) {
  std::vector<std::pair<Index, bool>> found;
  if (!faces.any()) return found;
  for (const Index f : faces.at(a)) {
    const auto c = faces.table().corners(f);
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Index next = c[i + 1 < c.size() ? i + 1 : 0];
      if (c[i] == a && next == b) found.emplace_back(f, true);
      if (c[i] == b && next == a) found.emplace_back(f, false);
    }
  }
  return found;
}

Vec3 normal_of(const InputMesh& input, const SlidingFaces& faces, Index face) {
  const auto c = faces.table().corners(face);
  const auto at = [&](std::size_t i) { return input.mesh.positions[c[i]]; };
  return c.size() == 3 ? cross(at(1) - at(0), at(2) - at(0)) : cross(at(2) - at(0), at(3) - at(1));
}

/// Number of elements at an edge of a planar mesh, and whether the edge parts materials.
std::pair<std::size_t, bool> sides_in_plane(const InputMesh& input, Index a, Index b) {
  std::pair<std::size_t, bool> found{0, false};
  EdgeFinder(input.mesh, input.topology).around(a, b, [&](Index other, std::span<const EdgeSide> sides) {
    if (other == b) found = {sides.size(), sides.size() == 2 && input.interfaces.between(sides[0].element, sides[1].element)};
  });
  return found;
}

EdgeKind kind_in_plane(const InputMesh& input, const StandingRule& rule, const Domain& domain, Index a, Index b) {
  const auto [sides, parts] = sides_in_plane(input, a, b);
  if (sides == 0) return EdgeKind::Off;
  if (sides == 1) return EdgeKind::Border;
  if (sides > 2) return EdgeKind::Touching;
  if (parts && rule.interfaces != InterfaceRule::Free) return EdgeKind::File;
  return domain.is_feature(a, b) ? EdgeKind::Hand : EdgeKind::Smooth;
}

class UnmetFinder {
 public:
  UnmetFinder(const InputMesh& input, const StandingRule& rule, const Domain* domain) : input_(input), rule_(rule), domain_(domain) {}

  std::vector<Unmet> find(const Kinds& said) {
    for (const Index v : said.corners) vertex(v, true);
    for (const Index v : said.no_corners) vertex(v, false);
    for (const EdgeEnds& edge : said.features) this->edge(edge, true);
    for (const EdgeEnds& edge : said.no_features) this->edge(edge, false);
    return std::move(found_);
  }

 private:
  void vertex(Index v, bool corner) {
    const HeldOn held = domain_ != nullptr ? domain_->held_on(v) : HeldOn::Nothing;
    const bool slides = domain_ != nullptr && domain_->slides(v);
    if (slides || (corner && held != HeldOn::Nothing)) return;
    if (!could_slide(input_, v) && held == HeldOn::Nothing) {
      const char* what = corner ? "; 'fix' keeps it" : "";
      found_.push_back({fmt::format("vertex {} lies on no boundary, interface or surface{}", v, what), true});
    } else if (held == HeldOn::Nothing) {
      found_.push_back({fmt::format("vertex {}: {}", v, kAsleep), false});
    } else if (held == HeldOn::Corner && input_.surface) {
      found_.push_back({fmt::format("vertex {} stays: the surface that it slides on has a corner there", v), true});
    } else if (held == HeldOn::Corner) {
      found_.push_back({fmt::format("vertex {} stays: its curve has no direction there", v), true});
    } else {
      found_.push_back({fmt::format("vertex {} stays: {}", v, domain_->why_held(v)), held != HeldOn::Rule});
    }
  }

  void edge(const EdgeEnds& edge, bool feature) {
    const auto [a, b] = edge;
    const bool planar = input_.geometry.shape == Shape::Planar;
    const EdgeKind kind = domain_ != nullptr ? edge_kind(input_, rule_, *domain_, a, b) : planar ? EdgeKind::Smooth : EdgeKind::Off;
    if (kind == EdgeKind::Off) {
      const bool could = could_slide(input_, a) && could_slide(input_, b);
      found_.push_back(
          {could ? fmt::format("edge {}-{}: {}", a, b, kAsleep) : fmt::format("edge {}-{} lies on no boundary, interface or surface", a, b),
           !could});
    } else if (feature && input_.surface && !is_feature(kind)) {
      found_.push_back({fmt::format("edge {}-{}: feature edges are those of the surface that the mesh slides on", a, b), true});
    } else if (!feature && is_feature(kind)) {
      found_.push_back({fmt::format("edge {}-{} stays a feature: {}", a, b, phrase(kind)), true});
    }
  }

  const InputMesh& input_;
  const StandingRule& rule_;
  const Domain* domain_;
  std::vector<Unmet> found_;
};

}  // namespace

std::string_view phrase(EdgeKind kind) noexcept {
  constexpr std::array<std::string_view, 8> kPhrases{
      {"", "", "the surface folds there", "it was made one by hand", "the file names it, or parts materials there", "the mesh ends there",
       "other than two faces meet there, or they cannot be wound alike", "the surface that it slides on has one there"}};
  return kPhrases[static_cast<std::size_t>(kind)];
}

std::optional<double> fold_of(const InputMesh& input, const Domain& domain, Index a, Index b) {
  const auto faces = faces_at_edge(domain.faces(), a, b);
  if (faces.size() != 2) return std::nullopt;
  const Vec3 one = normal_of(input, domain.faces(), faces[0].first), other = normal_of(input, domain.faces(), faces[1].first);
  return std::atan2(length(cross(one, other)), dot(one, other)) / kDegree;
}

EdgeKind edge_kind(const InputMesh& input, const StandingRule& rule, const Domain& domain, Index a, Index b) {
  const EdgeEnds edge = edge_ends(a, b);
  if (input.geometry.shape == Shape::Planar) return kind_in_plane(input, rule, domain, edge[0], edge[1]);
  const auto faces = faces_at_edge(domain.faces(), a, b);
  if (faces.empty()) return EdgeKind::Off;
  if (!domain.is_feature(a, b)) return EdgeKind::Smooth;
  if (faces.size() == 1) return EdgeKind::Border;
  const Vec3 one = normal_of(input, domain.faces(), faces[0].first), other = normal_of(input, domain.faces(), faces[1].first);
  const bool odd = faces.size() > 2 || faces[0].second == faces[1].second || one == Vec3{} || other == Vec3{};
  if (odd) return EdgeKind::Touching;
  if (input.surface) return EdgeKind::Reference;
  if (rule.kinds.has_feature(edge)) return EdgeKind::Hand;
  const bool folds = !(*fold_of(input, domain, a, b) <= rule.feature_angle) && !rule.kinds.has_no_feature(edge);
  return folds ? EdgeKind::Angle : EdgeKind::File;
}

std::vector<Unmet> unmet(const InputMesh& input, const StandingRule& rule, const Domain* domain, const Kinds& said) {
  return UnmetFinder(input, rule, domain).find(said);
}

std::string sentence(const std::vector<Unmet>& all) {
  if (all.empty()) return {};
  return all.size() == 1 ? all.front().what : fmt::format("{} (and {} more like this)", all.front().what, all.size() - 1);
}

std::string require_met(const InputMesh& input, const StandingRule& rule, const Domain* domain, const Kinds& said) {
  const std::vector<Unmet> not_met = unmet(input, rule, domain, said);
  const bool in_vain = !not_met.empty() && not_met.size() == said.size() && std::ranges::all_of(not_met, &Unmet::for_good);
  if (in_vain) throw UsageError(sentence(not_met));
  return sentence(not_met);
}

}  // namespace dmoscope
