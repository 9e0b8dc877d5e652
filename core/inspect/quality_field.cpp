#include "core/inspect/quality_field.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/thread_pool.h"
#include "core/inspect/require_star.h"
#include "core/quality/element_shape.h"
#include "core/search/mesh_star.h"
#include "core/smooth/defined_state.h"
#include "core/smooth/reference_visit.h"

namespace dmoscope {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kGrain = 16;  // rows in a chunk

template <class Frame>
StarIn<Frame, double> star_of(const InputMesh& input, PositionView positions, Index vertex) {
  require_vertex(input, vertex, std::is_same_v<Frame, Plane> ? Shape::Planar : Shape::Volume);
  if (input.topology.star(vertex).empty()) throw UsageError(fmt::format("vertex {} belongs to no element", vertex));
  StarIn<Frame, double> star;
  gather_star(MeshStar(input.view<Frame>(), positions, vertex), star);
  return star;
}

/// State of a star with the vertex at `p`, in units of the star's scale. View: of a Star or VolumeStar.
template <Metric M, class View, class Offset>
StarState state_at(const View& star, Offset p) {
  StarState state{kInfinity, kInfinity};
  star.template for_each<true>([&state, p](const auto& element) {
    const auto shape = element.with(p);
    state.quality = std::min(state.quality, evaluate_around<M>(shape, element.kMoving));
    state.jacobian = std::min(state.jacobian, formulas::smallest_jacobian_around(shape, element.kMoving) / element.reference);
  });
  return state;
}

/// Fills the field. state(offset): state of the star with the vertex there; offset(point): offset of the vertex, in mesh units.
template <class StateAt, class OffsetAt>
void fill(const StateAt& state_at, bool defined, ThreadPool* pool, const OffsetAt& offset, QualityField& field) {
  const auto width = static_cast<std::size_t>(field.columns);
  const auto middle = [](double from, double to, std::size_t i, int count) {
    return from + (to - from) * ((static_cast<double>(i) + 0.5) / count);
  };
  for_chunks(pool, static_cast<std::size_t>(field.rows), kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row)
      for (std::size_t column = 0; column < width; ++column) {
        const Vec2<double> at{middle(field.low.x, field.high.x, column, field.columns), middle(field.low.y, field.high.y, row, field.rows)};
        const StarState state = state_at(offset(at));
        field.quality[row * width + column] = defined ? static_cast<float>(state.quality) : std::numeric_limits<float>::quiet_NaN();
        field.jacobian[row * width + column] = static_cast<float>(state.jacobian);
      }
  });
}

/// Fills the field by any metric.
template <class Frame, class OffsetAt>
void fill(const InputMesh& input, PositionView positions, Metric metric, Index vertex, ThreadPool* pool, const OffsetAt& offset,
          QualityField& field) {
  const StarIn<Frame, double> star = star_of<Frame>(input, positions, vertex);
  const bool defined = defined_around(input, metric, vertex);
  if (!is_built_in(metric)) {
    const auto judge = input.quality_context().judge(metric);
    const auto star_judge = defined_star_judge<Frame>(input, *judge);
    const auto state = [&](OffsetIn<Frame, double> at) {
      return defined_star_state(star_judge, positions, vertex, positions[vertex] + star_judge.mesh.frame.lift(at));
    };
    return fill(state, defined, pool, offset, field);
  }
  const StarViewIn<Frame, double> view(star);
  const auto with = [&]<Metric M>() {
    fill([&](OffsetIn<Frame, double> at) { return state_at<M>(view, times(at, 1.0 / star.scale)); }, defined, pool, offset, field);
  };
  if constexpr (std::is_same_v<Frame, Plane>)
    formulas::with_planar_metric(metric, with);
  else
    formulas::with_volume_metric(metric, with);
}

QualityField empty_field(Vec2<double> low, Vec2<double> high, int columns, int rows) {
  if (columns < 2 || rows < 2) throw UsageError(fmt::format("a field needs at least 2 x 2 samples, not {} x {}", columns, rows));
  const std::size_t samples = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  return {low, high, columns, rows, std::vector<float>(samples), std::vector<float>(samples)};
}

}  // namespace

QualityField sample_quality(const InputMesh& input, PositionView positions, Metric metric, Index vertex, Vec2<double> low,
                            Vec2<double> high, int columns, int rows, ThreadPool* pool) {
  QualityField field = empty_field(low, high, columns, rows);
  fill<Plane>(
      input, positions, metric, vertex, pool, [](Vec2<double> at) { return at; }, field);
  return field;
}

QualityField sample_slice(const InputMesh& input, PositionView positions, Metric metric, Index vertex, const StarSlice& slice,
                          Vec2<double> low, Vec2<double> high, int columns, int rows, ThreadPool* pool) {
  QualityField field = empty_field(low, high, columns, rows);
  fill<Space>(
      input, positions, metric, vertex, pool, [&slice](Vec2<double> at) { return slice.lift(at); }, field);
  return field;
}

}  // namespace dmoscope
