#pragma once
// The generators behind generate_mesh() and what they share.

#include <cstdint>
#include <functional>
#include <span>

#include "core/base/progress.h"
#include "core/mesh/mesh.h"
#include "core/mesh/random.h"

namespace dmoscope::generators {

/// Request for a sample: approximate number of vertices, seed of its random numbers, and progress to report to.
struct Request {
  std::size_t size;
  std::uint64_t seed;
  Progress& progress;
};

[[nodiscard]] Mesh coast(const Request& request);
[[nodiscard]] Mesh block(const Request& request);
[[nodiscard]] Mesh annulus(const Request& request);
[[nodiscard]] Mesh random_points(const Request& request);
[[nodiscard]] Mesh quads(const Request& request);
[[nodiscard]] Mesh mixed(const Request& request);
[[nodiscard]] Mesh tangled(const Request& request);
[[nodiscard]] Mesh grid(const Request& request);
[[nodiscard]] Mesh wrapped(const Request& request);
[[nodiscard]] Mesh globe(const Request& request);
[[nodiscard]] Mesh tetrahedra(const Request& request);
[[nodiscard]] Mesh hexahedra(const Request& request);
[[nodiscard]] Mesh biased(const Request& request);
[[nodiscard]] Mesh mixed_volumes(const Request& request);
[[nodiscard]] Mesh tangled_volumes(const Request& request);
[[nodiscard]] Mesh screw(const Request& request);
[[nodiscard]] Mesh elbow(const Request& request);
[[nodiscard]] Mesh can(const Request& request);
[[nodiscard]] Mesh nested(const Request& request);
[[nodiscard]] Mesh nested_volumes(const Request& request);
[[nodiscard]] Mesh anisotropic(const Request& request);

/// Cosine and sine of an angle in turns, from additions and multiplications alone: the same bits with every mathematics library.
[[nodiscard]] double cos_turns(double turns);
[[nodiscard]] double sin_turns(double turns);

/// Smooth noise in (-1, 1) with features of size 1, equal on every machine.
[[nodiscard]] double noise(double x, double y, std::uint64_t seed);
/// Sum of `octaves` of noise(), each half as large and twice as fine as the one before.
[[nodiscard]] double fractal_noise(double x, double y, int octaves, std::uint64_t seed);

/// Rounds to a multiple of 1 / per_unit (a power of ten), so that a text file shows short numbers.
[[nodiscard]] double neat(double x, double per_unit = 1e6);

/// Form of a lattice cell: one quadrilateral, or two triangles by the direction of the diagonal. add_cells() adds the elements of a lattice
/// of nx x ny cells whose vertex (i, j) has the index i + j * columns, columns = nx + 1, or nx if it closes to a ring; `cell(i, j)` chooses
/// the form.
enum class Cell { Quadrilateral, RisingDiagonal, FallingDiagonal };
void add_cells(ElementTable& elements, Index nx, Index ny, bool ring, const std::function<Cell(Index, Index)>& cell);

/// Moves the vertices by `offsets`, each as far as all its elements keep a tenth of their smallest corner Jacobian; rounds with neat(x,
/// per_unit). The mesh must have no inverted element before; z stays as it is.
void displace(Mesh& mesh, std::span<const Vec3> offsets, double per_unit, Progress& progress);

}  // namespace dmoscope::generators
