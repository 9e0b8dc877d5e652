// DHI's mesh files (.mesh of MIKE 21 and MIKE 3): nodes with a level and a code of the boundary, triangles and quadrilaterals.
// https://docs.mikepoweredbydhi.com/core_libraries/dfs/dfs-file-system/ (Mesh file format)

#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/number_in.h"
#include "core/io/format.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {
namespace {

constexpr TextSyntax kMikeSyntax{};

bool is_whole_word(std::string_view word) { return number_in<long>(word).has_value(); }

/// Whether the file begins with the kind and unit of the levels, which older files leave out, the number of nodes, and the projection; then
/// "1 x y z code".
bool recognises_mike(std::string_view bytes) {
  const auto head = words_of(take_line(bytes).substr(0, 4096));
  const std::size_t numbers = head.size() >= 4 && is_whole_word(head[1]) ? 3 : 1;
  if (head.size() <= numbers || is_whole_word(head[numbers])) return false;
  for (std::size_t i = 0; i < numbers; ++i)
    if (!is_whole_word(head[i]) || head[i].front() == '-') return false;
  const auto node = words_of(take_line(bytes).substr(0, 4096));
  return node.size() == 5 && node[0] == "1" && is_whole_word(node[4]);
}

class MikeReader {
 public:
  MikeReader(SourceFile& source, const IoContext& context)
      : source_(source), tokens_(source.bytes(), source.path().string(), kMikeSyntax, context.progress) {
    source.set_layout({.components = 2, .syntax = kMikeSyntax});
  }

  Mesh read() {
    read_nodes(read_head());
    read_elements();
    if (!tokens_.at_end()) tokens_.fail("the file goes on after its elements");
    return std::move(mesh_);
  }

 private:
  std::size_t read_head() {
    constexpr std::size_t kShortestNode = 10;  // bytes of "1 0 0 0 0\n"
    std::int64_t count = tokens_.read_integer("number of nodes, or kind of the levels");
    const std::size_t at = tokens_.offset(), line = tokens_.line();
    if (is_whole_word(tokens_.token_on_line())) {
      count = tokens_.read_integer("number of nodes");
    } else {
      tokens_.seek(at, line);
    }
    mesh_.title = trimmed(tokens_.rest_of_line());
    if (!mesh_.title.empty()) source_.add_only_in_file(fmt::format("the projection {}", mesh_.title));
    return tokens_.check_count(count, "number of nodes", kShortestNode);
  }

  void read_nodes(std::size_t count) {
    const auto field = [](const char* name, const char* type, const char* role) {
      return Field{.name = name, .on = Field::On::Vertices, .type = type, .role = role};
    };
    Field level = field("elevation", "double", "elevation"), code = field("code", "int", "");
    level.place.with_positions = code.place.with_positions = true;
    level.place.at = 2, code.place.at = 3;  // words behind x
    for (std::vector<double>* values : {&level.values, &code.values}) reserve_large(*values, count);
    reserve_large(mesh_.positions, count);
    source_.reserve_places(count);
    for (std::size_t v = 0; v < count; ++v) {
      if (tokens_.at_end()) tokens_.fail_at_end("number of a node");
      const std::int64_t number = tokens_.read_integer("number of a node");
      if (number != static_cast<std::int64_t>(v) + 1) tokens_.fail(fmt::format("node {} should stand here, not {}", v + 1, number));
      const std::string_view x = tokens_.read_token("x coordinate");
      source_.add_place(tokens_.offset_of(x));
      const double at_x = tokens_.parse_double(x, "x coordinate");
      mesh_.positions.push_back({at_x, tokens_.read_double("y coordinate"), 0.0});
      level.values.push_back(tokens_.read_double("level of a node"));
      code.values.push_back(static_cast<double>(tokens_.read_integer("code of a node")));
      tokens_.end_line_of("a node");
    }
    mesh_.fields.push_back(std::move(level));
    mesh_.fields.push_back(std::move(code));
  }

  void read_elements() {
    constexpr std::size_t kShortestElement = 8;  // bytes of "1 1 2 3\n"
    if (tokens_.at_end()) tokens_.fail_at_end("number of elements");
    const std::size_t count = tokens_.read_count("number of elements", kShortestElement);
    const std::int64_t most = tokens_.read_integer("greatest number of corners");
    const std::int64_t type = tokens_.read_integer("kind of the elements");
    if (type != 21 && type != 25)
      tokens_.fail(fmt::format("elements of kind {}: 21 (triangles) and 25 (and quadrilaterals) are read", type));
    if (most != (type == 21 ? 3 : 4))
      tokens_.fail(fmt::format("elements of kind {} have {} corners at most, not {}", type, type == 21 ? 3 : 4, most));
    tokens_.end_line_of("the head of the elements");
    mesh_.elements.reserve(count, static_cast<std::size_t>(most) * count);
    for (std::size_t e = 0; e < count; ++e) {
      if (tokens_.at_end()) tokens_.fail_at_end("number of an element");
      (void)tokens_.read_integer("number of an element");
      std::array<Index, 4> corners{};
      std::size_t used = 0;
      for (; used < static_cast<std::size_t>(most) && tokens_.more_on_line(); ++used) {
        const std::size_t at = tokens_.offset(), line = tokens_.line();
        if (used == 3 && tokens_.token_on_line() == "0") break;  // a triangle in a file with quadrilaterals
        if (used == 3) tokens_.seek(at, line);
        corners[used] = tokens_.read_index("vertex index", mesh_.positions.size(), "vertices", 1);
      }
      if (used < 3) tokens_.fail(fmt::format("element with {} corners: 3 or 4 are known", used));
      add_element(mesh_, used == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral, std::span(corners).first(used), source_);
      tokens_.end_line_of("an element");
    }
  }

  SourceFile& source_;
  Tokenizer tokens_;
  Mesh mesh_;
};

}  // namespace

constinit const FormatHandler kMikeFormat{
    .info = {"mike", "MIKE mesh", ".mesh",
             "x, y and level, triangles and quadrilaterals, codes of the boundary; only written where it was read"},
    .recognises = recognises_mike,
    .read = read_with<MikeReader>,
    .not_written = "a mesh of MIKE is written only where one was read: write it as .2dm"};

}  // namespace dmoscope
