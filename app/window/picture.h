#pragma once
// A picture of a mesh coloured by quality, without a window.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/progress.h"
#include "core/input/input_mesh.h"
#include "core/io/reading/io_context.h"

namespace dmoscope::app {

struct InsideLook;
}  // namespace dmoscope::app
namespace dmoscope::render {
struct Image;
}
namespace dmoscope::app {

/// How a picture of a mesh looks.
struct PictureLook {
  Metric metric = Metric::MeanRatio;
  int width = 1280, height = 800;  // pixels
  std::string colormap = "beacon";
  /// Of quality, unless `range` is given. Inverted elements apart; all but Own rounded outwards.
  enum class Spans { All, Own, Percentiles };
  Spans spans = Spans::All;
  std::pair<double, double> percent{2.0, 98.0};
  std::optional<std::pair<double, double>> range;
  bool shading = false;    // volumes lit by a lamp, too
  bool occlusion = true;   // volumes darker in corners and along edges
  double zoom = 1.0;       // times as large as the whole mesh would be shown
  std::optional<Vec3> at;  // what is in the middle; none: the middle of the mesh
  bool transparent = false;
  bool wireframe = true;
  bool colour_bar = true;
  int supersample = 2;  // 1 to 8: drawn that much larger and averaged
};

/// The mesh with its vertices at `positions`. Throws Error (no usable EGL, a metric or a colour map that there is not, an inside asked for
/// of a mesh that has none) and Cancelled.
[[nodiscard]] render::Image picture_of(const InputMesh& input, std::span<const Vec3> positions, const PictureLook& look,
                                       const InsideLook& inside, const Progress& progress);
/// The same as a PNG file's bytes, of a volume its outside.
[[nodiscard]] std::string picture_png(const InputMesh& input, std::span<const Vec3> positions, const PictureLook& look,
                                      const Progress& progress);

/// A colour map as the CSS of a background, from its low end on the left.
[[nodiscard]] std::string css_gradient(std::string_view colormap);

/// Reads, draws, writes (all or nothing). Throws Error (bad input, no usable EGL, unwritable target, an inside asked for of a mesh that has
/// none) and Cancelled. Returns 0.
int render_picture(const std::filesystem::path& input, const std::filesystem::path& output, const PictureLook& look,
                   const InsideLook& inside, const IoContext& context);

}  // namespace dmoscope::app
