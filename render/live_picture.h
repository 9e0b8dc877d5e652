#pragma once
// The picture of a scene that a person looks at: drawn in short slices, and only when something changed.

#include <optional>

#include "render/framebuffer.h"
#include "render/scene.h"

namespace dmoscope::render {

/// Elements are drawn again only when something about them changed; marks cost only themselves. Where drawing all of a big mesh takes long,
/// a coarse picture comes first, and a full one is drawn beside it slice by slice until it takes its place.
class LivePicture {
 public:
  struct Wish {
    int width = 1, height = 1;
    Camera camera;
    Style style;
    Marks marks;
    double detail = 1.0;  // what can be drawn in a moment, see Scene::draw_elements
    bool refine = true;   // go on towards the full picture
  };
  /// Brings the picture up to date, as far as a moment goes. Throws Error.
  void update(Scene& scene, const Wish& wish);
  /// Draws anew next time, whatever the scene says of itself.
  void forget() { key_.reset(); }
  /// Whether every element in view is drawn.
  [[nodiscard]] bool complete() const noexcept { return complete_; }
  /// See Framebuffer::texture.
  [[nodiscard]] unsigned texture() const noexcept { return shown_.texture(); }
  [[nodiscard]] Image picture() const { return shown_.read_pixels(); }

 private:
  struct Key {
    const Scene* scene;
    int width, height;
    Camera camera;
    Style style;
    double detail;
    std::uint64_t revision;
    friend bool operator==(const Key&, const Key&) = default;
  };
  void refine(Scene& scene, const Wish& wish);

  Framebuffer base_{1, 1}, finer_{1, 1}, shown_{1, 1};
  std::optional<Key> key_;  // of base_
  Marks marks_;             // on shown_
  SliceProgress progress_;  // of finer_
  Index slice_ = 50'000;    // elements that are drawn in a moment
  bool complete_ = true;
};

}  // namespace dmoscope::render
