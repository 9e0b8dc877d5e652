#pragma once
// Which vertices stay where they are, whatever a person fixes besides.

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "core/input/input_mesh.h"

namespace dmoscope {

class Curves;

/// What becomes of the vertices of the boundary: they stay, or they slide along the boundary of the input.
enum class BoundaryRule : std::uint8_t { Fixed, Slide };
[[nodiscard]] std::string_view name(BoundaryRule rule) noexcept;  // "fixed"
/// Throws UsageError for an unknown word.
[[nodiscard]] BoundaryRule parse_boundary_rule(std::string_view word);

struct StandingRule {
  InterfaceRule interfaces = InterfaceRule::Fixed;
  BoundaryRule boundary = BoundaryRule::Fixed;
  double corner_angle = 20.0;  // degrees: where the boundary turns by more, a vertex stays
  [[nodiscard]] bool slides() const noexcept { return boundary == BoundaryRule::Slide || interfaces == InterfaceRule::Slide; }
  friend bool operator==(const StandingRule&, const StandingRule&) = default;
};

/// The curves along which the rule lets vertices slide; null where it lets none, and for a mesh that is not planar.
[[nodiscard]] std::shared_ptr<const Curves> curves_for(const InputMesh& input, const StandingRule& rule);

/// 1 where a vertex may not move: of no element and, by the rule and unless it slides, on the boundary or on an interface.
[[nodiscard]] std::vector<std::uint8_t> standing_vertices(const InputMesh& input, const StandingRule& rule);
/// The same; `curves`: curves_for() the rule.
[[nodiscard]] std::vector<std::uint8_t> standing_vertices(const InputMesh& input, const StandingRule& rule, const Curves* curves);

}  // namespace dmoscope
