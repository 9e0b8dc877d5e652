#include "core/inspect/quality_field.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/thread_pool.h"
#include "core/inspect/require_star.h"
#include "core/quality/element_shape.h"
#include "core/search/mesh_star.h"
#include "core/smooth/reference_visit.h"

namespace dmoscope {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kGrain = 16;  // rows a chunk

Star<double> star_of(const InputMesh& input, PositionView positions, Index vertex) {
  require_vertex(input, vertex);
  if (input.topology.star(vertex).empty()) throw UsageError(fmt::format("vertex {} belongs to no element", vertex));
  Star<double> star;
  gather_star(MeshStar<Plane>(input.planar_view(), positions, vertex), star);
  return star;
}

/// With the vertex at `p`, in units of the star's scale.
template <Metric M>
StarState state_at(const Star<double>& star, Vec2<double> p) {
  using V = Vec2<double>;
  StarState state{kInfinity, kInfinity};
  const auto take = [&state](const auto& shape, double reference) {
    state.quality = std::min(state.quality, evaluate<M>(shape));
    state.jacobian = std::min(state.jacobian, formulas::smallest_jacobian(shape) / reference);
  };
  for (const StarTriangle<double>& t : star.triangles) take(formulas::Triangle<V>(p, t.b, t.c), t.reference);
  for (const StarQuadrilateral<double>& q : star.quadrilaterals) take(formulas::Quadrilateral<V>(p, q.b, q.c, q.d), q.reference);
  return state;
}

template <Metric M>
void fill(const Star<double>& star, bool defined, ThreadPool* pool, QualityField& field) {
  const auto width = static_cast<std::size_t>(field.columns);
  const auto middle = [](double from, double to, std::size_t i, int count) {
    return from + (to - from) * ((static_cast<double>(i) + 0.5) / count);
  };
  for_chunks(pool, static_cast<std::size_t>(field.rows), kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row)
      for (std::size_t column = 0; column < width; ++column) {
        const Vec2<double> at{middle(field.low.x, field.high.x, column, field.columns), middle(field.low.y, field.high.y, row, field.rows)};
        const StarState state = state_at<M>(star, {at.x / star.scale, at.y / star.scale});
        field.quality[row * width + column] = defined ? static_cast<float>(state.quality) : std::numeric_limits<float>::quiet_NaN();
        field.jacobian[row * width + column] = static_cast<float>(state.jacobian);
      }
  });
}

}  // namespace

QualityField sample_quality(const InputMesh& input, PositionView positions, Metric metric, Index vertex, Vec2<double> low,
                            Vec2<double> high, int columns, int rows, ThreadPool* pool) {
  if (columns < 2 || rows < 2) throw UsageError(fmt::format("a field needs at least 2 x 2 samples, not {} x {}", columns, rows));
  const Star<double> star = star_of(input, positions, vertex);
  const bool defined = defined_around(input, metric, vertex);
  const std::size_t samples = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  QualityField field{low, high, columns, rows, std::vector<float>(samples), std::vector<float>(samples)};
  formulas::with_planar_metric(metric, [&]<Metric M>() { fill<M>(star, defined, pool, field); });
  return field;
}

}  // namespace dmoscope
