// A picture of the meshes as the viewports show them.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/labels.h"
#include "render/legend.h"
#include "render/text.h"
#include "ui/toolkit/theme.h"
#include "ui/viewports/viewports.h"

namespace dmoscope::ui {
namespace {

/// Draws as much of a title as there is room for, on a plate in the left upper corner of a viewport's part of the picture.
void draw_title(render::Image& image, const render::Font& font, std::vector<TitlePiece> pieces, const std::optional<render::Rgb>& run,
                const Rect& clip, const render::Style& style, float scale) {
  const float size = 13.0F * scale;
  const int pad = static_cast<int>(std::lround(8 * scale)), gap = pad;
  const auto width = [&] {
    int sum = 2 * pad;
    for (const TitlePiece& piece : pieces) sum += font.width(piece.text, size) + (&piece == &pieces.front() ? 0 : gap);
    return sum;
  };
  const int left = static_cast<int>(clip.x) + pad, top = static_cast<int>(clip.y) + pad, room = static_cast<int>(clip.w) - 2 * pad;
  const int swatch = run ? static_cast<int>(std::lround(14 * scale)) : 0;
  while (pieces.size() > 1 && width() + swatch > room) pieces.erase(std::ranges::max_element(pieces, {}, &TitlePiece::rank));
  if (pieces.empty() || width() + swatch > room) return;
  const render::Rgba paper = style.casing_colour, ink = style.highlight_colour;
  const int height = static_cast<int>(std::lround(1.8F * size));
  for (int y = top; y < std::min(image.height, top + height); ++y)
    for (int x = left; x < std::min(image.width, left + width() + swatch); ++x) image.set(x, y, {paper.r, paper.g, paper.b, 255});
  if (run) {
    const int side = static_cast<int>(std::lround(9 * scale)), low = top + (height - side) / 2;
    for (int y = low; y < low + side; ++y)
      for (int i = left + pad; i < left + pad + side; ++i)
        if (i < image.width && y < image.height) image.set(i, y, {run->r, run->g, run->b, 255});
  }
  int x = left + pad + swatch;
  for (const TitlePiece& piece : pieces) {
    const bool bad = piece.role == TitlePiece::Role::Bad;
    const render::Rgb alarm = render::kInvertedColour;
    font.draw(image, x, top + static_cast<int>(std::lround(1.27F * size)), piece.text, size,
              bad ? render::Rgba{alarm.r, alarm.g, alarm.b, 255} : render::Rgba{ink.r, ink.g, ink.b, 255});
    x += font.width(piece.text, size) + gap;
  }
}

/// Copies the columns of `part` that lie within `clip` of the whole.
void paste(render::Image& whole, const render::Image& part, const Rect& at, const Rect& clip) {
  const int left = static_cast<int>(at.x), top = static_cast<int>(at.y);
  const int first = std::max(0, static_cast<int>(clip.x) - left);
  const int last = std::min({part.width, static_cast<int>(clip.x + clip.w) - left, whole.width - left});
  for (int y = 0; y < std::min(part.height, whole.height - top); ++y)
    for (int x = first; x < last; ++x) whole.set(left + x, top + y, part.at(x, y));
}

void draw_rule(render::Image& image, int x, int height, int width, render::Rgba ink) {
  for (int y = 0; y < height; ++y)
    for (int i = x - width / 2; i < x - width / 2 + width; ++i)
      if (i >= 0 && i < image.width) image.set(i, y, {ink.r, ink.g, ink.b, 255});
}

}  // namespace

/// Picture of one viewport; without a frame only the background.
render::Image Viewports::picture_of(std::size_t pane, const Scenery& scenery, const render::Shot& shot) {
  const ViewState& state = scenery.state;
  PaneView& view = *views_[pane];
  render::Style look = picture_style(state, scenery.derived);
  look.scale = 1.0F;  // Shot::scale multiplies it
  look.transparent = shot.transparent;
  const Vec2<double> digit = render::label_digit(shot.scale), viewport = render::mesh_viewport(shot);
  const render::LabelWish wish{state.colouring.label_vertices, state.colouring.label_elements, digit.x, digit.y, 400};
  const render::Camera2D planar = facts_[pane].camera.for_viewport(state.viewport, viewport);
  const render::Camera camera = view.seen_from(state, planar);
  const render::Marks marks = view.marks(scenery, camera, viewport, facts_[pane].inspected);
  render::Image image = render::render_image(view.scene(), camera, look, marks, shot).image;
  render::draw_labels(image, view.scene().labels(camera, viewport, wish), viewport, look, shot.scale);
  return image;
}

render::Image Viewports::picture(const ViewState& state, const Derived& derived, const Inspection& inspection, render::Shot shot) {
  const Frame& frame = *session_->frame;
  const Scenery scenery{state, derived, inspection, session_->input.get()};
  render::Legend legend = legend_of(state, derived, frame);
  if (layout_ == PaneLayout::One) {
    const RunView& run = session_->runs[session_->active];
    legend.subtitle = fmt::format("{} · {}, iteration {}, minimum {:.4g}", frame.input->mesh.name, run.parameters.method,
                                  frame.moment.iteration, frame.shown_statistics.minimum);
    shot.legend = legend;
    return picture_of(0, scenery, shot);
  }
  legend.subtitle = frame.input->mesh.name;
  return joint_picture(scenery, shot, legend);
}

render::Image Viewports::joint_picture(const Scenery& scenery, const render::Shot& shot, const render::Legend& legend) {
  render::Style style = picture_style(scenery.state, scenery.derived);
  style.transparent = shot.transparent;
  const render::Rgb paper = style.background;
  render::Image whole(shot.width, shot.height, shot.transparent ? render::Rgba{0, 0, 0, 0} : render::Rgba{paper.r, paper.g, paper.b, 255});
  const int height = std::max(1, shot.height - render::legend_height(shot.scale));
  const Rect area{0, 0, static_cast<float>(shot.width), static_cast<float>(height)};
  const std::vector<Rect> places = pane_rects(layout_, area, std::round(4 * shot.scale), aspect_, 40 * shot.scale);
  const float handle = std::round(static_cast<float>(scenery.state.panes.split) * area.w);
  const std::unique_ptr<render::Font> font = render::Font::load();
  for (std::size_t k = 0; k < count_; ++k) {
    Rect clip = places[k];
    if (layout_ == PaneLayout::Split) clip = k == 0 ? Rect{0, 0, handle, area.h} : Rect{handle, 0, area.w - handle, area.h};
    render::Shot one = shot;
    one.width = std::max(1, static_cast<int>(places[k].w));
    one.height = std::max(1, static_cast<int>(places[k].h));
    if (views_[k]->frame() != nullptr) paste(whole, picture_of(k, scenery, one), places[k], clip);
    std::optional<render::Rgb> run;
    const PaneFacts& facts = facts_[k];
    if (facts.of_run && !facts.removed && facts.frame() != nullptr) run = palette(scenery.state.theme).run(facts.session->active);
    if (font) draw_title(whole, *font, title_of(facts_[k], session_->shown), run, clip, style, shot.scale);
  }
  if (layout_ == PaneLayout::Split)
    draw_rule(whole, static_cast<int>(handle), height, std::max(1, static_cast<int>(std::lround(3 * shot.scale))), style.highlight_colour);
  (void)render::draw_legend(whole, legend, style, shot.scale);
  return whole;
}

}  // namespace dmoscope::ui
