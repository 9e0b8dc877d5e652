#include "app/window/picture.h"

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/common/console.h"
#include "core/base/error.h"
#include "core/clipping/clip_to_text.h"
#include "core/io/mesh_io.h"
#include "core/io/writing/atomic_file.h"
#include "core/mesh/seam.h"
#include "core/quality/quality.h"
#include "core/view/input_spread.h"
#include "render/context.h"
#include "render/planar_scene.h"
#include "render/screenshot.h"
#include "render/volume_scene.h"
#include "ui/state/format.h"
#include "ui/state/view_geometry.h"

namespace dmoscope::app {
namespace {

/// Share of visible elements: "120 of 5,000 elements"; empty if all are visible.
std::string share_seen(std::size_t seen, std::size_t all) {
  if (seen == all) return {};
  return fmt::format("{} of {}", ui::count(seen), counted(all, "element", "elements"));
}

/// Qualities of a mesh's elements.
struct JudgedElements {
  std::vector<float> quality;  // NaN: not defined
  std::vector<std::uint8_t> inverted;
  std::size_t inverted_count;
  double minimum;  // infinity if no quality is defined
};

/// Judges the mesh with its vertices at `positions`. Throws UsageError for a metric that is not defined for its elements, and Cancelled.
JudgedElements judge(const InputMesh& input, std::span<const Vec3> positions, Metric metric, const Progress& progress) {
  require_defined(metric, input);
  progress.check();
  const std::size_t size = input.mesh.elements.size();
  const QualityContext context = input.quality_context();
  std::vector<double> exact(size);
  element_qualities(context, positions, metric, nullptr, exact);
  JudgedElements judged{{exact.begin(), exact.end()}, std::vector<std::uint8_t>(size), 0, INFINITY};
  for (Index e = 0; e < size; ++e) {
    judged.inverted[e] = smallest_jacobian(context, positions, e) <= 0.0 ? 1 : 0;
    judged.inverted_count += judged.inverted[e];
    judged.minimum = std::fmin(judged.minimum, exact[e]);
  }
  progress.check();
  return judged;
}

std::pair<double, double> range_of(const PictureLook& look, const JudgedElements& judged) {
  if (look.range) return *look.range;
  InputSpread spread;
  for (std::size_t e = 0; e < judged.quality.size(); ++e)
    if (judged.inverted[e] == 0) spread.add(static_cast<double>(judged.quality[e]));
  using Spans = PictureLook::Spans;
  const auto range = look.spans == Spans::Own           ? spread.range()
                     : look.spans == Spans::Percentiles ? spread.percentiles(look.percent.first, look.percent.second)
                                                        : spread.range_without_tail();
  if (!range) return {0.0, 1.0};
  if (look.spans != Spans::Own) return tidy_range(*range);
  return range->second > range->first ? *range : std::pair{0.0, 1.0};
}

render::Style style_of(const PictureLook& look, const JudgedElements& judged) {
  render::Style style = look.transparent ? render::Style::light() : render::Style::dark();
  style.transparent = look.transparent;
  style.wireframe = look.wireframe;
  style.colours.map = render::colour_map_from_name(look.colormap);
  style.shading = look.shading;
  style.occlusion = look.occlusion;
  std::tie(style.colours.low, style.colours.high) = range_of(look, judged);
  return style;
}

render::Shot shot_of(const InputMesh& input, const JudgedElements& judged, const PictureLook& look) {
  render::Shot shot;
  shot.width = look.width;
  shot.height = look.height;
  shot.supersample = look.supersample;
  shot.transparent = look.transparent;
  if (!look.colour_bar) return shot;
  render::Legend legend;
  legend.title = std::string(info(look.metric).title);
  legend.subtitle = fmt::format("{} · {} · minimum {}", input.mesh.name, counted(judged.quality.size(), "element", "elements"),
                                ui::short_number(judged.minimum));
  legend.inverted = judged.inverted_count;
  shot.legend = legend;
  return shot;
}

/// Draws a mesh in space: see picture_of().
render::Image volume_picture(const InputMesh& input, std::span<const Vec3> positions, const PictureLook& look, const InsideLook& inside,
                             const Progress& progress) {
  const JudgedElements judged = judge(input, positions, look.metric, progress);
  const auto context = render::create_headless_context();
  ThreadPool pool;
  render::VolumeScene scene;
  scene.set_pool(&pool);
  scene.set_mesh(input.mesh.elements, input.faces);
  scene.update({positions, judged.quality, judged.inverted, 1});
  ClippingView view = inside.view;
  if (!inside.clip.empty()) {
    view.clip = parse_clip(inside.clip, scene.bounds().low, scene.bounds().high);
    view.clip.mode = inside.view.clip.mode;
  }
  scene.set_view(view);
  render::Shot shot = shot_of(input, judged, look);
  if (shot.legend) shot.legend->selection = share_seen(scene.faces().visible_cells, judged.quality.size());
  render::OrbitCamera camera;
  camera.perspective = inside.perspective;
  camera.up_axis = inside.up == "auto" ? ui::guessed_up(input) : inside.up == "y" ? render::UpAxis::Y : render::UpAxis::Z;
  camera.look_from(render::view_preset_from_name(inside.from));
  const Vec2<double> viewport = render::mesh_viewport(shot);
  constexpr double kMargin = 24.0;  // pixels
  scene.fit(camera, viewport, {{kMargin, kMargin}, {viewport.x - kMargin, viewport.y - kMargin}});
  if (look.at) camera.orbit_about(*look.at);
  camera.height /= look.zoom;
  return render::render_image(scene, camera, style_of(look, judged), {}, shot).image;
}

}  // namespace

render::Image picture_of(const InputMesh& input, std::span<const Vec3> positions, const PictureLook& look, const InsideLook& inside,
                         const Progress& progress) {
  if (input.in_space()) return volume_picture(input, positions, look, inside, progress);
  if (inside.asked_for())
    throw UsageError(
        fmt::format("{}: this option works only on volume meshes", input.path.empty() ? input.mesh.name : input.path.string()));
  const JudgedElements judged = judge(input, positions, look.metric, progress);
  const auto context = render::create_headless_context();
  render::PlanarScene scene;
  scene.set_mesh(input.mesh, input.geometry.plane);
  scene.update(positions, judged.quality, judged.inverted);
  const render::Shot shot = shot_of(input, judged, look);
  render::Camera2D camera = render::Camera2D::fit(scene.bounds(), render::mesh_viewport(shot));
  if (look.at) camera.centre = input.geometry.plane.place(*look.at);
  camera.units_per_pixel /= look.zoom;
  return render::render_image(scene, camera, style_of(look, judged), {}, shot).image;
}

std::string picture_png(const InputMesh& input, std::span<const Vec3> positions, const PictureLook& look, const Progress& progress) {
  return render::encode_png(picture_of(input, positions, look, {}, progress));
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

int render_picture(const std::filesystem::path& input, const std::filesystem::path& output, const PictureLook& look,
                   const InsideLook& inside, const IoContext& context) {
  const Progress& progress = context.progress;
  const auto mesh = load_input(input, Need::QualityOnly, context);
  if (const std::string left_out = left_out_of_pictures(mesh->report.seam_elements, mesh->geometry.plane); !left_out.empty())
    complain(fmt::format("{}: {}", mesh->mesh.name, left_out));
  write_file_atomically(output, render::encode_png(picture_of(*mesh, mesh->mesh.positions, look, inside, progress)));
  return 0;
}

void require_sense(const InsideLook& inside) {
  if (!inside.clip.empty()) static_cast<void>(parse_clip(inside.clip, {}, {1, 1, 1}));
  static_cast<void>(render::view_preset_from_name(inside.from));
}

}  // namespace dmoscope::app
