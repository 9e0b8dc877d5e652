#include "render/scene.h"

#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "render/fill.h"
#include "render/framebuffer.h"
#include "render/mark_painter.h"

namespace dmoscope::render {
namespace {

PicturePart all_of(Vec2<double> viewport) { return {{0, 0}, viewport}; }

}  // namespace

Scene::Scene(double affordable) : affordable_(affordable), painter_(std::make_unique<MarkPainter>()) {}
Scene::~Scene() = default;

void Scene::set_shading(std::shared_ptr<const Shading> shading) {
  if (shading == shading_) return;  // a picture that is being refined goes on
  if (shading && (empty() || shading->values.size() != value_count(shading->by)))
    throw UsageError("as many values as the mesh has elements or vertices are needed");
  fill().set_shading(shading.get());
  shading_ = std::move(shading);
  changed();
}

void Scene::set_selection(const Selection& selection) {
  if (selection_ == selection) return;
  for (const auto& flags : {selection.members, selection.tinted})
    if (flags && (empty() || flags->size() != value_count(Shading::By::Elements)))
      throw UsageError("as many members as the mesh has elements are needed");
  fill().set_selection(selection);
  selection_ = selection;
  changed();
}

void Scene::draw(Framebuffer& target, const Camera& camera, const Style& style, const Marks& marks, double detail) {
  draw_elements(target, camera, style, detail);
  draw_marks(target, camera, style, marks);
}

bool Scene::draw_elements(Framebuffer& target, const Camera& camera, const Style& style, double detail) {
  const TargetGuard guard;
  clear(target, style);
  const Vec2<double> viewport = size_of(target);
  const auto drawn = pass(camera, style, viewport, all_of(viewport));
  if (!drawn) return true;
  const double budget = std::max(1.0, std::clamp(detail, 0.0, 1.0) * static_cast<double>(drawn_count()));
  const auto stride = static_cast<Index>(std::ceil(drawn->count() / budget - 1e-9));
  fill().set_colours(style.colours);
  begin_elements();
  drawn->begin();
  if (stride > 1) {
    drawn->draw_coarse(stride);
  } else {
    drawn->draw(0, drawn->count());
  }
  drawn->end(target, stride <= 1);
  return stride <= 1;
}

bool Scene::draw_slice(Framebuffer& target, const Camera& camera, const Style& style, SliceProgress& progress, Index most) {
  const TargetGuard guard;
  const bool first = !std::exchange(progress.begun, true);
  if (first) clear(target, style);
  target.bind();
  const Vec2<double> viewport = size_of(target);
  const auto drawn = pass(camera, style, viewport, all_of(viewport));
  if (!drawn) return true;
  fill().set_colours(style.colours);
  begin_elements();
  if (first) drawn->begin();
  const Index count = std::min(std::max<Index>(1, most), drawn->count() - progress.drawn);
  drawn->draw(progress.drawn, count);
  progress.drawn += count;
  const bool last = progress.drawn >= drawn->count();
  if (last) drawn->end(target, true);
  glFinish();
  return last;
}

void Scene::draw_whole(Framebuffer& target, const Camera& camera, const Style& style, Vec2<double> viewport, const PicturePart& part) {
  clear(target, style);
  const auto drawn = pass(camera, style, viewport, part);
  if (!drawn) return;
  fill().set_colours(style.colours);
  begin_elements();
  drawn->begin();
  drawn->draw(0, drawn->count());
  drawn->end(target, true);
}

void Scene::draw_part(Framebuffer& target, const Camera& camera, const Style& style, const Marks& marks, Vec2<double> viewport,
                      const PicturePart& part) {
  const TargetGuard guard;
  if (const int margin = reach(style, viewport); margin > 0) {
    const Vec2<double> around{static_cast<double>(margin), static_cast<double>(margin)};
    if (!wider_) wider_.emplace(1, 1);
    wider_->resize(target.width() + 2 * margin, target.height() + 2 * margin);
    draw_whole(*wider_, camera, style, viewport, {part.low - around, part.high + around});
    target.copy_middle_of(*wider_);
  } else {
    draw_whole(target, camera, style, viewport, part);
  }
  put_marks(target, camera, style, marks, viewport, part);
}

void Scene::draw_marks(Framebuffer& target, const Camera& camera, const Style& style, const Marks& marks) {
  const TargetGuard guard;
  const Vec2<double> viewport = size_of(target);
  put_marks(target, camera, style, marks, viewport, all_of(viewport));
}

}  // namespace dmoscope::render
