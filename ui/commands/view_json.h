#pragma once
// The view as a JSON object, for a saved session. Members that are not known are ignored; those that are missing keep their value.

#include <string>
#include <string_view>

#include "core/view/view.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// Camera, colours, panels, plots, what is picked: all on one line.
[[nodiscard]] std::string view_json(const ViewState& state);

/// Takes it over. `mesh`: what is open, null for nothing; what is picked must exist there. Throws UsageError that names the member which
/// makes no sense; the state is as it was then.
void apply_view_json(std::string_view text, ViewState& state, const Mesh* mesh);

}  // namespace dmoscope::ui
