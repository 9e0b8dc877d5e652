#include <algorithm>

#include <fmt/format.h>

#include "ui/overlays/moves.h"
#include "ui/overlays/overlay.h"
#include "ui/toolkit/theme.h"

namespace dmoscope::ui {
namespace {

constexpr std::size_t kFewRings = 50;          // more of them would be a carpet
constexpr std::size_t kMostArrowed = 300'000;  // moved vertices whose arrows are found in a moment

Inks flash_inks(const ViewState& state) {
  const Palette& colours = palette(state.theme);
  const int level = std::clamp(state.stepping.flash_level, 0, kFlashLevels);
  return {solid(colours.text, 255 * level / kFlashLevels), solid(colours.background, 230 * level / kFlashLevels)};
}

void outline_element(render::Marks& marks, const MarkView& view, const Frame& frame, Index element, const Inks& inks) {
  for_edges(frame.input->mesh.elements, element, [&](Index a, Index b) {
    const Vec3 first = frame.positions[frame.input->mesh.elements.corners(element)[0]];
    const Vec3 p = view.points.at(frame.positions[a], first), q = view.points.at(frame.positions[b], first);
    marks.lines.push_back({p, q, 3.5F, inks.casing});
    marks.lines.push_back({p, q, 1.6F, inks.ink});
  });
}

/// Rings, arrows and outlines of few, arrows of many, dots of very many; as strong as state.stepping.flash_level says. Few are shown
/// whether something hides them or not.
class FlashOverlay final : public Overlay {
 public:
  [[nodiscard]] bool wanted(const OverlayInput& in) const override {
    return in.state.stepping.flash_level > 0 && in.state.stepping.news.serial == in.frame().serial;
  }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    const StepNews& news = in.state.stepping.news;
    const Frame& frame = in.frame();
    const Inks inks = flash_inks(in.state);
    if (!in.input().is_volume())
      for (const Index e : news.elements) outline_element(marks, view, frame, e, inks);
    const auto ring = [&](Index v) { add_ring(marks, view, frame.positions[v], 22.0F, inks.ink); };
    if (news.vertex < frame.vertex_count()) ring(news.vertex);
    const bool few = news.moved.size() <= kFewRings, very_many = news.moved.size() > kMostArrowed;
    if (few) std::ranges::for_each(news.moved, ring);
    if (very_many) add_dots(marks, view, in.input(), frame.positions, news.moved, inks.ink, 4.0);
    factor_ = 0.0;
    if (!news.before || news.moved.empty() || very_many) return;
    const Displacements moved(view.points, news.before->positions, frame.positions, news.moved);
    MarkView all = view;
    if (few) all.unhidden.reset();
    factor_ = arrow_factor(all, moved, 0.0);
    add_arrows(marks, all, moved, factor_, inks);
  }
  [[nodiscard]] std::string note(const OverlayInput& in) const override {
    return wanted(in) && factor_ > 0.0 ? fmt::format("moved just now, arrows × {:.3g}", factor_) : "";
  }

 private:
  double factor_ = 0.0;  // by which the arrows are too long; 0: there are none
};

}  // namespace

OverlayPointer flash_overlay() { return std::make_unique<FlashOverlay>(); }

}  // namespace dmoscope::ui
