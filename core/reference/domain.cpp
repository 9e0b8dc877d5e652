#include "core/reference/domain.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/base/number_text.h"
#include "core/base/rounding.h"
#include "core/reference/hold.h"
#include "core/reference/planar_ends.h"
#include "core/reference/surface_ends.h"

namespace dmoscope {

Domain::Domain(const InputMesh& input, const StandingRule& rule)
    : Domain(input, rule, input.geometry.shape == Shape::Planar ? SurfaceEnds{planar_ends(input, rule), {}} : surface_ends(input, rule)) {}

Domain::Domain(const InputMesh& input, const StandingRule& rule, SurfaceEnds ends)
    : curves_(ends.onto ? Curves(input, ends.curves, *ends.onto) : Curves(input, ends.curves)),
      faces_(std::move(ends.faces)),
      surface_(ends.onto ? input.surface->mesh.name : ""),
      is_surface_(input.is_surface()),
      single_precision_(input.mesh.single_precision) {
  curves_.for_segments([this](Index curve, std::size_t segment, Index from, Index to) {
    segments_.push_back({std::min(from, to), std::max(from, to), curve, static_cast<Index>(segment)});
  });
  std::ranges::sort(segments_);
  said_in_plane_ = input.geometry.shape == Shape::Planar && !rule.kinds.features.empty();
  if (said_in_plane_) feature_edges_ = rule.kinds.features;
  find_feature_edges();
  held_.reserve(ends.curves.size());
  for (Index v = 0; v < ends.curves.size(); ++v) {
    const bool of_surface = faces_.any() && !faces_.at(v).empty() && !slides(v);
    held_.push_back(of_surface && ends.curves.off(v) ? HeldOn::Touching : slides(v) ? HeldOn::Nothing : ends.curves.why(v));
    const bool on_boundary = input.topology.boundary()[v] != 0;
    sliding_ += slides(v) ? 1 : 0;
    on_curves_ += on_curve(v) ? 1 : 0;
    inside_ += slides(v) && !on_boundary ? 1 : 0;
    corners_ += rule.boundary == BoundaryRule::Slide && on_boundary && !slides(v) ? 1 : 0;
  }
  if (ends.onto) corner_points_ = std::move(ends.onto->corners);
  take_pairs(input);
}

std::optional<Vec3> Domain::corner(Index vertex) const {
  const auto found = std::ranges::lower_bound(corner_points_, vertex, {}, &std::pair<Index, Vec3>::first);
  return found != corner_points_.end() && found->first == vertex ? std::optional(found->second) : std::nullopt;
}

void Domain::take_pairs(const InputMesh& input) {
  pairs_ = partners_of(input);
  std::erase_if(pairs_, [this](const Partners& pair) { return !slides(pair.first) || !slides(pair.second); });
  if (pairs_.empty()) return;
  pair_at_.assign(held_.size(), kNoIndex);
  followers_.assign(held_.size(), kNoIndex);
  for (Index i = 0; i < pairs_.size(); ++i) {
    pair_at_[pairs_[i].first] = pair_at_[pairs_[i].second] = i;
    followers_[pairs_[i].first] = pairs_[i].second;
  }
}

Vec3 Domain::place_of_follower(Index vertex, Vec3 place) const {
  const Vec3 shift = pairs_[pair_at_[vertex]].shift;
  if (shift == Vec3{}) return place;
  const Vec3 there = place + shift;
  return single_precision_ ? Vec3{nearest_float(there.x), nearest_float(there.y), nearest_float(there.z)} : there;
}

bool Domain::is_within(std::span<const Curves::Stretch> stretches, Index a, Index b) const {
  const Segment edge{std::min(a, b), std::max(a, b), 0, 0};
  const auto found = std::ranges::lower_bound(segments_, edge);
  if (found == segments_.end() || found->low != edge.low || found->high != edge.high) return false;
  return std::ranges::any_of(stretches,
                             [&](const auto& stretch) { return stretch.curve == found->curve && stretch.holds(found->segment); });
}

void Domain::find_feature_edges() {
  auto& edges = feature_edges_;
  curves_.for_edges([&edges](Index a, Index b) { edges.push_back(edge_ends(a, b)); });
  if (faces_.any() && faces_.are_own())
    for (const FacetSide& side : faces_.facets().sides()) edges.push_back({side.low, side.high});
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

bool Domain::is_feature(Index a, Index b) const { return std::ranges::binary_search(feature_edges_, edge_ends(a, b)); }

std::string_view Domain::why_held(Index vertex) const {
  constexpr std::array<std::string_view, 10> kWhy{
      {"", "it is a corner: the boundary or feature edge turns there by more than the corner angle", "feature edges meet there",
       "a feature edge ends there", "parts of the mesh touch there, or cannot be wound alike", "the file gives it a meaning",
       "what it lies on stays", "the surface to slide on is too far away, or has no feature edge there", "it was made a corner by hand",
       "it belongs to another vertex, from which it would part"}};
  return kWhy[static_cast<std::size_t>(held_[vertex])];
}

std::string Domain::sentence() const {
  const auto slide = [](Index n) { return fmt::format("{} {}", counted(n, "vertex", "vertices"), n == 1 ? "slides" : "slide"); };
  std::string text;
  if (sliding_ > inside_ || corners_ > 0)
    text = fmt::format("{} along the boundary, and {} of its vertices {}", slide(sliding_ - inside_), grouped(corners_),
                       corners_ == 1 ? "stays" : "stay");
  if (inside_ > 0 || text.empty())
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", slide(inside_),
                        is_surface_      ? "on the surface"
                        : said_in_plane_ ? "along interfaces and feature edges"
                                         : "along interfaces");
  if (faces_.any() && on_curves_ > 0) text += fmt::format(" ({} on feature edges)", grouped(on_curves_));
  Index held = 0, unmatched = 0, tied = 0;
  for (Index v = 0; v < held_.size(); ++v) {
    held += is_held(v) ? 1 : 0;
    unmatched += held_[v] == HeldOn::Unmatched ? 1 : 0;
    tied += held_[v] == HeldOn::Tied ? 1 : 0;
  }
  if (is_surface_ && held > unmatched + tied)
    text += fmt::format("; corners and ends of feature edges hold {}", grouped(held - unmatched - tied));
  if (unmatched > 0)
    text += fmt::format("; {} {}, for {} is too far away, or has no feature edge there", counted(unmatched, "vertex", "vertices"),
                        unmatched == 1 ? "stays" : "stay", surface_);
  if (!pairs_.empty())
    text += fmt::format("; {} of doubled or periodic vertices {} together", counted(static_cast<Index>(pairs_.size()), "pair", "pairs"),
                        pairs_.size() == 1 ? "moves" : "move");
  if (tied > 0)
    text += fmt::format("; {} {}, for each belongs to another one, from which it would part (periodic, at a seam, or one cell thick)",
                        counted(tied, "vertex", "vertices"), tied == 1 ? "stays" : "stay");
  return text;
}

std::shared_ptr<const Domain> domain_for(const InputMesh& input, const StandingRule& rule) {
  require_there(input, rule.kinds);
  if (!lets_slide(input, rule) && !input.is_surface()) return nullptr;
  return std::make_shared<const Domain>(input, rule);
}

}  // namespace dmoscope
