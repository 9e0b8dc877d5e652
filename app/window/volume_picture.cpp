#include "app/window/volume_picture.h"

#include <fmt/format.h>

#include "app/window/picture_parts.h"
#include "core/clipping/clip_to_text.h"
#include "render/context.h"
#include "render/screenshot.h"
#include "render/volume_scene.h"
#include "ui/state/format.h"

namespace dmoscope::app {
namespace {

/// Share of visible elements: "120 of 5,000 elements"; empty if all are visible.
std::string share_seen(std::size_t seen, std::size_t all) {
  if (seen == all) return {};
  return fmt::format("{} of {}", ui::count(seen), counted(all, "element", "elements"));
}

}  // namespace

void require_sense(const InsideLook& inside) {
  if (!inside.clip.empty()) static_cast<void>(parse_clip(inside.clip, {}, {1, 1, 1}));
  static_cast<void>(render::view_preset_from_name(inside.from));
}

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
  camera.look_from(render::view_preset_from_name(inside.from));
  const Vec2<double> viewport = render::mesh_viewport(shot);
  constexpr double kMargin = 24.0;  // pixels
  scene.fit(camera, viewport, {{kMargin, kMargin}, {viewport.x - kMargin, viewport.y - kMargin}});
  if (look.at) camera.orbit_about(*look.at);
  camera.height /= look.zoom;
  return render::render_image(scene, camera, style_of(look, judged), {}, shot).image;
}

}  // namespace dmoscope::app
