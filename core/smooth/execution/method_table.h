#pragma once
// Every smoothing method: what it is called, what it can do, and what makes it. To add a method is a row here and a source in methods/.

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
  bool optimises = true;        // the metric; else it only judges what the method does
  bool planar_only = false;     // not of volumes
  bool untangles = false;       // worth a try where another leaves elements inverted
  bool accelerated = false;     // accelerators can do it
  bool searches_grid = false;   // reads SearchParameters
  bool relaxes = false;         // reads MethodOptions::relaxation
  bool joint = false;           // an iteration moves a cluster of vertices together; visits of chosen ones are dmo's
  bool has_directions = false;  // reads MethodOptions::directions and seed
};
/// The methods this version has.
[[nodiscard]] std::span<const MethodInfo> method_table();
/// Throws UsageError that lists the known ones.
[[nodiscard]] const MethodInfo& method_info(std::string_view name);

/// Can the method optimise such a combination? Joint moves know metrics alone.
[[nodiscard]] bool can_combine(const MethodInfo& method, const CompositeTerms& combination);

/// A mix that is refused, and the reason: all other mixes of method, objective, boundary and phases work, but for what joint moves cannot
/// split into smooth pieces (see why_not_joint).
struct Refusal {
  std::string_view mix, why;
  bool (*applies)(const SmoothingTask&);  // of its pointers only `input` is read
};
[[nodiscard]] std::span<const Refusal> refusals();

/// After how many iterations in a row in which no vertex moved none will move any more; none: one can never tell. A method that looks along
/// one direction an iteration may find nothing there, and something along the next. `volume`: whether it looks in space.
[[nodiscard]] std::optional<std::uint64_t> still_iterations(const MethodInfo& method, const MethodOptions& options, bool volume);

/// Throws UsageError for an unknown method, for parameters out of range, for a metric that is not defined for the mesh or not for the
/// method, or for a combination that is not possible. Of the task's pointers only `input` is read.
void require_possible(const SmoothingTask& task);

/// Makes the smoother for a task on the CPU. Throws as require_possible does.
[[nodiscard]] std::unique_ptr<Smoother> make_smoother(const SmoothingTask& task);

}  // namespace dmoscope
