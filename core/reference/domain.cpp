#include "core/reference/domain.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/number_text.h"
#include "core/reference/planar_ends.h"
#include "core/reference/surface_ends.h"

namespace dmoscope {

Domain::Domain(const InputMesh& input, const StandingRule& rule)
    : Domain(input, rule, input.geometry.shape == Shape::Planar ? SurfaceEnds{planar_ends(input, rule), {}} : surface_ends(input, rule)) {}

Domain::Domain(const InputMesh& input, const StandingRule& rule, SurfaceEnds ends)
    : curves_(input, ends.curves), facets_(std::move(ends.facets)) {
  curves_.for_segments([this](Index curve, std::size_t segment, Index from, Index to) {
    segments_.push_back({std::min(from, to), std::max(from, to), curve, static_cast<Index>(segment)});
  });
  std::ranges::sort(segments_);
  if (facets_.any()) {
    std::vector<std::uint8_t> may(ends.curves.size());
    for (Index v = 0; v < may.size(); ++v) may[v] = ends.curves.off(v) ? 1 : 0;
    facets_.carry(may);
  }
  for (Index v = 0; v < ends.curves.size(); ++v) {
    const bool on_boundary = input.topology.boundary()[v] != 0;
    sliding_ += slides(v) ? 1 : 0;
    on_curves_ += on_curve(v) ? 1 : 0;
    inside_ += slides(v) && !on_boundary ? 1 : 0;
    corners_ += rule.boundary == BoundaryRule::Slide && on_boundary && !slides(v) ? 1 : 0;
  }
}

bool Domain::is_within(std::span<const Curves::Stretch> stretches, Index a, Index b) const {
  const Segment edge{std::min(a, b), std::max(a, b), 0, 0};
  const auto found = std::ranges::lower_bound(segments_, edge);
  if (found == segments_.end() || found->low != edge.low || found->high != edge.high) return false;
  return std::ranges::any_of(stretches,
                             [&](const auto& stretch) { return stretch.curve == found->curve && stretch.holds(found->segment); });
}

std::string Domain::sentence() const {
  const auto slide = [](Index n) { return fmt::format("{} {}", counted(n, "vertex", "vertices"), n == 1 ? "slides" : "slide"); };
  std::string text;
  if (sliding_ > inside_ || corners_ > 0)
    text = fmt::format("{} along the boundary, and {} of its vertices {}", slide(sliding_ - inside_), grouped(corners_),
                       corners_ == 1 ? "stays" : "stay");
  if (inside_ > 0 || text.empty()) text += fmt::format("{}{} along interfaces", text.empty() ? "" : "; ", slide(inside_));
  if (facets_.any() && on_curves_ > 0) text += fmt::format(" ({} on feature edges)", grouped(on_curves_));
  return text;
}

std::shared_ptr<const Domain> domain_for(const InputMesh& input, const StandingRule& rule) {
  if (!rule.slides() && !input.is_surface()) return nullptr;
  return std::make_shared<const Domain>(input, rule);
}

}  // namespace dmoscope
