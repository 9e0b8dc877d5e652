#include "library/include/dmoscope/trace.h"

#include "core/inspect/visit_trace.h"
#include "core/mesh/geographic.h"
#include "core/run/run.h"
#include "library/mesh_data.h"
#include "library/run_options.h"
#include "library/translate.h"

namespace dmo {
namespace {

void put(double (&to)[3], const dmoscope::Vec3& p) {
  to[0] = p.x;
  to[1] = p.y;
  to[2] = p.z;
}

/// Converts a trace. `lift`: maps an offset from the vertex to space.
template <class Traced, class Lift>
Trace trace_of(const dmoscope::Mesh& mesh, const Traced& traced, const Lift& lift) {
  Trace result;
  put(result.from, in_file(mesh, traced.from));
  put(result.to, in_file(mesh, traced.to));
  result.before = quality_of(traced.before);
  result.after = quality_of(traced.after);
  result.value = traced.value_phrase;
  result.sentence = traced.sentence();
  for (const auto& level : traced.levels) {
    TraceLevel out;
    out.points = static_cast<std::size_t>(level.points);
    out.values = level.values;
    out.quality = level.quality;
    out.best = level.best ? static_cast<long>(*level.best) : -1L;
    for (const auto& offset : level.offsets) {
      const dmoscope::Vec3 place = in_file(mesh, traced.from + lift(offset));
      out.candidates.insert(out.candidates.end(), {place.x, place.y, place.z});
    }
    result.levels.push_back(std::move(out));
  }
  return result;
}

}  // namespace

Trace trace(const Mesh& mesh, Index vertex, const SmoothOptions& options) {
  return translated([&] {
    const auto input = mesh.data()->judged(options.progress.state().progress);
    if (input->is_surface()) throw dmoscope::UsageError("the search of a vertex on a curved surface is not traced here");
    if (vertex >= input->mesh.vertex_count())
      throw dmoscope::UsageError("there is no vertex " + std::to_string(vertex) + ", the mesh has " +
                                 std::to_string(input->mesh.vertex_count()));
    const RunRequest request = request_of(*input, options);
    const dmoscope::Run run(input, request.parameters, nullptr, 0);
    const dmoscope::Sweep sweep = run.sweep();
    const auto composite =
        composite_objective_of_visit(run.parameters().metric, run.parameters().combination, run.size_field(), sweep, run.guard());
    const auto& positions = input->mesh.positions;
    const auto look = [&](auto function) {
      return function(*input, positions, run.fixed(), run.parameters().metric, run.parameters().search, vertex, composite, sweep.untangling,
                      run.guard());
    };
    if (input->is_volume())
      return trace_of(input->mesh, look(dmoscope::trace_volume_visit), [](const dmoscope::Vec3& offset) { return offset; });
    const dmoscope::Plane plane = input->geometry.plane;
    return trace_of(input->mesh, look(dmoscope::trace_visit), [plane](const dmoscope::Vec2<double>& offset) { return plane.lift(offset); });
  });
}

}  // namespace dmo
