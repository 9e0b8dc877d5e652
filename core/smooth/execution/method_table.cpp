#include "core/smooth/execution/method_table.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/input/mesh_share.h"
#include "core/joint/joint_clusters.h"
#include "core/smooth/methods/dmo.h"
#include "core/smooth/methods/dvr.h"
#include "core/smooth/methods/then_mean.h"
#include "core/smooth/visit/star_judge.h"

namespace dmoscope {

// Makers of smoothers, each defined in a source of methods/; make_smoother() checks the arguments.
std::unique_ptr<Smoother> make_laplace_smoother(const SmoothingTask& task);
std::unique_ptr<Smoother> make_smart_laplace_smoother(const SmoothingTask& task);
std::unique_ptr<Smoother> make_angle_based_smoother(const SmoothingTask& task);
std::unique_ptr<Smoother> make_pattern_search_smoother(const SmoothingTask& task);
std::unique_ptr<Smoother> make_active_set_smoother(const SmoothingTask& task);

namespace {
constexpr auto kMethods = std::to_array<MethodInfo>(
    {{.name = "dmo",
      .doc = "Discrete mesh optimization: best candidate of a grid, three levels (Zint and Grosso 2018)",
      .make = make_dmo_smoother,
      .untangles = true,
      .accelerated = true,
      .searches_grid = true},
     {.name = "laplace",
      .doc = "Laplacian smoothing: to the mean of the edge neighbours, whatever becomes of the elements",
      .make = make_laplace_smoother,
      .optimises = false,
      .untangles = true,
      .relaxes = true},
     {.name = "smart-laplace",
      .doc = "Laplacian smoothing, only where the vertex gains (Freitag 1997)",
      .make = make_smart_laplace_smoother,
      .relaxes = true},
     {.name = "angle-based",
      .doc = "Angle-based smoothing: to the mean of the places that halve the ring's angles, whatever becomes of the elements (Zhou and "
             "Shimada 2000)",
      .make = make_angle_based_smoother,
      .optimises = false,
      .planar_only = true,
      .untangles = true,
      .relaxes = true},
     {.name = "dvr",
      .doc = "Directional vertex relaxation: to the best place on a line, one direction an iteration (Rangarajan and Lew 2017)",
      .make = make_dvr_smoother,
      .has_directions = true},
     {.name = "pattern-search",
      .doc = "Compass search: the best of four steps, which grow or shrink (Park and Shontz 2010)",
      .make = make_pattern_search_smoother},
     {.name = "active-set",
      .doc = "Active-set ascent: along the steepest way on which none of the worst elements loses (Freitag, Jones and Plassmann 1995)",
      .make = make_active_set_smoother},
     {.name = "joint",
      .doc = "Joint moves: a cluster of vertices together, by an interior point, until nothing can raise the worst element",
      .make = make_dmo_smoother,
      .untangles = true,
      .joint = true}});

bool is_guided(const SmoothingTask& task) { return method_info(task.method).optimises; }
bool has_density(const SmoothingTask& task) { return task.combination && task.combination->size() != nullptr; }
bool moves_jointly(const SmoothingTask& task) { return method_info(task.method).joint || task.then_joint; }

constexpr auto kRefusals = std::to_array<Refusal>(
    {{"angle-based in volumes",
      "angle-based is defined only for planar meshes and surfaces: a vertex of a volume has no ring whose angles it could halve",
      [](const SmoothingTask& task) { return method_info(task.method).planar_only && task.input->is_volume(); }},
     {"laplace or angle-based with two aims",
      "laplace and angle-based move vertices whatever becomes of the elements: no objective guides them",
      [](const SmoothingTask& task) { return task.combination && !is_guided(task); }},
     {"density on volumes and curved surfaces", "sizes are of planar meshes in this version",
      [](const SmoothingTask& task) { return has_density(task) && task.input->geometry.shape != Shape::Planar; }},
     {"density, then mean", "a phase that raises the mean would undo the density of a combination",
      [](const SmoothingTask& task) { return has_density(task) && task.then_mean; }},
     {"density with joint moves", "joint moves raise the least of something over all elements, and a density is none",
      [](const SmoothingTask& task) { return has_density(task) && moves_jointly(task); }},
     {"joint, then joint", "joint moves cannot follow joint moves",
      [](const SmoothingTask& task) { return method_info(task.method).joint && task.then_joint; }},
     {"sliding in meshes that wrap", "nothing slides in meshes that go round in longitude",
      [](const SmoothingTask& task) { return task.slides && task.input->geometry.plane.period > 0.0; }}});

}  // namespace

std::span<const MethodInfo> method_table() { return kMethods; }

const MethodInfo& method_info(std::string_view name) {
  const auto found = std::ranges::find(kMethods, name, &MethodInfo::name);
  if (found != kMethods.end()) return *found;
  throw UsageError(unknown_row("method", name, kMethods));
}

bool can_combine(const MethodInfo& method, const CompositeTerms& combination) {
  return method.optimises && !(method.joint && combination.size() != nullptr);
}

std::optional<std::uint64_t> still_iterations(const MethodInfo& method, const MethodOptions& options, bool volume) {
  if (!method.has_directions) return 1;
  const std::uint64_t axes = volume ? 3 : 2;
  return options.directions == Directions::Axes ? std::optional(axes) : std::nullopt;
}

std::span<const Refusal> refusals() { return kRefusals; }

void require_possible(const SmoothingTask& task) {
  (void)method_info(task.method);
  validate(task.search);
  validate(task.options);
  require_defined(task.metric, *task.input);
  if (task.combination) {
    validate(task.metric, *task.combination);
    if (const auto* second = std::get_if<Metric>(&task.combination->second)) require_defined(*second, *task.input);
  }
  for (const Refusal& refusal : kRefusals)
    if (refusal.applies(task)) throw UsageError(std::string(refusal.why));
  if (!moves_jointly(task)) return;
  require_joint(*task.input, {task.metric, task.combination});
}

std::unique_ptr<Smoother> make_smoother(const SmoothingTask& task) {
  require_possible(task);
  std::unique_ptr<Smoother> smoother = method_info(task.method).make(task);
  if (task.then_mean) smoother = then_mean(std::move(smoother), task);
  return task.input->share ? task.input->share->among_others(std::move(smoother), task) : std::move(smoother);
}

}  // namespace dmoscope
