#include "core/io/polygons/obj_text.h"

#include <string_view>

#include <fmt/format.h>

namespace dmoscope {
namespace {

void check_references(const Tokenizer& tokens, std::string_view token, std::size_t slash) {
  for (int part = 0; slash != std::string_view::npos; ++part) {
    if (part == 2) tokens.fail(fmt::format("expected v, v/vt, v//vn or v/vt/vn, got {}", quote_token(token)));
    const std::size_t next = token.find('/', slash + 1);
    const std::string_view number = token.substr(slash + 1, next == std::string_view::npos ? next : next - slash - 1);
    if (!number.empty()) (void)tokens.parse_integer(number, part == 0 ? "texture coordinate index" : "normal index");
    slash = next;
  }
}

}  // namespace

Vec3 read_obj_vertex(Tokenizer& tokens, std::size_t& place) {
  const std::string_view x = tokens.read_token("x coordinate");
  place = tokens.offset_of(x);
  Vec3 p;
  p.x = tokens.parse_double(x, "x coordinate");
  p.y = tokens.read_double("y coordinate");
  p.z = tokens.read_double("z coordinate");
  return p;
}

std::size_t read_obj_face(Tokenizer& tokens, std::array<std::int64_t, 4>& corners) {
  std::size_t count = 0;
  for (std::string_view token = tokens.token_on_line(); !token.empty(); token = tokens.token_on_line()) {
    const std::size_t slash = token.find('/');
    const std::int64_t index = count < corners.size() ? tokens.parse_integer(token.substr(0, slash), "vertex index") : 1;
    if (count < corners.size()) check_references(tokens, token, slash);
    if (index == 0) tokens.fail("vertex index 0 out of range (OBJ counts from 1)");
    if (count < corners.size()) corners[count] = index;
    ++count;
  }
  if (count != 3 && count != 4) tokens.fail(fmt::format("face with {} corners: only triangles and quadrilaterals are read", count));
  return count;
}

}  // namespace dmoscope
