#pragma once
// Draws elements on the OpenGL side. Only for sources of this module.

#include <array>
#include <span>

#include "render/draw_order.h"
#include "render/fill.h"
#include "render/gl.h"
#include "render/shading.h"
#include "render/style.h"

namespace dmoscope::render {

/// A camera in the form that the shaders take.
struct View {
  Vec2<float> offset_high, offset_low;  // the camera's centre less the layout's origin
  float zoom = 1.0F;                    // pixels per unit
  Vec2<float> viewport;
  float widest = 1e30F;     // widest element to be drawn, in pixels; see Layout::widest
  Vec2<float> hatch_phase;  // phase of rising and falling stripes, in periods
  void apply(const Program& program) const;
};
inline constexpr float kHatchPeriod = 8.0F;  // pixels at scale 1

class ElementPainter {
 public:
  ElementPainter();
  /// Makes buffers for this layout; the content of the last one's is lost.
  void upload_topology(const Layout& layout);
  /// Replaces all points, in place; they are relative to the layout's origin.
  void upload_points(std::span<const Vec2<float>> points);
  /// Replaces the points of the vertices from `first` on; they are relative to the layout's origin.
  void upload_points(Index first, std::span<const Vec2<float>> points);
  /// Replaces the shades in place, one per element: see shade_of.
  void upload_shades(std::span<const float> shades);
  /// Notes which elements are inverted according to those shades; empty: not known, any may be.
  void mark_inverted(const Layout& layout, std::span<const float> shades);
  /// OpenGL's names of the buffers of points and shades, for others to write; new with every upload_topology.
  [[nodiscard]] GLuint point_buffer() const noexcept { return points_.id(); }
  [[nodiscard]] GLuint shade_buffer() const noexcept { return shades_.id(); }
  /// Colouring of the elements. upload_topology clears shading and selection.
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
  enum class Odd { None, Some, Unknown };       // inverted elements
  std::array<std::array<Program, 2>, 2> fill_;  // by one colour per element or by corners; then triangles or quadrilaterals
  Program coarse_, boundary_;
  std::array<Elements, 2> elements_;
  Buffer points_, shades_, edges_;
  GLsizei edge_count_ = 0;
  Odd odd_ = Odd::Unknown;
  Fill colouring_;
  Handle<DeleteVertexArray> nothing_;  // empty vertex array, for shaders that read their vertices from buffers
};

}  // namespace dmoscope::render
