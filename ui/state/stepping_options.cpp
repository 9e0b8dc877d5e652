// Rows of the table of options: display of steps and visits, and playing of time.
#include "ui/state/option_rows.h"

namespace dmoscope::ui {
namespace {

using V = ViewState;
using S = SteppingState;
using I = InspectionState;

/// References for arrows and ghosts that are saved: Input needs nothing but the run; references from one session do not last.
constexpr std::size_t kLastingReferences = 2;
std::vector<OptionChoice> references(std::string_view previous, std::string_view key, std::string_view input, std::string_view input_key) {
  using option_rows::choice;
  return {choice("off"), choice("input", "", "", input, input_key), choice("previous", "", "", previous, key), choice("a"), choice("b")};
}

/// Switches painting with the brush on or off.
void switch_brush(ViewState& state, double value) {
  if (value != 0.0 && state.in_space)
    throw UsageError("the brush works on planar meshes only; select vertices of a volume mesh by their ids");
  state.brush.on = value != 0.0;
}

}  // namespace

std::vector<ViewOption> stepping_options() {
  using namespace option_rows;
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
  using namespace option_rows;
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

}  // namespace dmoscope::ui
