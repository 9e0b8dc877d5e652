// Rows of the table of options, theme by theme.
#include <bit>
#include <type_traits>
#include <utility>

#include "ui/state/view_options.h"

namespace dmoscope::ui {
namespace option_rows {
namespace {

using V = ViewState;
using C = ColouringState;
using I = InspectionState;
using In = ClippingView;
using P = PlotOptions;
using S = SteppingState;

using enum Needs;
constexpr bool kScript = true, kApart = true;

/// Follows pointers to members: at<&ViewState::stepping, &SteppingState::next_class>().
template <auto... Path>
OptionValue at() {
  using Value = std::remove_cvref_t<decltype((std::declval<ViewState&>().*....*Path))>;
  using Step = std::conditional_t<std::is_enum_v<Value>, int, double>;  // type that turns a number into an enumerator
  return {[](const ViewState& state) { return static_cast<double>((state.*....*Path)); },
          [](ViewState& state, double value) {
            if constexpr (std::is_same_v<Value, bool>) {
              (state.*....*Path) = value != 0.0;
            } else {
              (state.*....*Path) = static_cast<Value>(static_cast<Step>(value));
            }
          },
          std::is_same_v<Value, bool>};
}

OptionValue words(OptionValue of, std::vector<OptionChoice> choices) { return of.choices = std::move(choices), of; }
template <class... Choice>
OptionValue words(OptionValue of, const OptionChoice& first, const Choice&... others) {
  return words(std::move(of), std::vector<OptionChoice>{first, others...});
}
OptionValue numbers(OptionValue of, const OptionNumber& number) { return of.number = number, of; }

/// One choice of an option: word, title, explanation; then title in the menu, key and id of its action, if they differ.
constexpr OptionChoice choice(std::string_view word, std::string_view title = {}, std::string_view doc = {}, std::string_view entry = {},
                              std::string_view key = {}, std::string_view id = {}) {
  return {word, title, doc, entry, key, id};
}
/// One row: command, explanation, value, and the groups of ViewOption in their order.
ViewOption row(std::string_view command, std::string_view doc, OptionValue at, const OptionKeeping& kept = {},
               const OptionEntry& entry = {}, const OptionEntries& entries = {}, const OptionBox& box = {}) {
  return {command, doc, std::move(at), kept, entry, entries, box};
}
/// Keeps an option under one name in both saved views and settings.
constexpr OptionKeeping both(std::string_view path, bool in_scripts = false) { return {path, path, in_scripts}; }
/// An entry that exists only for its tick.
template <class... Choice>
ViewOption ticked(std::string_view command, double (*get)(const ViewState&), const Choice&... choices) {
  return row(command, {}, {get, nullptr, true, {choices...}});
}

constexpr double kLargest = 1e300;

std::vector<OptionChoice> colour_maps() {
  std::vector<OptionChoice> choices;
  for (const render::ColourMapInfo& map : render::colour_map_table()) choices.push_back({map.name, map.name, map.doc});
  return choices;
}

template <class Table>
std::vector<OptionChoice> rows_of(const Table& table) {
  std::vector<OptionChoice> choices;
  for (const auto& row : table) choices.push_back({row.name, row.title, row.doc});
  return choices;
}

void set_labels(ViewState& state, double value) {
  const auto kinds = static_cast<unsigned>(value);
  state.colouring.label_vertices = (kinds & 1U) != 0;
  state.colouring.label_elements = (kinds & 2U) != 0;
}

/// Gives all viewports one camera (1), or each its own (0).
void link_cameras(ViewState& state, double value) {
  if (value == 0.0 && state.in_space) throw UsageError("all viewports of a volume mesh share one camera");
  state.link_cameras(value != 0.0);
}

/// References for arrows and ghosts that are saved: Input needs nothing but the run; references from one session do not last.
constexpr std::size_t kLastingReferences = 2;
std::vector<OptionChoice> references(std::string_view previous, std::string_view key, std::string_view input, std::string_view input_key) {
  return {choice("off"), choice("input", "", "", input, input_key), choice("previous", "", "", previous, key), choice("a"), choice("b")};
}

/// Switches painting with the brush on or off.
void switch_brush(ViewState& state, double value) {
  if (value != 0.0 && state.in_space)
    throw UsageError("the brush works on planar meshes only; select vertices of a volume mesh by their ids");
  state.brush.on = value != 0.0;
}

constexpr OptionNumber kPanelSize{.least = 6.0, .most = 60.0, .clamped = true, .unit = "EM", .rest_word = "default"};

/// Shows all of the horizontal axis, because its quantity is another one now.
void show_all_iterations(ViewState& state) {
  for (const auto& [name, tab] : kPlotTabs)
    if (over_iterations(tab)) state.plots[static_cast<std::size_t>(tab)].x_range.reset();
}

void show_all_of_histogram(ViewState& state) { state.plots[static_cast<std::size_t>(PlotTab::Histogram)].x_range.reset(); }

double axis_of(const ViewState& state) { return static_cast<double>(state.plots[static_cast<std::size_t>(state.plot)].axis); }
bool offers_axis(const ViewState& state, double axis) { return offers(state.plot, static_cast<ValueAxis>(static_cast<int>(axis))); }
void choose_axis(ViewState& state, double axis) {
  if (!offers_axis(state, axis)) throw UsageError("log-distance is for plots of quality: convergence and sorted");
  if (axis_of(state) != axis) state.plot_view().y_range.reset();
  state.plot_view().axis = static_cast<ValueAxis>(static_cast<int>(axis));
}

std::vector<ViewOption> mark_options() {
  return {
      row("wireframe", "edges of the elements", at<&V::wireframe>(), both("/wireframe", kScript), {"Wireframe", "next-metric", "W"}),
      row("vertices", "dots: free vertices round, fixed ones square", at<&V::vertices>(), {"/vertices"},
          {"Vertices", "wireframe", "D", "", Planar}),
      row("worst", "ring around the worst element, and a diamond where a listed one is inverted only inside", at<&V::worst_marker>(),
          {"/worst_marker"}, {"Mark the worst element", "vertices", "K", "worst-marker"}),
      row("pointer-value", "the value of the element where the pointer rests", at<&V::pointer_value>(), {"", "/pointer_value"},
          {"Value under the resting pointer", "vertices"}),
      row("features", "where vertices slide: boundary, interfaces and feature edges as lines, corners as squares", at<&V::features>(),
          {"/features"}, {"Feature edges and corners, where vertices slide", "worst-marker", "Alt+K"}),
      row("holders",
          "what holds the minimum: the elements that hold one another, the forces on their vertices, and the cluster around them",
          at<&V::holders>(), {"/holders"}, {"What holds the minimum: elements that hold one another", "features", "Alt+O", "", Mesh}),
      row("viewports", "one mesh, several side by side, or two over each other with a handle between them",
          words(at<&V::panes, &Panes::layout>(), choice("1", "One viewport", "", "", "1"), choice("2", "Two viewports", "", "", "2"),
                choice("4", "Four viewports", "", "", "4"), choice("split", "Split view", "", "", "3"))
              .changed_by([](V& state, double value) { state.set_layout(static_cast<PaneLayout>(static_cast<int>(value))); }),
          {"/viewports/layout", "", kScript}, {}, {"each-reset", "", kApart}),
      row("link-cameras", "all viewports look at the same place, or each for itself",
          at<&V::panes, &Panes::linked>().changed_by(link_cameras).seen_as([](const V& state) {
            return state.panes.linked || state.in_space ? 1.0 : 0.0;
          }),
          {"/viewports/linked", "", kScript}, {"One camera for all viewports", "viewports-split", "", "", Planar}),
      row("split", "where the handle of the split view is, 0 (left) to 1", numbers(at<&V::panes, &Panes::split>(), {.unit = "X"}),
          {"/viewports/split", "", kScript}),
  };
}

std::vector<ViewOption> inside_options() {
  return {
      row("clip flip", "", at<&V::inside, &In::clip, &ClipPlane::flip>(), {"/volume/inside/clip/flip"}),
      row("clip", "", at<&V::inside, &In::clip, &ClipPlane::on>(), {"/volume/inside/clip/on"},
          {"Clip plane", "holders", "J", "inside-clip", Volume, false, "Inside"}),
      row("clip-mode", "whole cells stay, or they are cut through",
          words(at<&V::inside, &In::clip, &ClipPlane::mode>(), choice("crinkle", "whole", "cells that the plane passes through stay whole"),
                choice("cut", "cut", "cells that the plane passes through are cut")),
          {"/volume/inside/clip/mode", "", kScript}, {"Cut cells through, or whole ones", "inside-flip", "Alt+J", "inside-cut", Volume}),
      row("peel", "peels this many layers of cells off the boundary of a volume mesh",
          numbers(at<&V::inside, &In::peel>(), {.most = kNoIndex - 1, .whole = true, .clamped = true, .step = 1.0}),
          {"/volume/inside/peel", "", kScript}, {"", "", "", "", Volume}),
      row("worst-cells", "shows only the N worst cells (50), within a faint outline of the rest",
          numbers(at<&V::inside, &In::worst>(), {.most = kNoIndex, .whole = true, .rest = 0.0, .rest_word = "off", .usual = 50.0})
              .and_then([](V& state) { state.inside.ghost = state.inside.worst > 0; }),
          {"/volume/inside/worst", "", kScript}, {"Only the worst cells", "inside-unpeel", "Q", "inside-worst", Volume}),
      row("ghost-rest", "a faint outline of hidden cells", at<&V::inside, &In::ghost>(), {"/volume/inside/ghost", "", kScript},
          {"Faint outline of hidden cells", "inside-worst", "Alt+Q", "inside-ghost", Volume}, {}, {"faint rest"}),
      row("shrink", "draws every cell of a volume mesh at this share of its size",
          numbers(at<&V::inside, &In::shrink>(), {.least = 1e-6, .unit = "FACTOR", .rest = 1.0, .usual = 0.8}),
          {"/volume/inside/shrink", "", kScript}, {"Shrunk cells", "inside-unpeel", "E", "inside-shrink", Volume}),
      row("trackball", "a drag rolls a mesh in space like a ball instead of keeping it upright", at<&V::trackball>(),
          {"/volume/trackball", "", kScript}, {"Roll freely", "from-minus-z", "", "from-trackball", Volume}, {}, {"roll freely"}),
      row("perspective", "what is farther away looks smaller", at<&V::orbit, &render::OrbitCamera::perspective>(),
          {"/volume/perspective", "", kScript}, {"Perspective", "from-minus-z", "Alt+E", "from-perspective", Volume, kApart}, {},
          {"perspective"}),
      row("up-axis", "the axis that points up: guessed of a mesh that is opened",
          words(at<&V::orbit, &render::OrbitCamera::up_axis>(), choice("z", "z"), choice("y", "y")).changed_by([](V& state, double axis) {
            const auto wanted = static_cast<render::UpAxis>(static_cast<int>(axis));
            state.requests.fit = state.requests.fit || wanted != state.orbit.up_axis;
            state.orbit.raise(wanted);
          }),
          {"/volume/up_axis", "", kScript}, {"The other axis up", "from-perspective", "", "from-up-axis", Volume}, {}, {"up"}),
  };
}

std::vector<ViewOption> colour_options() {
  return {
      row("color-by", "", words(at<&V::colouring, &C::by>(), rows_of(kColourBys)), {"/colours/by"}, {},
          {"copy-level", "", false, false, "Colours"}),
      row("range", "", words(at<&V::range_mode>(), rows_of(kRangeModes)), {"/colours/range_mode", "/range/mode"}, {},
          {"color-by-multiplier", "Range", kApart}),
      row("", "", numbers(at<&V::range_low>(), {-kLargest, kLargest}), {"/colours/range_low", "/range/low"}),
      row("", "", numbers(at<&V::range_high>(), {-kLargest, kLargest}), {"/colours/range_high", "/range/high"}),
      row("", "", numbers(at<&V::range_low_percent>(), {0.0, 100.0}), {"/colours/range_low_percent", "/range/low_percent"}),
      row("", "", numbers(at<&V::range_high_percent>(), {0.0, 100.0}), {"/colours/range_high_percent", "/range/high_percent"}),
      row("colormap", "colours of quality", words(at<&V::colour_map>(), colour_maps()), both("/colormap", kScript),
          {"Next colour map", "range-given", "Shift+M", "next-map"}, {}, {"map"}),
      row("reverse-colors", "reverses the colour map", at<&V::colouring, &C::reversed>(), {"/colours/reversed", "/reversed", kScript},
          {"Reversed", "next-map"}, {}, {"reversed"}),
      row("color-steps", "number of colour steps of equal width, 2 to 64; 0: continuous",
          numbers(at<&V::colouring, &C::steps>(), {.least = 2.0, .most = 64.0, .whole = true, .rest = 0.0}),
          {"/colours/steps", "/steps", kScript}, {}, {}, {"steps"}),
      row("occlusion", "meshes in space a little darker in corners and along edges, which shows their form", at<&V::occlusion>(),
          both("/occlusion", kScript), {"Darker corners", "reverse-colors"}, {}, {"corners", "depth"}),
      row("shading", "soft light on meshes in space, which shows their form; colours get a little darker where faces turn away",
          at<&V::shading>(), both("/shading", kScript), {"Soft light", "reverse-colors"}, {}, {"light", "depth"}),
      row("filter-mode", "how elements that do not count are drawn: grey, not at all, or as outlines",
          words(at<&V::colouring, &C::others>(), choice("fade", "faded", "", "", "", "others-fade"),
                choice("isolate", "hidden", "", "", "", "others-isolate"),
                choice("only-outline", "outlines", "", "", "", "others-only-outline")),
          {"/colours/filter_mode"}, {}, {"filter-off", "Other elements"}, {"others"}),
      row("worst-view", "only the N worst elements count, 1 to 100",
          numbers(at<&V::colouring, &C::worst>(),
                  {.least = 1.0, .most = 100.0, .whole = true, .rest = 0.0, .rest_word = "off", .usual = 10.0}),
          {"/colours/worst"}, {"Only the 10 worst elements", "isolate-off", "Shift+K", "", Mesh, kApart}, {}, {"worst"}),
      row("labels", "ids of visible vertices or elements, where there is room",
          words(
              {[](const V& s) { return (s.colouring.label_vertices ? 1.0 : 0.0) + (s.colouring.label_elements ? 2.0 : 0.0); }, set_labels},
              choice("off", "none"), choice("vertices", "vertices"), choice("elements", "elements"), choice("both", "both")),
          {}, {"Next labels", "fit-worst", "I", "labels-next", Mesh, false, "", "next"}, {"fit-worst", "Labels"}, {"labels"}),
      row("", "", at<&V::colouring, &C::label_vertices>(), {"/colours/label_vertices"}),
      row("", "", at<&V::colouring, &C::label_elements>(), {"/colours/label_elements"}),
  };
}

std::vector<ViewOption> stepping_options() {
  return {
      row("next-class", "dots on the vertices of the colour class that moves next", at<&V::stepping, &S::next_class>(),
          {"/stepping/next_class"}, {"Show vertices that move next", "link-cameras", "H", "", Mesh, false, "Stepping"}),
      row("arrows", "from where vertices were: at the input, before the last command, or at a mark",
          words(at<&V::stepping, &S::arrows>(), references("Arrows of the last step", "A", "Arrows from the input", "Alt+A")),
          {"/stepping/arrows", "", false, kLastingReferences}, {"", "", "", "", Mesh}, {"next-class", "", false, true}),
      row("arrow-scale", "the factor by which arrows are longer than the moves",
          numbers(at<&V::stepping, &S::arrow_scale>(),
                  {.least = 1e-3, .most = 1e6, .clamped = true, .unit = "FACTOR", .rest = 0.0, .rest_word = "auto", .factor = 2.0}),
          {"/stepping/arrow_scale"}),
      row("flash", "tints the elements that a step has moved: for a moment, or until the next step",
          words(at<&V::stepping, &S::flash>(), choice("off"), choice("on"), choice("hold")), {},
          {"Tint what a step moves", "arrows-auto", "", "", Nothing, false, "", "toggle"}),
      row("", "",
          {[](const V& s) { return s.stepping.flash != Flash::Off ? 1.0 : 0.0; },
           [](V& s, double value) { s.stepping.flash = value != 0.0 ? Flash::On : Flash::Off; }, true},
          {"", "/flash"}),
      row("ghost", "edges as they were: at the input, before the last command, or at a mark",
          words(at<&V::stepping, &S::ghost>(), references("Ghost of the mesh before the last step", "O", "Ghost of the input", "Shift+O")),
          {"/stepping/ghost", "", false, kLastingReferences}, {"", "", "", "", Mesh}, {"flash", "", false, true}),
      row("brush", "dragging selects vertices; with Shift it adds, with Ctrl it removes",
          at<&V::brush, &Brush::on>().changed_by(switch_brush), {},
          {"Brush: drag to select vertices", "ghost-previous", "S", "", Planar, kApart}),
      row("brush-radius", "how wide the brush is, 2 to 200 at scale 1",
          numbers(at<&V::brush, &Brush::radius>(), {.least = 2.0, .most = 200.0, .clamped = true, .unit = "PIXELS", .factor = 1.25})),
      row("click-smooths", "a click on a free vertex moves it to its best candidate", at<&V::stepping, &S::click_smooths>(),
          {"/stepping/click_smooths"}, {"Click moves a vertex", "select-none", "T", "", Mesh, kApart}),
      row("speed", "iterations (or steps) a second that playing shows, 0.5 to 60",
          numbers(at<&V::timeline, &Timeline::play, &Playback::speed>(),
                  {.least = Playback::kSlowest, .most = Playback::kFastest, .clamped = true, .factor = 1.5}),
          {"/speed"}),
      ticked("play", [](const V& s) { return s.timeline.play.kind == Playback::Kind::History ? 1.0 : 0.0; }),
      ticked("play-steps", at<&V::timeline, &Timeline::play, &Playback::kind>().get, choice("off"), choice("history"), choice("vertex"),
             choice("class"), choice("iteration")),
  };
}

std::vector<ViewOption> inspection_options() {
  return {
      row("inspect", "", at<&V::inspection, &I::open>(), {"/inspection/open"}),
      ticked("play-levels", at<&V::inspection, &I::playing>().get),
      ticked(
          "level", [](const V& s) { return s.inspection.open && s.inspection.all_levels ? 1.0 : 0.0; }, choice(""), choice("all")),
      row("", "", numbers(at<&V::inspection, &I::level>(), {.most = 16.0, .whole = true}), {"/inspection/level"}),
      row("", "", at<&V::inspection, &I::all_levels>(), {"/inspection/all_levels"}),
      row("", "", numbers(at<&V::inspection, &I::slice_axis>(), {.most = 2.0, .whole = true}), {"/inspection/slice_axis"}),
      row("field", "the quality around the inspected vertex, in the inspector", at<&V::inspection, &I::field>(), {"/inspection/field"},
          {"Quality around the vertex", "apply-move", "Shift+Q", "", Nothing, kApart}),
      row("field-in-view", "the quality around the inspected vertex, over the mesh", at<&V::inspection, &I::field_in_view>(),
          {"/inspection/field_in_view"}, {"Quality around the vertex over the mesh", "field", "Shift+F"}),
      row("inspect-zoom", "zooms in as close as the shown level needs", at<&V::inspection, &I::zoom>(), {"/inspection/zoom"},
          {"Close-up of small levels", "field-in-view"}),
      row("inspect-alone", "shows the rest of a volume faintly while a vertex is inspected", at<&V::inspection, &I::alone>(),
          {"/inspection/alone"}),
      row("level-range", "colours of the levels' heat maps: as in the view, or over each level's own range",
          words(at<&V::inspection, &I::own_range>(), choice("view", "in the view's colours"), choice("level", "over each level's range")),
          {}, {}, {"inspect-zoom", "Heat maps"}),
  };
}

std::vector<ViewOption> plot_options() {
  return {
      row("plot", "which plot is shown, or the table of runs",
          words(at<&V::plot>(), choice("convergence", "Convergence", "", "", "Alt+1"), choice("histogram", "Histogram", "", "", "Alt+2"),
                choice("sorted", "Sorted", "", "Sorted quality", "Alt+3"), choice("moved", "Moved", "", "Moved vertices", "Alt+4"),
                choice("time", "Time", "", "", "Alt+5"), choice("runs", "Runs", "", "Table of runs", "Alt+6"),
                choice("compare", "Compare", "", "Comparison of runs", "Alt+7")),
          {"/plots/shown"}, {}, {"log", "", false, false, "Plot"}),
      row("judged-by", "the metric of runs that are compared: the one that is shown, or each its own",
          words(at<&V::plot_options, &P::judged_own>(), choice("shown"), choice("own")), {"/plots/judged_own"}),
      row("axis", "the shown plot's value axis; log-distance: by the logarithm of 1 - quality",
          words({axis_of}, choice("linear", "linear", "values evenly along the axis"),
                choice("log", "log", "logarithmic; values of 0 and below are gaps"),
                choice("log-distance", "log 1 − q", "by the logarithm of 1 - q, the distance to the ideal element: for qualities near 1"))
              .changed_by(choose_axis)
              .offered_if(offers_axis),
          {}, {"Next value axis", "plot-runs", "Alt+L", "log-scale", Nothing, kApart}),
      row("plot-x", "the horizontal axis of plots over a run: iterations or seconds",
          words(at<&V::plot_options, &P::by_seconds>(), choice("iteration", "by iteration", "iterations along the plot"),
                choice("seconds", "by seconds", "seconds of smoothing along the plot: compares methods by their cost"))
              .and_then(show_all_iterations),
          {"/plots/by_seconds"}, {"Seconds instead of iterations", "log-scale", "Alt+T", "plot-seconds"}),
      row("x-axis", "the axis of iterations or seconds: logarithmic, linear up to the last visible change, or linear",
          words(at<&V::plot_options, &P::x_axis>(),
                choice("log", "x: log", "0, 1, 2, 5, 10, …: the first iterations, in which most happens, have the room",
                       "Iterations by their logarithm"),
                choice("changes", "x: last change", "evenly, up to the last iteration with a visible change",
                       "Iterations up to the last change"),
                choice("linear", "x: linear", "all iterations, evenly", "Iterations evenly"))
              .and_then(show_all_iterations),
          {"/plots/x_axis", "/x_axis"}, {}, {"plot-seconds"}),
      row("histogram-range", "whether the histogram begins where its elements are, or from 0 to 1",
          words(at<&V::plot_options, &P::histogram_range>(),
                choice("data", "its data", "from the first bar to the last; what lies outside is said above"),
                choice("whole", "0 to 1", "all possible qualities"))
              .and_then(show_all_of_histogram),
          {"/plots/histogram_range", "/histogram_range"}, {"Histogram from 0 to 1", "x-axis-linear", "", "histogram-whole"}),
      row("plot-bins", "bars of the histogram",
          words({[](const V& s) { return static_cast<double>(std::countr_zero(static_cast<unsigned>(s.plot_options.bins)) - 4); },
                 [](V& s, double value) { s.plot_options.bins = 16 << static_cast<int>(value); }},
                choice("16", "16 bars", "bars from 0 to 1"), choice("32", "32 bars", "bars from 0 to 1"),
                choice("64", "64 bars", "bars from 0 to 1")),
          {"/plots/bins"}),
      row("", "", at<&V::plot_options, &P::descending>(), {"/plots/runs_descending"}),
  };
}

template <auto Dock>
OptionValue side_of() {
  return words(at<&V::panels, Dock>(), choice("left"), choice("right"));
}

std::vector<ViewOption> panel_options() {
  return {
      row("panel setup", "shows or hides a panel; left and right are older names of the first two", at<&V::panels, &Panels::setup>(),
          both("/panels/left", kScript), {"Setup: runs, method, metric", "from-trackball", "F2", "panel-left", Nothing, kApart, "View"}),
      row("panel facts", "shows or hides a panel", at<&V::panels, &Panels::facts>(), both("/panels/right", kScript),
          {"Facts: mesh, selection, worst", "panel-left", "F3", "panel-right"}),
      row("panel left", "an older name of setup", at<&V::panels, &Panels::setup>()),
      row("panel right", "an older name of facts", at<&V::panels, &Panels::facts>()),
      row("dock setup", "the side at which a panel stands", side_of<&Panels::setup_side>(), both("/panels/setup_side", kScript)),
      row("dock facts", "the side at which a panel stands", side_of<&Panels::facts_side>(), both("/panels/facts_side", kScript)),
      row("tab", "what the panel of facts shows: mesh, what is picked, worst elements, colours, the inside of a volume",
          words(at<&V::panels, &Panels::tab>(), choice("mesh"), choice("selection"), choice("worst"), choice("colours"), choice("inside")),
          {"/panels/tab", "", kScript}),
      row("settings", "all parameters of the run", at<&V::panels, &Panels::settings>(), {"", "/panels/settings", kScript}),
      row("unfold-holds", "what holds the minimum, and what would raise it", at<&V::panels, &Panels::holds>(),
          {"", "/panels/holds", kScript}),
      row("unfold-loops", "the list of boundary loops", at<&V::panels, &Panels::loops>(), {"", "/panels/loops"}),
      row("unfold-notice", "the note about a run's end", at<&V::panels, &Panels::notice>(), {"", "/panels/notice", kScript}),
      row("panel bottom", "shows or hides a panel",
          at<&V::panels, &Panels::bottom>().and_then([](V& state) { state.panels.plots_wait = false; }).seen_as([](const V& state) {
            return state.panels.plots() ? 1.0 : 0.0;
          }),
          both("/panels/bottom"), {"Bottom panel: plots", "panel-right", "F4", "panel-bottom"}),
      row("panel-size left", "width or height of a panel, or of the list of runs, in heights of the interface's font",
          numbers(at<&V::panels, &Panels::left_width>(), kPanelSize), both("/panels/left_width", kScript)),
      row("panel-size right", "width of the right column", numbers(at<&V::panels, &Panels::right_width>(), kPanelSize),
          both("/panels/right_width", kScript)),
      row("panel-size bottom", "height of the bottom panel", numbers(at<&V::panels, &Panels::bottom_height>(), kPanelSize),
          both("/panels/bottom_height", kScript)),
      row("panel-size runs", "height of the list of runs",
          numbers(at<&V::panels, &Panels::runs_height>(),
                  {.least = 4.0, .most = 60.0, .clamped = true, .unit = "EM", .rest_word = "default"}),
          both("/panels/runs_height", kScript)),
      row("unfold left", "in a narrow window: shows a side panel over the mesh",
          at<&V::panels, &Panels::left_over>().and_then([](V& state) { state.panels.picked_over = false; }), {"", "", kScript},
          {"Show the left column over the mesh", "scale-one", "", "unfold-left"}),
      row("unfold right", "in a narrow window: shows a side panel over the mesh",
          at<&V::panels, &Panels::right_over>().and_then([](V& state) { state.panels.picked_over = false; }), {"", "", kScript},
          {"Show the right column over the mesh", "unfold-left", "", "unfold-right"}),
  };
}

std::vector<ViewOption> desktop_options() {
  return {
      row("full-screen", "the whole monitor",
          at<&V::full_screen>().and_then([](V& state) { state.requests.full_screen = state.full_screen; }), {},
          {"Full screen", "panel-bottom", "F11"}),
      row("theme", "colours of the interface",
          words(at<&V::theme>(), choice("dark", "dark"), choice("light", "light"), choice("contrast", "high contrast")),
          {"", "/theme", kScript}, {}, {"full-screen", "Theme", kApart}),
      row("watch", "reads the mesh's file again whenever it changes", at<&V::watch_file>(), {}, {"Watch the file", "reload"}),
      row("native-dialogs", "the desktop's own file dialogs where there are any (zenity, kdialog)", at<&V::native_dialogs>(),
          {"", "/native_dialogs"}, {"The desktop's file dialogs", "sample-biased", "", "", Nothing, kApart}),
      row("ask-unsaved", "asks before unsaved work is given up", at<&V::asks_unsaved>()),
      row("", "", at<&V::tour, &Tour::offered>(), {"", "/tour_offered"}),
  };
}

}  // namespace
}  // namespace option_rows

std::vector<ViewOption> all_view_options() {
  using namespace option_rows;
  std::vector<ViewOption> rows;
  for (auto* const theme : {&mark_options, &inside_options, &colour_options, &stepping_options, &inspection_options, &plot_options,
                            &panel_options, &desktop_options})
    for (ViewOption& option : theme()) rows.push_back(std::move(option));
  return rows;
}

}  // namespace dmoscope::ui
