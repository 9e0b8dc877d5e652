#include "core/reference/standing.h"

#include <array>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/reference/domain.h"

namespace dmoscope {

namespace {
constexpr std::array<std::string_view, 2> kBoundaryRules{"fixed", "slide"}, kLayerRules{"keep", "free"};  // words in enum order
}

std::string_view name(BoundaryRule rule) noexcept { return kBoundaryRules[static_cast<std::size_t>(rule)]; }
BoundaryRule parse_boundary_rule(std::string_view word) {
  return parse_choice<BoundaryRule>("rule for the boundary", word, kBoundaryRules);
}

std::string_view name(LayerRule rule) noexcept { return kLayerRules[static_cast<std::size_t>(rule)]; }
LayerRule parse_layer_rule(std::string_view word) { return parse_choice<LayerRule>("rule for boundary layers", word, kLayerRules); }

bool lets_slide(const InputMesh& input, const StandingRule& rule) {
  return rule.slides() || (input.geometry.shape == Shape::Planar && !rule.kinds.features.empty());
}

std::vector<std::uint8_t> standing_vertices(const InputMesh& input, const StandingRule& rule, const Domain* domain) {
  const auto boundary = input.topology.boundary();
  std::vector<std::uint8_t> standing(boundary.begin(), boundary.end());
  for (Index v = 0; v < standing.size(); ++v) {
    if (input.topology.star(v).empty() || (rule.interfaces != InterfaceRule::Free && input.interfaces.holds(v))) standing[v] = 1;
    if (domain != nullptr && domain->slides(v))
      standing[v] = 0;
    else if (input.is_surface())
      standing[v] = 1;
  }
  if (rule.layers == LayerRule::Keep)
    for (const Index v : input.layers) standing[v] = 1;
  // Fixes the ends of feature edges that the user named inside a plane, which would be free otherwise.
  if (domain == nullptr || input.geometry.shape != Shape::Planar) return standing;
  for (const auto& edge : rule.kinds.features)
    for (const Index v : edge)
      if (!domain->slides(v)) standing[v] = 1;
  return standing;
}

std::vector<std::uint8_t> standing_vertices(const InputMesh& input, const StandingRule& rule) {
  return standing_vertices(input, rule, domain_for(input, rule).get());
}

}  // namespace dmoscope
