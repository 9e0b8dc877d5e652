#include "library/include/dmoscope/smooth.h"

#include <memory>
#include <utility>

#include "core/base/thread_pool.h"
#include "core/input/input_mesh.h"
#include "core/mesh/geographic.h"
#include "core/run/crossing_faces.h"
#include "core/run/ending.h"
#include "core/run/run.h"
#include "core/transfer/moved_fields.h"
#include "core/transfer/thin_places.h"
#include "library/mesh_data.h"
#include "library/run_options.h"
#include "library/statistics.h"
#include "library/translate.h"

namespace dmo {
namespace {

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
    if (request.until_converged || !optimises) run.end_at_best(progress);
    for (std::string& sentence : missing_phases(run)) result.warnings.push_back(std::move(sentence));
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
    std::shared_ptr<const dmoscope::InputMesh> input;
    try {
      input = mesh.data()->judged(progress);
    } catch (const dmoscope::Cancelled&) {
      return Smoothed{mesh, {}, 0, false, true, "cancelled", {}, {}};
    }
    RunRequest request = request_of(*input, options);
    auto pool = std::make_shared<dmoscope::ThreadPool>(options.threads);
    dmoscope::Run run(input, request.parameters, pool, 0);  // no past positions: none are returned
    require_fields(request.parameters.fields, input->mesh);
    Smoothed result{mesh, {}, 0, false, false, {}, std::move(request.warnings), {}};
    if (std::string warning = run.take_warning(); !warning.empty()) result.warnings.push_back(std::move(warning));
    if (run.size_field() && !run.size_field()->note().empty()) result.warnings.push_back(run.size_field()->note());
    advance(run, request, options, result);
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

}  // namespace dmo
