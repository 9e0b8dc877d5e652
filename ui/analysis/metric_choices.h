#pragma once
// Metrics that a person may choose besides the built-in ones.

#include <string>
#include <vector>

#include "core/view/view.h"

namespace dmoscope::ui {

/// Formulas with names of their own, those of the session's runs and the one that is shown; if the active run has a target, metrics against
/// it. All are defined for the active mesh.
[[nodiscard]] std::vector<Metric> further_metrics(const SessionView& session);

/// A target that fits a mesh, as it is written, with its name in lists.
struct TargetChoice {
  std::string text, title, doc;
};
[[nodiscard]] std::vector<TargetChoice> target_choices(const InputMesh& input);

}  // namespace dmoscope::ui
