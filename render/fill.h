#pragma once
// Colours of elements on the OpenGL side, in the form that resources/shaders/fill.glsl reads. Only for sources of this module.

#include <optional>

#include "render/gl.h"
#include "render/shading.h"
#include "render/style.h"

namespace dmoscope::render {

/// Sets a uniform to the rgb of a colour, and alpha.
void set_colour(const Program& program, const char* name, Rgb colour, float alpha = 1.0F);

/// An empty vertex array, for shaders that read their vertices from buffers.
[[nodiscard]] Handle<DeleteVertexArray> make_array();

class Fill {
 public:
  Fill();
  /// Prepares for another mesh: forgets shading and selection.
  void reset();
  void set_colours(const ColourScale& colours);
  /// Sets the shading that is shown instead of quality; null: quality.
  void set_shading(const Shading* shading);
  void set_selection(const Selection& selection);
  /// Binds the colours for programs that include fill.glsl. `shades`: one per element, see shade_of; `order`: the elements as they are
  /// drawn.
  void bind(const Program& program, const Style& style, const Buffer& shades, const Buffer& order) const;
  /// Binds values by vertex and the palette for the shaders of edges; `instead`: what to bind when edges have no categories. Returns their
  /// number.
  [[nodiscard]] int bind_edges(const Buffer& instead) const;
  /// Whether the selection may leave some elements out.
  [[nodiscard]] bool selects() const noexcept { return !selection_.all(); }
  [[nodiscard]] bool by_vertices() const noexcept { return by_ == Shading::By::Vertices; }

 private:
  Buffer values_, members_;
  Handle<DeleteTexture> colours_, palette_;
  std::optional<Shading::By> by_;  // none: quality
  int categories_ = 0;
  bool edges_by_category_ = false;
  Selection selection_;
  std::optional<ColourScale> uploaded_;  // the map in colours_, with a range from 0 to 1
};

}  // namespace dmoscope::render
