#include "core/smooth/execution/method_table.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/input/mesh_share.h"
#include "core/joint/joint_clusters.h"
#include "core/smooth/methods/active_set_ascent.h"
#include "core/smooth/methods/angle_based.h"
#include "core/smooth/methods/dmo.h"
#include "core/smooth/methods/dvr.h"
#include "core/smooth/methods/laplace.h"
#include "core/smooth/methods/pattern_search.h"
#include "core/smooth/methods/then_mean.h"
#include "core/smooth/visit/star_judge.h"

namespace dmoscope {

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

void require_possible(const Combination& combination, const SmoothingTask& task) {
  validate(task.metric, combination);
  if (!method_info(task.method).optimises)
    throw UsageError(fmt::format("{} moves vertices whatever becomes of the elements: no objective guides it", task.method));
  if (task.then_mean && combination.size() != nullptr)
    throw UsageError("a phase that raises the mean would undo the density of a combination");
  if (combination.size() != nullptr && task.input->geometry.shape != Shape::Planar)
    throw UsageError(fmt::format("sizes are of planar meshes in this version, and the mesh is a {}",
                                 task.input->is_volume() ? "volume" : "curved surface"));
  if (const auto* second = std::get_if<Metric>(&combination.second)) require_defined(*second, *task.input);
}

}  // namespace

std::span<const MethodInfo> method_table() { return kMethods; }

const MethodInfo& method_info(std::string_view name) {
  const auto found = std::ranges::find(kMethods, name, &MethodInfo::name);
  if (found != kMethods.end()) return *found;
  throw UsageError(unknown_row("method", name, kMethods));
}

std::optional<std::uint64_t> still_iterations(const MethodInfo& method, const MethodOptions& options, bool volume) {
  if (!method.has_directions) return 1;
  const std::uint64_t axes = volume ? 3 : 2;
  return options.directions == Directions::Axes ? std::optional(axes) : std::nullopt;
}

void require_possible(const SmoothingTask& task) {
  const MethodInfo& method = method_info(task.method);
  validate(task.search);
  validate(task.options);
  require_defined(task.metric, *task.input);
  if (method.planar_only && task.input->is_volume())
    throw UsageError(fmt::format("{} is defined only for planar meshes and surfaces", method.name));
  if (task.combination) require_possible(*task.combination, task);
  if (task.slides && task.input->geometry.plane.period > 0.0) throw UsageError("nothing slides in meshes that go round in longitude");
  if (method.joint && task.then_joint) throw UsageError("joint moves cannot follow joint moves");
  if (method.joint || task.then_joint) {
    if (task.combination) throw UsageError("joint moves have one aim, and a combination two");
    require_joint(*task.input, task.metric);
  }
}

std::unique_ptr<Smoother> make_smoother(const SmoothingTask& task) {
  require_possible(task);
  std::unique_ptr<Smoother> smoother = method_info(task.method).make(task);
  if (task.then_mean) smoother = then_mean(std::move(smoother), task);
  return task.input->share ? task.input->share->among_others(std::move(smoother), task) : std::move(smoother);
}

}  // namespace dmoscope
