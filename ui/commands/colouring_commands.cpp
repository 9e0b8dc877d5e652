#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "core/input/input_mesh.h"
#include "ui/analysis/counting_elements.h"
#include "ui/analysis/element_colours.h"
#include "ui/commands/command_words.h"
#include "ui/state/view_geometry.h"
#include "ui/state/view_options.h"

namespace dmoscope::ui {
namespace {

ColourBy parse_by(const std::string& word) {
  const ViewOption& option = view_option("color-by");
  const double value = option.value_of(word);
  if (value < 0.0) unexpected(word, option.expected());
  return static_cast<ColourBy>(static_cast<int>(value));
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
  const ViewOption& option = view_option("range");
  const double value = option.value_of(words[0]);
  if (value < 0.0) unexpected(words[0], option.expected() + ", or two qualities");
  option.at.set(state, value);
}

void add_colour_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add(
      {"range", "range input|fixed|auto|expanding|percentile [LOW HIGH]|given  or  range LOW HIGH",
       "qualities that range of the colours: the input's, 0 to 1, the mesh's own, all seen since it was opened, between two percentiles of "
       "the input (2 98), or given"},
      {1, 3}, [&state](Arguments words) { set_range(state, words); });
  table.add({"color-by",
             "color-by "
             "quality|kind|group|valence|class|displacement|size|edge-length|size-over-target|inverted|deviation|tilt|freedom|multiplier|"
             "difference [input|run N|mark a|b]",
             "what the colours of the elements mean; difference: quality less that of the input, of a run or of a mark"},
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

}  // namespace

void add_colouring_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  add_colour_commands(table, state, host);
  add_filter_commands(table, state, host);
}

}  // namespace dmoscope::ui
