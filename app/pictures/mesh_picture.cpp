#include "app/pictures/mesh_picture.h"

#include "core/base/error.h"
#ifdef DMOSCOPE_HAVE_GUI
#include "app/window/picture.h"
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

}  // namespace dmoscope::app
