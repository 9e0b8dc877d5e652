#include "mpi/mesh/vertex_marks.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/number_in.h"

namespace dmoscope {
namespace {

[[noreturn]] void fail(const std::string& word, const std::string& what) { throw UsageError(fmt::format("--fix {}: {}", word, what)); }

}  // namespace

SharedVertexWords::SharedVertexWords(const std::vector<std::string>& words) {
  for (const std::string& word : words) words_.push_back(read(word));
}

SharedVertexWords::Word SharedVertexWords::read(const std::string& text) {
  Word word{text};
  const std::size_t colon = text.find(':');
  const std::string_view whole = text, head = whole.substr(0, colon == std::string::npos ? 0 : colon);
  const std::string_view rest = whole.substr(colon == std::string::npos ? 0 : colon + 1);
  const bool is_list = !whole.empty() && whole.find_first_not_of("0123456789,-") == std::string_view::npos;
  if (head == "vertices" || is_list)
    word.ranges = parse_number_list(is_list ? whole : rest, "--fix " + text);
  else if (head == "box")
    word.box = parse_box(rest, "--fix " + text);
  else if (head == "data" || head == "point-data" || head == "cell-data")
    read_data(word, rest);
  else if (head == "group" || head == "points")
    word.group = rest;
  else if (whole.find('=') != std::string_view::npos)
    read_data(word, whole);
  else
    word.group = whole;
  return word;
}

void SharedVertexWords::read_data(Word& word, std::string_view text) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string_view::npos) fail(word.text, "data are named as in mat_id=3 or mat_id=3,5");
  word.field = text.substr(0, equals);
  for (const std::string_view part : split_at_commas(text.substr(equals + 1))) {
    const auto value = number_in<double>(part);
    if (!value) fail(word.text, fmt::format("'{}' is no number", part));
    word.values.push_back(*value);
  }
}

FieldFilter SharedVertexWords::fields() const {
  FieldFilter filter;
  for (const Word& word : words_)
    if (!word.field.empty()) filter.names.push_back(word.field);
  return filter;
}

BlockMarks SharedVertexWords::find(const World& world, const MeshBlock& block) const {
  BlockMarks marks;
  if (words_.empty()) return marks;
  marks.vertices.resize(block.positions.size());
  marks.elements.resize(block.kinds.size());
  for (const Word& word : words_) {
    bool any = false;
    world.together([&] { any = mark(world, block, word, marks); });
    const bool anywhere = world.any(any);
    world.together([&] {
      if (!anywhere) fail(word.text, word.box.limits.empty() ? "it names no vertex of this mesh" : "no vertex lies in this box");
    });
  }
  return marks;
}

bool SharedVertexWords::mark(const World& world, const MeshBlock& block, const Word& word, BlockMarks& marks) {
  const WholeIndex first = block.vertices.begin(world.rank()), end = block.vertices.end(world.rank());
  bool any = false;
  const auto take = [&](WholeIndex v) {
    if (v < first || v >= end) return;
    marks.vertices[v - first] = 1;
    any = true;
  };
  for (const NumberRange& range : word.ranges) {
    if (range.last >= block.vertices.size())
      fail(word.text, fmt::format("there is no vertex {} (the mesh has {}, counted from 0)", range.last, block.vertices.size()));
    for (WholeIndex v = std::max(range.first, first); v <= range.last && v < end; ++v) take(v);
  }
  if (!word.group.empty()) {
    const auto found =
        std::find_if(block.strings.begin(), block.strings.end(), [&](const VertexString& s) { return s.name == word.group; });
    if (found == block.strings.end())
      fail(word.text, "neither a list of vertices like 3,7-9 nor one of the mesh's boundary strings nor its data with a number (mat_id=3)");
    for (const WholeIndex v : found->vertices) take(v);
  }
  for (std::size_t v = 0; v < block.positions.size(); ++v)
    if (word.box.has(block.positions[v])) take(first + v);
  return mark_field(block, word, marks) || any;
}

bool SharedVertexWords::mark_field(const MeshBlock& block, const Word& word, BlockMarks& marks) {
  bool any = false, known = word.field.empty();
  for (const BlockField& field : block.fields) {
    if (field.name != word.field || known) continue;
    known = true;
    std::vector<std::uint8_t>& of = field.on == Field::On::Vertices ? marks.vertices : marks.elements;
    for (std::size_t i = 0; i < field.values.size(); ++i) {
      if (std::ranges::find(word.values, field.values[i]) == word.values.end()) continue;
      of[i] = 1;
      any = true;
    }
  }
  if (!known) fail(word.text, fmt::format("the file has no data {} with one number each", word.field));
  return any;
}

}  // namespace dmoscope
