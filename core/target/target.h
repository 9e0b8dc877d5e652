#pragma once
// Target shapes of elements, instead of ideal ones (Knupp's target-matrix paradigm), and their notation, which is the same on the command
// line, in the command language and in saved sessions.

#include <string>
#include <string_view>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope {

/// Target shape of an element.
struct TargetShape {
  enum class Kind {
    Ideal,
    Input,   // the shape that the element has in the input
    Field,   // unit size in a metric tensor that the file has at the vertices
    Aspect,  // stretched along a direction
  };
  Kind kind = Kind::Ideal;
  int rounds = 0;  // Input: rounds of averaging with the neighbours, against noise
  double tolerance =
      0.0;              // Input: percent by which its aspect may change until it counts as little as an inverted element; 0: no such limit
  std::string field{};  // Field: name of the field; empty: the only one with tensors
  double aspect = 1.0;  // Aspect: length over width, at least 1
  Vec3 direction{1, 0, 0};  // Aspect: direction of the length; in the plane (cos, sin) of an angle
  double angle = 0.0;       // Aspect, in the plane: degrees from x
  bool planar = true;       // Aspect: whether it is given by the angle
  friend bool operator==(const TargetShape&, const TargetShape&) = default;
};

/// Target shapes of all elements, by the groups they are in.
struct Target {
  struct OfGroup {
    std::string group;  // name of the group, without quotation marks; "layers": also the boundary layers that are found
    TargetShape shape;
    friend bool operator==(const OfGroup&, const OfGroup&) = default;
  };
  std::vector<OfGroup> groups{};  // the first group that an element is in counts
  TargetShape others{};
  [[nodiscard]] bool is_ideal() const noexcept { return groups.empty() && others.kind == TargetShape::Kind::Ideal; }
  friend bool operator==(const Target&, const Target&) = default;
};

/// Default and least percent by which the aspect of an element that is kept may change.
inline constexpr double kKeptTolerance = 5.0, kLeastTolerance = 0.01;
inline constexpr std::string_view kLayersName = "layers";

/// Notation: "ideal", "input", "input:2", "field", "field:NAME", "aspect:R:DEGREES", "aspect:R:X:Y:Z"; for groups "NAME:SHAPE", joined by
/// "+": "layers:input:5%+wing:aspect:4:30".
[[nodiscard]] std::string to_text(const Target& target);
/// Reads the notation of to_text(). Throws UsageError that says what is possible.
[[nodiscard]] Target parse_target(std::string_view text);
/// Help on the notation of targets, one line.
inline constexpr std::string_view kTargetHelp =
    "ideal, input, input:ROUNDS, field, field:NAME, aspect:RATIO:DEGREES or aspect:RATIO:X:Y:Z; for groups GROUP:SHAPE, joined by '+', "
    "such as "
    "layers:input";

}  // namespace dmoscope
