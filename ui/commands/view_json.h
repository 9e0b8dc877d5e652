#pragma once
// The view as a JSON object, for a saved session. Members that are not known are ignored; those that are missing keep their value.

#include <string>
#include <string_view>

#include "core/view/view.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// Camera, colours, panels, plots and pick as JSON on one line.
[[nodiscard]] std::string view_json(const ViewState& state);

/// Takes over a view. `mesh`: the open mesh, null for none; the pick must exist there. Throws UsageError that names the invalid member; the
/// state is then unchanged.
void apply_view_json(std::string_view text, ViewState& state, const Mesh* mesh);

}  // namespace dmoscope::ui
