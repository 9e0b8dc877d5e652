#include "ui/state/home_of_item.h"

#include <algorithm>
#include <array>

#include "core/run/parameters.h"

namespace dmoscope::ui {
namespace {

/// Prefixes of the names of a tab's controls; the first that fits counts.
constexpr std::array<std::pair<std::string_view, FactsTab>, 36> kHomes{
    {{"worst:", FactsTab::Worst},        {"why:", FactsTab::Worst},        {"why?", FactsTab::Worst},
     {"color-", FactsTab::Colours},      {"colormap", FactsTab::Colours},  {"reverse-colors", FactsTab::Colours},
     {"range-menu", FactsTab::Mesh},  // part of the legend
     {"range-", FactsTab::Colours},      {"occlusion", FactsTab::Colours}, {"shading", FactsTab::Colours},
     {"labels", FactsTab::Colours},      {"filter", FactsTab::Colours},    {"worst-view", FactsTab::Colours},
     {"isolate-off", FactsTab::Colours}, {"shown", FactsTab::Colours},     {"inside:", FactsTab::Inside},
     {"from:", FactsTab::Inside},        {"group-", FactsTab::Mesh},       {"loop-next", FactsTab::Selection},
     {"loop-back", FactsTab::Selection}, {"loop-", FactsTab::Mesh},        {"reference", FactsTab::Colours},
     {"held-by", FactsTab::Mesh},        {"show-worst", FactsTab::Mesh},   {"star:", FactsTab::Selection},
     {"metric:", FactsTab::Selection},   {"why", FactsTab::Selection},     {"kind:", FactsTab::Selection},
     {"edge:", FactsTab::Selection},     {"chain:", FactsTab::Selection},  {"place:", FactsTab::Selection},
     {"inspect", FactsTab::Selection},   {"level", FactsTab::Selection},   {"candidate", FactsTab::Selection},
     {"element:", FactsTab::Selection},  {"field", FactsTab::Selection}}};
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
