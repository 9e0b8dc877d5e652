#include "app/window/volume_picture.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/inside/clip_words.h"
#include "render/context.h"
#include "render/screenshot.h"
#include "ui/format.h"

namespace dmoscope::app {
namespace {

/// "120 of 5,000 elements", empty when all are seen.
std::string share_seen(std::size_t seen, std::size_t all) {
  if (seen == all) return {};
  return fmt::format("{} of {}", ui::count(seen), ui::counted(all, "element", "elements"));
}

render::Legend legend_of(const JudgedVolume& volume, const PictureLook& look, std::size_t seen) {
  float minimum = INFINITY;
  for (const float q : volume.quality) minimum = std::fmin(minimum, q);
  const std::size_t size = volume.mesh.elements.size();
  render::Legend legend;
  legend.title = std::string(info(look.metric).title);
  legend.subtitle = fmt::format("{} · {} · minimum {}", volume.mesh.name, ui::counted(size, "element", "elements"),
                                ui::short_number(static_cast<double>(minimum)));
  legend.inverted = static_cast<std::size_t>(std::ranges::count_if(volume.inverted, [](std::uint8_t i) { return i != 0; }));
  legend.undefined = std::ranges::any_of(volume.quality, [](float q) { return std::isnan(q); });
  legend.selection = share_seen(seen, size);
  return legend;
}

}  // namespace

void require_sense(const InsideLook& inside) {
  if (!inside.clip.empty()) static_cast<void>(parse_clip(inside.clip, {}, {1, 1, 1}));
  static_cast<void>(render::view_preset_from_name(inside.from));
}

std::string volume_picture_png(const JudgedVolume& volume, const PictureLook& look, const InsideLook& inside) {
  const auto context = render::create_headless_context();
  ThreadPool pool;
  render::VolumeScene scene;
  scene.set_pool(&pool);
  scene.set_mesh(volume.mesh.elements, volume.faces);
  scene.update({volume.positions, volume.quality, volume.inverted, 1});
  InsideView view = inside.view;
  if (!inside.clip.empty()) {
    const ClipPlane::Mode mode = view.clip.mode;
    view.clip = parse_clip(inside.clip, scene.bounds().low, scene.bounds().high);
    view.clip.mode = mode;
  }
  scene.set_view(view);
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
  if (look.colour_bar) shot.legend = legend_of(volume, look, scene.faces().visible_cells);
  render::OrbitCamera camera;
  camera.perspective = inside.perspective;
  camera.look_from(render::view_preset_from_name(inside.from));
  camera.fit(scene.bounds(), render::mesh_viewport(shot));
  return render::encode_png(render::render_image(scene, camera, style, {}, shot).image);
}

}  // namespace dmoscope::app
