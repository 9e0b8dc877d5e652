#include "render/live_picture.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace dmoscope::render {

void LivePicture::update(Scene& scene, const Wish& wish) {
  const Key key{&scene, wish.width, wish.height, wish.camera, wish.style, wish.detail, scene.revision()};
  bool drawn = false;
  if (key_ != key) {
    key_.reset();
    base_.resize(wish.width, wish.height);
    Style style = wish.style;
    style.occlusion = style.occlusion && !wish.plain;
    whole_ = scene.draw_elements(base_, wish.camera, style, wish.detail);
    complete_ = whole_ && style == wish.style;
    progress_ = {};
    key_ = key;
    ++serial_;
    drawn = true;
  } else if (!complete_ && wish.refine) {
    refine(scene, wish);
    drawn = complete_;
  }
  if (!drawn && marks_ == wish.marks) return;
  marks_ = wish.marks;
  shown_.copy_from(base_);
  scene.draw_marks(shown_, wish.camera, wish.style, marks_);
}

void LivePicture::refine(Scene& scene, const Wish& wish) {
  constexpr double kMoment = 0.03;  // seconds that an input may wait for its frame
  finer_.resize(wish.width, wish.height);
  const auto begin = std::chrono::steady_clock::now();
  const Index before = progress_.drawn;
  complete_ = scene.draw_slice(finer_, wish.camera, wish.style, progress_, slice_);
  const double taken = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const Index count = progress_.drawn - before;
  if (!complete_ && count > 0) {
    const double fitting = static_cast<double>(count) * kMoment / std::max(taken, 1e-6);
    slice_ = static_cast<Index>(std::clamp(fitting, 0.5 * static_cast<double>(slice_), 2.0 * static_cast<double>(slice_)));
    // The slice has a least size because the clock also counts other programs: slices that shrank with it would never end on a busy
    // machine.
    slice_ = std::clamp<Index>(slice_, 20'000, 4'000'000);
  }
  whole_ = whole_ || complete_;
  if (complete_) std::swap(base_, finer_);
}

}  // namespace dmoscope::render
