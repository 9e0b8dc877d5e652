#include "core/inspect/quality_field.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/thread_pool.h"
#include "core/inspect/require_star.h"
#include "core/smooth/visit/star_judge.h"

namespace dmoscope {

namespace {

constexpr std::size_t kGrain = 16;  // rows in a chunk

/// Fills the field by any metric. offset(point): offset of the vertex, in mesh units.
template <class Frame, class OffsetAt>
void fill(const InputMesh& input, PositionView positions, Metric metric, Index vertex, ThreadPool* pool, const OffsetAt& offset,
          QualityField& field) {
  require_vertex(input, vertex, std::is_same_v<Frame, Plane> ? Shape::Planar : Shape::Volume);
  if (input.topology.star(vertex).empty()) throw UsageError(fmt::format("vertex {} belongs to no element", vertex));
  const StarJudge<Frame> judge(input, single_objective(metric));
  const bool defined = defined_around(input, metric, vertex);
  const auto width = static_cast<std::size_t>(field.columns);
  const auto middle = [](double from, double to, std::size_t i, int count) {
    return from + (to - from) * ((static_cast<double>(i) + 0.5) / count);
  };
  for_chunks(pool, static_cast<std::size_t>(field.rows), kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row)
      for (std::size_t column = 0; column < width; ++column) {
        const Vec2<double> at{middle(field.low.x, field.high.x, column, field.columns), middle(field.low.y, field.high.y, row, field.rows)};
        const Vec3 place = displaced(judge.mesh().frame, positions[vertex], offset(at), false);
        const StarState state = judge.state(metric, positions, vertex, place);
        field.quality[row * width + column] = defined ? static_cast<float>(state.quality) : std::numeric_limits<float>::quiet_NaN();
        field.jacobian[row * width + column] = static_cast<float>(state.jacobian);
      }
  });
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
