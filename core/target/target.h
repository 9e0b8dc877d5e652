#pragma once
// Target shapes: what the elements of a mesh are wished to be instead of ideal ones (Knupp's target-matrix paradigm). How they are written:
// the same way on the command line, in the command language and in saved sessions.

#include <string>
#include <string_view>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope {

/// What an element is wished to be.
struct TargetShape {
  enum class Kind {
    Ideal,
    Input,   // as it was in the input
    Field,   // of unit size in a metric tensor that the file has at the vertices
    Aspect,  // stretched along a direction
  };
  Kind kind = Kind::Ideal;
  int rounds = 0;  // Input: of averaging with the neighbours, against noise
  double tolerance =
      0.0;              // Input: percent by which its aspect may change until it counts as little as an inverted element; 0: as any other
  std::string field{};  // Field: its name; empty: the only one with tensors
  double aspect = 1.0;  // Aspect: length over width, at least 1
  Vec3 direction{1, 0, 0};  // Aspect: of the length; in the plane (cos, sin) of an angle
  double angle = 0.0;       // Aspect, in the plane: degrees from x
  bool planar = true;       // Aspect: given by the angle
  friend bool operator==(const TargetShape&, const TargetShape&) = default;
};

/// Of all elements, by the groups they are in.
struct Target {
  struct OfGroup {
    std::string group;  // its name, without quotation marks; "layers": also the boundary layers that are found
    TargetShape shape;
    friend bool operator==(const OfGroup&, const OfGroup&) = default;
  };
  std::vector<OfGroup> groups{};  // the first that an element is in counts
  TargetShape others{};
  [[nodiscard]] bool is_ideal() const noexcept { return groups.empty() && others.kind == TargetShape::Kind::Ideal; }
  friend bool operator==(const Target&, const Target&) = default;
};

/// Percent by which the aspect of an element that is kept may change, if nothing else is said.
inline constexpr double kKeptTolerance = 5.0, kLeastTolerance = 0.01;
inline constexpr std::string_view kLayersName = "layers";

/// "ideal", "input", "input:2", "field", "field:NAME", "aspect:R:DEGREES", "aspect:R:X:Y:Z"; of groups "NAME:SHAPE", joined by "+":
/// "layers:input:5%+wing:aspect:4:30".
[[nodiscard]] std::string to_text(const Target& target);
/// The reverse. Throws UsageError that says what is possible.
[[nodiscard]] Target parse_target(std::string_view text);
/// One line on how targets are written.
inline constexpr std::string_view kTargetHelp =
    "ideal, input, input:ROUNDS, field, field:NAME, aspect:RATIO:DEGREES or aspect:RATIO:X:Y:Z; for groups GROUP:SHAPE, joined by '+', "
    "such as "
    "layers:input";

}  // namespace dmoscope
