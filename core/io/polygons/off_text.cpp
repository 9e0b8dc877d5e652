#include "core/io/polygons/off_text.h"

#include <fmt/format.h>

namespace dmoscope {

std::optional<OffHeader> parse_off_header(std::string_view word) {
  OffHeader header;
  const auto eat = [&word](std::string_view prefix) {
    if (!word.starts_with(prefix)) return false;
    word.remove_prefix(prefix.size());
    return true;
  };
  header.texture = eat("ST");
  header.colours = eat("C");
  header.normals = eat("N");
  if (word != "OFF") return std::nullopt;
  return header;
}

OffHeader read_off_word(Tokenizer& tokens) {
  if (tokens.at_end()) tokens.fail_at_end("OFF");
  const std::size_t begin = tokens.offset();
  const std::string_view word = tokens.token_on_line();
  if (const auto found = parse_off_header(word)) return *found;
  if (word.front() < '0' || word.front() > '9' || word.find("OFF") != std::string_view::npos)
    tokens.fail(fmt::format("expected OFF (or a form of it such as COFF, NOFF, STOFF), got {}", quote_token(word)));
  tokens.seek(begin, tokens.line());  // the word may be missing
  return {};
}

OffCounts read_off_counts(Tokenizer& tokens) {
  constexpr std::size_t kShortestVertex = 6;  // bytes of "0 0 0\n"
  constexpr std::size_t kShortestFace = 8;    // bytes of "3 0 1 2\n"
  if (tokens.at_end()) tokens.fail_at_end("number of vertices");
  const std::size_t vertices = tokens.read_count("number of vertices", kShortestVertex);
  const std::size_t faces = tokens.read_count("number of faces", kShortestFace);
  tokens.end_line();  // the number of edges, which is unused and sometimes missing
  return {vertices, faces};
}

Vec3 read_off_vertex(Tokenizer& tokens, std::size_t& place, bool& extras) {
  place = tokens.offset();
  Vec3 p;
  p.x = tokens.read_double("x coordinate");
  p.y = tokens.read_double("y coordinate");
  p.z = tokens.read_double("z coordinate");
  extras = tokens.more_on_line() || extras;
  tokens.end_line();
  return p;
}

std::span<const Index> read_off_face(Tokenizer& tokens, std::size_t vertices, std::array<Index, 4>& corner, bool& extras) {
  const std::int64_t corners = tokens.read_integer("number of corners");
  if (corners != 3 && corners != 4) tokens.fail(wrong_off_corners(corners));
  const std::span<Index> used(corner.data(), static_cast<std::size_t>(corners));
  for (Index& c : used) c = tokens.read_index("vertex index", vertices, "vertices");
  extras = tokens.more_on_line() || extras;
  tokens.end_line();
  return used;
}

std::string wrong_off_corners(std::int64_t corners) {
  return fmt::format("face with {} corners: only triangles and quadrilaterals are read", corners);
}

}  // namespace dmoscope
