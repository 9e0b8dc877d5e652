#pragma once
// Pictures of a scene at any size.

#include <optional>
#include <string>
#include <vector>

#include "render/image.h"
#include "render/scene.h"

namespace dmoscope::render {

/// A category in a legend.
struct LegendEntry {
  std::string name;
  Rgb colour;
  std::size_t count = 0;
};

/// Colour bar or categories, drawn into the picture below the mesh.
struct Legend {
  std::string title;                 // "mean ratio"
  std::string subtitle;              // "east.14, dmo, iteration 4; minimum 0.8121"; may be empty
  std::size_t inverted = 0;          // > 0: a magenta swatch with the number
  bool undefined = false;            // a grey swatch "not defined"
  std::size_t below = 0, above = 0;  // elements outside the bar's range
  bool logarithmic = false;          // the bar's values are powers of ten
  bool has_categories = false;       // swatches instead of the bar
  std::vector<LegendEntry> categories;
  std::vector<LegendEntry> beside;  // swatches of further categories
  std::string selection;            // choice of elements that count: "120 of 5,000 elements"; may be empty
};

struct Shot {
  int width = 1280, height = 800;  // size of the final picture, legend included
  int supersample = 2;             // n x n samples per pixel, 1 to 8
  bool transparent = false;
  std::optional<Legend> legend;
  float scale = 1.0F;  // factor of text and line widths
};

struct Rendered {
  Image image;
  std::string note;  // anything that could not be done (no font: no text), else empty
};

/// Size of the part of a Shot that shows the mesh: the viewport to fit a camera to.
[[nodiscard]] Vec2<double> mesh_viewport(const Shot& shot);

/// Draws the scene at full detail, supersampled, in tiles if OpenGL's limits ask for it. `camera` is for mesh_viewport(shot). Style::scale
/// is multiplied by shot.scale. Throws UsageError for sizes out of range (1 to 32768), Error.
[[nodiscard]] Rendered render_image(Scene& scene, const Camera& camera, const Style& style, const Marks& marks, const Shot& shot);

}  // namespace dmoscope::render
