#pragma once
// A scene's picture on the screen, drawn in short slices and only when something changed.

#include <optional>

#include "render/framebuffer.h"
#include "render/scene.h"

namespace dmoscope::render {

/// Draws elements again only when something about them changed; marks cost only themselves. When drawing all of a big mesh takes long, a
/// coarse picture comes first, and a full one is drawn beside it slice by slice until it takes its place.
class LivePicture {
 public:
  struct Wish {
    int width = 1, height = 1;
    Camera camera;
    Style style;
    Marks marks;
    double detail = 1.0;  // share that can be drawn in a moment, see Scene::draw_elements
    bool refine = true;   // whether to go on towards the full picture
    bool plain = false;   // corners are darkened only in the full picture
  };
  /// Brings the picture up to date, as far as a moment goes. Throws Error.
  void update(Scene& scene, const Wish& wish);
  /// Makes the next update draw anew, whatever the scene says of itself.
  void forget() { key_.reset(); }
  /// Grows whenever the elements look otherwise than before.
  [[nodiscard]] std::uint64_t serial() const noexcept { return serial_; }
  /// Whether every element in view is drawn; and whether it is the full picture.
  [[nodiscard]] bool whole() const noexcept { return whole_; }
  [[nodiscard]] bool complete() const noexcept { return complete_; }
  /// OpenGL's name of the picture, see Framebuffer::texture.
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
  std::optional<Key> key_;  // state that base_ shows
  Marks marks_;             // marks that shown_ has
  SliceProgress progress_;  // progress of finer_
  Index slice_ = 50'000;    // elements drawn in a moment
  bool whole_ = true, complete_ = true;
  std::uint64_t serial_ = 0;
};

}  // namespace dmoscope::render
