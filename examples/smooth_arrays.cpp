// smooth_arrays: a mesh that a program has in arrays of its own: quality before, smoothing, places after.

#include <cstdio>
#include <vector>

#include <dmoscope/dmoscope.h>

int main() {
  // Eight triangles around a vertex that stands far from their middle.
  const std::vector<double> positions{0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 0.2, 0.3, 0, 2, 1, 0, 0, 2, 0, 1, 2, 0, 2, 2, 0};
  const std::vector<dmo::Index> ring{0, 1, 2, 5, 8, 7, 6, 3};
  std::vector<dmo::CellKind> kinds;
  std::vector<dmo::Index> offsets{0}, connectivity;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    kinds.push_back(dmo::CellKind::Triangle);
    for (const dmo::Index corner : {dmo::Index{4}, ring[i], ring[(i + 1) % ring.size()]}) connectivity.push_back(corner);
    offsets.push_back(static_cast<dmo::Index>(connectivity.size()));
  }
  const dmo::Mesh mesh(positions.data(), positions.size() / 3, {kinds.size(), kinds.data(), offsets.data(), connectivity.data()});
  const dmo::Smoothed smoothed = dmo::smooth(mesh);
  const double* const p = smoothed.mesh.positions() + 3 * 4;
  std::printf("minimum %.4f -> %.4f, vertex 4 at (%.4f, %.4f)\n", dmo::statistics(mesh).minimum, dmo::statistics(smoothed.mesh).minimum,
              p[0], p[1]);
}
