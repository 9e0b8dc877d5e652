#include <algorithm>
#include <iterator>

#include "render/draw_order.h"
#include "ui/toolkit/theme.h"
#include "ui/viewports/mesh_marks.h"

namespace dmoscope::ui {
namespace {

constexpr std::size_t kFewRings = 50;          // more of them would be a carpet
constexpr std::size_t kMostArrowed = 300'000;  // moved vertices whose arrows are found in a moment

struct FlashInk {
  render::Rgba ink, casing;
};

FlashInk flash_ink(const ViewState& state) {
  const Palette& colours = palette(state.theme);
  const int level = std::clamp(state.stepping.flash_level, 0, kFlashLevels);
  const auto faded = [level](render::Rgb c, int whole) {
    return render::Rgba{c.r, c.g, c.b, static_cast<std::uint8_t>(whole * level / kFlashLevels)};
  };
  return {faded(colours.text, 255), faded(colours.background, 230)};
}

void outline_element(render::Marks& marks, const Frame& frame, Index element, const FlashInk& ink) {
  const Plane& plane = frame.input->geometry.plane;
  const auto corners = frame.input->mesh.elements.corners(element);
  const Vec3 first = frame.positions[corners[0]];
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2<double> a = render::place_near(plane, frame.positions[corners[i]], first);
    const Vec2<double> b = render::place_near(plane, frame.positions[corners[(i + 1) % corners.size()]], first);
    marks.lines.push_back({a, b, 3.5F, ink.casing});
    marks.lines.push_back({a, b, 1.6F, ink.ink});
  }
}

}  // namespace

double add_flash(render::Marks& marks, const MarkView& view, const ViewState& state, const Frame& frame) {
  const StepNews& news = state.stepping.news;
  if (state.stepping.flash_level <= 0) return 0.0;
  const FlashInk ink = flash_ink(state);
  const Plane& plane = frame.input->geometry.plane;
  for (const Index e : news.elements) outline_element(marks, frame, e, ink);
  const auto ring = [&](Index v) { marks.dots.push_back({plane.place(frame.positions[v]), 22.0F, ink.ink, render::DotShape::Ring}); };
  if (news.vertex < frame.vertex_count()) ring(news.vertex);
  if (news.moved.size() <= kFewRings) {
    std::ranges::for_each(news.moved, ring);
  } else if (news.moved.size() > kMostArrowed) {
    add_dots(marks, view, *frame.input, frame.positions, news.moved, ink.ink, 4.0);
  }
  if (!news.before || news.moved.empty() || news.moved.size() > kMostArrowed) return 0.0;
  std::vector<Vec3> from, to;
  for (const Index v : news.moved) {
    from.push_back(news.before->positions[v]);
    to.push_back(frame.positions[v]);
  }
  const Displacements moved(plane, from, to);
  const double factor = arrow_factor(view, moved, 0.0);
  add_arrows(marks, view, moved, factor, ink.ink, ink.casing);
  return factor;
}

double add_space_flash(render::SpaceMarks& marks, const SpaceMarkView& view, const ViewState& state, const Frame& frame,
                       std::span<const Index> unhidden) {
  const StepNews& news = state.stepping.news;
  if (state.stepping.flash_level <= 0) return 0.0;
  const FlashInk ink = flash_ink(state);
  std::vector<Index> seen;
  std::ranges::set_intersection(news.moved, unhidden, std::back_inserter(seen));
  const bool few = news.moved.size() <= kFewRings;  // then they are shown whether something hides them or not
  const std::span<const Index> shown = few ? std::span<const Index>(news.moved) : seen;
  const auto ring = [&](Index v) { marks.dots.push_back({frame.positions[v], 22.0F, ink.ink, render::DotShape::Ring}); };
  if (news.vertex < frame.vertex_count()) ring(news.vertex);
  if (few) std::ranges::for_each(shown, ring);
  for (std::size_t k = 0; !few && k < std::min(shown.size(), kMostMarks); ++k)
    marks.dots.push_back({frame.positions[shown[k]], 5.0F, ink.ink, render::DotShape::Round});
  if (!news.before || shown.empty()) return 0.0;
  const std::span<const Vec3> from = news.before->positions;
  const double factor = space_arrow_factor(view, from, frame.positions, shown, 0.0);
  add_space_arrows(marks, view, from, frame.positions, shown, factor, ink.ink, ink.casing);
  return factor;
}

}  // namespace dmoscope::ui
