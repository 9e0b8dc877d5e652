#pragma once
// Colouring of elements, choice of those that count, and labels on them, as plain data.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "render/shading.h"
#include "ui/state/panes.h"

namespace dmoscope::ui {

/// Choice of the range of the quality's colours. Input: the input's, rounded outwards, which stays through a run; Fixed: 0 to 1; Auto:
/// minimum and maximum of the shown qualities; Expanding: minimum and maximum of all qualities shown since the input was opened;
/// Percentile: between two percentiles of the input, rounded outwards; Given: two numbers.
enum class RangeMode { Input, Fixed, Auto, Expanding, Percentile, Given };
struct RangeModeInfo {
  RangeMode mode;
  std::string_view name, title, doc;
};
inline constexpr std::array<RangeModeInfo, 6> kRangeModes{{
    {RangeMode::Input, "input", "the input's",
     "from the worst valid element of the input to the best one, or to 95 % of them where the others lie far above, rounded; stays the "
     "same during a run"},
    {RangeMode::Fixed, "fixed", "0 to 1", "from 0, degenerate, to 1, ideal"},
    {RangeMode::Auto, "auto", "the mesh's own", "from the worst to the best element of the current mesh"},
    {RangeMode::Expanding, "expanding", "growing", "all qualities since the mesh was opened; never shrinks"},
    {RangeMode::Percentile, "percentile", "percentiles", "without the extremes of the input, rounded; stays the same during a run"},
    {RangeMode::Given, "given", "given", "two numbers; the ends of the colour bar can be dragged"},
}};
[[nodiscard]] constexpr const RangeModeInfo& info(RangeMode mode) { return kRangeModes[static_cast<std::size_t>(mode)]; }

/// Quantity that elements are coloured by.
enum class ColourBy {
  Quality,
  Kind,
  Group,
  Valence,
  Class,
  Displacement,
  Size,
  Inverted,
  EdgeLength,
  SizeOverTarget,
  Difference,
  Deviation,
  Tilt,
  Freedom,
  Multiplier
};
struct ColourByInfo {
  ColourBy by;
  std::string_view name, title, doc;
};
inline constexpr std::array<ColourByInfo, 15> kColourBys{{
    {ColourBy::Quality, "quality", "Quality", "of the shown metric"},
    {ColourBy::Kind, "kind", "Kind of element", "triangle or quadrilateral"},
    {ColourBy::Group, "group", "Group", "boundaries, markers and element groups that the file carried"},
    {ColourBy::Valence, "valence", "Valence", "the number of elements around each vertex"},
    {ColourBy::Class, "class", "Colour class", "the class of each free vertex: vertices of one class move at the same time"},
    {ColourBy::Displacement, "displacement", "Displacement", "distance from the input of the corner that moved farthest"},
    {ColourBy::Size, "size", "Size", "area relative to the mean, logarithmic"},
    {ColourBy::Inverted, "inverted", "Inverted", "only inverted elements"},
    {ColourBy::EdgeLength, "edge-length", "Edge length", "mean length of the edges around an element's corners, logarithmic"},
    {ColourBy::SizeOverTarget, "size-over-target", "Size over target",
     "edge length over the size that the run's size function asks for, logarithmic; 1: as large as the rest of the mesh allows"},
    {ColourBy::Difference, "difference", "Difference", "quality minus that of the input, of another run or of a mark"},
    {ColourBy::Deviation, "deviation", "Deviation", "distance of an element's boundary from that of the input, where vertices slide"},
    {ColourBy::Tilt, "tilt", "Tilt", "the greatest angle between a face and the input's surface beneath it, where vertices slide"},
    {ColourBy::Freedom, "freedom", "Freedom to move", "what the least free vertex of an element may do: stay, slide or move freely"},
    {ColourBy::Multiplier, "multiplier", "Multiplier",
     "how strongly an element holds the minimum, within the cluster around the worst one"},
}};
[[nodiscard]] constexpr const ColourByInfo& info(ColourBy by) { return kColourBys[static_cast<std::size_t>(by)]; }

/// Whether the colours are those of categories, whose elements can be looked at alone.
[[nodiscard]] constexpr bool has_categories(ColourBy by) {
  return by != ColourBy::Quality && by != ColourBy::Displacement && by != ColourBy::Size && by != ColourBy::EdgeLength &&
         by != ColourBy::SizeOverTarget && by != ColourBy::Difference && by != ColourBy::Deviation && by != ColourBy::Tilt &&
         by != ColourBy::Multiplier;
}

/// The only category on show: `name` from the legend, or the name or role of a group.
struct Isolation {
  ColourBy by = ColourBy::Kind;
  std::string name;
  friend bool operator==(const Isolation&, const Isolation&) = default;
};

struct ColouringState {
  ColourBy by = ColourBy::Quality;
  PaneContent reference{PaneContent::Kind::Input, 0, std::nullopt};  // for ColourBy::Difference: input, a run as it stands or a mark
  bool reversed = false;
  int steps = 0;                                                       // see render::ColourScale
  std::optional<std::pair<double, double>> filter;                     // lowest and highest quality that counts
  render::Selection::Others others = render::Selection::Others::Fade;  // look of elements that do not count
  int worst = 0;                                                       // number of worst elements that count; 0: all
  std::optional<Isolation> isolated;
  bool label_vertices = false, label_elements = false;
  std::optional<std::pair<double, double>> held_range;  // range while a handle of the bar is held; set by the drawing code
  friend bool operator==(const ColouringState&, const ColouringState&) = default;
};

}  // namespace dmoscope::ui
