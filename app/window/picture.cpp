#include "app/window/picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/window/volume_picture.h"
#include "core/base/error.h"
#include "core/io/mesh_io.h"
#include "core/quality/quality.h"
#include "render/context.h"
#include "render/scene.h"
#include "render/screenshot.h"
#include "ui/format.h"

namespace dmoscope::app {

std::string picture_png(const InputMesh& input, std::span<const Vec3> positions, const PictureLook& look, const Progress& progress) {
  require_defined(look.metric, input.mesh);
  progress.check();
  const std::size_t size = input.mesh.elements.size();
  const QualityContext quality_context = input.quality_context();
  std::vector<double> exact(size);
  element_qualities(quality_context, positions, look.metric, nullptr, exact);
  std::vector<float> quality(exact.begin(), exact.end());
  std::vector<std::uint8_t> inverted(size);
  std::size_t inverted_count = 0;
  double minimum = INFINITY;
  for (Index e = 0; e < size; ++e) {
    inverted[e] = smallest_jacobian(quality_context, positions, e) <= 0.0 ? 1 : 0;
    inverted_count += inverted[e];
    minimum = std::fmin(minimum, exact[e]);
  }
  progress.check();

  const auto context = render::create_headless_context();
  render::MeshScene scene;
  scene.set_mesh(input.mesh, input.geometry.plane);
  scene.update(positions, quality, inverted);
  render::Style style = look.transparent ? render::Style::light() : render::Style::dark();
  style.transparent = look.transparent;
  style.wireframe = look.wireframe;
  style.colours.map = render::colour_map_from_name(look.colormap);
  if (look.range) std::tie(style.colours.low, style.colours.high) = *look.range;
  render::Shot shot;
  shot.width = look.width;
  shot.height = look.height;
  shot.supersample = look.supersample;
  shot.transparent = look.transparent;
  if (look.colour_bar) {
    render::Legend legend;
    legend.title = std::string(info(look.metric).title);
    legend.subtitle =
        fmt::format("{} · {} · minimum {}", input.mesh.name, ui::counted(size, "element", "elements"), ui::short_number(minimum));
    legend.inverted = inverted_count;
    shot.legend = legend;
  }
  const render::Camera2D camera = render::Camera2D::fit(scene.bounds(), render::mesh_viewport(shot));
  return render::encode_png(render::render_image(scene, camera, style, {}, shot).image);
}

std::string css_gradient(std::string_view colormap) {
  constexpr int kStops = 10;
  const render::ColourMap map = render::colour_map_from_name(colormap);
  std::string css = "linear-gradient(to right";
  for (int i = 0; i <= kStops; ++i) {
    const render::Rgb colour = render::sample(map, static_cast<double>(i) / kStops);
    css += fmt::format(", #{:02x}{:02x}{:02x}", colour.r, colour.g, colour.b);
  }
  return css + ")";
}

namespace {

/// TODO: the metrics of volume elements.
std::vector<float> provisional_quality(const Mesh& mesh) {
  std::vector<float> quality;
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const auto c = mesh.elements.corners(e);
    double edges = 0.0, volume = 0.0;
    for (Index f = 0; f < faces_of(mesh.elements.kind(e)).size(); ++f) {
      const auto v = vertices_of(mesh.elements, {e, f});
      const std::size_t n = v[3] == kNoIndex ? 3 : 4;
      for (std::size_t i = 0; i < n; ++i) {
        const Vec3 a = mesh.positions[v[i]] - mesh.positions[c[0]], b = mesh.positions[v[(i + 1) % n]] - mesh.positions[c[0]];
        edges += 0.5 * dot(b - a, b - a);
        if (i > 0 && i + 1 < n) volume += dot(mesh.positions[v[0]] - mesh.positions[c[0]], cross(a, b)) / 6.0;
      }
    }
    const double shape = 12.0 * std::cbrt(9.0 * volume * volume) / edges;
    quality.push_back(static_cast<float>(volume > 0.0 ? shape / (c.size() == 4 ? 1.0 : c.size() == 8 ? 2.080083823 : 1.5) : -shape));
  }
  return quality;
}

}  // namespace

int render_picture(const std::filesystem::path& input, const std::filesystem::path& output, const PictureLook& look,
                   const InsideLook& inside, Progress& progress) {
  Mesh read = read_mesh(input, progress);
  if (std::ranges::any_of(read.elements.kinds(), [](ElementKind kind) { return info(kind).dimension == 3; })) {
    const FaceNeighbours faces(read, &progress);
    const std::vector<float> quality = provisional_quality(read);
    std::vector<std::uint8_t> inverted;
    for (const float q : quality) inverted.push_back(q <= 0.0F ? 1 : 0);
    write_file_atomically(output, volume_picture_png({read, faces, read.positions, quality, inverted}, look, inside));
    return 0;
  }
  if (inside.asked_for()) throw UsageError(fmt::format("{}: only a mesh of volume elements has an inside to be seen", input.string()));
  const auto mesh = prepare_input(std::move(read), input, Need::QualityOnly, progress);
  write_file_atomically(output, picture_png(*mesh, mesh->mesh.positions, look, progress));
  return 0;
}

}  // namespace dmoscope::app
