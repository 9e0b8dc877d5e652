#pragma once
// Values worked out from a frame once, not at every drawing.

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/view/view.h"
#include "render/scene.h"
#include "render/screenshot.h"
#include "ui/analysis/element_colours.h"
#include "ui/analysis/facts.h"
#include "ui/analysis/mesh_parts.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

struct ColourFacts {
  std::shared_ptr<const ElementColours> colours;          // null: quality
  std::optional<std::pair<double, double>> values_range;  // values that all frames on show are coloured by instead of quality
  std::optional<std::pair<double, double>> own;           // range over all frames on show, see own_range
  std::vector<std::pair<std::uint64_t, std::optional<std::pair<double, double>>>> owns;  // range of each frame, by its serial
  std::map<Metric, std::pair<double, double>> seen;                                      // range of all frames so far of this input
  std::shared_ptr<const std::vector<std::uint8_t>> members;  // elements that isolation and worst-view let count; null: all
  std::optional<std::size_t> counting;  // number of elements that count; none: all do, or it is not known for a device-resident frame

  // Inputs that the above was worked out from
  using MembersKey = std::tuple<std::optional<Isolation>, int, std::uint64_t, std::uint64_t, const Colouring*>;
  std::optional<MembersKey> members_key;
  using RangeKey = std::tuple<RangeMode, double, double, double, double, std::optional<std::pair<double, double>>,
                              std::optional<std::pair<double, double>>, const std::vector<std::uint8_t>*>;
  std::optional<RangeKey> range_key;
};

/// Values derived from a frame, worked out once a frame serial.
struct Derived {
  std::uint64_t input_serial = 0, frame_serial = 0;
  std::vector<Metric> metrics;          // defined for every element
  std::vector<std::string> mesh_facts;  // sentences of the report
  std::string interfaces;               // sentence on vertices that stay while the active run's interfaces are fixed; empty for none
  std::string free_interfaces;          // sentence on vertices that may move while they are free
  std::vector<GroupLine> groups;
  std::vector<bool> groups_fixed;      // for each group whether all its vertices are among groups_fixed_by
  std::vector<Index> groups_fixed_by;  // vertices that the active run's user has fixed
  std::array<std::size_t, kElementKindCount> kinds{};
  std::vector<double> sorted_now, sorted_before;  // samples of the shown quality, ascending; filled when their plot is open. sorted_now of
                                                  // a light frame is from its histogram
  std::pair<std::uint64_t, Metric> sorted_before_key{0, Metric::MeanRatio};  // input_serial and metric of sorted_before
  std::size_t outside_low = 0,
              outside_high = 0;           // elements outside the colours' range, inverted ones not counted; 0 for a device-resident frame
  bool undefined = false;                 // some element's shown quality is NaN
  std::optional<AngleSpan> worst_angles;  // angles of the worst element by the shown metric, unless it is inverted
  PickedFacts facts;                      // facts of the pick
  std::pair<std::uint64_t, Picked> facts_key;  // frame serial and pick for which they were read
  std::pair<double, double> range{0.0, 1.0};   // range of the colours of quality
  ColourFacts colouring;
};

/// Brings `derived` up to date with the session's frame and the view's colour range, plot and selection; cheap when nothing changed.
/// `frames`: all on show, for the range of colours; none: only the session's.
void refresh(Derived& derived, const ViewState& state, const SessionView& session,
             std::span<const std::shared_ptr<const Frame>> frames = {});
/// Finds which elements of one frame count.
void refresh_members(ColourFacts& facts, const ViewState& state, const SessionView& session);

/// Scale from quality to colour, the same in the mesh, the bar, legends and heat maps.
[[nodiscard]] render::ColourScale colour_scale(const ViewState& state, const Derived& derived);
/// Scale of the values that the elements are coloured by now, unless these are categories.
[[nodiscard]] render::ColourScale shown_scale(const ViewState& state, const Derived& derived);
/// Selection of the elements that count now.
[[nodiscard]] render::Selection selection_of(const ViewState& state, const Derived& derived);
/// Legend of a picture's colours.
[[nodiscard]] render::Legend legend_of(const ViewState& state, const Derived& derived, const Frame& frame);

}  // namespace dmoscope::ui
