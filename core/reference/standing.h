#pragma once
// Which vertices stay where they are, whatever a person fixes besides.

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/reference/kinds.h"

namespace dmoscope {

class Domain;

/// What becomes of the vertices of the boundary: they stay, or they slide along the boundary of the input.
enum class BoundaryRule : std::uint8_t { Fixed, Slide };
[[nodiscard]] std::string_view name(BoundaryRule rule) noexcept;  // "fixed"
/// Throws UsageError for an unknown word.
[[nodiscard]] BoundaryRule parse_boundary_rule(std::string_view word);

/// What becomes of the vertices of boundary layers (see InputMesh::layers): they stay, or they are as any other.
enum class LayerRule : std::uint8_t { Keep, Free };
[[nodiscard]] std::string_view name(LayerRule rule) noexcept;  // "keep"
/// Throws UsageError for an unknown word.
[[nodiscard]] LayerRule parse_layer_rule(std::string_view word);

struct StandingRule {
  InterfaceRule interfaces = InterfaceRule::Fixed;
  BoundaryRule boundary = BoundaryRule::Fixed;
  double corner_angle = 20.0;   // degrees: where the boundary, or a feature edge, turns by more, a vertex stays
  double feature_angle = 40.0;  // degrees: where the surface of a volume folds by more, it has a feature edge
  Kinds kinds{};                // what a person says against angles
  LayerRule layers = LayerRule::Free;
  [[nodiscard]] bool slides() const noexcept { return boundary == BoundaryRule::Slide || interfaces == InterfaceRule::Slide; }
  friend bool operator==(const StandingRule&, const StandingRule&) = default;
};

/// Does the rule let vertices slide, besides those of a curved surface? In a plane feature edges that a person names do so, too.
[[nodiscard]] bool lets_slide(const InputMesh& input, const StandingRule& rule);

/// 1 where a vertex may not move: of no element or, by the rule, of a boundary layer and, unless it slides, on the boundary or an
/// interface.
[[nodiscard]] std::vector<std::uint8_t> standing_vertices(const InputMesh& input, const StandingRule& rule);
/// The same; `domain`: domain_for() the rule.
[[nodiscard]] std::vector<std::uint8_t> standing_vertices(const InputMesh& input, const StandingRule& rule, const Domain* domain);

}  // namespace dmoscope
