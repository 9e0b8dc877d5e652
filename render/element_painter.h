#pragma once
// Elements on the OpenGL side. Only for sources of this module.

#include <array>
#include <span>

#include "render/draw_order.h"
#include "render/fill.h"
#include "render/gl.h"
#include "render/shading.h"
#include "render/style.h"

namespace dmoscope::render {

/// A camera as the shaders take it.
struct View {
  Vec2<float> offset_high, offset_low;  // the camera's centre less the layout's origin
  float zoom = 1.0F;                    // pixels per unit
  Vec2<float> viewport;
  float widest = 1e30F;     // pixels; see Layout::widest
  Vec2<float> hatch_phase;  // of rising and falling stripes, in periods
  void apply(const Program& program) const;
};
inline constexpr float kHatchPeriod = 8.0F;  // pixels at scale 1

class ElementPainter {
 public:
  ElementPainter();
  /// Makes buffers for this layout; what the last one's held is gone.
  void upload_topology(const Layout& layout);
  /// Relative to the layout's origin, in place.
  void upload_points(std::span<const Vec2<float>> points);
  /// The same of the vertices from `first` on.
  void upload_points(Index first, std::span<const Vec2<float>> points);
  /// One per element, in place: see shade_of.
  void upload_shades(std::span<const float> shades);
  /// Which elements are inverted, of those shades; empty: nobody here knows, any may be.
  void mark_inverted(const Layout& layout, std::span<const float> shades);
  /// The buffers of the two, for others to write: new ones with every upload_topology, the same ones until then.
  [[nodiscard]] GLuint point_buffer() const noexcept { return points_.id(); }
  [[nodiscard]] GLuint shade_buffer() const noexcept { return shades_.id(); }
  /// Shading and selection are gone with upload_topology.
  [[nodiscard]] Fill& fill() noexcept { return colouring_; }
  /// Draws all elements of the ranges.
  void draw(const View& view, const Style& style, std::size_t batch, std::span<const DrawRange> ranges);
  /// Draws a square for every stride-th element of the ranges.
  void draw_coarse(const View& view, const Style& style, std::size_t batch, std::span<const DrawRange> ranges, Index stride);
  void draw_boundary(const View& view, const Style& style);

 private:
  struct Elements {
    Buffer order, corners;
    Buffer odd;  // a bit for every 32 drawn elements, see coarse.vert.glsl
    Handle<DeleteVertexArray> array;
  };
  enum class Odd { None, Some, Unknown };       // elements that are inverted
  std::array<std::array<Program, 2>, 2> fill_;  // one colour an element, or by corners; of triangles, of quadrilaterals
  Program coarse_, boundary_;
  std::array<Elements, 2> elements_;
  Buffer points_, shades_, edges_;
  GLsizei edge_count_ = 0;
  Odd odd_ = Odd::Unknown;
  Fill colouring_;
  Handle<DeleteVertexArray> nothing_;  // for shaders that read their vertices from buffers
};

}  // namespace dmoscope::render
