#include "core/joint/determinant_samples.h"

#include <vector>

#include "core/joint/atoms.h"
#include "core/joint/mean_ratio_atom.h"

namespace dmoscope {

namespace {

template <int D>
using Samples = std::vector<DeterminantSample<D>>;

/// Sample at a corner, from the edges that leave it: its number, then those of their ends.
template <int D, class Ends>
DeterminantSample<D> at_corner(AtomShape shape, const Ends& ends) {
  const IdealWeights<D> weights = ideal_weights<D>(shape);
  DeterminantSample<D> sample{.count = D + 1};
  for (std::size_t k = 0; k <= D; ++k) sample.corners[k] = static_cast<std::uint8_t>(ends[k]);
  for (std::size_t j = 0; j < D; ++j)
    for (std::size_t c = 0; c < D; ++c) {
      sample.slopes[j + 1][c] = weights[j][c];
      sample.slopes[0][c] -= weights[j][c];
    }
  return sample;
}

template <int D>
Samples<D> corners_of(ElementKind kind) {
  Samples<D> result;
  if constexpr (D == 2) {
    const std::size_t n = info(kind).corners, count = kind == ElementKind::Triangle ? 1 : n;
    const AtomShape shape = kind == ElementKind::Triangle ? AtomShape::Triangle : AtomShape::SquareCorner;
    for (std::size_t i = 0; i < count; ++i) result.push_back(at_corner<2>(shape, std::array{i, (i + 1) % n, (i + n - 1) % n}));
  } else {
    const AtomShape shape = kind == ElementKind::Tetrahedron  ? AtomShape::Tetrahedron
                            : kind == ElementKind::Hexahedron ? AtomShape::CubeCorner
                            : kind == ElementKind::Wedge      ? AtomShape::PrismCorner
                                                              : AtomShape::PyramidCorner;
    for (const CornerTable& frame : corner_frames(kind)) result.push_back(at_corner<3>(shape, frame));
  }
  return result;
}

/// Sample at a place with coordinates in [0, 1].
DeterminantSample<3> in_hexahedron(const std::array<double, 3>& at) {
  static constexpr std::array<std::array<int, 3>, 8> kUpper{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  DeterminantSample<3> sample;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const auto weight = [&](std::size_t axis) { return kUpper[corner][axis] != 0 ? at[axis] : 1.0 - at[axis]; };
    DeterminantSample<3>::Slope slope{};
    for (std::size_t c = 0; c < 3; ++c) slope[c] = (kUpper[corner][c] != 0 ? 1.0 : -1.0) * weight((c + 1) % 3) * weight((c + 2) % 3);
    if (slope == DeterminantSample<3>::Slope{}) continue;
    sample.corners[sample.count] = static_cast<std::uint8_t>(corner);
    sample.slopes[sample.count++] = slope;
  }
  return sample;
}

Samples<3> inside_hexahedron() {
  Samples<3> result;
  for (int place = 0; place < 27; ++place) {
    const std::array<int, 3> halves{place / 9, place / 3 % 3, place % 3};
    if (halves[0] != 1 && halves[1] != 1 && halves[2] != 1) continue;  // no corner
    result.push_back(in_hexahedron({0.5 * halves[0], 0.5 * halves[1], 0.5 * halves[2]}));
  }
  return result;
}

/// Sample in the middle of the edge from corner i to i + 3, with the mean of the two triangles' slopes there.
DeterminantSample<3> in_wedge(std::size_t i) {
  const std::size_t next = (i + 1) % 3, last = (i + 2) % 3;
  const IdealWeights<3> weights = ideal_weights<3>(AtomShape::PrismCorner);
  DeterminantSample<3> sample{.count = 6, .corners = {0, 1, 2, 3, 4, 5}};
  for (std::size_t c = 0; c < 3; ++c) {
    for (const std::size_t layer : {0U, 3U}) {
      sample.slopes[layer + next][c] += 0.5 * weights[0][c];
      sample.slopes[layer + last][c] += 0.5 * weights[1][c];
      sample.slopes[layer + i][c] -= 0.5 * (weights[0][c] + weights[1][c]);
    }
    sample.slopes[i + 3][c] += weights[2][c];
    sample.slopes[i][c] -= weights[2][c];
  }
  return sample;
}

}  // namespace

template <>
std::span<const DeterminantSample<2>> corner_samples<2>(ElementKind kind) {
  static const std::array<Samples<2>, 2> kAll{corners_of<2>(ElementKind::Triangle), corners_of<2>(ElementKind::Quadrilateral)};
  return kAll[kind == ElementKind::Triangle ? 0 : 1];
}
template <>
std::span<const DeterminantSample<3>> corner_samples<3>(ElementKind kind) {
  static const std::array<Samples<3>, 4> kAll{corners_of<3>(ElementKind::Tetrahedron), corners_of<3>(ElementKind::Hexahedron),
                                              corners_of<3>(ElementKind::Wedge), corners_of<3>(ElementKind::Pyramid)};
  return kAll[static_cast<std::size_t>(kind) - static_cast<std::size_t>(ElementKind::Tetrahedron)];
}

template <>
std::span<const DeterminantSample<2>> inner_samples<2>(ElementKind /*kind*/) {
  return {};
}
template <>
std::span<const DeterminantSample<3>> inner_samples<3>(ElementKind kind) {
  static const Samples<3> kHexahedron = inside_hexahedron(), kWedge{in_wedge(0), in_wedge(1), in_wedge(2)};
  if (kind == ElementKind::Hexahedron) return kHexahedron;
  return kind == ElementKind::Wedge ? std::span<const DeterminantSample<3>>(kWedge) : std::span<const DeterminantSample<3>>();
}

}  // namespace dmoscope
