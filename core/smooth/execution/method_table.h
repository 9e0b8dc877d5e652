#pragma once
// Table of all smoothing methods: their names, abilities and makers. A new method is a row here and a source in methods/.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "core/smooth/smoother.h"

namespace dmoscope {

struct MethodInfo {
  std::string_view name, doc;
  std::unique_ptr<Smoother> (*make)(const SmoothingTask&);
  bool optimises = true;        // raises the metric; else it only judges the method's moves
  bool planar_only = false;     // not for volumes
  bool untangles = false;       // worth a try where another leaves elements inverted
  bool accelerated = false;     // accelerators can do it
  bool searches_grid = false;   // reads SearchParameters
  bool relaxes = false;         // reads MethodOptions::relaxation
  bool joint = false;           // an iteration moves a cluster of vertices together; visits of chosen ones are dmo's
  bool has_directions = false;  // reads MethodOptions::directions and seed
};
/// Methods of this version.
[[nodiscard]] std::span<const MethodInfo> method_table();
/// Row of this name. Throws UsageError that lists the known ones.
[[nodiscard]] const MethodInfo& method_info(std::string_view name);

/// Returns whether the method can optimise such a combination. Joint moves know metrics alone.
[[nodiscard]] bool can_combine(const MethodInfo& method, const CompositeTerms& combination);

/// Mix that is refused, and the reason: all other mixes of method, objective, boundary and phases work, but for metrics that joint moves
/// cannot split into smooth pieces (see why_not_joint).
struct Refusal {
  std::string_view mix, why;
  bool (*applies)(const SmoothingTask&);  // reads only `input` of the task's pointers
};
[[nodiscard]] std::span<const Refusal> refusals();

/// Number of iterations in a row without a move after which no vertex will move any more; none: one can never tell. A method that looks
/// along one direction an iteration may find nothing there, and something along the next. `volume`: whether it looks in space.
[[nodiscard]] std::optional<std::uint64_t> still_iterations(const MethodInfo& method, const MethodOptions& options, bool volume);

/// Throws UsageError for an unknown method, for parameters out of range, for a metric that is not defined for the mesh or not for the
/// method, or for a combination that is not possible. Reads only `input` of the task's pointers.
void require_possible(const SmoothingTask& task);

/// Makes the smoother for a task on the CPU. Throws as require_possible does.
[[nodiscard]] std::unique_ptr<Smoother> make_smoother(const SmoothingTask& task);

}  // namespace dmoscope
