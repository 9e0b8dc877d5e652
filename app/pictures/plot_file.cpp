#include "app/pictures/plot_file.h"

#include <string>

#include <fmt/format.h>

#include "app/common/output_checks.h"
#include "core/base/error.h"
#include "core/io/writing/atomic_file.h"
#ifdef DMOSCOPE_HAVE_GUI
#include "render/drawing_picture.h"
#endif

namespace dmoscope::app {

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
