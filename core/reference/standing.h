#pragma once
// Vertices that stay by rule, without those that the user fixes besides.

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/reference/kinds.h"

namespace dmoscope {

class Domain;

/// Treatment of the vertices of the boundary: they stay, or they slide along the boundary of the input.
enum class BoundaryRule : std::uint8_t { Fixed, Slide };
[[nodiscard]] std::string_view name(BoundaryRule rule) noexcept;  // word of a rule, such as "fixed"
/// Parses "fixed" or "slide". Throws UsageError for an unknown word.
[[nodiscard]] BoundaryRule parse_boundary_rule(std::string_view word);

/// Treatment of the vertices of boundary layers (see InputMesh::layers): they stay, or they are like any other.
enum class LayerRule : std::uint8_t { Keep, Free };
[[nodiscard]] std::string_view name(LayerRule rule) noexcept;  // word of a rule, such as "keep"
/// Parses "keep" or "free". Throws UsageError for an unknown word.
[[nodiscard]] LayerRule parse_layer_rule(std::string_view word);

struct StandingRule {
  InterfaceRule interfaces = InterfaceRule::Fixed;
  BoundaryRule boundary = BoundaryRule::Fixed;
  double corner_angle = 20.0;   // degrees; a vertex stays if the boundary, or a feature edge, turns there by more
  double feature_angle = 40.0;  // degrees; an edge is a feature edge if the surface of a volume mesh folds there by more
  Kinds kinds{};                // kinds by hand, which override angles
  LayerRule layers = LayerRule::Free;
  double fit = 0.0;  // mesh units; vertices so near the surface of another mesh belong to it and are drawn to it; 0: not drawn
  [[nodiscard]] bool slides() const noexcept { return boundary == BoundaryRule::Slide || interfaces == InterfaceRule::Slide; }
  friend bool operator==(const StandingRule&, const StandingRule&) = default;
};

/// Whether the rule lets vertices slide, besides those of a curved surface. In a plane also along feature edges by hand.
[[nodiscard]] bool lets_slide(const InputMesh& input, const StandingRule& rule);

/// Whether each vertex is fixed (1): vertices of no element, those of boundary layers that are kept, and those on the boundary or an
/// interface that do not slide.
[[nodiscard]] std::vector<std::uint8_t> standing_vertices(const InputMesh& input, const StandingRule& rule);
/// Whether each vertex is fixed (1), see above; `domain`: domain_for() the rule.
[[nodiscard]] std::vector<std::uint8_t> standing_vertices(const InputMesh& input, const StandingRule& rule, const Domain* domain);

}  // namespace dmoscope
