// slide_on_surface: a coarse mesh of a sphere whose vertices slide on a fine mesh of it; both are arrays.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <dmoscope/dmoscope.h>

namespace {

/// Makes a sphere of radius 1 with n x n quadrilaterals on each side of a cube, which vertices leave along the sphere by up to `off` cells.
dmo::Mesh sphere(dmo::Index n, double off) {
  std::vector<double> positions;
  std::vector<dmo::Index> connectivity, offsets{0};
  std::vector<std::vector<long>> known;  // places on the cube of the vertices so far
  const auto vertex = [&](const std::vector<long>& on_cube) {
    const auto found = std::find(known.begin(), known.end(), on_cube);
    if (found != known.end()) return static_cast<dmo::Index>(found - known.begin());
    double p[3], length = 0.0;
    for (int k = 0; k < 3; ++k) {
      p[k] = std::tan(0.785398 * static_cast<double>(on_cube[static_cast<std::size_t>(k)]) / n);
      p[k] += off / n * std::sin(37.0 * static_cast<double>(known.size()) + 2.0 * k);
      length += p[k] * p[k];
    }
    for (const double x : p) positions.push_back(x / std::sqrt(length));
    known.push_back(on_cube);
    return static_cast<dmo::Index>(known.size() - 1);
  };
  const long m = n;
  for (int axis = 0; axis < 3; ++axis)
    for (const long side : {-m, m})
      for (long i = -m; i < m; i += 2)
        for (long j = -m; j < m; j += 2) {
          const auto corner = [&](long u, long v) {
            std::vector<long> on_cube(3);
            on_cube[static_cast<std::size_t>(axis)] = side;
            on_cube[static_cast<std::size_t>((axis + 1) % 3)] = side > 0 ? u : v;
            on_cube[static_cast<std::size_t>((axis + 2) % 3)] = side > 0 ? v : u;
            connectivity.push_back(vertex(on_cube));
          };
          corner(i, j), corner(i + 2, j), corner(i + 2, j + 2), corner(i, j + 2);
          offsets.push_back(static_cast<dmo::Index>(connectivity.size()));
        }
  const std::vector<dmo::CellKind> kinds(offsets.size() - 1, dmo::CellKind::Quadrilateral);
  return {positions.data(), positions.size() / 3, {kinds.size(), kinds.data(), offsets.data(), connectivity.data()}};
}

/// Returns the greatest distance of a vertex from the sphere.
double distance(const dmo::Mesh& mesh) {
  double greatest = 0.0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const double* p = mesh.positions() + 3 * v;
    greatest = std::max(greatest, std::abs(std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 1.0));
  }
  return greatest;
}

}  // namespace

int main() {
  try {
    const dmo::Mesh mesh = sphere(8, 0.25);
    dmo::SmoothOptions options;
    options.until_converged = true;
    options.max_deviation = 0.02;  // of the diagonal of the box
    options.feature_angle = 90.0;  // a sphere has no feature edges
    const dmo::Mesh alone = dmo::smooth(mesh, options).mesh;
    options.surface = sphere(32, 0.0);
    const dmo::Mesh on_fine = dmo::smooth(mesh, options).mesh;
    std::printf("minimum %.4f -> %.4f on its own surface, %.4f on the fine one\n", dmo::statistics(mesh).minimum,
                dmo::statistics(alone).minimum, dmo::statistics(on_fine).minimum);
    std::printf("distance from the sphere: %.5f on its own surface, %.5f on the fine one\n", distance(alone), distance(on_fine));
    return distance(on_fine) < distance(alone) ? 0 : 1;
  } catch (const dmo::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
