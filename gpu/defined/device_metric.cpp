#include "gpu/defined/device_metric.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/formula/evaluator.h"
#include "core/smooth/kernels/targets/star_targets.h"
#include "core/smooth/kernels/targets/tetrahedron_targets.h"
#include "core/smooth/methods/star_kernels.h"
#include "gpu/defined/formula_source.h"
#include "gpu/defined/program_table.h"

namespace dmoscope::gpu {

namespace {

/// Greatest size of a stretch: device memory for its stars, in bytes, and visits.
constexpr std::size_t kStretchBytes = std::size_t{64} << 20U, kStretchVisits = std::size_t{1} << 16U;
/// Greatest number of lanes that run programs at once, enough for any device; and the greatest size of their registers, in bytes.
constexpr std::size_t kMostLanes = std::size_t{1} << 16U, kRegisterBytes = std::size_t{256} << 20U;
constexpr std::size_t kSearchers = kFormulaWarp, kTeam = 8;  // lanes of a team

/// All programs' code, one after the other.
class Code {
 public:
  explicit Code(const DefinedJudge& judge) : judge_(judge) {}

  void add(const FormulaProgram* program) {
    Place& place = places_.emplace_back();
    if (program == nullptr) return;
    place = {program, constants.size(), given.size(), steps.size(), prepared.size()};
    append(constants, program->constants);
    append(given, program->given);
    append(given, program->varying);
    append(steps, program->beforehand);
    append(steps, program->steps);
    if (program->use != FormulaUse::Elements) return;
    prepared.resize(prepared.size() + program->uniforms);
    prepare(
        *program, [this](const FormulaInput& input) { return judge_.given(input, 0, judge_.targets().of(0), 1.0); },
        prepared.data() + place.prepared);
  }
  /// The programs with pointers into the device's copies of what was added.
  [[nodiscard]] std::vector<ProgramCode> seen(const FormulaProgram::Constant* constants_at, const FormulaProgram::Given* given_at,
                                              const FormulaStep* steps_at, const double* prepared_at) const {
    std::vector<ProgramCode> codes;
    for (const Place& place : places_) {
      ProgramCode& code = codes.emplace_back();
      if (place.program == nullptr) continue;
      const FormulaProgram& program = *place.program;
      const auto count = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
      code.constants = constants_at + place.constants;
      code.given = given_at + place.given;
      code.varying = code.given + program.given.size();
      code.beforehand = steps_at + place.steps;
      code.steps = code.beforehand + program.beforehand.size();
      code.prepared = prepared_at + place.prepared;
      code.constant_count = count(program.constants);
      code.given_count = count(program.given);
      code.varying_count = count(program.varying);
      code.beforehand_count = count(program.beforehand);
      code.step_count = count(program.steps);
      code.uniforms = program.uniforms;
      code.result = program.result;
      code.ceiling = program.ceiling.value_or(ProgramCode::kNoCeiling);
    }
    return codes;
  }
  /// The greatest number of registers that a program needs.
  [[nodiscard]] std::size_t registers() const {
    std::size_t most = 1;
    for (const Place& place : places_)
      if (place.program != nullptr) most = std::max<std::size_t>(most, place.program->registers);
    return most;
  }

  std::vector<FormulaProgram::Constant> constants;
  std::vector<FormulaProgram::Given> given;
  std::vector<FormulaStep> steps;
  std::vector<double> prepared;

