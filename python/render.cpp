// Pictures of meshes as arrays, apart from the rest of the module, for they need OpenGL's libraries.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "app/window/picture.h"
#include "core/base/error.h"
#include "core/clipping/clip_to_text.h"
#include "core/quality/metric.h"
#include "library/include/dmoscope/error.h"
#include "library/mesh_data.h"
#include "render/image.h"

namespace py = pybind11;

namespace {

template <class T>
using Array = py::array_t<T, py::array::c_style | py::array::forcecast>;

dmoscope::app::PictureLook look_of(const std::string& metric, std::pair<int, int> size, const std::string& colormap,
                                   const std::optional<std::pair<double, double>>& range, bool transparent, bool edges, bool colour_bar) {
  constexpr int kLargestSide = 16384;
  const auto [width, height] = size;
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide)
    throw py::value_error("size must be (width, height) in pixels, each 1 to 16384");
  if (range && !(range->first < range->second)) throw py::value_error("range must be (low, high) with low < high");
  dmoscope::app::PictureLook look;
  look.metric = dmoscope::parse_metric(metric);
  look.width = width;
  look.height = height;
  look.colormap = colormap;
  look.range = range;
  look.transparent = transparent;
  look.wireframe = edges;
  look.colour_bar = colour_bar;
  return look;
}

/// Draws a mesh. Returns height x width x 4 bytes: red, green, blue, opacity.
py::array_t<std::uint8_t> render(const Array<double>& points, const Array<std::uint8_t>& kinds, const Array<dmo::Index>& offsets,
                                 const Array<dmo::Index>& connectivity, const std::string& metric, std::pair<int, int> size,
                                 const std::string& colormap, const std::optional<std::pair<double, double>>& range, bool transparent,
                                 bool edges, bool colour_bar, const std::string& clip, const std::string& clip_mode,
                                 const std::string& view) {
  try {
    const auto look = look_of(metric, size, colormap, range, transparent, edges, colour_bar);
    dmoscope::app::InsideLook inside;
    inside.clip = clip;
    inside.view.clip.mode = dmoscope::parse_clip_mode(clip_mode);
    inside.from = view;
    require_sense(inside);
    const dmo::Cells cells{static_cast<std::size_t>(kinds.shape(0)), reinterpret_cast<const dmo::CellKind*>(kinds.data()), offsets.data(),
                           connectivity.data()};
    dmoscope::render::Image image;
    {
      const py::gil_scoped_release release;
      const dmo::Mesh mesh(points.data(), static_cast<std::size_t>(points.shape(0)), cells);
      const dmoscope::Progress progress;
      image = picture_of(*mesh.data()->input, mesh.data()->positions(), look, inside, progress);
    }
    py::array_t<std::uint8_t> pixels({py::ssize_t{image.height}, py::ssize_t{image.width}, py::ssize_t{4}});
    std::copy(image.rgba.begin(), image.rgba.end(), pixels.mutable_data());
    return pixels;
  } catch (const dmoscope::UsageError& error) {
    throw py::value_error(error.what());
  }
}

}  // namespace

PYBIND11_MODULE(_render, module) { module.def("render", &render); }
