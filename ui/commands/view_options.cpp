#include "ui/commands/view_options.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "ui/commands/command_words.h"

namespace dmoscope::ui {
namespace {

/// `at`: finds the option's place in the state, which is const where it is read.
template <class At>
ViewOption flag(At at, ViewOption option) {
  option.is_flag = true;
  option.words = {"off", "on"};
  option.get = [at](const ViewState& state) { return std::size_t{at(state)}; };
  option.set = [at](ViewState& state, std::size_t value) { at(state) = value != 0; };
  return option;
}

template <class Choices, class At>
ViewOption choice(At at, const Choices& choices, ViewOption option) {
  using Value = typename Choices::value_type::second_type;
  std::vector<Value> values;
  for (const auto& [word, value] : choices) {
    option.words.push_back(word);
    values.push_back(value);
  }
  option.get = [at, values](const ViewState& state) {
    return static_cast<std::size_t>(std::ranges::find(values, at(state)) - values.begin());
  };
  option.set = [at, values](ViewState& state, std::size_t value) { at(state) = values[value]; };
  return option;
}

/// For the menu alone.
template <class Get>
ViewOption shown(std::string_view command, std::vector<std::string_view> words, Get get) {
  return {command, {}, {}, {}, false, std::move(words), [get](const ViewState& state) { return static_cast<std::size_t>(get(state)); }};
}
template <class Get>
ViewOption shown(std::string_view command, Get get) {
  return shown(command, {"off", "on"}, get);
}

template <class Rows, class Row, class Value>
auto named(const Rows& rows, std::string_view Row::*name, Value Row::*value) {
  std::vector<std::pair<std::string_view, Value>> choices;
  for (const Row& row : rows) choices.emplace_back(row.*name, row.*value);
  return choices;
}

constexpr std::array<std::pair<std::string_view, ClipPlane::Mode>, 2> kClipModes{
    {{"crinkle", ClipPlane::Mode::Crinkle}, {"cut", ClipPlane::Mode::Cut}}};
constexpr std::array<std::pair<std::string_view, bool>, 2> kAlong{{{"iteration", false}, {"seconds", true}}};
constexpr std::array<std::pair<std::string_view, bool>, 2> kJudges{{{"shown", false}, {"own", true}}};
constexpr std::array<std::pair<std::string_view, bool>, 2> kLevelRanges{{{"view", false}, {"level", true}}};
constexpr std::array<std::pair<std::string_view, int>, 3> kBins{{{"16", 16}, {"32", 32}, {"64", 64}}};

// Rows: where the option is; command, its doc, member of a saved view, setting.
std::vector<ViewOption> all_options() {
  return {
      flag([](auto& s) -> auto& { return s.wireframe; }, {"wireframe", "edges of the elements", "/wireframe", "/wireframe"}),
      flag([](auto& s) -> auto& { return s.vertices; }, {"vertices", "dots: free vertices round, fixed ones square", "/vertices"}),
      flag([](auto& s) -> auto& { return s.worst_marker; },
           {"worst", "ring around the worst element, and a diamond where a listed one is inverted inside alone", "/worst_marker"}),
      flag([](auto& s) -> auto& { return s.pointer_value; },
           {"pointer-value", "the value of the element where the pointer rests", "", "/pointer_value"}),
      flag([](auto& s) -> auto& { return s.features; },
           {"features", "where vertices slide: boundary, interfaces and feature edges as lines, corners as squares", "/features"}),
      flag([](auto& s) -> auto& { return s.holders; },
           {"holders",
            "what holds the minimum: the elements that hold one another, the forces on their vertices, and the cluster around them",
            "/holders"}),
      flag([](auto& s) -> auto& { return s.shading; },
           {"shading", "volumes lit by a lamp, too, which changes what their colours tell", "/shading", "/shading"}),
      flag([](auto& s) -> auto& { return s.occlusion; },
           {"occlusion", "volumes a little darker in corners and along edges, which shows their form", "/occlusion", "/occlusion"}),
      flag([](auto& s) -> auto& { return s.trackball; },
           {"trackball", "a drag rolls a volume mesh as a ball instead of turning it upright", "/volume/trackball"}),
      flag([](auto& s) -> auto& { return s.orbit.perspective; },
           {"perspective", "what is farther away looks smaller", "/volume/perspective"}),
      flag([](auto& s) -> auto& { return s.inside.clip.flip; }, {"clip flip", "", "/volume/inside/clip/flip"}),
      flag([](auto& s) -> auto& { return s.inside.clip.on; }, {"clip", "", "/volume/inside/clip/on"}),
      choice([](auto& s) -> auto& { return s.inside.clip.mode; }, kClipModes, {"clip-mode", "", "/volume/inside/clip/mode"}),
      flag([](auto& s) -> auto& { return s.inside.ghost; },
           {"ghost-rest", "the boundary of what was taken away is seen faintly", "/volume/inside/ghost"}),
      shown("shrink", [](auto& s) { return s.inside.shrink < 1.0; }),
      shown("worst-cells", [](auto& s) { return s.inside.worst > 0; }),
      choice([](auto& s) -> auto& { return s.panes.layout; }, kPaneLayouts, {"viewports", "", "/viewports/layout"}),
      shown("link-cameras", [](auto& s) { return s.panes.linked || s.in_space; }),
      choice([](auto& s) -> auto& { return s.colour_map; },
             named(render::colour_map_table(), &render::ColourMapInfo::name, &render::ColourMapInfo::map),
             {"colormap", "", "/colormap", "/colormap"}),
      flag([](auto& s) -> auto& { return s.colouring.reversed; },
           {"reverse-colors", "the colour map from its other end", "/colours/reversed", "/reversed"}),
      choice([](auto& s) -> auto& { return s.range_mode; }, named(kRangeModes, &RangeModeInfo::name, &RangeModeInfo::mode),
             {"range", "", "/colours/range_mode", "/range/mode"}),
      choice([](auto& s) -> auto& { return s.colouring.by; }, named(kColourBys, &ColourByInfo::name, &ColourByInfo::by),
             {"color-by", "", "/colours/by"}),
      choice([](auto& s) -> auto& { return s.colouring.others; }, kFilterModes,
             {"filter-mode", "how elements that do not count are drawn: grey, not, as outlines", "/colours/filter_mode"}),
      shown("worst-view", [](auto& s) { return s.colouring.worst > 0; }),
      shown("labels", {"off", "vertices", "elements", "both"},
            [](auto& s) { return (s.colouring.label_vertices ? 1 : 0) + (s.colouring.label_elements ? 2 : 0); }),
      flag([](auto& s) -> auto& { return s.stepping.next_class; },
           {"next-class", "dots on the vertices of the colour class that moves next", "/stepping/next_class"}),
      flag([](auto& s) -> auto& { return s.stepping.click_smooths; },
           {"click-smooths", "a click on a free vertex visits it", "/stepping/click_smooths"}),
      choice([](auto& s) -> auto& { return s.stepping.arrows; }, kReferences, {"arrows"}),
      choice([](auto& s) -> auto& { return s.stepping.ghost; }, kReferences, {"ghost"}),
      shown("arrow-scale", {"", "auto"}, [](auto& s) { return !(s.stepping.arrow_scale > 0.0); }),
      shown("brush", [](auto& s) { return s.brush.on; }),
      shown("play", [](auto& s) { return s.timeline.play.kind == Playback::Kind::History; }),
      shown("play-steps", {"off", "history", "vertex", "class", "iteration"}, [](auto& s) { return s.timeline.play.kind; }),
      flag([](auto& s) -> auto& { return s.inspection.open; }, {"inspect", "", "/inspection/open"}),
      shown("play-levels", [](auto& s) { return s.inspection.playing; }),
      shown("level", {"", "all"}, [](auto& s) { return s.inspection.open && s.inspection.all_levels; }),
      flag([](auto& s) -> auto& { return s.inspection.zoom; },
           {"inspect-zoom", "goes as close as the shown level needs", "/inspection/zoom"}),
      flag([](auto& s) -> auto& { return s.inspection.field; },
           {"field", "the quality around the inspected vertex, in the inspector", "/inspection/field"}),
      flag([](auto& s) -> auto& { return s.inspection.field_in_view; },
           {"field-in-view", "the quality around the inspected vertex, over the mesh", "/inspection/field_in_view"}),
      flag([](auto& s) -> auto& { return s.inspection.alone; },
           {"inspect-alone", "of a volume the rest is but a ghost while a vertex is looked into", "/inspection/alone"}),
      choice([](auto& s) -> auto& { return s.inspection.own_range; }, kLevelRanges,
             {"level-range", "colours of the levels' heat maps: as in the view, or over each level's own range"}),
      choice([](auto& s) -> auto& { return s.theme; }, kThemes, {"theme", "", "", "/theme"}),
      flag([](auto& s) -> auto& { return s.panels.setup; }, {"panel setup", "", "/panels/left", "/panels/left"}),
      flag([](auto& s) -> auto& { return s.panels.facts; }, {"panel facts", "", "/panels/right", "/panels/right"}),
      choice([](auto& s) -> auto& { return s.panels.setup_side; }, kSides, {"dock setup", "", "/panels/setup_side", "/panels/setup_side"}),
      choice([](auto& s) -> auto& { return s.panels.facts_side; }, kSides, {"dock facts", "", "/panels/facts_side", "/panels/facts_side"}),
      flag([](auto& s) -> auto& { return s.panels.settings; }, {"settings", "all parameters of the run", "", "/panels/settings"}),
      flag([](auto& s) -> auto& { return s.panels.notice; }, {"unfold-notice", "the note about a run's end", "", "/panels/notice"}),
      flag([](auto& s) -> auto& { return s.panels.holds; },
           {"unfold-holds", "what holds the minimum, and what would raise it", "", "/panels/holds"}),
      choice(
          [](auto& s) -> auto& { return s.panels.tab; }, kFactsTabs,
          {"tab", "what the panel of facts shows: mesh, what is picked, worst elements, colours, the inside of a volume", "/panels/tab"}),
      flag([](auto& s) -> auto& { return s.panels.bottom; }, {"panel bottom", "", "/panels/bottom", "/panels/bottom"}),
      flag([](auto& s) -> auto& { return s.panels.left_over; }, {"unfold left"}),
      flag([](auto& s) -> auto& { return s.panels.right_over; }, {"unfold right"}),
      shown("full-screen", [](auto& s) { return s.full_screen; }),
      flag([](auto& s) -> auto& { return s.watch_file; }, {"watch", "reads the mesh's file again whenever it is written anew"}),
      flag([](auto& s) -> auto& { return s.native_dialogs; },
           {"native-dialogs", "the desktop's own file dialogs where there are any (zenity, kdialog)", "", "/native_dialogs"}),
      flag([](auto& s) -> auto& { return s.asks_unsaved; }, {"ask-unsaved", "asks before keys and menus give up what is in no file"}),
      choice([](auto& s) -> auto& { return s.plot; }, kPlotTabs, {"plot", "which plot is shown, or the table of runs", "/plots/shown"}),
      choice([](auto& s) -> auto& { return s.plot_options.by_seconds; }, kAlong, {"plot-x", "", "/plots/by_seconds", "", true}),
      choice([](auto& s) -> auto& { return s.plot_options.judged_own; }, kJudges,
             {"judged-by", "the metric of runs that are compared: the one that is shown, or each its own", "/plots/judged_own"}),
      choice([](auto& s) -> auto& { return s.plot_options.x_axis; }, kXAxes, {"x-axis", "", "/plots/x_axis", "/x_axis"}),
      choice([](auto& s) -> auto& { return s.plot_options.histogram_range; }, kHistogramRanges,
             {"histogram-range", "", "/plots/histogram_range", "/histogram_range"}),
      choice([](auto& s) -> auto& { return s.plot_options.bins; }, kBins, {"plot-bins", "bars of the histogram", "/plots/bins"}),
  };
}

const ViewOption& option_of(std::string_view command) { return *std::ranges::find(view_options(), command, &ViewOption::command); }

}  // namespace

const std::vector<ViewOption>& view_options() {
  static const std::vector<ViewOption> table = all_options();
  return table;
}

nlohmann::json ViewOption::saved(const ViewState& state) const {
  return is_flag ? nlohmann::json(get(state) != 0) : nlohmann::json(words[get(state)]);
}

bool ViewOption::take(const nlohmann::json& saved, ViewState& state) const {
  const auto at = saved.is_string() && !is_flag ? std::ranges::find(words, saved.get<std::string>()) : words.end();
  if (at == words.end() && !(is_flag && saved.is_boolean())) return false;
  set(state, is_flag ? std::size_t{saved.get<bool>()} : static_cast<std::size_t>(at - words.begin()));
  return true;
}

std::string ViewOption::expected() const { return is_flag ? "true or false" : fmt::format("one of {}", fmt::join(words, ", ")); }

void add_option_commands(CommandTable& table, ViewState& state, std::initializer_list<std::string_view> commands) {
  for (const std::string_view command : commands) {
    const ViewOption& option = option_of(command);
    const std::string usage = option.is_flag ? "[on|off|toggle]" : fmt::format("{}", fmt::join(option.words, "|"));
    table.add({std::string(command), fmt::format("{} {}", command, usage), std::string(option.doc)}, {option.is_flag ? 0U : 1U, 1},
              [&state, &option](Arguments words) {
                const std::size_t now = option.get(state);
                const auto at = words.empty() ? option.words.end() : std::ranges::find(option.words, words[0]);
                if (option.is_flag) return option.set(state, std::size_t{switched(words, 0, now != 0)});
                if (at == option.words.end()) unexpected(words[0], option.expected());
                option.set(state, static_cast<std::size_t>(at - option.words.begin()));
              });
  }
}

std::string option_line(const ViewState& state, std::string_view command) {
  const ViewOption& option = option_of(command);
  return fmt::format("{} {}", command, option.words[option.get(state)]);
}

bool is_ticked(const ViewState& state, const Action& action) {
  if (action.needs == Needs::Volume && !state.in_space) return false;
  const auto option = std::ranges::find_if(view_options(), [&](const ViewOption& one) {
    return action.command == one.command || action.command.starts_with(std::string(one.command) + ' ');
  });
  if (option == view_options().end()) return false;
  const std::string_view words = action.command.substr(std::min(option->command.size() + 1, action.command.size()));
  const std::string_view word = words.substr(0, words.find(' '));
  const std::size_t now = option->get(state);
  return word.empty() || word == "toggle" ? now != 0 : option->words[now] == word;
}

}  // namespace dmoscope::ui
