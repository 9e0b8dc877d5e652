// progress_and_cancel: smooths arrays on another thread, shows how far that is, and ends it when enough is reached.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <future>
#include <vector>

#include <dmoscope/dmoscope.h>

int main() {
  // A sheet of 200 x 200 squares, each of two triangles; inner vertices are out of place.
  const dmo::Index n = 200, row = n + 1;
  std::vector<double> positions;
  std::vector<dmo::Index> connectivity, offsets{0};
  for (dmo::Index j = 0; j <= n; ++j)
    for (dmo::Index i = 0; i <= n; ++i) {
      const double off = i > 0 && i < n && j > 0 && j < n ? 0.35 : 0.0, turn = 1.7 * i + 2.9 * j;
      positions.insert(positions.end(), {i + off * std::cos(turn), j + off * std::sin(turn), 0.0});
    }
  for (dmo::Index j = 0; j < n; ++j)
    for (dmo::Index i = 0; i < n; ++i) {
      const dmo::Index a = i + row * j;
      for (const dmo::Index corner : {a, a + 1, a + row + 1, a, a + row + 1, a + row}) connectivity.push_back(corner);
    }
  const std::vector<dmo::CellKind> kinds(connectivity.size() / 3, dmo::CellKind::Triangle);
  for (std::size_t c = 0; c < kinds.size(); ++c) offsets.push_back(static_cast<dmo::Index>(3 * (c + 1)));

  try {
    const dmo::Mesh mesh(positions.data(), positions.size() / 3, {kinds.size(), kinds.data(), offsets.data(), connectivity.data()});
    dmo::SmoothOptions options;
    options.iterations = 1000000;  // far more than are needed
    options.after_iteration = [](const dmo::Iteration& at) {
      std::printf("iteration %llu: minimum %.4f\n", static_cast<unsigned long long>(at.number), at.statistics.minimum);
      return true;  // false would end the run, too
    };
    dmo::Progress progress = options.progress;  // shares its state with the options
    std::future<dmo::Smoothed> work = std::async(std::launch::async, [&] { return dmo::smooth(mesh, options); });
    for (int looks = 0; work.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready;) {
      std::printf("%s: %.4f %%\n", progress.label().c_str(), 100.0 * progress.fraction());
      if (++looks == 10) progress.request_cancel();
    }
    const dmo::Smoothed result = work.get();
    positions.assign(result.mesh.positions(), result.mesh.positions() + 3 * result.mesh.vertex_count());  // arrays again
    std::printf("%s after %llu iterations; minimum %.4f -> %.4f; %zu coordinates\n", result.cancelled ? "cancelled" : "done",
                static_cast<unsigned long long>(result.iteration), result.history.front().statistics.minimum,
                result.history.back().statistics.minimum, positions.size());
    return result.cancelled ? 0 : 1;
  } catch (const dmo::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
