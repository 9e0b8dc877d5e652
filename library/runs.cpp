// Quality, smoothing and traces.

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/base/thread_count.h"
#include "core/base/thread_pool.h"
#include "core/input/input_mesh.h"
#include "core/inspect/visit_trace.h"
#include "core/mesh/geographic.h"
#include "core/quality/defined_metric.h"
#include "core/quality/metric.h"
#include "core/quality/quality.h"
#include "core/run/crossing_faces.h"
#include "core/run/ending.h"
#include "core/run/hints.h"
#include "core/run/run.h"
#include "core/transfer/moved_fields.h"
#include "core/transfer/thin_places.h"
#include "library/include/dmoscope/quality.h"
#include "library/include/dmoscope/smooth.h"
#include "library/include/dmoscope/trace.h"
#include "library/mesh_data.h"
#include "library/run_request.h"

namespace dmo {

namespace {

Statistics statistics_of(const dmoscope::Statistics& s) {
  return {s.minimum, s.mean, s.movable_minimum, s.inverted, s.worst_element == dmoscope::kNoIndex ? 0 : s.worst_element};
}

}  // namespace

std::vector<Metric> metrics() {
  std::vector<Metric> all;
  const auto add = [&all](const dmoscope::MetricInfo& m, std::string_view title, std::string_view formula, std::string_view doc) {
    all.push_back({std::string(m.name), std::string(title), m.lowest, m.highest, std::string(formula), std::string(doc)});
  };
  for (const dmoscope::MetricInfo& m : dmoscope::metric_table()) add(m, m.title, m.formula, m.doc);
  for (const dmoscope::NamedFormula& m : dmoscope::named_formulas()) add(info(dmoscope::parse_metric(m.name)), m.title, m.formula, m.doc);
  return all;
}

std::vector<double> quality(const Mesh& mesh, const std::string& metric, unsigned threads) {
  return translated([&] {
    dmoscope::require_thread_count(threads);
    const dmoscope::Metric parsed = dmoscope::parse_metric(metric);
    dmoscope::ThreadPool pool(threads);
    std::vector<double> values(mesh.cell_count());
    dmoscope::element_qualities(mesh.data()->judge()->quality_context(), mesh.data()->judged_positions(), parsed, &pool, values);
    return values;
  });
}

Statistics statistics(const Mesh& mesh, const std::string& metric, unsigned threads) {
  return translated([&] {
    dmoscope::require_thread_count(threads);
    const auto judge = mesh.data()->judge();
    const dmoscope::InputMesh& input = *judge;
    const dmoscope::Metric parsed = dmoscope::parse_metric(metric);
    require_defined(parsed, input);
    dmoscope::ThreadPool pool(threads);
    return statistics_of(
        dmoscope::compute_statistics(input.quality_context(), mesh.data()->judged_positions(), parsed, input.topology.boundary(), &pool));
  });
}

namespace {

Held held_of(const dmoscope::HeldMinimum& found) {
  Held held;
  held.cell = found.element;
  held.quality = found.quality;
  held.by = name(found.by);
  for (const dmoscope::HeldVertex& one : found.vertices) {
    held.vertices.push_back(one.vertex);
    held.reasons.emplace_back(name(one.by));
  }
  held.change = fmt::format("{}", fmt::join(found.commands(), "; "));
  held.certified = found.certified();
  held.sentence = found.sentence();
  return held;
}

Iteration iteration_of(const dmoscope::IterationRecord& record) {
  return {record.iteration, statistics_of(record.statistics), record.moved, record.seconds};
}

/// Steps the run to the end that the request gives, or until it is cancelled.
void advance(dmoscope::Run& run, const RunRequest& request, const SmoothOptions& options, Smoothed& result) {
  dmoscope::Progress& progress = options.progress.state().progress;
  const auto after = [&](const dmoscope::Run& at) {
    if (!options.after_iteration) return;
    if (!options.after_iteration(iteration_of(at.history().records()[at.moment().iteration]))) throw dmoscope::Cancelled();
  };
  try {
    constexpr std::uint64_t kUsual = 20;
    const dmoscope::Outcome outcome = request.until_converged ? run.until_converged(request.limits, progress, after)
                                                              : run.iterate(options.iterations.value_or(kUsual), progress, after);
    const bool optimises = dmoscope::method_info(run.parameters().method).optimises;
    if (request.until_converged || !optimises || joint_moves_lose(run.parameters(), run.history().records())) run.end_at_best(progress);
    constexpr std::string_view kOfProgram = "add --until-converged", kHere = "set until_converged";
    for (std::string& sentence : missing_phases(run)) {
      if (const std::size_t at = sentence.find(kOfProgram); at != std::string::npos) sentence.replace(at, kOfProgram.size(), kHere);
      result.warnings.push_back(std::move(sentence));
    }
    result.converged = request.until_converged && outcome.reason != dmoscope::StopReason::IterationLimit;
    result.sentence = run.last_outcome().value_or(outcome).sentence();
  } catch (const dmoscope::Cancelled&) {
    result.cancelled = true;
    result.sentence = "cancelled";
  }
}

}  // namespace

Smoothed smooth(const Mesh& mesh, const SmoothOptions& options) {
  return translated([&] {
    dmoscope::Progress& progress = options.progress.state().progress;
    RunRequest request;
    try {
      progress.begin("preparing the mesh");
      request = request_of(mesh, options, progress);
    } catch (const dmoscope::Cancelled&) {
      return Smoothed{mesh, {}, 0, false, true, "cancelled", {}, {}, {}};
    }
    const auto input = request.input;
    auto pool = std::make_shared<dmoscope::ThreadPool>(options.threads);
    dmoscope::Run run(input, request.parameters, pool, 0);  // no past positions: none are returned
    Smoothed result{mesh, {}, 0, false, false, {}, std::move(request.warnings), {}, {}};
    if (std::string warning = run.take_warning(); !warning.empty()) result.warnings.push_back(std::move(warning));
    if (run.size_field() && !run.size_field()->note().empty()) result.warnings.push_back(run.size_field()->note());
    if (input->surface && !run.domain())
      result.warnings.emplace_back("surface: nothing slides on it; boundary = slide lets the vertices of a volume's boundary");
    progress.begin("smoothing");
    advance(run, request, options, result);
    if (run.visits_per_iteration() == 0) result.warnings.emplace_back("nothing can move: all vertices are fixed");
    if (options.explain && !result.cancelled) {
      progress.begin("looking for what holds the minimum");
      if (const auto found = what_holds(run, pool.get(), progress)) result.held = held_of(*found);
    }
    for (const dmoscope::IterationRecord& record : run.history().records()) result.history.push_back(iteration_of(record));
    result.iteration = run.moment().iteration;
    if (const auto left = find_left_inverted(run)) result.warnings.push_back(left->sentence());
    if (const auto crossing = find_crossing_faces(run)) result.warnings.push_back(crossing->sentence());
    std::vector<dmoscope::Vec3> positions = places_in_file(input->mesh, run.positions());
    dmoscope::Progress unwatched;  // the result until a cancel is completed
    if (input->mesh.thin) positions = places_with_back(*input, positions, pool.get(), unwatched);
    dmoscope::MovedFields fields =
        move_fields(input->mesh.thin ? *input : *mesh.data()->input, request.parameters.fields, positions, pool.get(), unwatched);
    result.fields = fields.sentence();
    result.mesh = moved_mesh(mesh, std::move(positions), std::move(fields.values));
    return result;
  });
}

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
    const RunRequest request = request_of(mesh, options, options.progress.state().progress);
    const auto& input = request.input;
    if (input->is_surface()) throw dmoscope::UsageError("the search of a vertex on a curved surface is not traced here");
    if (vertex >= input->mesh.vertex_count())
      throw dmoscope::UsageError(fmt::format("vertex: there is no vertex {}, the mesh has {}", vertex, input->mesh.vertex_count()));
    const dmoscope::Run run(input, request.parameters, nullptr, 0);
    const dmoscope::Sweep sweep = run.sweep();
    const auto composite =
        composite_objective_of_visit(run.parameters().metric, run.parameters().combination, run.place_aim(), sweep, run.guard());
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
