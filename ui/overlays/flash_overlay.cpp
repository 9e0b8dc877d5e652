#include <algorithm>

#include "ui/overlays/moves.h"
#include "ui/overlays/overlay.h"
#include "ui/toolkit/theme.h"

namespace dmoscope::ui {
namespace {

Inks flash_inks(const ViewState& state) {
  const Palette& colours = palette(state.theme);
  const int level = std::clamp(state.stepping.flash_level, 0, kFlashLevels);
  return {solid(colours.text, 255 * level / kFlashLevels), solid(colours.background, 230 * level / kFlashLevels)};
}

/// Marks the only vertex that a step visited, even if something hides it: with a ring, and an arrow from its old place. Steps of several
/// vertices only tint their elements.
class FlashOverlay final : public Overlay {
 public:
  [[nodiscard]] bool wanted(const OverlayInput& in) const override {
    const StepNews& news = in.state.stepping.news;
    return in.state.stepping.flash_level > 0 && news.serial == in.frame().serial && (news.moved.size() == 1 || news.vertex != kNoIndex);
  }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    const StepNews& news = in.state.stepping.news;
    const Frame& frame = in.frame();
    const Inks inks = flash_inks(in.state);
    const Index vertex = news.moved.empty() ? news.vertex : news.moved.front();
    if (vertex >= frame.vertex_count()) return;
    add_ring(marks, view, frame.positions[vertex], 22.0F, inks.ink);
    if (!news.before || news.moved.empty()) return;
    MarkView all = view;
    all.unhidden.reset();
    const Displacements moved(view.points, news.before->positions, frame.positions, news.moved);
    add_arrows(marks, all, moved, arrow_factor(all, moved, 0.0), inks);
  }
};

}  // namespace

OverlayPointer flash_overlay() { return std::make_unique<FlashOverlay>(); }

}  // namespace dmoscope::ui
