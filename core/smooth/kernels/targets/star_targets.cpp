#include "core/smooth/kernels/targets/star_targets.h"

#include <array>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/thread_pool.h"

namespace dmoscope {

namespace {

constexpr std::size_t kStarsAtOnce = 8192;

/// Writer of the targets of corners in their order in memory.
class Writer {
 public:
  Writer(const TargetTable& targets, bool crossed, std::vector<double>& to) : targets_(targets), crossed_(crossed), to_(to) {}

  /// Writes the target of a triangle for the edges that leave `corner`. Its matrix is for those that leave the first.
  void triangle(Index element, std::size_t corner) {
    // Gives the first corner's edges by those of this one, as columns.
    static const std::array<SmallMatrix, 3> kFirst{SmallMatrix{2, {{{1, 0, 0}, {0, 1, 0}, {}}}},
                                                   SmallMatrix{2, {{{0, 1, 0}, {-1, -1, 0}, {}}}},
                                                   SmallMatrix{2, {{{-1, -1, 0}, {1, 0, 0}, {}}}}};
    write(element, 0, ElementKind::Triangle, kFirst[corner]);
  }
  void corner_of_quadrilateral(Index element, std::size_t corner) {
    write(element, corner, ElementKind::Quadrilateral, SmallMatrix::identity(2));
  }

 private:
  void write(Index element, std::size_t matrix, ElementKind kind, const SmallMatrix& first) {
    const ElementTarget target = targets_.of(element);
    SmallMatrix right = inverse(ideal_edges(kind)), left = SmallMatrix::identity(2);
    if (target.space == FormulaSpace::Target) right = at(target.matrices + 4 * matrix) * right;
    if (target.space == FormulaSpace::Stretched) left = at(target.matrices);
    right = first * right;
    // Turns the matrix from the right until it is lower triangular.
    const double l11 = std::hypot(right.at[0][0], right.at[0][1]), c = right.at[0][0] / l11, s = right.at[0][1] / l11;
    const double l21 = right.at[1][0] * c + right.at[1][1] * s, l22 = determinant(right) / l11;
    const double size = 1.0 / std::sqrt(l11 * l22);
    for (const double number : {l11 * size, l21 * size, l22 * size, target.steepness}) to_.push_back(number);
    if (!crossed_) return;
    const double stretch = 1.0 / std::sqrt(left.at[0][0] * left.at[1][1]);
    for (const double number : {left.at[0][0] * stretch, left.at[0][1] * stretch, left.at[1][1] * stretch}) to_.push_back(number);
  }
  static SmallMatrix at(const double* m) { return {2, {{{m[0], m[1], 0}, {m[2], m[3], 0}, {}}}}; }

  const TargetTable& targets_;
  bool crossed_;
  std::vector<double>& to_;
};

[[nodiscard]] std::size_t target_count(const StarShape& shape) { return shape.triangles + kQuadrilateralTargets * shape.quadrilaterals; }

}  // namespace

bool has_crossed_targets(const TargetTable& targets, Index elements) {
  for (Index e = 0; e < elements; ++e)
    if (targets.of(e).space == FormulaSpace::Stretched) return true;
  return false;
}

void append_star_targets(const TargetTable& targets, bool crossed, const Mesh& mesh, const Topology& topology, Index vertex,
                         const StarShape& shape, std::span<const Index> others, std::vector<double>& numbers) {
  Writer writer(targets, crossed, numbers);
  const auto star = topology.star(vertex);
  if (shape.kind == StarShape::Kind::Fan) {
    std::uint64_t used = 0;
    for (std::size_t i = 0; i < others.size(); ++i) {
      const Index b = others[i], c = others[i + 1 < others.size() ? i + 1 : 0];
      for (std::size_t k = 0; k < star.size(); ++k) {
        const auto corners = mesh.elements.corners(star[k].element);
        if ((used >> k & 1U) != 0 || corners[(star[k].corner + 1) % 3] != b || corners[(star[k].corner + 2) % 3] != c) continue;
        used |= std::uint64_t{1} << k;
        writer.triangle(star[k].element, star[k].corner);
        break;
      }
    }
    return;
  }
  for (const Incidence& at : star)
    if (mesh.elements.corners(at.element).size() == 3) writer.triangle(at.element, at.corner);
  for (const Incidence& at : star)
    if (mesh.elements.corners(at.element).size() == 4)
      for (const Index way : {0U, 1U, 3U, 2U}) writer.corner_of_quadrilateral(at.element, (at.corner + way) % 4);
}

StarTargets build_star_targets(const TargetTable& targets, bool crossed, const Mesh& mesh, const Topology& topology, const StarTable& table,
                               ThreadPool* pool) {
  StarTargets all;
  const std::size_t numbers = target_numbers(crossed), ranks = table.shapes.size() - 1;
  all.first = large_vector<std::uint32_t>(ranks + 1);
  std::uint64_t end = 0;
  for (std::size_t rank = 0; rank < ranks; ++rank) {
    all.first[rank] = static_cast<std::uint32_t>(end);
    end += target_count(table.shapes[rank]);
  }
  if (end > std::numeric_limits<std::uint32_t>::max())
    throw UsageError("the mesh is too large to be smoothed with targets: its stars have 2^32 corners or more");
  all.numbers = large_vector<double>(end * numbers);
  for_chunks(pool, ranks, kStarsAtOnce, [&](std::size_t first, std::size_t last) {
    std::vector<double> one;
    std::vector<Index> others;
    for (std::size_t rank = first; rank < last; ++rank) {
      const StarShape& shape = table.shapes[rank];
      if (shape.kind == StarShape::Kind::Alone) continue;
      others.clear();
      for (std::uint32_t i = shape.first; i < table.shapes[rank + 1].first; ++i) others.push_back(table.vertex_of_rank[table.others[i]]);
      one.clear();
      append_star_targets(targets, crossed, mesh, topology, table.vertex_of_rank[rank], shape, others, one);
      std::copy(one.begin(), one.end(), all.numbers.begin() + static_cast<std::ptrdiff_t>(all.first[rank] * numbers));
    }
  });
  return all;
}

}  // namespace dmoscope
