// Handles the pointer over a mesh: it shows the value of the element where it rests, and clicks on axes.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "render/triad.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

constexpr double kRest = 0.35;                  // seconds until a pointer rests
constexpr std::size_t kMostElements = 300'000;  // with more, finding the one under the pointer takes longer than a person waits

bool presses(const ImGuiIO& io) { return io.MouseDown[0] || io.MouseDown[1] || io.MouseDown[2]; }

void show_value(PanelContext& context, const Frame& frame, Index element) {
  if (element >= frame.quality.size()) return;
  const float quality = frame.quality[element];
  const std::string value = std::isnan(quality) ? std::string("not defined") : short_number(static_cast<double>(quality));
  ImGui::BeginTooltip();
  ImGui::PushFont(context.fonts.bold);
  ImGui::TextUnformatted(value.c_str());
  ImGui::PopFont();
  ImGui::SameLine();
  dim_text(context, fmt::format("{} · element {}", metric_phrase(frame.shown), element), false);
  ImGui::EndTooltip();
}

}  // namespace

void handle_rest(PanelContext& context, const PaneFacts& pane, Vec2<double> at) {
  PointerRest& rest = context.widgets.pointer_rest;
  const ImGuiIO& io = ImGui::GetIO();
  const Frame& frame = *pane.frame();
  const bool moved = std::exchange(rest.pane, pane.number) != pane.number || std::exchange(rest.at.x, at.x) != at.x ||
                     std::exchange(rest.at.y, at.y) != at.y || std::exchange(rest.frame, frame.serial) != frame.serial || presses(io) ||
                     io.MouseWheel != 0;
  if (moved) rest = {pane.number, at, frame.serial, context.now, std::nullopt};
  if (!context.state.pointer_value || presses(io) || frame.device || frame.element_count() > kMostElements) return;
  const double waits = rest.since + kRest - context.now;
  if (waits > 0.0) {
    rest.wakes_in = waits;
    return;
  }
  if (!rest.element) rest.element = context.pick(pane.number, at).second;
  if (*rest.element != kNoIndex) show_value(context, frame, *rest.element);
}

void handle_axes(PanelContext& context, const PaneFacts& pane) {
  if (pane.frame() == nullptr || !pane.frame()->input->in_space()) return;
  const render::OrbitCamera& camera = context.state.orbit;
  const auto letters =
      render::triad_letters(camera, {static_cast<double>(pane.rect.w), static_cast<double>(pane.rect.h)}, context.state.scale);
  constexpr std::array<Vec3, 3> kAxes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const float reach = context.px(11);
  for (std::size_t i = 0; i < letters.size(); ++i) {
    constexpr double kAlong = 0.999;
    const char letter = static_cast<char>('x' + i);
    const bool from_behind = dot(kAxes[i], camera.back()) > kAlong;  // the camera looks along the axis already
    ImGui::SetCursorScreenPos(
        {pane.rect.x + static_cast<float>(letters[i].x) - reach, pane.rect.y + static_cast<float>(letters[i].y) - reach});
    const std::string item = fmt::format("axis:{}", letter);
    if (ImGui::InvisibleButton(item.c_str(), {2 * reach, 2 * reach}))
      context.send(fmt::format("view-from {}{}", from_behind ? '-' : '+', letter));
    note_item(context, item, fmt::format("look along {}{}", letter, from_behind ? ", from behind" : "; once more: from behind"));
  }
}

}  // namespace dmoscope::ui
