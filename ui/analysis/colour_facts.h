#pragma once
// Facts about the colours on show, worked out once a frame serial.

#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "core/view/view.h"
#include "render/scene.h"
#include "ui/analysis/element_colours.h"
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

}  // namespace dmoscope::ui
