#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "core/input/input_mesh.h"
#include "ui/analysis/counting_elements.h"
#include "ui/analysis/element_colours.h"
#include "ui/commands/command_words.h"
#include "ui/state/view_geometry.h"

namespace dmoscope::ui {
namespace {

constexpr int kMostWorst = 100;  // as many as a frame lists

ColourBy parse_by(const std::string& word) {
  std::string names;
  for (const ColourByInfo& one : kColourBys) {
    if (one.name == word) return one.by;
    names += (names.empty() ? "" : ", ") + std::string(one.name);
  }
  unexpected(word, "one of " + names);
}

PaneContent parse_reference(const ViewState& state, Arguments words) {
  const PaneContent content = state.panes.parse({words.begin(), words.end()});
  using Kind = PaneContent::Kind;
  const bool usable = content.kind == Kind::Input || (content.kind == Kind::Run && !content.iteration) || content.kind == Kind::MarkA ||
                      content.kind == Kind::MarkB;
  if (!usable) throw UsageError("differences are taken from input, run N, mark a or mark b");
  const Timeline& timeline = state.timeline;
  if ((content.kind == Kind::MarkA && !timeline.a.frame) || (content.kind == Kind::MarkB && !timeline.b.frame))
    throw UsageError(fmt::format("{} is not marked: mark {}", content.kind == Kind::MarkA ? "A" : "B", words[1]));
  return content;
}

std::pair<double, double> parse_range(Arguments words) {
  require(words, 2, 2);
  const double low = to_number(words[0]), high = to_number(words[1]);
  if (!(high > low)) throw UsageError("the second quality must be greater than the first");
  return {low, high};
}

void set_range(ViewState& state, Arguments words) {
  if (words[0] == info(RangeMode::Percentile).name) {
    if (words.size() > 1) {
      const auto [low, high] = parse_range(words.subspan(1));
      if (!(low >= 0.0 && high <= 100.0)) throw UsageError("percentiles are from 0 to 100");
      state.range_low_percent = low;
      state.range_high_percent = high;
    }
    state.range_mode = RangeMode::Percentile;
    return;
  }
  if (words.size() > 1) {
    std::tie(state.range_low, state.range_high) = parse_range(words);
    state.range_mode = RangeMode::Given;
    return;
  }
  std::string names;
  for (const RangeModeInfo& one : kRangeModes) {
    if (one.mode == RangeMode::Given) continue;
    names += (names.empty() ? "" : ", ") + std::string(one.name);
    if (one.name != words[0]) continue;
    state.range_mode = one.mode;
    return;
  }
  unexpected(words[0], "one of " + names + ", or two qualities");
}

void add_colour_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add({"colormap", "colormap NAME|next", "colours of quality"}, {1, 1}, [&state](Arguments words) {
    const auto maps = render::colour_map_table();
    if (words[0] == "next") {
      const auto at = std::find_if(maps.begin(), maps.end(), [&](const auto& map) { return map.map == state.colour_map; });
      state.colour_map = at == maps.end() || at + 1 == maps.end() ? maps.front().map : (at + 1)->map;
    } else {
      state.colour_map = render::colour_map_from_name(words[0]);
    }
  });
  add_option_commands(table, state, {"reverse-colors", "shading", "occlusion"});
  table.add({"color-steps", "color-steps N", "so many colours of equal width, 2 to 64; 0: without steps"}, {1, 1},
            [&state](Arguments words) {
              const std::uint64_t steps = to_count(words[0]);
              if (steps == 1 || steps > 64) throw UsageError("the steps are 2 to 64, or 0 for none");
              state.colouring.steps = static_cast<int>(steps);
            });
  table.add(
      {"range", "range input|fixed|auto|expanding|percentile [LOW HIGH]  or  range LOW HIGH",
       "qualities that the colours span: the input's, 0 to 1, the mesh's own, all seen since it was opened, between two percentiles of "
       "the input (2 98), or given"},
      {1, 3}, [&state](Arguments words) { set_range(state, words); });
  table.add({"color-by",
             "color-by "
             "quality|kind|group|valence|class|displacement|size|edge-length|size-over-target|inverted|deviation|tilt|freedom|multiplier|"
             "difference [input|run N|mark a|b]",
             "what the elements' colours tell; difference: quality less that of the input, of a run or of a mark"},
            {1, 4}, [&state, &host](Arguments words) {
              const ColourBy by = parse_by(words[0]);
              const auto view = host.session();
              if (by == ColourBy::Group && view && view->input && view->input->mesh.groups.empty()) {
                throw UsageError("the mesh has no groups or markers");
              }
              if (const auto why = view && view->input ? why_not_drawn(by, *view->input) : std::nullopt) throw UsageError(*why);
              if (by != ColourBy::Difference) require(words, 1, 1);
              if (by == ColourBy::Difference && words.size() > 1) state.colouring.reference = parse_reference(state, words.subspan(1));
              state.colouring.by = by;
            });
}

void add_filter_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add({"filter", "filter off|LOW HIGH", "only elements of these qualities count (inverted ones when LOW is 0 or less)"},
            [&state](Arguments words) {
              if (words.size() == 1 && words[0] == "off") {
                state.colouring.filter.reset();
              } else {
                state.colouring.filter = parse_range(words);
              }
            });
  add_option_commands(table, state, {"filter-mode"});
  table.add({"isolate", "isolate kind|group|valence|class|freedom|inverted NAME  or  isolate off", "only elements of this category count"},
            [&state, &host](Arguments words) {
              if (words.size() == 1 && words[0] == "off") {
                state.colouring.isolated.reset();
                return;
              }
              if (words.empty()) throw UsageError("expected what and its name, or off");
              Isolation isolation{parse_by(words[0]), {}};
              if (!has_categories(isolation.by))
                throw UsageError(words[0] + " has no categories; filter LOW HIGH takes a range of quality");
              require(words, isolation.by == ColourBy::Inverted ? 1 : 2, 2);
              isolation.name = words.size() > 1 ? words[1] : "inverted";
              if (const auto why = why_unknown(isolation, *open_view(host)->input)) throw UsageError(*why);
              state.colouring.isolated = std::move(isolation);
            });
  table.add({"worst-view", "worst-view N|off|toggle", "only the N worst elements count, 1 to 100"}, {1, 1}, [&state](Arguments words) {
    constexpr int kUsual = 10;
    if (words[0] == "off" || words[0] == "toggle") {
      state.colouring.worst = words[0] == "off" || state.colouring.worst > 0 ? 0 : kUsual;
      return;
    }
    const std::uint64_t count = to_count(words[0], 1);
    if (count > kMostWorst) throw UsageError("the worst 100 elements are known, not more");
    state.colouring.worst = static_cast<int>(count);
  });
  table.add({"fit-worst", "fit-worst", "moves the view to the worst elements: those of worst-view, or 10"}, {0, 0},
            [&state, &host](Arguments) {
              const auto view = host.session();
              if (!view || !view->frame || view->frame->worst.empty()) throw UsageError("no worst elements are known");
              const Frame& frame = *view->frame;
              const std::size_t wanted = state.colouring.worst > 0 ? static_cast<std::size_t>(state.colouring.worst) : 10;
              render::Bounds2 box;
              for (std::size_t k = 0; k < std::min(wanted, frame.worst.size()); ++k)
                box.include(element_box(frame, frame.worst[k].element));
              const double margin = 0.2 * std::min(state.viewport.x, state.viewport.y);
              state.camera = render::Camera2D::fit(box, state.viewport, margin);
            });
}

void add_label_commands(CommandTable& table, ViewState& state) {
  table.add({"labels", "labels off|vertices|elements|both|next", "ids, where there is room for them"}, {1, 1}, [&state](Arguments words) {
    ColouringState& s = state.colouring;
    static constexpr std::array<std::pair<std::string_view, int>, 5> kinds{
        {{"off", 0}, {"vertices", 1}, {"elements", 2}, {"both", 3}, {"next", 4}}};
    int kind = choose(words[0], kinds);
    if (kind == 4) kind = ((s.label_vertices ? 1 : 0) + (s.label_elements ? 2 : 0) + 1) % 4;
    s.label_vertices = kind % 2 == 1;
    s.label_elements = kind >= 2;
  });
}

}  // namespace

void add_colouring_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  add_colour_commands(table, state, host);
  add_filter_commands(table, state, host);
  add_label_commands(table, state);
}

}  // namespace dmoscope::ui
