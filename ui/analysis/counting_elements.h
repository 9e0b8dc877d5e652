#pragma once
// Which elements count: those of one category looked at alone, and the worst few. No ImGui, no OpenGL.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/view/view.h"
#include "ui/state/colouring_state.h"

namespace dmoscope::ui {

/// Whether `isolation` names something of this mesh; else why not.
[[nodiscard]] std::optional<std::string> why_unknown(const Isolation& isolation, const InputMesh& input);

/// `run`: whose colour classes and fixed vertices count; null: none. Of a vertex' own category (valence, colour class, boundary) the
/// elements around it are members. Null: all elements count.
[[nodiscard]] std::shared_ptr<const std::vector<std::uint8_t>> members_of(const ColouringState& state, const Frame& frame,
                                                                          const RunView* run);

}  // namespace dmoscope::ui
