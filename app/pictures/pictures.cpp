#include "app/pictures/pictures.h"

#include <fmt/format.h>

#include "app/common/output_checks.h"
#include "core/base/error.h"
#include "core/io/writing/atomic_file.h"
#ifdef DMOSCOPE_HAVE_GUI
#include "app/window/picture.h"
#include "render/drawing_picture.h"
#endif

namespace dmoscope::app {

std::string quality_gradient() {
#ifdef DMOSCOPE_HAVE_GUI
  return css_gradient(PictureLook{}.colormap);
#else
  return {};
#endif
}

MeshPicture picture_of_mesh(const InputMesh& input, std::span<const Vec3> positions, Metric metric, const Progress& progress, double low) {
  require_defined(metric, input);
#ifdef DMOSCOPE_HAVE_GUI
  PictureLook look;
  look.metric = metric;
  look.range = {low, 1.0};
  look.width = 800;
  look.height = 600;
  look.transparent = true;
  look.colour_bar = false;
  try {
    return {picture_png(input, positions, look, progress), {}};
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    return {{}, error.what()};
  }
#else
  static_cast<void>(positions), static_cast<void>(progress), static_cast<void>(low);
  return {{}, "this program was built without OpenGL, so it makes no pictures"};
#endif
}

void require_plot_target(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
#ifndef DMOSCOPE_HAVE_GUI
  if (extension == ".png") throw UsageError("this program was built without its window, so it plots .svg only");
#endif
  if (extension != ".svg" && extension != ".png") throw UsageError(fmt::format("{}: plots are written as .svg or .png", path.string()));
  require_writable(path);
}

std::string plot_bytes([[maybe_unused]] const std::filesystem::path& path, const Drawing& drawing) {
#ifdef DMOSCOPE_HAVE_GUI
  if (path.extension() == ".png") return render::encode_png(render::picture_of(drawing));
#endif
  return svg_of(drawing);
}

void write_plot(const std::filesystem::path& path, const Drawing& drawing) { write_file_atomically(path, plot_bytes(path, drawing)); }

}  // namespace dmoscope::app
