#pragma once
// Lines of an OFF file in ASCII.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/vec.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {

/// Meaning of the word before the counts: [ST][C][N]OFF.
struct OffHeader {
  bool texture = false;
  bool colours = false;
  bool normals = false;
};

/// Parses the word; none if it is no such header; a header of four or n dimensions ("4OFF", "nOFF") is none.
[[nodiscard]] std::optional<OffHeader> parse_off_header(std::string_view word);
/// Reads the word, which may be missing.
[[nodiscard]] OffHeader read_off_word(Tokenizer& tokens);

struct OffCounts {
  std::size_t vertices, faces;
};
/// Reads the counts, and goes to the line behind them.
[[nodiscard]] OffCounts read_off_counts(Tokenizer& tokens);

/// Reads a line's vertex; `place` gets its offset, `extras` becomes true if more follows on the line.
[[nodiscard]] Vec3 read_off_vertex(Tokenizer& tokens, std::size_t& place, bool& extras);
/// Reads a line's face, a triangle or quadrilateral of `vertices` vertices; `extras` becomes true if more follows on the line.
[[nodiscard]] std::span<const Index> read_off_face(Tokenizer& tokens, std::size_t vertices, std::array<Index, 4>& corner, bool& extras);
[[nodiscard]] std::string wrong_off_corners(std::int64_t corners);

}  // namespace dmoscope
