#pragma once
// Small meshes made in place for tests, independent of the program's own generators.

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <vector>

#include "core/input/input_mesh.h"

namespace dmoscope::testing {

/// Deterministic numbers in [0, 1) for tests (a plain linear congruential generator).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 2862933555777941757ULL + 3037000493ULL) {}
  double operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11U) * 0x1.0p-53;
  }
  double operator()(double low, double high) { return low + (high - low) * (*this)(); }

 private:
  std::uint64_t state_;
};

inline void add(Mesh& mesh, std::initializer_list<Index> corners) {
  mesh.elements.add(corners.size() == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral, std::vector<Index>(corners));
}

enum class Cells { Triangles, Quadrilaterals, Mixed };

/// (n + 1)^2 vertices on the unit square's lattice, interior ones displaced by up to `jitter` spacings.
inline Mesh lattice(Index n, double jitter, std::uint64_t seed, Cells cells = Cells::Triangles) {
  Mesh mesh;
  mesh.name = "lattice";
  Random random(seed);
  const double h = 1.0 / n;
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= n; ++i) {
      const bool inside = i > 0 && i < n && j > 0 && j < n;
      const double dx = inside ? random(-jitter, jitter) : 0.0, dy = inside ? random(-jitter, jitter) : 0.0;
      mesh.positions.push_back({(i + dx) * h, (j + dy) * h, 0.0});
    }
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index a = j * (n + 1) + i, b = a + 1, d = a + n + 1, c = d + 1;
      if (cells == Cells::Quadrilaterals || (cells == Cells::Mixed && i < n / 2)) {
        add(mesh, {a, b, c, d});
      } else if (random() < 0.5) {
        add(mesh, {a, b, c});
        add(mesh, {a, c, d});
      } else {
        add(mesh, {a, b, d});
        add(mesh, {b, c, d});
      }
    }
  return mesh;
}

inline std::shared_ptr<const InputMesh> input(Mesh mesh, Need need = Need::Smoothing) {
  Progress progress;
  return prepare_input(std::move(mesh), {}, need, progress);
}

}  // namespace dmoscope::testing
