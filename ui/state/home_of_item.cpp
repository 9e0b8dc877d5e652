#include "ui/state/home_of_item.h"

#include <algorithm>
#include <array>

#include "core/run/parameters.h"

namespace dmoscope::ui {
namespace {

using enum FactsTab;

/// How names of a tab's controls begin; the first that fits counts.
constexpr std::array<std::pair<std::string_view, FactsTab>, 32> kHomes{
    {{"worst:", Worst},        {"why:", Worst},          {"why?", Worst},
     {"color-", Colours},      {"colormap", Colours},    {"reverse-colors", Colours},
     {"range-menu", Mesh},  // in the legend
     {"range-", Colours},      {"occlusion", Colours},   {"shading", Colours},
     {"labels", Colours},      {"filter", Colours},      {"worst-view", Colours},
     {"isolate-off", Colours}, {"shown", Colours},       {"inside:", Inside},
     {"from:", Inside},        {"group-", Mesh},         {"held-by", Mesh},
     {"show-worst", Mesh},     {"star:", Selection},     {"metric:", Selection},
     {"why", Selection},       {"kind:", Selection},     {"edge:", Selection},
     {"chain:", Selection},    {"place:", Selection},    {"inspect", Selection},
     {"level", Selection},     {"candidate", Selection}, {"element:", Selection},
     {"field", Selection}}};
/// Controls of the settings that are not rows of parameter_table().
constexpr std::array<std::string_view, 8> kSettings{"target", "then-", "combine", "backend", "threads", "seed", "size", "threshold"};

bool is_setting(std::string_view item) {
  const auto is = [item](std::string_view name) { return !name.empty() && item.starts_with(name); };
  if (item == "method" || item.starts_with("method:") || item.starts_with("method-") || item.starts_with("metric")) return false;
  return std::ranges::any_of(kSettings, is) ||
         std::ranges::any_of(parameter_table(), [&](const ParameterInfo& row) { return is(row.item.empty() ? row.name : row.item); });
}

}  // namespace

void open_home_of(std::string_view item, Panels& panels) {
  panels.notice = panels.notice || item.starts_with("notice");
  const auto home = std::ranges::find_if(kHomes, [item](const auto& one) { return item.starts_with(one.first); });
  if (is_setting(item) && home == kHomes.end()) {
    panels.settings = panels.setup = true;
  } else if (home != kHomes.end() && !item.starts_with("range-menu")) {
    panels.tab = home->second;
    panels.facts = true;
    panels.holds = panels.holds || item.starts_with("held-by");
  }
}

}  // namespace dmoscope::ui
