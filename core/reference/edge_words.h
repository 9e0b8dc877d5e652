#pragma once
// Words by which a person names edges of a mesh: by their ends, by the file's groups, or by the chain of feature edges that they belong to.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/reference/domain.h"

namespace dmoscope {

/// How such words are written, in one line for --help.
inline constexpr std::string_view kEdgeWords =
    "edges by their ends, ids from 0 (3-4,4-9 or 3-4-9), a group of the file (its name or group:NAME): its lines, or the border of its "
    "faces "
    "or elements, or chain:A-B: feature edges from A-B on both ways up to the next corner";

/// The edges that any of several words names:
///   edges:3-4,4-9       by their ends from 0; 3-4-9 are both of them
///   chain:3-4           this feature edge and those that continue it, both ways as far as the next vertex that is held, or where other
///   than
///                       two meet; also edges that the rule's kinds name
///   group:NAME          of a group by its name, or else by its number: its lines, or the border of its faces or elements. Where groups
///   share a
///                       name: lines:NAME, faces:NAME, elements:NAME
/// and, without what stands before the colon, the first or the last. Ascending, each once. `domain`: by the rule; may be null. Throws
/// UsageError, which begins with the word.
[[nodiscard]] std::vector<EdgeEnds> edges_named(const InputMesh& input, const StandingRule& rule, const Domain* domain,
                                                std::span<const std::string> words);

}  // namespace dmoscope