 private:
  struct Place {
    const FormulaProgram* program = nullptr;
    std::size_t constants = 0, given = 0, steps = 0, prepared = 0;
  };
  template <class T>
  static void append(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
  }
  const DefinedJudge& judge_;
  std::vector<Place> places_;
};

/// Number of matrices before an element's first one, by element.
std::vector<std::uint32_t> first_matrices(const TargetTable& targets, std::size_t elements, std::size_t numbers) {
  std::vector<std::uint32_t> first(elements, 0);
  for (Index e = 0; e < elements; ++e)
    if (const double* matrices = targets.of(e).matrices; matrices != nullptr)
      first[e] = static_cast<std::uint32_t>(static_cast<std::size_t>(matrices - targets.matrices().data()) / numbers);
  return first;
}

}  // namespace

DeviceMetric::DeviceMetric(std::shared_ptr<Queue> queue, const SmoothingTask& task, const Task& mesh)
    : queue_(std::move(queue)), judge_(task.input->quality_context().judge(task.metric)) {
  const InputMesh& input = *task.input;
  const SearchParameters& parameters = task.search;
  const ProgramTable table(input, *judge_);
  const TargetTable& targets = judge_->targets();
  task_.is_volume = input.is_volume();
  task_.in_double = parameters.precision == Precision::Double || judge_->needs_double();
  upload_programs(table);
  const auto upload = [this]<class T>(Buffer<T>& buffer, std::span<const T> content) {
    buffer = Buffer<T>(queue_, content);
    return buffer.data();
  };
  std::vector<double> steepness;
  for (const ElementGroup& group : table.groups()) steepness.push_back(group.steepness);
  task_.steepness_of_group = upload(steepness_, std::span<const double>(steepness));
  task_.matrices = upload(matrices_, targets.matrices());
  const std::vector<std::uint32_t> first = first_matrices(targets, input.mesh.elements.size(), input.is_volume() ? 9 : 4);
  task_.first_matrix = upload(first_matrix_, std::span<const std::uint32_t>(first));
  task_.given = judge_->numbers();
  task_.given.fields = upload(fields_, judge_->fields());
  task_.search = {.vertex_of_rank = mesh.vertex_of_rank,
                  .star_offsets = mesh.mesh.star_offsets,
                  .incidences = mesh.mesh.incidences,
                  .group_of_element = upload(groups_, table.group_of_element()),
                  .omega = parameters.omega,
                  .grid_points = parameters.grid_points,
                  .levels = parameters.levels,
                  .unit_matters = judge_->unit_matters()};
  if (has_target_kernel(input, task.metric, parameters)) upload_targets(task);
  lay_out(input, *task.colouring, table);
  const auto source = formula_source(table, {task_.is_volume, task_.in_double});
  compiled_ = source ? queue_->compile(*source) : Queue::Compiled{nullptr, "it is too long"};
}

void DeviceMetric::upload_programs(const ProgramTable& table) {
  Code code(*judge_);
  for (const FormulaProgram* program : table.programs()) code.add(program);
  steps_ = {queue_, std::span<const FormulaStep>(code.steps)};
  given_ = {queue_, std::span<const FormulaProgram::Given>(code.given)};
  constants_ = {queue_, std::span<const FormulaProgram::Constant>(code.constants)};
  prepared_ = {queue_, std::span<const double>(code.prepared)};
  const std::vector<ProgramCode> codes = code.seen(constants_.data(), given_.data(), steps_.data(), prepared_.data());
  programs_ = {queue_, std::span<const ProgramCode>(codes)};
  task_.programs = programs_.data();
  registers_of_lane_ = code.registers();
}

void DeviceMetric::upload_targets(const SmoothingTask& task) {
  const InputMesh& input = *task.input;
  const TargetTable& targets = judge_->targets();
  if (input.is_volume()) {
    const TetrahedronTargets tetrahedra(targets, input.mesh);
    if (!tetrahedra.any()) return;
    task_.crossed = tetrahedra.crossed();
    star_targets_ = {queue_, tetrahedra.all_numbers(), task.pool};
    fits_ = {queue_, tetrahedra.fits(), task.pool};
  } else {
    task_.crossed = has_crossed_targets(targets, static_cast<Index>(input.mesh.elements.size()));
    const StarTable table = build_star_table(input.mesh, input.topology, *task.colouring, task.pool);
    const StarTargets stars = build_star_targets(targets, task_.crossed, input.mesh, input.topology, table, task.pool);
    star_targets_ = {queue_, std::span<const double>(stars.numbers), task.pool};
    first_target_ = {queue_, std::span<const std::uint32_t>(stars.first), task.pool};
  }
  task_.star_targets = star_targets_.data();
  task_.first_target = first_target_.data();
  task_.fits = fits_.data();
}

/// Cuts the visits into stretches, each within a class, and gives every element of a star its place among its stretch's numbers.
void DeviceMetric::lay_out(const InputMesh& input, const Colouring& colouring, const ProgramTable& table) {
  const std::size_t bytes_of_number = task_.in_double ? sizeof(double) : sizeof(float);
  std::vector<std::uint32_t> numbers_at(input.topology.incidences().size(), 0);
  std::size_t most_numbers = 0, most_visits = 0;
  for (Index c = 0; c < colouring.class_count(); ++c) {
    std::size_t numbers = 0;
    for (std::size_t rank = colouring.class_offsets[c]; rank < colouring.class_offsets[c + 1]; ++rank) {
      const Index vertex = colouring.order[rank];
      const auto star = input.topology.star(vertex);
      std::size_t needed = 0;
      for (const Incidence& at : star) needed += table.for_places(at).uniforms;
      const bool full =
          !stretches_.empty() && ((numbers + needed) * bytes_of_number > kStretchBytes || rank - stretches_.back() >= kStretchVisits);
      if (rank == colouring.class_offsets[c] || full) {
        stretches_.push_back(rank);
        numbers = 0;
      }
      for (std::size_t i = 0; i < star.size(); ++i) {
        numbers_at[input.topology.star_offsets()[vertex] + i] = static_cast<std::uint32_t>(numbers);
        numbers += table.for_places(star[i]).uniforms;
      }
      most_numbers = std::max(most_numbers, numbers);
      most_visits = std::max(most_visits, rank + 1 - stretches_.back());
    }
  }
  stretches_.push_back(colouring.order.size());
  numbers_at_ = {queue_, std::span<const std::uint32_t>(numbers_at)};
  numbers_ = {queue_, most_numbers * bytes_of_number};
  stars_ = {queue_, most_visits};
  before_ = {queue_, most_visits};
  task_.search.numbers_at = numbers_at_.data();
  task_.search.numbers = numbers_.data();
  task_.search.stars = stars_.data();
  task_.before = before_.data();
  const std::size_t wanted = std::max<std::size_t>(most_visits * kSearchers, input.mesh.elements.size());
  const std::size_t room = kRegisterBytes / (registers_of_lane_ * sizeof(double)) / kSearchers * kSearchers;
  task_.lanes = std::clamp(room, kSearchers, std::min(std::max(wanted, kSearchers), kMostLanes));
  registers_ = {queue_, task_.lanes * registers_of_lane_};
  task_.registers = registers_.data();
}

void DeviceMetric::visit(Task task, std::size_t first, std::size_t last) const {
  task.defined = task_;
  for (auto stretch = std::prev(std::ranges::upper_bound(stretches_, first)); first < last; ++stretch) {
    const std::size_t end = std::min(last, *std::next(stretch));
    task.defined.search.first_of_stretch = *stretch;
    task.defined.search.first = first;
    task.defined.search.visits = end - first;
    launch_visits(task);
    first = end;
  }
}

void DeviceMetric::launch_visits(const Task& task) const {
  const std::size_t visits = task.defined.search.visits;
  const auto launch = [&](Work work, std::size_t team) { queue_->launch(work, kNoMetric, task, std::min(visits, task_.lanes / team)); };
  if (task_.star_targets != nullptr) launch_targets(task);
  launch(Work::PrepareDefined, 1);
  if (compiled_.search)
    queue_->launch_search(*compiled_.search, task.defined.search, visits);
  else
    launch(Work::SearchDefined, kSearchers);
  launch(Work::UntangleDefined, kTeam);
  launch(Work::SettleDefined, 1);
}

/// Planar classes that would leave most of a device's lanes idle are visited by teams.
void DeviceMetric::launch_targets(const Task& task) const {
  const std::size_t visits = task.defined.search.visits;
  const bool few = visits * kTeamShare <= queue_->lanes_at_once();
  const Work work = task_.is_volume ? Work::SearchTargets : few ? Work::VisitTargetsInTeam : Work::VisitTargets;
  queue_->launch(work, kNoMetric, task, std::min(visits, task_.lanes / (work == Work::VisitTargets ? 1 : kTeam)));
}

void DeviceMetric::judge(Task task) const {
  task.defined = task_;
  queue_->launch(Work::JudgeDefined, kNoMetric, task, std::min(task.element_count, task_.lanes));
}

void DeviceMetric::warm_up(const Task& task) const {
  if (stretches_.size() < 2) return;
  visit(task, 0, 1);
  if (task_.star_targets == nullptr || task_.is_volume) return;
  Task other = task;  // few enough to be visited by teams
  other.defined = task_;
  other.defined.search.visits = 1;
  queue_->launch(Work::VisitTargets, kNoMetric, other, 1);
}

std::string DeviceMetric::description() const {
  return compiled_.search ? fmt::format("the metric compiled by {}", compiled_.how)
                          : fmt::format("the metric run step by step: {}", compiled_.how);
}

}  // namespace dmoscope::gpu
