#pragma once
// The metrics that a person may choose besides the built-in ones.

#include <string>
#include <vector>

#include "core/view/view.h"

namespace dmoscope::ui {

/// Formulas with names of their own, those of the session's runs and the one that is shown; where the active run has a target, metrics
/// against it. All are defined for the active mesh.
[[nodiscard]] std::vector<Metric> further_metrics(const SessionView& session);

/// Targets that fit a mesh, as they are written, with what a list calls them.
struct TargetChoice {
  std::string text, title, doc;
};
[[nodiscard]] std::vector<TargetChoice> target_choices(const InputMesh& input);

}  // namespace dmoscope::ui
