// Time of drawing the inside of a mesh of a million cells. Disabled: it prints figures, and fails for none of them.
//   test_render --gtest_also_run_disabled_tests --gtest_filter='*Milliseconds*'
#include <algorithm>
#include <cstdio>

#include "core/base/stopwatch.h"
#include "render/gl.h"
#include "render/volume_scene.h"
#include "tests/render/fixture.h"
#include "tests/support/volume_grids.h"

namespace dmoscope::render {
namespace {

class VolumeSpeed : public WithContext {
 protected:
  void measure(ThreadPool* pool);
};

/// Measures on the window's thread alone, or with other threads.
void VolumeSpeed::measure(ThreadPool* pool) {
  std::printf("%u threads\n", pool == nullptr ? 1U : pool->size());
  const Mesh mesh = test::volume_grid(100, test::Fill::Hexahedra, 0.2);
  const FaceNeighbours neighbours(mesh);
  std::vector<float> quality(mesh.elements.size());
  for (std::size_t e = 0; e < quality.size(); ++e) quality[e] = static_cast<float>(e * 2654435761U % 1000) / 1000.0F;
  VolumeScene space;
  space.set_pool(pool);
  space.set_mesh(mesh.elements, neighbours);
  target->resize(1280, 800);
  OrbitCamera camera;
  camera.look_from(ViewPreset::Isometric);
  const auto tell = [&](const char* what, int count, double detail, const auto& change) {
    std::vector<double> times;
    for (int i = 0; i < count; ++i) {
      const Stopwatch watch;
      change(i);
      space.draw(*target, camera, Style::dark(), {}, detail);
      glFinish();
      times.push_back(1e3 * watch.seconds());
    }
    std::ranges::sort(times);
    std::printf("%-44s median %7.1f  longest %7.1f ms  (%zu faces)\n", what, times[times.size() / 2], times.back(),
                space.faces().faces.size());
  };
  ClippingView view;
  std::uint64_t serial = 0;
  tell("vertices moved", 5, 1.0, [&](int) {
    space.update({mesh.positions, quality, {}, ++serial});
    camera.fit(space.bounds(), {1280, 800});
  });
  tell("turned", 10, 1.0, [&](int) { camera.turn({5, 0}, {1280, 800}); });
  tell("turned, a fourth", 10, 0.25, [&](int) { camera.turn({5, 0}, {1280, 800}); });
  for (const auto mode : {ClipPlane::Mode::Crinkle, ClipPlane::Mode::Cut}) {
    tell(mode == ClipPlane::Mode::Cut ? "clip dragged, cut" : "clip dragged, crinkle", 20, 1.0, [&](int i) {
      view.clip = {.on = true, .normal = {1, -0.5, 0.7}, .offset = 0.3 + 0.02 * i, .flip = false, .mode = mode};
      space.set_view(view);
    });
  }
  const Stopwatch looking;
  const auto unhidden = space.unhidden(camera, {1280, 800});
  std::printf("what nothing hides among %zu faces %.1f ms (%zu vertices)\n", space.faces().faces.size(), 1e3 * looking.seconds(),
              unhidden ? unhidden->vertices.size() : 0);
  view = {};
  view.shrink = 0.8;
  tell("shrunk, one fortieth", 5, 0.025, [&](int i) {
    view.shrink = 0.8 - 0.01 * i;
    space.set_view(view);
  });
  tell("shrunk, turned, one fortieth", 5, 0.025, [&](int) { camera.turn({5, 0}, {1280, 800}); });
  const Stopwatch watch;
  static_cast<void>(space.pick(camera, {1280, 800}, {640, 400}));
  std::printf("pick among %zu faces %.1f ms\n", space.faces().faces.size(), 1e3 * watch.seconds());
}

TEST_F(VolumeSpeed, DISABLED_MillisecondsOfAMillionHexahedra) {
  measure(nullptr);
  ThreadPool pool;
  measure(&pool);
}

}  // namespace
}  // namespace dmoscope::render
