// Rows of the table of options: visible parts of a mesh, and colours.
#include "ui/state/option_rows.h"

namespace dmoscope::ui {
namespace {

using V = ViewState;
using C = ColouringState;
using In = ClippingView;

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

}  // namespace

std::vector<ViewOption> mark_options() {
  using namespace option_rows;
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
  using namespace option_rows;
  return {
      row("clip flip", "", at<&V::inside, &In::clip, &ClipPlane::flip>(), {"/volume/inside/clip/flip"}),
      row("clip", "", at<&V::inside, &In::clip, &ClipPlane::on>(), {"/volume/inside/clip/on"},
          {"Clip plane", "holders", "J", "inside-clip", Volume}),
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
  using namespace option_rows;
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

}  // namespace dmoscope::ui
