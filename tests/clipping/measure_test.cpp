// Time of an update of the visible part of a mesh with a million cells. Disabled: it prints figures, and fails for none of them.
//   test_clipping --gtest_also_run_disabled_tests --gtest_filter='*Milliseconds*'
#include <algorithm>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "core/base/stopwatch.h"
#include "core/clipping/clipping.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

/// Median and longest of the seconds that `update(i)` takes, in milliseconds.
template <class Update>
std::pair<double, double> milliseconds(int count, const Update& update) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) {
    const Stopwatch watch;
    update(i);
    times.push_back(1e3 * watch.seconds());
  }
  std::ranges::sort(times);
  return {times[times.size() / 2], times.back()};
}

void measure(const char* name, const Mesh& mesh) {
  const Stopwatch watch;
  const FaceNeighbours neighbours(mesh);
  std::printf("%s: %u cells, %u vertices; neighbours %.0f ms\n", name, mesh.elements.size(), mesh.vertex_count(), 1e3 * watch.seconds());
  std::vector<float> quality(mesh.elements.size());
  for (std::size_t e = 0; e < quality.size(); ++e) quality[e] = static_cast<float>(e * 2654435761U % 1000) / 1000.0F;
  for (const unsigned threads : {1U, 2U}) {
    ThreadPool pool(threads);
    Clipping inside(mesh.elements, neighbours);
    CellState state{mesh.positions, quality, {}, 1};
    const auto tell = [&](const char* what, int count, const auto& change) {
      ClippingView view;
      std::size_t faces = 0, cuts = 0;
      const auto [median, longest] = milliseconds(count, [&](int i) {
        change(view, i);
        const ClippedFaces& seen = inside.update(view, state, &pool);
        faces = seen.faces.size();
        cuts = seen.cuts.polygons.size();
      });
      std::printf("  %u threads  %-44s median %6.2f  longest %6.2f ms  (%zu faces, %zu cuts)\n", threads, what, median, longest, faces,
                  cuts);
    };
    const auto clip = [](ClippingView& view, ClipPlane::Mode mode, double offset) {
      view.clip = {.on = true, .normal = {0.3, 0.2, 1.0}, .offset = offset, .flip = false, .mode = mode};
    };
    tell("all", 1, [](ClippingView&, int) {});
    tell("clip, first time", 1, [&](ClippingView& v, int) { clip(v, ClipPlane::Mode::Crinkle, 0.7); });
    tell("clip dragged by 1/200 of the mesh, crinkle", 200,
         [&](ClippingView& v, int i) { clip(v, ClipPlane::Mode::Crinkle, 0.25 + 0.005 * i); });
    tell("clip dragged by 1/200 of the mesh, cut", 200, [&](ClippingView& v, int i) { clip(v, ClipPlane::Mode::Cut, 0.25 + 0.005 * i); });
    tell("clip turned by a degree, crinkle", 60, [&](ClippingView& v, int i) {
      clip(v, ClipPlane::Mode::Crinkle, 0.6);
      v.clip.normal = {std::sin(0.0175 * i), 0.2, std::cos(0.0175 * i)};
    });
    tell("clip flipped", 10, [&](ClippingView& v, int i) {
      clip(v, ClipPlane::Mode::Crinkle, 0.7);
      v.clip.flip = i % 2 == 0;
    });
    tell("clip, vertices moved", 20, [&](ClippingView& v, int) {
      clip(v, ClipPlane::Mode::Crinkle, 0.7);
      ++state.serial;
    });
    tell("peel, a layer more", 20, [](ClippingView& v, int i) { v.peel = static_cast<Index>(i); });
    tell("quality range dragged", 50, [](ClippingView& v, int i) { v.isolate = std::pair{0.0F, 0.02F * static_cast<float>(i)}; });
    tell("worst 100 in a ghost", 5, [](ClippingView& v, int i) {
      v.worst = 100 + static_cast<std::size_t>(i);
      v.ghost = true;
    });
    tell("shrunk", 5, [](ClippingView& v, int i) { v.shrink = 0.9 - 0.01 * i; });
  }
}

TEST(Clipping, DISABLED_MillisecondsOfAMillionHexahedra) { measure("hexahedra", test::volume_grid(100, test::Fill::Hexahedra, 0.2)); }
TEST(Clipping, DISABLED_MillisecondsOfAMillionTetrahedra) { measure("tetrahedra", test::volume_grid(55, test::Fill::Tetrahedra, 0.2)); }

}  // namespace
}  // namespace dmoscope
