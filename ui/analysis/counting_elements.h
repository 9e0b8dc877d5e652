#pragma once
// Elements that count: those of the only category on show, and the worst few. No ImGui, no OpenGL.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/view/view.h"
#include "ui/state/colouring_state.h"

namespace dmoscope::ui {

/// Reason why `isolation` names nothing of this mesh; none if it does.
[[nodiscard]] std::optional<std::string> why_unknown(const Isolation& isolation, const InputMesh& input);

/// Marks of the elements that count, one per element; null: all do. `run`: run whose colour classes and fixed vertices are taken; null:
/// none. In a category of vertices (valence, colour class, boundary) the elements around them are members.
[[nodiscard]] std::shared_ptr<const std::vector<std::uint8_t>> members_of(const ColouringState& state, const Frame& frame,
                                                                          const RunView* run);

}  // namespace dmoscope::ui
