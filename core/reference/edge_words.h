#pragma once
// Words by which the user names edges of a mesh: by their ends, by the file's groups, or by the chain of feature edges that they belong to.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/reference/domain.h"

namespace dmoscope {

/// Syntax of these words, in one line for --help.
inline constexpr std::string_view kEdgeWords =
    "edges by their ends, ids from 0 (3-4,4-9 or 3-4-9), a group of the file (its name or group:NAME): its lines, or the border of its "
    "faces "
    "or elements, or chain:A-B: feature edges from A-B on both ways up to the next corner";

/// The edges that any of several words names:
///   edges:3-4,4-9       those with these ends, from 0; 3-4-9 stands for both of them
///   chain:3-4           this feature edge and those that continue it, both ways as far as the next vertex that is held, or at which not
///                       exactly two meet; also edges that the rule's kinds name
///   group:NAME          those of a group, by its name, or else by its number: its lines, or the border of its faces or elements. If
///                       groups share a name: lines:NAME, faces:NAME, elements:NAME
/// and, without the text before the colon, the first or the last. Ascending, each once. `domain`: that of the rule; may be null. Throws
/// UsageError, which begins with the word.
[[nodiscard]] std::vector<EdgeEnds> edges_named(const InputMesh& input, const StandingRule& rule, const Domain* domain,
                                                std::span<const std::string> words);

}  // namespace dmoscope
