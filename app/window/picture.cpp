#include "app/window/picture.h"

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/quality/quality.h"
#include "core/session/input_mesh.h"
#include "render/context.h"
#include "render/scene.h"
#include "render/screenshot.h"
#include "ui/format.h"

namespace dmoscope::app {

int render_picture(const PictureOptions& options, Progress& progress) {
  const auto input = load_input(options.input, Need::QualityOnly, progress);
  require_defined(options.metric, input->mesh);
  progress.check();
  const std::size_t size = input->mesh.elements.size();
  const QualityContext quality_context = input->quality_context();
  std::vector<double> exact(size);
  element_qualities(quality_context, input->mesh.positions, options.metric, nullptr, exact);
  std::vector<float> quality(exact.begin(), exact.end());
  std::vector<std::uint8_t> inverted(size);
  std::size_t inverted_count = 0;
  double minimum = INFINITY;
  for (Index e = 0; e < size; ++e) {
    inverted[e] = smallest_jacobian(quality_context, input->mesh.positions, e) <= 0.0 ? 1 : 0;
    inverted_count += inverted[e];
    minimum = std::fmin(minimum, exact[e]);
  }
  progress.check();

  const auto context = render::create_headless_context();
  render::MeshScene scene;
  scene.set_mesh(input->mesh, input->geometry.plane);
  scene.update(input->mesh.positions, quality, inverted);
  render::Style style = options.transparent ? render::Style::light() : render::Style::dark();
  style.transparent = options.transparent;
  style.wireframe = options.wireframe;
  style.colours.map = render::colour_map_from_name(options.colormap);
  if (options.range) std::tie(style.colours.low, style.colours.high) = *options.range;
  render::Shot shot;
  shot.width = options.width;
  shot.height = options.height;
  shot.supersample = options.supersample;
  shot.transparent = options.transparent;
  if (options.colour_bar) {
    render::Legend legend;
    legend.title = std::string(info(options.metric).title);
    legend.subtitle =
        fmt::format("{} · {} · minimum {}", input->mesh.name, ui::counted(size, "element", "elements"), ui::short_number(minimum));
    legend.inverted = inverted_count;
    shot.legend = legend;
  }
  const render::Camera2D camera = render::Camera2D::fit(scene.bounds(), render::mesh_viewport(shot));
  render::write_png(options.output, render::render_image(scene, camera, style, {}, shot).image);
  return 0;
}

}  // namespace dmoscope::app
