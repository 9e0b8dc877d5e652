#pragma once
// Statements of Wavefront OBJ that make a mesh.

#include <array>
#include <cstdint>

#include "core/base/vec.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {

inline constexpr TextSyntax kObjSyntax{.comment = '#', .backslash_joins_lines = true};

/// Reads three or four corners behind the word "f", "v", "v/vt", "v//vn" or "v/vt/vn" each; returns their number. Their vertices count from
/// 1, or back from the vertex read last (-1); none is 0.
[[nodiscard]] std::size_t read_obj_face(Tokenizer& tokens, std::array<std::int64_t, 4>& corners);

}  // namespace dmoscope
