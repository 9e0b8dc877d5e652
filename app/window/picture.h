#pragma once
// A picture of a mesh coloured by quality, without a window.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/progress.h"
#include "core/clipping/clipped_view.h"
#include "core/input/input_mesh.h"
#include "core/io/reading/io_context.h"

namespace dmoscope::render {
struct Image;
}
namespace dmoscope::app {

/// Look of a mesh's picture.
struct PictureLook {
  Metric metric = Metric::MeanRatio;
  int width = 1280, height = 800;  // pixels
  std::string colormap = "beacon";
  /// Range of quality for the colours, unless `range` is given. Without inverted elements; all but Own are rounded outwards.
  enum class Spans { All, Own, Percentiles };
  Spans spans = Spans::All;
  std::pair<double, double> percent{2.0, 98.0};
  std::optional<std::pair<double, double>> range;
  bool shading = false;    // volumes are also lit by a lamp
  bool occlusion = true;   // volumes are darker in corners and along edges
  double zoom = 1.0;       // factor to the size at which the whole mesh fits
  std::optional<Vec3> at;  // centre of the picture; none: the middle of the mesh
  bool transparent = false;
  bool wireframe = true;
  bool colour_bar = true;
  int supersample = 2;  // 1 to 8: the factor by which it is drawn larger and then averaged
};

/// The visible part of a volume mesh, and the view's direction.
struct InsideLook {
  std::string clip;          // see parse_clip; empty: no plane
  ClippingView view{};       // the mode alone; the plane is that of `clip`
  std::string from = "iso";  // see view_preset_table
  std::string up = "auto";   // axis that points up: z, y, or as the window guesses it
  bool perspective = false;
  /// Whether any member differs from its default.
  [[nodiscard]] bool asked_for() const { return !clip.empty() || view != ClippingView{} || from != "iso" || up != "auto" || perspective; }
};

/// Throws UsageError for words without meaning, before anything is read.
void require_sense(const InsideLook& inside);

/// Draws the mesh with its vertices at `positions`. Throws Error (no usable EGL, an unknown metric or colour map, an inside of a mesh that
/// has none) and Cancelled.
[[nodiscard]] render::Image picture_of(const InputMesh& input, std::span<const Vec3> positions, const PictureLook& look,
                                       const InsideLook& inside, const Progress& progress);
/// Draws a mesh as a PNG file's bytes, a volume from outside. Throws the errors of picture_of().
[[nodiscard]] std::string picture_png(const InputMesh& input, std::span<const Vec3> positions, const PictureLook& look,
                                      const Progress& progress);

/// A colour map as the CSS of a background, from its low end on the left.
[[nodiscard]] std::string css_gradient(std::string_view colormap);

/// Reads a mesh, draws it, writes the picture (all or nothing). Throws Error (bad input, no usable EGL, unwritable target, an inside of a
/// mesh that has none) and Cancelled. Returns 0.
int render_picture(const std::filesystem::path& input, const std::filesystem::path& output, const PictureLook& look,
                   const InsideLook& inside, const IoContext& context);

}  // namespace dmoscope::app
